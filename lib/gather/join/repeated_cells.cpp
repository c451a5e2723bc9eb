#include "repeated_cells.h"

#include <algorithm>
#include <array>

#include "buckets.h"
#include "memory.h"
#include "mix.h"
#include "point_set.h"
#include "wrapped_mesh.h"

namespace tetstream {

namespace {

constexpr uint64_t kBlock = 4096;  // cells whose kept ones are counted together

// Calls visit(first, count, corners) for the cells of a mesh.
template <class Visit>
void forCells(IndexedSource& mesh, Visit visit) {
  std::vector<int64_t> corners(4 * kRowsAtOnce);
  const auto cells = static_cast<uint64_t>(mesh.schema().cell_count);
  for (uint64_t at = 0; at < cells; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells - at));
    mesh.readCells(at, n, corners.data());
    visit(at, n, corners.data());
  }
}

// Of the points as they are now, those that several pieces have.
struct SharedPoints {
  SharedPoints(IndexedSource& mesh, PointJoin& points, Account& account)
      : set(account, points.count()) {
    const int64_t before = mesh.schema().vertex_count;
    for (int64_t point = 0; point < before; ++point)
      if (const int64_t first = points.firstOf(point); first != point)
        count += set.add(static_cast<uint64_t>(points.newOf(static_cast<uint64_t>(first))));
  }
  bool has(int64_t point) const { return set.has(static_cast<uint64_t>(point)); }
  // Of cells with all corners among them there are hardly more than meshes have to a point.
  uint64_t mostCells(uint64_t cells) const { return std::min(kCellsToAPoint * count, cells); }

  static constexpr uint64_t kCellsToAPoint = 8;
  PointSet set;
  uint64_t count = 0;
};

}  // namespace

struct RepeatedCells::Row {
  std::array<int64_t, 4> corners;  // sorted, as they are now
  uint64_t cell, piece;
  bool operator<(const Row& other) const {
    return corners != other.corners ? corners < other.corners : cell < other.cell;
  }
  size_t bucketOf(size_t count) const {
    uint64_t sum = 0;
    for (const int64_t corner : corners) sum = mix(sum ^ static_cast<uint64_t>(corner));
    return static_cast<size_t>(sum % count);
  }
};

struct RepeatedCells::Marks {
  explicit Marks(uint64_t cells)
      : dropped(account, cells), kept_before(account, static_cast<size_t>(cells / kBlock + 1)) {}
  Account account;
  PointSet dropped;
  Array<uint64_t> kept_before;  // each block
};

RepeatedCells::~RepeatedCells() = default;

RepeatedCells::RepeatedCells(IndexedSource& mesh, PointJoin& points)
    : cells_(static_cast<uint64_t>(mesh.schema().cell_count)) {
  Account account;
  const SharedPoints shared(mesh, points, account);
  if (shared.count < 4) return;
  const std::vector<uint64_t>& pieces = points.plan().first_points;
  Buckets<Row> rows(bucketsFor(shared.mostCells(cells_), sizeof(Row)), points.plan().temp_dir);
  forCells(mesh, [&](uint64_t first, size_t count, const int64_t* corners) {
    for (size_t i = 0; i < count; ++i) {
      Row row{{}, first + i, 0};
      const auto point = static_cast<uint64_t>(corners[4 * i]);
      row.piece = static_cast<uint64_t>(std::upper_bound(pieces.begin(), pieces.end(), point) -
                                        pieces.begin());
      bool are_shared = true;
      for (size_t j = 0; j < 4 && are_shared; ++j) {
        row.corners[j] = points.newOf(static_cast<uint64_t>(corners[4 * i + j]));
        are_shared = shared.has(row.corners[j]);
      }
      if (!are_shared) continue;
      std::sort(row.corners.begin(), row.corners.end());
      rows.add(row.bucketOf(rows.count()), row);
    }
  });
  for (size_t bucket = 0; bucket < rows.count(); ++bucket) {
    const Array<Row> sorted = rows.take(bucket, account);
    take(sorted.data(), sorted.size());
  }
  if (marks_) countKept();
}

// Two of one piece are as the file has them.
void RepeatedCells::take(const Row* rows, size_t count) {
  for (size_t i = 0, first = 0; i < count; ++i) {
    if (rows[i].corners != rows[first].corners) first = i;
    if (rows[i].piece != rows[first].piece) drop(rows[i].cell);
  }
}

void RepeatedCells::drop(uint64_t cell) {
  if (!marks_) marks_ = std::make_unique<Marks>(cells_);
  marks_->dropped.add(cell);
  ++count_;
}

void RepeatedCells::countKept() {
  uint64_t kept = 0;
  for (uint64_t cell = 0; cell < cells_; ++cell) {
    if (cell % kBlock == 0) marks_->kept_before[static_cast<size_t>(cell / kBlock)] = kept;
    kept += !marks_->dropped.has(cell);
  }
}

bool RepeatedCells::has(uint64_t cell) const {
  return marks_ && marks_->dropped.has(cell);
}

uint64_t RepeatedCells::oldOf(uint64_t cell) const {
  if (!marks_) return cell;
  const Array<uint64_t>& before = marks_->kept_before;
  const auto blocks = static_cast<ptrdiff_t>((cells_ + kBlock - 1) / kBlock);
  const auto block = std::upper_bound(before.data(), before.data() + blocks, cell) - 1;
  uint64_t old = kBlock * static_cast<uint64_t>(block - before.data());
  for (uint64_t left = cell - *block;; ++old) {
    if (has(old)) continue;
    if (left-- == 0) return old;
  }
}

namespace {

class DistinctCells final : public WrappedMesh {
 public:
  DistinctCells(std::unique_ptr<IndexedSource> mesh, std::shared_ptr<const RepeatedCells> repeated)
      : WrappedMesh(*mesh),
        mesh_(std::move(mesh)),
        repeated_(std::move(repeated)),
        schema_(mesh_->schema()) {
    schema_.cell_count -= static_cast<int64_t>(repeated_->count());
  }

  const Schema& schema() const override { return schema_; }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    forRuns(first, count,
            [&](uint64_t cell, size_t n, size_t at) { mesh_->readCells(cell, n, out + 4 * at); });
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    const size_t bytes = schema_.cell_data[column].bytesPerRow();
    forRuns(first, count, [&](uint64_t cell, size_t n, size_t at) {
      mesh_->readCellData(column, cell, n, static_cast<unsigned char*>(out) + bytes * at);
    });
  }

 private:
  // read(cell that there was, so many, to row): those without one to drop between them.
  template <class Read>
  void forRuns(uint64_t first, size_t count, Read read) {
    uint64_t cell = count > 0 ? repeated_->oldOf(first) : 0;
    for (size_t at = 0; at < count;) {
      while (repeated_->has(cell)) ++cell;
      size_t n = 1;
      while (at + n < count && !repeated_->has(cell + n)) ++n;
      read(cell, n, at);
      at += n;
      cell += n;
    }
  }

  std::unique_ptr<IndexedSource> mesh_;
  std::shared_ptr<const RepeatedCells> repeated_;
  Schema schema_;
};

}  // namespace

std::unique_ptr<IndexedSource> withoutCells(std::unique_ptr<IndexedSource> mesh,
                                            std::shared_ptr<const RepeatedCells> repeated) {
  return std::make_unique<DistinctCells>(std::move(mesh), std::move(repeated));
}

}  // namespace tetstream
