// run: a stream's box cut into bricks that are about equally full of vertices, and some bricks
// taken. Depends on stream.
//
// Real meshes have cells of a millionth of others' volume, and most of their cells in little space:
// bricks of one size would hold nothing there, or everything. So the vertices are counted first, in
// the cells of a grid; halving the box as often as a brick's vertices want then gives bricks for
// what was met. What is finer than the grid is cut as if it were even there, and met in one brick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "schema.h"

namespace tetstream {

class Bricks {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;
  static constexpr int64_t kGridBytes = 8 << 18;

  // Of the box of a stream; the grid has about so many bytes at most, of 8 or more.
  explicit Bricks(const Schema& schema, int64_t most_bytes = kGridBytes);

  // First every vertex,
  void count(const double place[3]) { ++cells_[codeOf(place) + 1]; }
  // or those that another one of the same box counted;
  void addCounts(const Bricks& other);
  // then a brick is taken for each of `wanted` equal parts of the vertices, but for a part whose
  // first vertex lies in the brick before. All together have about `share` of the vertices if none
  // is skipped.
  void take(size_t wanted, double share);

  size_t size() const { return cuts_.size(); }
  // Vertices of a brick of the usual size.
  uint64_t usual() const { return usual_; }
  // The brick that a place lies in, or kNone.
  uint32_t at(const double place[3]) const {
    const uint64_t brick = cells_[codeOf(place)];
    return brick == kNone || cuts_[brick].holds(place) ? static_cast<uint32_t>(brick) : kNone;
  }

 private:
  // What of its cells of the grid a brick is.
  struct Cut {
    double low[3], high[3];
    bool holds(const double place[3]) const {
      for (int i = 0; i < 3; ++i)
        if (!(place[i] >= low[i] && place[i] < high[i])) return false;
      return true;
    }
  };
  // Where halving has come to: a run of cells of the grid, or what is cut out of one of them.
  struct Piece {
    uint64_t begin, end;
    double low[3], side[3];
    Cut cut;
  };

  uint64_t codeOf(const double place[3]) const;
  uint64_t verticesIn(const Piece& piece) const { return cells_[piece.end] - cells_[piece.begin]; }
  void halve(Piece& piece, uint64_t vertex) const;
  Piece pieceAt(uint64_t vertex) const;

  double low_[3], extent_[3], scale_[3];  // cells of the grid per length
  // Of an axis: what a row of cells adds to their code.
  std::array<std::vector<uint64_t>, 3> digits_;
  // Vertices of cell k - 1, by code; then of all before cell k; then the brick that cell k is of.
  std::vector<uint64_t> cells_;
  std::vector<Cut> cuts_;  // of a brick
  uint64_t usual_ = 0;
};

}  // namespace tetstream
