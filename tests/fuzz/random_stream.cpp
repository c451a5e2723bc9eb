#include "random_stream.h"

#include <algorithm>

namespace fuzz {

namespace {

constexpr size_t kMostBatches = 64, kMostRows = 48;

template <class T>
void append(std::vector<unsigned char>& out, T value) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof value);
}

void appendReal(std::vector<unsigned char>& out, int32_t type, double value) {
  if (type == TETSTREAM_TYPE_FLOAT32)
    append(out, static_cast<float>(value));
  else
    append(out, value);
}

}  // namespace

RandomStream::RandomStream(Choices& choices) : choices_(choices) {
  static const char* const kFields[] = {"a", "b", "c"};
  static const char* const kCellData[] = {"region", "part", "size"};
  wild_ = choices_.below(3) == 0;
  info_.struct_size = sizeof info_;
  info_.position_type = choices_.below(2) ? TETSTREAM_TYPE_FLOAT64 : TETSTREAM_TYPE_FLOAT32;
  info_.flags = choices_.below(4) == 0 ? TETSTREAM_STREAM_INDEXED : 0;
  addColumns(fields_, kFields);
  addColumns(cell_data_, kCellData);
  info_.fields = fields_.data();
  info_.field_count = static_cast<int32_t>(fields_.size());
  info_.cell_data = cell_data_.data();
  info_.cell_data_count = static_cast<int32_t>(cell_data_.size());
  const auto count = [&] { return choices_.below(8) ? -1 : static_cast<int64_t>(choices_.bits()); };
  info_.vertex_count = count();
  info_.cell_count = count();
  // What is announced of the front is room that is set aside, untouched: not too much of it here.
  for (int64_t* front : {&info_.front_width, &info_.front_span, &info_.front_cells})
    *front = choices_.below(8) ? -1 : static_cast<int64_t>(choices_.below(1 << 16)) - 1;
  info_.face_count = choices_.below(8) ? 0 : count();
  field_rows_.resize(fields_.size());
  cell_rows_.resize(cell_data_.size());
}

void RandomStream::addColumns(std::vector<tetstream_column>& columns, const char* const* names) {
  columns.resize(choices_.below(4));
  for (size_t i = 0; i < columns.size(); ++i) {
    columns[i] = {names[i], static_cast<int32_t>(1 + choices_.below(3)),
                  static_cast<int32_t>(1 + choices_.below(4))};
    if (breaksRule()) columns[i].components = static_cast<int32_t>(choices_.bits());
    if (breaksRule()) columns[i].name = names[0];
    // What the library would read must be there.
    columns[i].components = std::min(columns[i].components, 16);
  }
}

void RandomStream::addRow(std::vector<unsigned char>& out, const tetstream_column& column) {
  for (int32_t i = 0; i < column.components; ++i) {
    if (column.type == TETSTREAM_TYPE_INT32)
      append(out, static_cast<int32_t>(choices_.below(3)));
    else if (column.type == TETSTREAM_TYPE_INT64)
      append(out, static_cast<int64_t>(choices_.below(3)));
    else
      appendReal(out, column.type, choices_.real());
  }
}

void RandomStream::addVertices() {
  for (size_t left = choices_.below(12); left > 0 && !choices_.atEnd(); --left) {
    for (int k = 0; k < 3; ++k) appendReal(positions_, info_.position_type, choices_.real());
    for (size_t i = 0; i < fields_.size(); ++i) addRow(field_rows_[i], fields_[i]);
    locked_.push_back(choices_.below(32) == 1);
    front_.push_back(vertices_++);
  }
}

int64_t RandomStream::someVertex() {
  if (breaksRule()) return static_cast<int64_t>(choices_.bits());
  // The newest ones, so that the front moves on.
  const size_t reach = std::min<size_t>(front_.size(), 16);
  return front_[front_.size() - 1 - choices_.below(reach)];
}

void RandomStream::addCell() {
  uint8_t uses = 0;
  int64_t corners[4];
  for (int64_t& corner : corners) corner = someVertex();
  const bool repeats = corners[0] == corners[1] || corners[0] == corners[2] ||
                       corners[0] == corners[3] || corners[1] == corners[2] ||
                       corners[1] == corners[3] || corners[2] == corners[3];
  if (repeats && !wild_) return;
  if (choices_.below(4) == 0) uses = choices_.byte() & 15;
  if (info_.flags & TETSTREAM_STREAM_INDEXED) uses = 0;
  for (int j = 0; j < 4; ++j) {
    cells_.push_back(corners[j]);
    if (uses >> j & 1 && !breaksRule())
      front_.erase(std::remove(front_.begin(), front_.end(), corners[j]), front_.end());
  }
  last_uses_.push_back(breaksRule() ? choices_.byte() : uses);
  for (size_t i = 0; i < cell_data_.size(); ++i) addRow(cell_rows_[i], cell_data_[i]);
}

void RandomStream::addCells() {
  for (size_t left = choices_.below(kMostRows); left > 0 && !choices_.atEnd(); --left)
    if (front_.size() >= 4) addCell();
  if (cells_.size() >= 12 && choices_.below(4) == 0) addFaces();
}

// Of cells of this batch, one label or two.
void RandomStream::addFaces() {
  const size_t cell = choices_.below(cells_.size() / 4), without = choices_.below(4);
  for (size_t j = 0; j < 4; ++j)
    if (j != without) faces_.push_back(cells_[4 * cell + j]);
  if (breaksRule()) faces_.back() = static_cast<int64_t>(choices_.bits());
  face_labels_.push_back(static_cast<int64_t>(choices_.below(2)));
  locked_faces_.push_back(choices_.below(8) == 1);
  if (choices_.below(4) == 0) edges_.assign(faces_.end() - 3, faces_.end() - 1);
}

void RandomStream::addFinalized() {
  if (info_.flags & TETSTREAM_STREAM_INDEXED && !breaksRule()) return;
  for (size_t left = choices_.below(6); left > 0 && !front_.empty(); --left) {
    const size_t i = choices_.below(front_.size());
    finalized_.push_back(front_[i]);
    if (!breaksRule()) front_.erase(front_.begin() + static_cast<long>(i));
  }
}

void RandomStream::next(tetstream_batch* batch) {
  positions_.clear();
  for (auto& rows : field_rows_) rows.clear();
  for (auto& rows : cell_rows_) rows.clear();
  for (auto* flags : {&locked_, &last_uses_, &locked_faces_}) flags->clear();
  for (auto* ids : {&cells_, &finalized_, &faces_, &face_labels_, &edges_}) ids->clear();
  if (choices_.atEnd() || ++batches_ > kMostBatches) return;
  addVertices();
  addCells();
  addFinalized();
  field_pointers_.clear();
  cell_pointers_.clear();
  for (const auto& rows : field_rows_) field_pointers_.push_back(rows.data());
  for (const auto& rows : cell_rows_) cell_pointers_.push_back(rows.data());
  batch->vertex_count = static_cast<int64_t>(locked_.size());
  batch->positions = positions_.data();
  batch->fields = field_pointers_.data();
  batch->locked = choices_.below(2) ? locked_.data() : nullptr;
  batch->cell_count = static_cast<int64_t>(last_uses_.size());
  batch->cells = cells_.data();
  batch->last_uses = last_uses_.data();
  batch->cell_data = cell_pointers_.data();
  batch->finalized_count = static_cast<int64_t>(finalized_.size());
  batch->finalized = finalized_.data();
  batch->face_count = static_cast<int64_t>(face_labels_.size());
  batch->faces = faces_.data();
  batch->face_labels = face_labels_.data();
  batch->locked_faces = choices_.below(2) ? locked_faces_.data() : nullptr;
  batch->locked_edge_count = static_cast<int64_t>(edges_.size() / 2);
  batch->locked_edges = edges_.data();
  cells_given_ += batch->cell_count;
}

}  // namespace fuzz
