// gather/pieces: an array over all pieces of a mesh, one row per point or cell. Depends on
// mesh_pieces.h.
#pragma once

#include <memory>
#include <vector>

#include "mesh_pieces.h"

namespace tetstream {

enum class PieceRows { kPoints, kCells };

// What the rows of one column are and which array of each piece they come from.
struct PieceColumnPlan {
  PieceRows rows = PieceRows::kPoints;
  int components = 1;
  ScalarType type = ScalarType::kFloat32;  // as it is given out
  std::vector<const MeshArray*> arrays;    // per piece; null where the piece has no rows
};

class PieceColumn {
 public:
  PieceColumn(const MeshPieces& mesh, PieceColumnPlan plan) : mesh_(mesh), plan_(std::move(plan)) {}

  // Rows [first, first + count) of the whole file.
  void read(uint64_t first, size_t count, void* out);
  // Throws if the piece's array does not hold what the counts need, as far as that can be seen
  // without reading its values.
  void check(size_t piece);
  const PieceColumnPlan& plan() const { return plan_; }

 private:
  uint64_t firstRow(size_t piece) const;
  uint64_t rowCount(size_t piece) const;
  void open(size_t piece);

  const MeshPieces& mesh_;
  PieceColumnPlan plan_;
  size_t piece_ = SIZE_MAX;  // that is open
  std::unique_ptr<Values> values_;
};

}  // namespace tetstream
