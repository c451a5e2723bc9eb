#include "batch_copy.h"

#include <algorithm>
#include <cstring>

namespace tetstream {

// Every array begins at a multiple of it.
static constexpr size_t kAlignment = 16;
// Room that was needed once is kept up to so many times what is needed now.
static constexpr size_t kMostRoom = 4;

BatchCopy::BatchCopy(const Schema& schema, Account& account)
    : position_bytes_(3 * sizeOf(schema.position_type)),
      fields_(schema.fields.size()),
      cell_data_(schema.cell_data.size()),
      block_(account) {
  for (const Column& c : schema.fields) field_bytes_.push_back(c.bytesPerRow());
  for (const Column& c : schema.cell_data) cell_bytes_.push_back(c.bytesPerRow());
}

// The array's place is after those before; null stays null.
template <class T>
void BatchCopy::place(const T*& array, size_t rows, size_t bytes_per_row) {
  if (!array) return;
  const size_t bytes = checkedMultiply(rows, bytes_per_row), at = used_;
  used_ = checkedAdd(used_, checkedAdd(bytes, kAlignment - 1) / kAlignment * kAlignment);
  if (!copies_) return;
  if (bytes > 0) std::memcpy(block_.data() + at, array, bytes);
  array = reinterpret_cast<const T*>(block_.data() + at);
}

void BatchCopy::placeAll(BatchView& b, bool copies) {
  copies_ = copies;
  used_ = 0;
  for (size_t i = 0; i < fields_.size(); ++i) {
    fields_[i] = b.vertex_count > 0 ? b.fields[i] : nullptr;
    place(fields_[i], b.vertex_count, field_bytes_[i]);
  }
  for (size_t i = 0; i < cell_data_.size(); ++i) {
    cell_data_[i] = b.cell_count > 0 ? b.cell_data[i] : nullptr;
    place(cell_data_[i], b.cell_count, cell_bytes_[i]);
  }
  place(b.positions, b.vertex_count, position_bytes_);
  place(b.locked, b.vertex_count, sizeof *b.locked);
  place(b.origins, b.vertex_count, sizeof *b.origins);
  place(b.cells, b.cell_count, 4 * sizeof *b.cells);
  place(b.last_uses, b.cell_count, sizeof *b.last_uses);
  place(b.finalized, b.finalized_count, sizeof *b.finalized);
  place(b.faces, b.face_count, 3 * sizeof *b.faces);
  place(b.face_labels, b.face_count, sizeof *b.face_labels);
  place(b.face_origins, b.face_count, sizeof *b.face_origins);
  place(b.face_locks, b.face_count, sizeof *b.face_locks);
  place(b.locked_edges, b.edge_count, 2 * sizeof *b.locked_edges);
}

void BatchCopy::take(const BatchView& batch) {
  view_ = batch;
  placeAll(view_, false);
  if (block_.size() < used_ || block_.size() / kMostRoom > used_) block_.resize(used_);
  placeAll(view_, true);
  view_.fields = fields_.data();
  view_.cell_data = cell_data_.data();
}

}  // namespace tetstream
