#include "batch.h"

namespace tetstream {

Batch::Batch(const Schema& schema)
    : position_stride_(3 * sizeOf(schema.position_type)),
      fields_(schema.fields.size()),
      cell_data_(schema.cell_data.size()),
      field_pointers_(schema.fields.size()),
      cell_pointers_(schema.cell_data.size()) {
  for (const Column& c : schema.fields) field_strides_.push_back(c.bytesPerRow());
  for (const Column& c : schema.cell_data) cell_strides_.push_back(c.bytesPerRow());
}

void Batch::clear(uint64_t first_vertex) {
  first_vertex_ = first_vertex;
  vertex_count_ = cell_count_ = 0;
  any_locked_ = false;
  positions_.clear();
  locked_.clear();
  origins_.clear();
  last_uses_.clear();
  for (Bytes& b : fields_) b.clear();
  for (Bytes& b : cell_data_) b.clear();
  cells_.clear();
  finalized_.clear();
  faces_.clear();
  face_labels_.clear();
  face_origins_.clear();
}

size_t Batch::addVertices(size_t count) {
  const size_t first = vertex_count_;
  vertex_count_ += count;
  positions_.resize(vertex_count_ * position_stride_);
  locked_.resize(vertex_count_, 0);
  for (size_t i = 0; i < fields_.size(); ++i) fields_[i].resize(vertex_count_ * field_strides_[i]);
  return first;
}

size_t Batch::addCells(size_t count) {
  const size_t first = cell_count_;
  cell_count_ += count;
  cells_.resize(4 * cell_count_);
  last_uses_.resize(cell_count_, 0);
  for (size_t i = 0; i < cell_data_.size(); ++i)
    cell_data_[i].resize(cell_count_ * cell_strides_[i]);
  return first;
}

void Batch::addFace(const int64_t corners[3], int64_t label) {
  faces_.insert(faces_.end(), corners, corners + 3);
  face_labels_.push_back(label);
}

void Batch::lock(size_t vertex_row) {
  locked_[vertex_row] = 1;
  any_locked_ = true;
}

BatchView Batch::view() {
  for (size_t i = 0; i < fields_.size(); ++i) field_pointers_[i] = fields_[i].data();
  for (size_t i = 0; i < cell_data_.size(); ++i) cell_pointers_[i] = cell_data_[i].data();
  BatchView v;
  v.first_vertex = first_vertex_;
  v.vertex_count = vertex_count_;
  v.positions = positions_.data();
  v.fields = field_pointers_.data();
  v.locked = any_locked_ ? locked_.data() : nullptr;
  v.origins = origins_.empty() ? nullptr : origins_.data();
  v.cell_count = cell_count_;
  v.cells = cells_.data();
  v.last_uses = last_uses_.data();
  v.cell_data = cell_pointers_.data();
  v.finalized_count = finalized_.size();
  v.finalized = finalized_.data();
  v.face_count = face_labels_.size();
  v.faces = faces_.data();
  v.face_labels = face_labels_.data();
  v.face_origins = face_origins_.empty() ? nullptr : face_origins_.data();
  return v;
}

}  // namespace tetstream
