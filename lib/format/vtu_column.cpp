#include "vtu_column.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

bool hasRows(const VtuPiece& piece, VtuRows rows) {
  return (rows == VtuRows::kPoints ? piece.point_count : piece.cell_count) > 0;
}

VtuColumnPlan planNeeded(const VtuFile& file, const ByteSource& bytes, PieceArray which,
                         VtuRows rows, const char* name, int components) {
  VtuColumnPlan plan;
  plan.rows = rows;
  plan.components = components;
  plan.type = ScalarType::kInt64;
  for (size_t i = 0; i < file.pieces.size(); ++i) {
    const VtuPiece& piece = file.pieces[i];
    const std::optional<VtuArray>& array = piece.*which;
    plan.arrays.push_back(array ? &*array : nullptr);
    if (!hasRows(piece, rows)) continue;
    if (!array) fail(Status::kBadData, "%s: piece %zu has no %s", bytes.name().c_str(), i, name);
    if (rows == VtuRows::kCells && isFloat(array->type))
      fail(Status::kBadData, "%s: the %s of piece %zu are no integers", bytes.name().c_str(), name,
           i);
  }
  return plan;
}

uint64_t VtuColumn::firstRow(size_t piece) const {
  const VtuPiece& p = file_.pieces[piece];
  return plan_.rows == VtuRows::kPoints ? p.first_point : p.first_cell;
}

uint64_t VtuColumn::rowCount(size_t piece) const {
  const VtuPiece& p = file_.pieces[piece];
  return plan_.rows == VtuRows::kPoints ? p.point_count : p.cell_count;
}

void VtuColumn::open(size_t piece) {
  if (piece == piece_) return;
  piece_ = SIZE_MAX;
  values_.reset();
  const uint64_t count = rowCount(piece) * static_cast<uint64_t>(plan_.components);
  values_ = openVtuValues(bytes_, file_, *plan_.arrays[piece], count);
  piece_ = piece;
}

void VtuColumn::check(size_t piece) {
  if (rowCount(piece) > 0) open(piece);
}

void VtuColumn::read(uint64_t first, size_t count, void* out) {
  const uint64_t total = plan_.rows == VtuRows::kPoints ? file_.point_count : file_.cell_count;
  if (first > total || count > total - first)
    fail(Status::kBadArgument, "%s: rows %llu to %llu were asked for, there are %llu",
         bytes_.name().c_str(), static_cast<unsigned long long>(first),
         static_cast<unsigned long long>(first + count), static_cast<unsigned long long>(total));
  unsigned char* to = static_cast<unsigned char*>(out);
  const uint64_t components = static_cast<uint64_t>(plan_.components);
  while (count > 0) {
    // The last piece that begins at or before `first`; those without rows share their begin.
    size_t low = 0, high = file_.pieces.size();
    while (high - low > 1) {
      const size_t middle = (low + high) / 2;
      (firstRow(middle) <= first ? low : high) = middle;
    }
    open(low);
    const uint64_t row = first - firstRow(low);
    const size_t n = static_cast<size_t>(std::min<uint64_t>(count, rowCount(low) - row));
    values_->read(row * components, n * components, to, plan_.type);
    to += n * components * sizeOf(plan_.type);
    first += n;
    count -= n;
  }
}

}  // namespace tetstream
