// format/sv: post-order files as a stream. A cell comes before its vertices there, so it waits
// until the last of them has come; ranks need no change, because the n-th vertex element is vertex
// n.
//
// Memory: the cells that wait, and a count for each vertex that a waiting cell uses.
#include <cstring>
#include <unordered_map>

#include "status.h"
#include "sv_check.h"
#include "sv_open.h"

namespace tetstream {

namespace {

constexpr int64_t kNone = -1;

// Spreads ranks over the table, so that a file cannot choose ranks that all fall into one bucket.
struct RankHash {
  size_t operator()(int64_t rank) const {
    uint64_t x = static_cast<uint64_t>(rank) + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return static_cast<size_t>(x ^ (x >> 31));
  }
};

// The waiting cells. Each hangs, in file order, on its highest vertex: when that one has come, all
// four have.
class WaitingCells {
 public:
  explicit WaitingCells(const Schema& schema) {
    for (const Column& c : schema.cell_data) strides_.push_back(c.bytesPerRow());
    for (size_t s : strides_) row_bytes_ += s;
  }

  void add(const int64_t ranks[4], uint64_t place, Batch& from, size_t row) {
    const int64_t slot = newSlot();
    Cell& cell = cells_[static_cast<size_t>(slot)];
    int64_t highest = ranks[0];
    for (int j = 0; j < 4; ++j) {
      cell.ranks[j] = ranks[j];
      highest = ranks[j] > highest ? ranks[j] : highest;
    }
    cell.place = place;
    cell.next = kNone;
    unsigned char* out = data_.data() + static_cast<size_t>(slot) * row_bytes_;
    for (size_t c = 0; c < strides_.size(); out += strides_[c++])
      std::memcpy(out, from.cellData(c, row), strides_[c]);
    for (int j = 0; j < 4; ++j) ++vertices_[ranks[j]].uses;
    append(vertices_[highest], slot);
    ++count_;
  }

  // The vertex has come. False if no cell waits for it; else *first is the first of the cells that
  // nothing keeps waiting now, or kNone.
  bool arrive(int64_t rank, int64_t* first) {
    const auto found = vertices_.find(rank);
    if (found == vertices_.end()) return false;
    *first = found->second.first;
    return true;
  }

  // Moves a cell to the batch and returns the next one that hangs on the same vertex.
  int64_t release(int64_t slot, Batch& to) {
    Cell& cell = cells_[static_cast<size_t>(slot)];
    const size_t row = to.addCells(1);
    for (int j = 0; j < 4; ++j) {
      to.cell(row)[j] = cell.ranks[j];
      const auto vertex = vertices_.find(cell.ranks[j]);
      if (--vertex->second.uses > 0) continue;
      vertices_.erase(vertex);
      to.lastUses(row) |= static_cast<uint8_t>(1 << j);
    }
    const unsigned char* in = data_.data() + static_cast<size_t>(slot) * row_bytes_;
    for (size_t c = 0; c < strides_.size(); in += strides_[c++])
      std::memcpy(to.cellData(c, row), in, strides_[c]);
    const int64_t next = cell.next;
    cell.ranks[0] = kNone;
    cell.next = free_;
    free_ = slot;
    --count_;
    return next;
  }

  uint64_t count() const { return count_; }
  // Where the first waiting cell of the file stands, and the vertex that it waits for.
  uint64_t firstPlace(int64_t* vertex) const {
    const Cell* first = nullptr;
    for (const Cell& c : cells_)
      if (c.ranks[0] != kNone && (!first || c.place < first->place)) first = &c;
    *vertex = first->ranks[0];
    for (int64_t r : first->ranks) *vertex = r > *vertex ? r : *vertex;
    return first->place;
  }

 private:
  struct Cell {
    int64_t ranks[4];  // ranks[0] is kNone: the slot is free
    int64_t next;      // on the same vertex, or among the free slots
    uint64_t place;
  };
  struct Vertex {
    int64_t uses = 0;  // by waiting cells
    int64_t first = kNone, last = kNone;
  };

  int64_t newSlot() {
    if (free_ != kNone) {
      const int64_t slot = free_;
      free_ = cells_[static_cast<size_t>(slot)].next;
      return slot;
    }
    cells_.emplace_back();
    data_.resize(cells_.size() * row_bytes_);
    return static_cast<int64_t>(cells_.size()) - 1;
  }

  void append(Vertex& vertex, int64_t slot) {
    if (vertex.first == kNone)
      vertex.first = slot;
    else
      cells_[static_cast<size_t>(vertex.last)].next = slot;
    vertex.last = slot;
  }

  std::vector<size_t> strides_;
  size_t row_bytes_ = 0;
  std::vector<Cell> cells_;
  std::vector<unsigned char> data_;  // a row of all cell columns per slot
  std::unordered_map<int64_t, Vertex, RankHash> vertices_;
  int64_t free_ = kNone;
  uint64_t count_ = 0;
};

class PostOrderStream final : public Source {
 public:
  explicit PostOrderStream(std::unique_ptr<SvElements> elements)
      : elements_(std::move(elements)),
        in_(elements_->schema()),
        out_(elements_->schema()),
        waiting_(elements_->schema()) {}

  const Schema& schema() const override { return elements_->schema(); }

  bool next(BatchView& batch) override {
    out_.clear(static_cast<uint64_t>(vertices_));
    while (out_.vertexCount() + out_.cellCount() < kSvBlockElements) {
      if (ready_ != kNone) {
        // An unused vertex is final where it stands: before this cell.
        if (out_.finalizedCount() > 0) break;
        ready_ = waiting_.release(ready_, out_);
      } else if (at_ < in_.kinds.size()) {
        takeElement();
      } else if (!refill()) {
        break;
      }
    }
    if (out_.empty()) return false;
    batch = out_.view();
    return true;
  }

 private:
  bool refill() {
    in_.clear(static_cast<uint64_t>(vertices_));
    at_ = vertex_row_ = cell_row_ = 0;
    if (elements_->read(in_)) {
      checkSvPositions(*elements_, in_);
      return true;
    }
    if (waiting_.count() > 0) {
      int64_t vertex = 0;
      const uint64_t place = waiting_.firstPlace(&vertex);
      fail(Status::kBadData, "%s: the cell uses vertex %lld, which does not come before the end",
           elements_->where(place).c_str(), static_cast<long long>(vertex));
    }
    checkSvCounts(*elements_, vertices_, cells_);
    return false;
  }

  void takeElement() {
    const size_t element = at_++;
    switch (in_.kinds[element]) {
      case SvKind::kVertex:
        takeVertex();
        break;
      case SvKind::kCell:
        takeCell(element);
        break;
      case SvKind::kFinalize:
        failAt(element, "in post-order a vertex is finalized by its own element alone");
    }
  }

  void takeVertex() {
    const size_t from = vertex_row_++, to = out_.addVertices(1);
    const Schema& s = schema();
    std::memcpy(out_.position(to), in_.rows.position(from), 3 * sizeOf(s.position_type));
    for (size_t c = 0; c < s.fields.size(); ++c)
      std::memcpy(out_.field(c, to), in_.rows.field(c, from), s.fields[c].bytesPerRow());
    const int64_t rank = vertices_++;
    if (!waiting_.arrive(rank, &ready_)) out_.addFinalized(rank);
  }

  void takeCell(size_t element) {
    const size_t row = cell_row_++;
    int64_t ranks[4];
    for (int j = 0; j < 4; ++j) {
      const int64_t ref = in_.rows.cell(row)[j];
      if (ref <= 0) failAt(element, "a post-order cell has references above 0 only");
      ranks[j] = ref - 1;
      const int64_t announced = schema().vertex_count;
      if (announced >= 0 && ranks[j] >= announced)
        failAt(element, "the cell uses a vertex beyond those that the header announces");
      if (ranks[j] < vertices_) failAt(element, "the cell uses a vertex that was final before");
    }
    if (!svAllDiffer(ranks)) failAt(element, "a cell needs four different vertices");
    waiting_.add(ranks, in_.places[element], in_.rows, row);
    ++cells_;
  }

  [[noreturn]] void failAt(size_t element, const char* text) {
    fail(Status::kBadData, "%s: %s", elements_->where(in_.places[element]).c_str(), text);
  }

  std::unique_ptr<SvElements> elements_;
  SvBlock in_;
  Batch out_;
  WaitingCells waiting_;
  size_t at_ = 0, vertex_row_ = 0, cell_row_ = 0;  // what comes next in in_
  int64_t ready_ = kNone;                          // the next cell that waits no more
  int64_t vertices_ = 0, cells_ = 0;               // seen
};

}  // namespace

std::unique_ptr<Source> makeSvPostOrder(std::unique_ptr<SvElements> elements) {
  return std::make_unique<PostOrderStream>(std::move(elements));
}

}  // namespace tetstream
