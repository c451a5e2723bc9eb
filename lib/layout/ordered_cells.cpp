#include "ordered_cells.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "status.h"

namespace tetstream {

constexpr uint64_t kLeastPart = 1 << 14;  // points
constexpr size_t kCellsAhead = 12;        // whose memory is asked for

static size_t dataBytes(const IndexedSource& source) {
  if (source.randomAccess()) return source.schema().cell_data.empty() ? 0 : sizeof(uint64_t);
  size_t bytes = 0;
  for (const Column& c : source.schema().cell_data) bytes += c.bytesPerRow();
  return bytes;
}

OrderedCells::OrderedCells(IndexedSource& source, RankedVertices& vertices, bool sorts,
                           RankedVertices::Budget budget, CellFront* front, const Tell& tell)
    : source_(source),
      data_bytes_(dataBytes(source)),
      rows_(kCorners + data_bytes_, budget.temp_dir),
      last_uses_(1, budget.temp_dir) {
  sortCells(vertices, sorts, budget, [&](double share) { tell(0.8 * share); });
  const Tell listing = [&](double share) { tell(0.8 + 0.2 * share); };
  const auto takeLast = [front](const uint32_t corners[4], uint64_t place) {
    return front->takeLast(corners, static_cast<uint32_t>(place));
  };
  if (front)
    listLastUses(takeLast, listing);
  else
    findLastUses(vertices.count(), budget.account, listing);
  disk_ += rows_.diskBytes() + last_uses_.diskBytes();
}

// ------------------------------------------------------------------------- points become ranks

// Every point of a cell has a rank, unless somebody writes the file meanwhile.
static uint32_t highestOf(const uint32_t ranks[4]) {
  const uint32_t highest = std::max(std::max(ranks[0], ranks[1]), std::max(ranks[2], ranks[3]));
  if (highest == RankedVertices::kNoRank)
    fail(Status::kBadData,
         "the mesh has changed while it was read: a cell has a point that none had before");
  return highest;
}

// Part by part, as many points as fit the memory: cells with points of other parts wait in a spool
// for theirs.
class OrderedCells::Translation {
 public:
  Translation(RankedVertices& vertices, uint64_t points, uint64_t part_points, Account& account)
      : vertices_(vertices),
        points_(points),
        ranks_(account, static_cast<size_t>(std::min(points, part_points))) {}

  bool isLast() const { return first_ + ranks_.size() >= points_; }
  void begin() { vertices_.tellRanks(first_, ranks_); }
  void goOn() {
    first_ += ranks_.size();
    begin();
  }
  void prefetch(int64_t point) const {
    const uint64_t place = static_cast<uint64_t>(point) - first_;
    if (place < ranks_.size()) __builtin_prefetch(ranks_.data() + place);
  }
  void translate(uint32_t corners[4], uint32_t& known) const {
    for (int j = 0; j < 4; ++j) {
      const uint64_t place = uint64_t{corners[j]} - first_;
      if (known >> j & 1 || place >= ranks_.size()) continue;
      corners[j] = ranks_[static_cast<size_t>(place)];
      known |= 1u << j;
    }
  }

 private:
  RankedVertices& vertices_;
  uint64_t points_, first_ = 0;
  Array<uint32_t> ranks_;
};

namespace {

// The cell data of a piece of the cells, row by row.
class DataRows {
 public:
  DataRows(IndexedSource& source, size_t bytes) : source_(source), bytes_(bytes) {
    if (bytes == 0) return;
    rows_.resize(bytes * kRowsOfPiece);
    column_.resize(static_cast<size_t>(kMaxComponents) * kRowsOfPiece);
  }
  void read(uint64_t first, size_t count) {
    if (bytes_ == 0) return;
    if (source_.randomAccess()) {
      for (size_t i = 0; i < count; ++i) {
        const uint64_t number = first + i;
        std::memcpy(rows_.data() + i * bytes_, &number, sizeof number);
      }
      return;
    }
    size_t place = 0;
    const std::vector<Column>& columns = source_.schema().cell_data;
    for (size_t k = 0; k < columns.size(); ++k) {
      const size_t width = columns[k].bytesPerRow();
      source_.readCellData(k, first, count, column_.data());
      const auto* from = reinterpret_cast<const unsigned char*>(column_.data());
      for (size_t i = 0; i < count; ++i)
        std::memcpy(rows_.data() + i * bytes_ + place, from + i * width, width);
      place += width;
    }
  }
  void copy(size_t row, unsigned char* to) const {
    if (bytes_ > 0) std::memcpy(to, rows_.data() + row * bytes_, bytes_);
  }

 private:
  IndexedSource& source_;
  size_t bytes_;
  std::vector<unsigned char> rows_;
  std::vector<double> column_;
};

}  // namespace

// A row on its way has four more bytes at its end, which tell whose corners are ranks.
class OrderedCells::Passage {
 public:
  Passage(OrderedCells& to, RankedVertices& vertices, bool sorts, const RankedVertices::Budget& b)
      : to_(to),
        sorts_(sorts),
        row_bytes_(kCorners + to.data_bytes_),
        translation_(vertices, points(), partPoints(b), b.account),
        sort_(row_bytes_, sortBytes(b), b.account, b.temp_dir),
        temp_dir_(b.temp_dir),
        row_(row_bytes_ + sizeof(uint32_t)) {
    translation_.begin();
    startWaiting();
  }

  // A cell of the source, whose data are at its end already.
  unsigned char* data() { return row_.data() + kCorners; }
  void take(const int64_t corners[4]) {
    uint32_t points[4];
    for (size_t j = 0; j < 4; ++j) points[j] = static_cast<uint32_t>(corners[j]);
    pass(points, 0);
  }
  void prefetch(const int64_t corners[4]) const {
    for (size_t j = 0; j < 4; ++j) translation_.prefetch(corners[j]);
  }
  // Then all that wait for the points of other parts; and the rows in their order.
  void finish(const Tell& tell) {
    while (waiting_) takeWaiting(tell);
    sort_.finish();
    const auto all = static_cast<double>(to_.source_.schema().cell_count);
    uint64_t key, count = 0;
    while (const unsigned char* row = sorts_ ? sort_.next(&key) : nullptr) {
      to_.rows_.append(row, 1);
      if (++count % kRowsOfPiece == 0) tell(static_cast<double>(count) / all);
    }
    to_.rows_.finish();
    to_.disk_ = std::max(to_.disk_, sort_.diskBytes());
  }

 private:
  uint64_t points() const { return static_cast<uint64_t>(to_.source_.schema().vertex_count); }
  static uint64_t partPoints(const RankedVertices::Budget& b) {
    return std::max<uint64_t>(b.memory_bytes / 2 / sizeof(uint32_t), kLeastPart);
  }
  // What the ranks leave.
  size_t sortBytes(const RankedVertices::Budget& b) const {
    const auto ranks = static_cast<size_t>(sizeof(uint32_t) * std::min(points(), partPoints(b)));
    return b.memory_bytes > ranks ? b.memory_bytes - ranks : 0;
  }
  void startWaiting() {
    waiting_ = translation_.isLast() ? nullptr : std::make_unique<RowSpool>(row_.size(), temp_dir_);
  }
  void pass(uint32_t corners[4], uint32_t known) {
    translation_.translate(corners, known);
    std::memcpy(row_.data(), corners, kCorners);
    std::memcpy(row_.data() + row_bytes_, &known, sizeof known);
    if (waiting_) {
      waiting_->append(row_.data(), 1);
      return;
    }
    const uint32_t highest = highestOf(corners);
    if (sorts_)
      std::memcpy(sort_.add(highest), row_.data(), row_bytes_);
    else
      to_.rows_.append(row_.data(), 1);
  }
  void takeWaiting(const Tell& tell) {
    waiting_->finish();
    to_.disk_ = std::max(to_.disk_, 2 * waiting_->diskBytes());
    const std::unique_ptr<RowSpool> before(waiting_.release());
    translation_.goOn();
    startWaiting();
    for (uint64_t i = 0; i < before->rows(); ++i) {
      uint32_t corners[4], known;
      std::memcpy(row_.data(), before->row(i), row_.size());
      std::memcpy(corners, row_.data(), kCorners);
      std::memcpy(&known, row_.data() + row_bytes_, sizeof known);
      pass(corners, known);
      if (i % kRowsOfPiece == 0) tell(0);
    }
  }

  OrderedCells& to_;
  bool sorts_;
  size_t row_bytes_;
  Translation translation_;
  ExternalSort sort_;
  const std::string& temp_dir_;
  std::vector<unsigned char> row_;
  std::unique_ptr<RowSpool> waiting_;  // null in the last part
};

// Whether the cells can be sorted in memory by counting, those of a source that is no memory itself
// with all of their rows.
bool OrderedCells::fits(const RankedVertices& vertices, size_t memory_bytes) const {
  const auto cells = static_cast<uint64_t>(source_.schema().cell_count);
  const auto points = static_cast<uint64_t>(source_.schema().vertex_count);
  const uint64_t rows = source_.randomAccess() ? 0 : cells * (kCorners + data_bytes_);
  const uint64_t order = CountedOrder::bytesFor(cells, vertices.count());
  return cells <= std::numeric_limits<uint32_t>::max() &&
         rows + order + points * sizeof(uint32_t) <= memory_bytes;
}

void OrderedCells::sortCells(RankedVertices& vertices, bool sorts,
                             const RankedVertices::Budget& budget, const Tell& tell) {
  if (!sorts || !fits(vertices, budget.memory_bytes))
    return passCells(vertices, sorts, budget, tell);
  Array<uint32_t> ranks(budget.account, static_cast<size_t>(source_.schema().vertex_count));
  vertices.tellRanks(0, ranks);
  CountedOrder order(static_cast<uint64_t>(source_.schema().cell_count), vertices.count(),
                     budget.account);
  if (source_.randomAccess())
    countCells(ranks, order, tell);
  else
    countRows(ranks, order, budget.account, tell);
  rows_.finish();
}

void OrderedCells::passCells(RankedVertices& vertices, bool sorts,
                             const RankedVertices::Budget& budget, const Tell& tell) {
  Passage passage(*this, vertices, sorts, budget);
  DataRows data(source_, data_bytes_);
  const Tell reading = [&](double share) { tell(0.6 * share); };
  readAllCells(source_, reading, [&](uint64_t first, size_t count, const int64_t* corners) {
    data.read(first, count);
    for (size_t i = 0; i < count; ++i) {
      if (i + kCellsAhead < count) passage.prefetch(corners + 4 * (i + kCellsAhead));
      data.copy(i, passage.data());
      passage.take(corners + 4 * i);
    }
  });
  passage.finish([&](double share) { tell(0.6 + 0.4 * share); });
}

// Of a mesh in memory, whose cells need not be carried to where they belong: their order is enough.
void OrderedCells::countCells(const Array<uint32_t>& ranks, CountedOrder& order, const Tell& tell) {
  const auto translate = [&ranks](const int64_t points[4], uint32_t corners[4]) {
    for (size_t j = 0; j < 4; ++j) corners[j] = ranks[static_cast<size_t>(points[j])];
  };
  uint32_t corners[4];
  readAllCells(
      source_, [&](double share) { tell(0.3 * share); },
      [&](uint64_t, size_t count, const int64_t* points) {
        for (size_t i = 0; i < count; ++i) {
          translate(points + 4 * i, corners);
          order.count(highestOf(corners));
        }
      });
  order.beginPutting();
  readAllCells(
      source_, [&](double share) { tell(0.3 + 0.3 * share); },
      [&](uint64_t first, size_t count, const int64_t* points) {
        for (size_t i = 0; i < count; ++i) {
          translate(points + 4 * i, corners);
          order.put(highestOf(corners), static_cast<uint32_t>(first + i));
        }
      });
  std::vector<unsigned char> row(kCorners + data_bytes_);
  const Tell writing = [&](double share) { tell(0.6 + 0.4 * share); };
  readInPieces(order.size(), writing, [&](uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const uint64_t number = order[static_cast<size_t>(first) + i];
      int64_t points[4];
      source_.readCells(number, 1, points);
      translate(points, corners);
      std::memcpy(row.data(), corners, kCorners);
      if (data_bytes_ > 0) std::memcpy(row.data() + kCorners, &number, sizeof number);
      rows_.append(row.data(), 1);
    }
  });
}

// Of another source, which is read once more: its rows are held as they come, and written in order.
void OrderedCells::countRows(const Array<uint32_t>& ranks, CountedOrder& order, Account& account,
                             const Tell& tell) {
  const size_t row_bytes = kCorners + data_bytes_;
  Array<unsigned char> rows(account, checkedMultiply(order.size(), row_bytes));
  DataRows data(source_, data_bytes_);
  const auto corners = [&](size_t row) {
    std::array<uint32_t, 4> ranks_of;
    std::memcpy(ranks_of.data(), rows.data() + row * row_bytes, kCorners);
    return ranks_of;
  };
  readAllCells(
      source_, [&](double share) { tell(0.5 * share); },
      [&](uint64_t first, size_t count, const int64_t* points) {
        data.read(first, count);
        for (size_t i = 0; i < count; ++i) {
          if (i + kCellsAhead < count)
            for (size_t j = 0; j < 4; ++j)
              __builtin_prefetch(&ranks[static_cast<size_t>(points[4 * (i + kCellsAhead) + j])]);
          uint32_t ranks_of[4];
          for (size_t j = 0; j < 4; ++j)
            ranks_of[j] = ranks[static_cast<size_t>(points[4 * i + j])];
          unsigned char* const row = rows.data() + (static_cast<size_t>(first) + i) * row_bytes;
          std::memcpy(row, ranks_of, kCorners);
          data.copy(i, row + kCorners);
          order.count(highestOf(ranks_of));
        }
      });
  order.beginPutting();
  for (size_t i = 0; i < order.size(); ++i)
    order.put(highestOf(corners(i).data()), static_cast<uint32_t>(i));
  const Tell writing = [&](double share) { tell(0.6 + 0.4 * share); };
  readInPieces(order.size(), writing, [&](uint64_t first, size_t count) {
    const auto at = [&](size_t i) { return rows.data() + order[first + i] * row_bytes; };
    for (size_t i = 0; i < count; ++i) {
      if (i + kCellsAhead < count) __builtin_prefetch(at(i + kCellsAhead));
      rows_.append(at(i), 1);
    }
  });
}

// From the last cell to the first. usesOf(corners, place)
template <class UsesOf>
void OrderedCells::listLastUses(UsesOf usesOf, const Tell& tell) {
  for (uint64_t left = rows_.rows(); left-- > 0;) {
    uint32_t corners[4];
    std::memcpy(corners, rows_.row(left), kCorners);
    const auto uses = static_cast<unsigned char>(usesOf(corners, left));
    last_uses_.append(&uses, 1);
    if (left % kRowsOfPiece == 0)
      tell(1 - static_cast<double>(left) / static_cast<double>(rows_.rows()));
  }
  last_uses_.finish();
}

// The first that has a vertex is the last to use it.
void OrderedCells::findLastUses(uint64_t vertices, Account& account, const Tell& tell) {
  Array<uint64_t> seen(account, static_cast<size_t>(vertices / 64 + 1));
  std::fill_n(seen.data(), seen.size(), uint64_t{0});
  const auto usesOf = [&seen](const uint32_t corners[4], uint64_t) {
    unsigned uses = 0;
    for (unsigned j = 0; j < 4; ++j) {
      uint64_t& word = seen[corners[j] / 64];
      const uint64_t bit = uint64_t{1} << (corners[j] % 64);
      if (!(word & bit)) uses |= 1u << j;
      word |= bit;
    }
    return uses;
  };
  listLastUses(usesOf, tell);
}

OrderedCell OrderedCells::cell(uint64_t place) {
  OrderedCell cell;
  const auto* row = static_cast<const unsigned char*>(rows_.row(place));
  std::memcpy(cell.corners, row, kCorners);
  cell.last_uses =
      *static_cast<const unsigned char*>(last_uses_.row(last_uses_.rows() - 1 - place));
  cell.data = row + kCorners;
  return cell;
}

void OrderedCells::copyData(const OrderedCell& cell, Batch& batch, size_t row) {
  const std::vector<Column>& columns = source_.schema().cell_data;
  const unsigned char* from = cell.data;
  for (size_t k = 0; k < columns.size(); ++k) {
    if (source_.randomAccess()) {
      uint64_t number;
      std::memcpy(&number, cell.data, sizeof number);
      source_.readCellData(k, number, 1, batch.cellData(k, row));
      continue;
    }
    std::memcpy(batch.cellData(k, row), from, columns[k].bytesPerRow());
    from += columns[k].bytesPerRow();
  }
}

}  // namespace tetstream
