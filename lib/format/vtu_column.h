// format: an array over all pieces of a .vtu file, one row per point or cell. Depends on
// vtu_values.h.
#pragma once

#include <memory>
#include <vector>

#include "vtu_values.h"

namespace tetstream {

enum class VtuRows { kPoints, kCells };

using PieceArray = std::optional<VtuArray> VtuPiece::*;

bool hasRows(const VtuPiece& piece, VtuRows rows);

// What the rows of one column are and which array of each piece they come from.
struct VtuColumnPlan {
  VtuRows rows = VtuRows::kPoints;
  int components = 1;
  ScalarType type = ScalarType::kFloat32;  // as it is given out
  std::vector<const VtuArray*> arrays;     // per piece; null where the piece has no rows
};

// An array that every piece with such rows must have: of cells, integers.
VtuColumnPlan planNeeded(const VtuFile& file, const ByteSource& bytes, PieceArray which,
                         VtuRows rows, const char* name, int components);

class VtuColumn {
 public:
  VtuColumn(ByteSource& bytes, const VtuFile& file, VtuColumnPlan plan)
      : bytes_(bytes), file_(file), plan_(std::move(plan)) {}

  const VtuColumnPlan& plan() const { return plan_; }
  void giveAs(ScalarType type) { plan_.type = type; }
  // Rows [first, first + count) of the whole file.
  void read(uint64_t first, size_t count, void* out);
  // Throws if the piece's array does not hold what the counts need, as far as that can be seen
  // without reading its values.
  void check(size_t piece);

 private:
  uint64_t firstRow(size_t piece) const;
  uint64_t rowCount(size_t piece) const;
  void open(size_t piece);

  ByteSource& bytes_;
  const VtuFile& file_;
  VtuColumnPlan plan_;
  size_t piece_ = SIZE_MAX;  // that is open
  std::unique_ptr<VtuValues> values_;
};

}  // namespace tetstream
