#include "tets_recovery.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "status.h"
#include "wrapping_parts.h"

namespace tetstream::tets {

using ull = unsigned long long;

constexpr uint64_t kMostTold = 8;

void Losses::add(const std::string& sentence) {
  if (places++ < kMostTold) told.push_back(sentence);
}

namespace {

// Vertices that are missing, and by which ranks the others have after them.
class Gaps {
 public:
  void add(uint64_t first, uint64_t end) {
    gaps_.push_back({first, end, missing() + (end - first)});
  }
  uint64_t missing() const { return gaps_.empty() ? 0 : gaps_.back().missing; }

  // The rank without those that are missing; -1: it is one of them.
  int64_t renumbered(int64_t id) const {
    const auto rank = static_cast<uint64_t>(id);
    const auto after = std::upper_bound(gaps_.begin(), gaps_.end(), rank,
                                        [](uint64_t r, const Gap& gap) { return r < gap.first; });
    if (after == gaps_.begin()) return id;
    const Gap& gap = *(after - 1);
    return rank < gap.end ? -1 : id - static_cast<int64_t>(gap.missing);
  }

 private:
  struct Gap {
    uint64_t first, end, missing;  // up to its end
  };
  std::vector<Gap> gaps_;
};

// The faces of the last cells, so that no label is handed out whose cell is missing: labels come
// with their cells, or not long after. Bounded; what is older is forgotten.
class RecentFaces {
 public:
  void add(const int64_t* cell) {
    if (cells_.size() == 8 * kMost) cells_.erase(cells_.begin(), cells_.begin() + 4 * kMost);
    cells_.insert(cells_.end(), cell, cell + 4);
    is_sorted_ = false;
  }
  bool has(const int64_t* corners) {
    if (!is_sorted_) sort();
    return std::binary_search(faces_.begin(), faces_.end(),
                              sorted({corners[0], corners[1], corners[2]}));
  }

 private:
  using Face = std::array<int64_t, 3>;
  static constexpr size_t kMost = size_t{1} << 16;

  static Face sorted(Face face) {
    std::sort(face.begin(), face.end());
    return face;
  }
  void sort() {
    faces_.clear();
    for (size_t i = 0; i < cells_.size(); i += 4)
      for (size_t j = 0; j < 4; ++j)
        faces_.push_back(
            sorted({cells_[i + (j + 1) % 4], cells_[i + (j + 2) % 4], cells_[i + (j + 3) % 4]}));
    std::sort(faces_.begin(), faces_.end());
    is_sorted_ = true;
  }

  std::vector<int64_t> cells_;
  std::vector<Face> faces_;
  bool is_sorted_ = false;
};

class RecoveredStream final : public Source {
 public:
  RecoveredStream(std::unique_ptr<ByteSource> bytes, std::function<void(const std::string&)> note);
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;

 private:
  void take(const BatchView& in);
  void takeVertices(const BatchView& in);
  void takeCell(const BatchView& in, size_t cell);
  void takeMarks(const BatchView& in);
  void tell();

  std::string name_;
  std::function<void(const std::string&)> note_;
  Losses losses_;
  std::unique_ptr<Source> damaged_;
  Schema schema_;
  int64_t announced_vertices_ = -1, announced_cells_ = -1;

  Gaps gaps_;
  RecentFaces recent_;  // once something is missing
  std::unique_ptr<Batch> batch_;
  uint64_t end_ = 0;  // of the vertices that came, missing ones included
  uint64_t vertices_ = 0, cells_ = 0, cells_left_out_ = 0, faces_left_out_ = 0;
  bool ended_ = false;
};

std::unique_ptr<Source> openOrExplain(std::unique_ptr<ByteSource> bytes, Losses& losses) {
  try {
    return openTolerant(std::move(bytes), losses);
  } catch (const Error& error) {
    if (error.status() != Status::kBadData) throw;
    fail(error.status(), "%s; without a header nothing can be recovered", error.text().c_str());
  }
}

RecoveredStream::RecoveredStream(std::unique_ptr<ByteSource> bytes,
                                 std::function<void(const std::string&)> note)
    : name_(bytes->name()),
      note_(std::move(note)),
      damaged_(openOrExplain(std::move(bytes), losses_)),
      schema_(damaged_->schema()) {
  announced_vertices_ = schema_.vertex_count;
  announced_cells_ = schema_.cell_count;
  // What the header tells is of the whole.
  schema_.vertex_count = schema_.cell_count = schema_.face_count = -1;
  schema_.front_width = schema_.front_span = schema_.front_cells = -1;
  schema_.box_min.clear();
  schema_.box_max.clear();
  batch_ = std::make_unique<Batch>(schema_);
}

bool RecoveredStream::next(BatchView& batch) {
  batch = BatchView{};
  while (!ended_) {
    if (!damaged_->next(batch)) {
      ended_ = true;
      tell();
      return false;
    }
    if (batch.first_vertex > end_) gaps_.add(end_, batch.first_vertex);
    end_ = batch.first_vertex + batch.vertex_count;
    vertices_ += batch.vertex_count;
    if (losses_.places == 0) {
      cells_ += batch.cell_count;
      return true;
    }
    take(batch);
    batch = batch_->view();
    if (!batch_->empty()) return true;
  }
  return false;
}

void RecoveredStream::take(const BatchView& in) {
  batch_->clear(in.first_vertex - gaps_.missing());
  takeVertices(in);
  for (size_t cell = 0; cell < in.cell_count; ++cell) takeCell(in, cell);
  takeMarks(in);
}

void RecoveredStream::takeVertices(const BatchView& in) {
  if (in.vertex_count == 0) return;
  batch_->addVertices(in.vertex_count);
  std::memcpy(batch_->position(0), in.positions,
              in.vertex_count * 3 * sizeOf(schema_.position_type));
  for (size_t i = 0; i < schema_.fields.size(); ++i)
    std::memcpy(batch_->field(i, 0), in.fields[i],
                in.vertex_count * schema_.fields[i].bytesPerRow());
  for (size_t i = 0; in.locked && i < in.vertex_count; ++i)
    if (in.locked[i]) batch_->lock(i);
}

// A cell that is left out still carries last uses of vertices that are there.
void RecoveredStream::takeCell(const BatchView& in, size_t cell) {
  int64_t corners[4];
  for (size_t j = 0; j < 4; ++j) corners[j] = gaps_.renumbered(in.cells[4 * cell + j]);
  const unsigned uses = in.last_uses ? in.last_uses[cell] : 0;
  if (*std::min_element(corners, corners + 4) < 0) {
    for (size_t j = 0; j < 4; ++j)
      if (uses >> j & 1 && corners[j] >= 0) batch_->addFinalized(corners[j]);
    ++cells_left_out_;
    return;
  }
  const size_t row = batch_->addCells(1);
  std::memcpy(batch_->cell(row), corners, sizeof corners);
  batch_->lastUses(row) = static_cast<uint8_t>(uses);
  for (size_t i = 0; i < schema_.cell_data.size(); ++i) {
    const size_t bytes = schema_.cell_data[i].bytesPerRow();
    const auto* from = static_cast<const unsigned char*>(in.cell_data[i]) + cell * bytes;
    std::memcpy(batch_->cellData(i, row), from, bytes);
  }
  recent_.add(corners);
  ++cells_;
}

void RecoveredStream::takeMarks(const BatchView& in) {
  for (size_t i = 0; i < in.finalized_count; ++i) {
    const int64_t vertex = gaps_.renumbered(in.finalized[i]);
    if (vertex >= 0) batch_->addFinalized(vertex);
  }
  for (size_t i = 0; i < in.face_count; ++i) {
    int64_t corners[3];
    for (size_t k = 0; k < 3; ++k) corners[k] = gaps_.renumbered(in.faces[3 * i + k]);
    if (*std::min_element(corners, corners + 3) >= 0 && recent_.has(corners))
      batch_->addFace(corners, in.face_labels[i]);
    else
      ++faces_left_out_;
  }
}

static std::string ofAll(int64_t announced) {
  return announced > 0 ? textOf(" of %lld", static_cast<long long>(announced)) : "";
}

void RecoveredStream::tell() {
  if (!note_) return;
  for (const std::string& sentence : losses_.told) note_(sentence);
  if (losses_.places > losses_.told.size())
    note_(textOf("%s: %llu more such places", name_.c_str(),
                 ull{losses_.places - losses_.told.size()}));
  std::string text =
      textOf("%s: recovered %llu vertices%s and %llu cells%s", name_.c_str(), ull{vertices_},
             ofAll(announced_vertices_).c_str(), ull{cells_}, ofAll(announced_cells_).c_str());
  if (losses_.places == 0 && losses_.complete) return note_(text + "; nothing is missing");
  if (!losses_.complete) text += "; the end is missing";
  if (gaps_.missing() + losses_.cells > 0)
    text += textOf("; before it %llu vertices and %llu cells are missing", ull{gaps_.missing()},
                   ull{losses_.cells});
  if (cells_left_out_ > 0)
    text += textOf("; %llu cells that use missing vertices are left out", ull{cells_left_out_});
  if (faces_left_out_ > 0)
    text += textOf("; %llu labelled faces of cells that are, or may be, missing are left out",
                   ull{faces_left_out_});
  note_(text);
}

// What comes out of a wrapping before it fails.
class UpToDamage final : public WrappedSource {
 public:
  UpToDamage(std::unique_ptr<ByteSource> bytes, std::function<void(const std::string&)> note)
      : WrappedSource(std::move(bytes), kAtOnce), note_(std::move(note)) {}

  size_t read(void* out, size_t size) override {
    if (!hasInput() && !goOn()) return 0;
    const size_t n = std::min(size, inputSize());
    std::copy_n(input(), n, static_cast<unsigned char*>(out));
    take(n);
    return n;
  }

 private:
  static constexpr size_t kAtOnce = size_t{1} << 16;  // what is lost of the last read
  bool goOn() {
    if (is_over_) return false;
    try {
      return fill();
    } catch (const Error& error) {
      if (error.status() != Status::kBadData) throw;
      is_over_ = true;
      if (note_) note_(error.text());
      return false;
    }
  }

  std::function<void(const std::string&)> note_;
  bool is_over_ = false;
};

}  // namespace

std::unique_ptr<Source> recover(std::unique_ptr<ByteSource> bytes, const std::string& temp_dir,
                                std::function<void(const std::string&)> note) {
  if (!bytes->seekable()) bytes = std::make_unique<UpToDamage>(std::move(bytes), note);
  return std::make_unique<RecoveredStream>(makeSeekable(std::move(bytes), temp_dir),
                                           std::move(note));
}

}  // namespace tetstream::tets
