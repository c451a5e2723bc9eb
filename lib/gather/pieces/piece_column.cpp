#include "piece_column.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

uint64_t PieceColumn::firstRow(size_t piece) const {
  const MeshPiece& p = mesh_.pieces[piece];
  return plan_.rows == PieceRows::kPoints ? p.first_point : p.first_cell;
}

uint64_t PieceColumn::rowCount(size_t piece) const {
  const MeshPiece& p = mesh_.pieces[piece];
  return plan_.rows == PieceRows::kPoints ? p.point_count : p.cell_count;
}

void PieceColumn::open(size_t piece) {
  if (piece == piece_) return;
  piece_ = SIZE_MAX;
  values_.reset();
  const uint64_t count = rowCount(piece) * static_cast<uint64_t>(plan_.components);
  values_ = plan_.arrays[piece]->open(count);
  piece_ = piece;
}

void PieceColumn::check(size_t piece) {
  if (rowCount(piece) > 0) open(piece);
}

void PieceColumn::read(uint64_t first, size_t count, void* out) {
  const uint64_t total = plan_.rows == PieceRows::kPoints ? mesh_.point_count : mesh_.cell_count;
  if (first > total || count > total - first)
    fail(Status::kBadArgument, "%s: rows %llu to %llu were asked for, there are %llu",
         mesh_.name.c_str(), static_cast<unsigned long long>(first),
         static_cast<unsigned long long>(first + count), static_cast<unsigned long long>(total));
  unsigned char* to = static_cast<unsigned char*>(out);
  const uint64_t components = static_cast<uint64_t>(plan_.components);
  while (count > 0) {
    // The last piece that begins at or before `first`; those without rows share their begin.
    size_t low = 0, high = mesh_.pieces.size();
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
