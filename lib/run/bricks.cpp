#include "bricks.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "memory.h"
#include "mix.h"

namespace tetstream {

// Pieces are halved until they have no more: most of them end with a half of it to all.
constexpr double kLargest = 1.4;

static int longestOf(const double extent[3]) {
  return static_cast<int>(std::max_element(extent, extent + 3) - extent);
}

// The box is halved across its longest side, again and again; the code of a cell has a bit for each
// time, the first one highest, so that each piece is a run of codes.
Bricks::Bricks(const Schema& schema, int64_t most_bytes) {
  const uint64_t count = std::bit_floor(static_cast<uint64_t>(most_bytes) / sizeof(cells_[0]));
  assert(count > 0);
  cells_.reserve(count + 1);
  askForPages(cells_.data(), (count + 1) * sizeof(cells_[0]));
  cells_.resize(count + 1);
  double side[3];
  for (size_t i = 0; i < 3; ++i) {
    low_[i] = schema.box_min[i];
    side[i] = extent_[i] = schema.box_max[i] - schema.box_min[i];
    digits_[i] = {0};
  }
  for (uint64_t bit = count / 2; bit > 0; bit /= 2) {
    const int axis = longestOf(side);
    side[axis] /= 2;
    std::vector<uint64_t> finer;
    for (uint64_t digits : digits_[axis]) finer.insert(finer.end(), {digits, digits + bit});
    digits_[axis].swap(finer);
  }
  for (size_t i = 0; i < 3; ++i) scale_[i] = static_cast<double>(digits_[i].size()) / extent_[i];
}

void Bricks::addCounts(const Bricks& other) {
  for (size_t k = 0; k < cells_.size(); ++k) cells_[k] += other.cells_[k];
}

uint64_t Bricks::codeOf(const double place[3]) const {
  uint64_t code = 0;
  for (int i = 0; i < 3; ++i) {
    const double row = (place[i] - low_[i]) * scale_[i];
    const auto last = static_cast<double>(digits_[i].size() - 1);
    code += digits_[i][static_cast<size_t>(row > 0 ? std::min(row, last) : 0)];
  }
  return code;
}

// Keeps the half with that vertex, in the order of codes; of a single cell, whose vertices nobody
// knows the places of, any half.
void Bricks::halve(Piece& piece, uint64_t vertex) const {
  const int axis = longestOf(piece.side);
  piece.side[axis] /= 2;
  const double middle = piece.low[axis] + piece.side[axis];
  const uint64_t half = piece.begin + (piece.end - piece.begin) / 2;
  const bool is_cell = half == piece.begin;
  const bool is_low = is_cell ? mix(vertex) % 2 == 0 : vertex < cells_[half];
  if (!is_low) piece.low[axis] = middle;
  if (is_cell)
    (is_low ? piece.cut.high : piece.cut.low)[axis] = middle;
  else
    (is_low ? piece.end : piece.begin) = half;
}

// The piece of usual size round a vertex, in the order of codes.
Bricks::Piece Bricks::pieceAt(uint64_t vertex) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Piece piece{0, cells_.size() - 1, {}, {}, {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}};
  std::copy_n(low_, 3, piece.low);
  std::copy_n(extent_, 3, piece.side);
  const double most = kLargest * static_cast<double>(usual_);
  while (piece.end - piece.begin > 1 && static_cast<double>(verticesIn(piece)) > most)
    halve(piece, vertex);
  for (auto left = static_cast<double>(verticesIn(piece)); left > most; left /= 2)
    halve(piece, vertex = mix(vertex + 1));
  return piece;
}

void Bricks::take(size_t wanted, double share) {
  for (size_t k = 1; k < cells_.size(); ++k) cells_[k] += cells_[k - 1];
  const double all = static_cast<double>(cells_.back());
  const double part = all / static_cast<double>(wanted);
  usual_ = static_cast<uint64_t>(std::max(share * part, 1.0));
  std::vector<Piece> pieces;
  for (size_t k = 0; k < wanted && all > 0; ++k) {
    const double within = uniform(mix(k + 1));
    const auto vertex = static_cast<uint64_t>((static_cast<double>(k) + within) * part);
    const Piece piece = pieceAt(std::min(vertex, cells_.back() - 1));
    if (pieces.empty() || piece.begin >= pieces.back().end) pieces.push_back(piece);
  }
  std::fill(cells_.begin(), cells_.end(), kNone);
  for (const Piece& piece : pieces) {
    std::fill(cells_.begin() + static_cast<ptrdiff_t>(piece.begin),
              cells_.begin() + static_cast<ptrdiff_t>(piece.end), cuts_.size());
    cuts_.push_back(piece.cut);
  }
}

}  // namespace tetstream
