// Faces and the faces of cells come together by their corners: hashed into buckets that fit into
// memory, each of which is sorted.
#include "exodus_sides.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "exodus_blocks.h"
#include "face_key.h"
#include "label_column.h"
#include "point_set.h"
#include "rows_at_once.h"
#include "winding.h"

namespace tetstream {

namespace {

constexpr size_t kBuckets = 64;

struct Row {
  FaceKey key;
  int32_t element;  // 0: the labelled face itself
  int32_t is_down;  // whether its corners are (isWoundDown); rows of a file have no gaps
  int64_t side_or_label;
  uint64_t rank;  // of labelled faces
  bool operator<(const Row& other) const {
    return std::tie(key, element, rank) < std::tie(other.key, other.element, other.rank);
  }
};

class FaceRows {
 public:
  explicit FaceRows(const std::string& temp_dir) : buckets_(kBuckets, temp_dir) {}
  Buckets<Row>& buckets() { return buckets_; }
  void add(const int64_t corners[3], int64_t element, int64_t side_or_label, uint64_t rank = 0) {
    const FaceKey key = faceKey(corners);
    buckets_.add(bucketOf(key, kBuckets),
                 {key, static_cast<int32_t>(element), isWoundDown(corners), side_or_label, rank});
  }

 private:
  Buckets<Row> buckets_;
};

// Returns how many are left out.
uint64_t addFaces(MeshSpool& mesh, FaceRows& rows, PointSet& points) {
  std::vector<int64_t> corners(3 * kRowsAtOnce), labels(kRowsAtOnce);
  uint64_t left_out = 0;
  std::set<int64_t> known;
  for (uint64_t at = 0; at < mesh.faceCount(); at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh.faceCount() - at));
    mesh.readFaces(at, n, corners.data(), labels.data());
    for (size_t i = 0; i < n; ++i) {
      const int64_t* face = corners.data() + 3 * i;
      const bool may_be_set = ExodusSides::isId(labels[i]) &&
                              (known.size() < kMostGroups || known.count(labels[i]) > 0);
      if (!may_be_set) {
        ++left_out;
        continue;
      }
      known.insert(labels[i]);
      rows.add(face, 0, labels[i], at + i);
      for (int k = 0; k < 3; ++k) points.add(static_cast<uint64_t>(face[k]));
    }
  }
  return left_out;
}

// Of cells, the faces that can be labelled ones.
void addSides(MeshSpool& mesh, RowSpool& elements, FaceRows& rows, const PointSet& points) {
  std::vector<int64_t> cells(4 * kRowsAtOnce);
  for (uint64_t at = 0; at < mesh.cellCount(); at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh.cellCount() - at));
    mesh.readCells(at, n, cells.data());
    for (size_t i = 0; i < n; ++i) {
      const int64_t* cell = &cells[4 * i];
      for (int64_t side = 1; side <= 4; ++side) {
        int places[4];
        exodusSide(CellShape::kTetra, side, places);
        const int64_t face[3] = {cell[places[0]], cell[places[1]], cell[places[2]]};
        if (std::any_of(face, face + 3,
                        [&](int64_t corner) { return !points.has(static_cast<uint64_t>(corner)); }))
          continue;
        const auto element = *static_cast<const int64_t*>(elements.row(at + i));
        rows.add(face, element + 1, side);
      }
    }
  }
}

}  // namespace

struct ExodusSides::Found {
  int64_t label;
  ExodusSide side;
};

ExodusSides::ExodusSides(MeshSpool& mesh, RowSpool& elements, const std::string& temp_dir)
    : temp_dir_(temp_dir) {
  RowSpool found(sizeof(Found), temp_dir);
  if (mesh.faceCount() > 0) find(mesh, elements, found);
  found.finish();
  grouped_ = std::make_unique<GroupedRows<ExodusSide>>(counts_, temp_dir);
  for (uint64_t i = 0; i < found.rows(); ++i) {
    const auto* row = static_cast<const Found*>(found.row(i));
    grouped_->add(row->label, row->side);
  }
  grouped_->finish();
}

void ExodusSides::find(MeshSpool& mesh, RowSpool& elements, RowSpool& found) {
  Account account;
  FaceRows rows(temp_dir_);
  PointSet points(account, mesh.pointCount());
  left_out_ = addFaces(mesh, rows, points);
  addSides(mesh, elements, rows, points);
  for (size_t bucket = 0; bucket < kBuckets; ++bucket) {
    const Array<Row> sorted = rows.buckets().take(bucket, account);
    for (size_t i = 0; i < sorted.size(); ++i) {
      if (sorted[i].element != 0) continue;
      const Row& face = sorted[i];  // the first of those with its corners
      const auto isAgain = [&](size_t k) { return k < sorted.size() && sorted[k].key == face.key; };
      for (; isAgain(i + 1) && sorted[i + 1].element == 0; ++i) ++left_out_;
      if (!isAgain(i + 1)) {
        ++left_out_;  // of no cell
        continue;
      }
      size_t cell = i + 1;
      while (isAgain(cell) && sorted[cell].is_down != face.is_down) ++cell;
      const Row& side = sorted[isAgain(cell) ? cell : i + 1];
      const Found row = {face.side_or_label,
                         {side.element, static_cast<int32_t>(side.side_or_label)}};
      found.append(&row, 1);
      ++counts_[row.label];
    }
  }
}

}  // namespace tetstream
