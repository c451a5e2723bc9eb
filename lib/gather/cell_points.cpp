#include "cell_points.h"

#include <algorithm>
#include <vector>

#include "memory.h"
#include "rows_at_once.h"

namespace tetstream {

namespace {

constexpr uint64_t kLeastCells = 16;   // fewer may well be apart in truth
constexpr uint64_t kFewestPoints = 3;  // of a cell, as a rule; joined ones have hardly two
constexpr int64_t kMostPoints = 64;    // of a cell that is read

// Integers of an array, some at a time.
class Integers {
 public:
  Integers(const MeshArray& array, uint64_t count) : count_(count) {
    if (count > 0) values_ = array.open(count);
  }
  bool ended() const { return at_ == count_; }
  int64_t next() {
    if (at_ == filled_) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count_ - at_));
      values_->read(at_, n, held_, ScalarType::kInt64);
      filled_ = at_ + n;
      first_ = at_;
    }
    return held_[at_++ - first_];
  }

 private:
  std::unique_ptr<Values> values_;
  uint64_t count_, at_ = 0, first_ = 0, filled_ = 0;
  int64_t held_[kRowsAtOnce];
};

// The cells of one piece, each as the numbers of its points.
class PieceCells {
 public:
  PieceCells(const MeshPieces& mesh, const MeshPiece& piece) : form_(mesh.form) {
    if (form_ == CellForm::kOffsets && piece.offsets)
      ends_.emplace(*piece.offsets, piece.cell_count);
    if (piece.connectivity) names_.emplace(*piece.connectivity, namesOf(piece));
  }

  // False: there is no further one that is whole.
  bool next(std::vector<int64_t>& points) {
    points.clear();
    if (!names_ || names_->ended()) return false;
    int64_t count = 4;
    if (form_ == CellForm::kInterleaved) count = names_->next();
    if (form_ == CellForm::kOffsets) {
      const int64_t end = ends_->next();
      count = end - end_;
      end_ = end;
    }
    if (count < 0 || count > kMostPoints) return false;
    for (; count > 0 && !names_->ended(); --count) points.push_back(names_->next());
    return count == 0;
  }

 private:
  uint64_t namesOf(const MeshPiece& piece) const {
    if (form_ == CellForm::kTetrahedra) return 4 * piece.cell_count;
    if (form_ == CellForm::kInterleaved) return piece.connectivity_size;
    int64_t end = 0;
    if (piece.offsets)
      piece.offsets->open(piece.cell_count)
          ->read(piece.cell_count - 1, 1, &end, ScalarType::kInt64);
    return end > 0 ? static_cast<uint64_t>(end) : 0;
  }

  CellForm form_;
  std::optional<Integers> ends_, names_;
  int64_t end_ = 0;
};

bool isApart(const MeshPieces& mesh, const MeshPiece& piece, Account& account) {
  Array<uint64_t> named(account, static_cast<size_t>(piece.point_count / 64 + 1));
  std::fill_n(named.data(), named.size(), uint64_t{0});
  PieceCells cells(mesh, piece);
  std::vector<int64_t> points;
  uint64_t count = 0;
  while (cells.next(points)) {
    ++count;
    for (const int64_t point : points) {
      if (point < 0 || static_cast<uint64_t>(point) >= piece.point_count) return false;
      uint64_t& word = named[static_cast<size_t>(point / 64)];
      const uint64_t bit = uint64_t{1} << (point % 64);
      if ((word & bit) != 0) return false;
      word |= bit;
    }
  }
  return count == piece.cell_count;
}

// Whether two of a cell's points are one.
bool losesACorner(std::vector<int64_t>& points, PointJoin& joined) {
  for (int64_t& point : points) point = joined.firstOf(point);
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

}  // namespace

bool cellsAreApart(const MeshPieces& mesh) {
  if (mesh.cell_count < kLeastCells || mesh.point_count / kFewestPoints < mesh.cell_count)
    return false;
  Account account;
  return std::all_of(mesh.pieces.begin(), mesh.pieces.end(), [&](const MeshPiece& piece) {
    return piece.cell_count == 0 || isApart(mesh, piece, account);
  });
}

std::optional<uint64_t> cellThatLosesACorner(const MeshPieces& mesh, PointJoin& joined) {
  std::vector<int64_t> points;
  for (const MeshPiece& piece : mesh.pieces) {
    if (piece.cell_count == 0) continue;
    PieceCells cells(mesh, piece);
    for (uint64_t cell = piece.first_cell; cells.next(points); ++cell) {
      const auto count = static_cast<int64_t>(piece.point_count);
      std::erase_if(points, [count](int64_t point) { return point < 0 || point >= count; });
      for (int64_t& point : points) point += static_cast<int64_t>(piece.first_point);
      if (losesACorner(points, joined)) return cell;
    }
  }
  return {};
}

std::optional<uint64_t> cellThatLosesACorner(IndexedSource& mesh, PointJoin& joined) {
  std::vector<int64_t> rows(4 * kRowsAtOnce), points;
  const auto cells = static_cast<uint64_t>(mesh.schema().cell_count);
  for (uint64_t at = 0; at < cells; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells - at));
    mesh.readCells(at, n, rows.data());
    for (size_t i = 0; i < n; ++i) {
      points.assign(&rows[4 * i], &rows[4 * i] + 4);
      if (losesACorner(points, joined)) return at + i;
    }
  }
  return {};
}

}  // namespace tetstream
