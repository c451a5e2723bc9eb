#include "mesh_spool.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "label_names.h"
#include "status.h"

namespace tetstream {

constexpr size_t kFaceWords = 4;

MeshSpool::MeshSpool(ScalarType position_type, const std::string& temp_dir, const Tasks* tasks)
    : temp_dir_(temp_dir),
      tasks_(tasks),
      positions_(3 * sizeOf(position_type), temp_dir, kSpooledInSequence, tasks),
      cells_(4 * sizeof(int32_t), temp_dir, kSpooledInSequence, tasks),
      wide_cells_(4 * sizeof(int64_t), temp_dir, kSpooledInSequence, tasks),
      faces_(openFaces()),
      locked_(account_) {
  schema_.position_type = position_type;
}

MeshSpool::MeshSpool(const Schema& schema, const std::string& temp_dir)
    : MeshSpool(schema.position_type, temp_dir) {
  for (const Column& c : schema.fields) addField(c);
  for (const Column& c : schema.cell_data) addCellData(c);
  schema_ = schema;
}

size_t MeshSpool::addField(const Column& column) {
  schema_.fields.push_back(column);
  fields_.push_back(
      std::make_unique<ColumnRows>(column.bytesPerRow(), temp_dir_, kSpooledInSequence, tasks_));
  return fields_.size() - 1;
}

size_t MeshSpool::addCellData(const Column& column) {
  schema_.cell_data.push_back(column);
  cell_data_.push_back(
      std::make_unique<ColumnRows>(column.bytesPerRow(), temp_dir_, kSpooledInSequence, tasks_));
  return cell_data_.size() - 1;
}

std::unique_ptr<RowSpool> MeshSpool::openFaces() const {
  return std::make_unique<RowSpool>(kFaceWords * sizeof(int64_t), temp_dir_, kSpooledInSequence,
                                    tasks_);
}

static void removeAt(std::vector<Column>& columns, std::vector<std::unique_ptr<ColumnRows>>& rows,
                     size_t column) {
  columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(column));
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(column));
}

void MeshSpool::appendCells(const int64_t* rows, size_t count) {
  constexpr size_t kAtOnce = 1024;
  int32_t narrow[4 * kAtOnce];
  for (size_t n; count > 0; rows += 4 * n, count -= n) {
    n = std::min(count, kAtOnce);
    int64_t lost = 0;  // bits that are not in the narrow ones
    for (size_t k = 0; k < 4 * n; ++k) {
      narrow[k] = static_cast<int32_t>(rows[k]);
      lost |= narrow[k] ^ rows[k];
    }
    if (lost == 0 && wide_cells_.rows() == 0)
      cells_.append(narrow, n);
    else
      wide_cells_.append(rows, n);
  }
}

void MeshSpool::removeField(size_t column) {
  removeAt(schema_.fields, fields_, column);
}

void MeshSpool::removeCellData(size_t column) {
  removeLabelNames(schema_.label_names, schema_.cell_data[column].name);
  removeAt(schema_.cell_data, cell_data_, column);
}

void MeshSpool::appendFace(const int64_t corners[3], int64_t label) {
  const int64_t row[kFaceWords] = {corners[0], corners[1], corners[2], label};
  faces_->append(row, 1);
}

// Arrays without rows may be null, and so may the lists of them.
void MeshSpool::append(const BatchView& batch) {
  if (batch.vertex_count > 0) {
    appendPositions(batch.positions, batch.vertex_count);
    for (size_t i = 0; i < fields_.size(); ++i) appendField(i, batch.fields[i], batch.vertex_count);
  }
  if (batch.cell_count > 0) {
    appendCells(batch.cells, batch.cell_count);
    for (size_t i = 0; i < cell_data_.size(); ++i)
      appendCellData(i, batch.cell_data[i], batch.cell_count);
  }
  for (size_t i = 0; i < batch.face_count; ++i)
    appendFace(batch.faces + 3 * i, batch.face_labels[i]);
}

void MeshSpool::lock(uint64_t point) {
  growLocks();
  locked_[static_cast<size_t>(point)] = 1;
}

void MeshSpool::growLocks() {
  const size_t known = locked_.size();
  const auto points = static_cast<size_t>(positions_.rows());
  if (known >= points) return;
  locked_.resize(points);
  std::fill(locked_.data() + known, locked_.data() + points, uint8_t{0});
}

void MeshSpool::checkRows(const std::vector<Column>& columns, const Columns& rows,
                          uint64_t count) const {
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows[i]->rows() != count)
      fail(Status::kInternal, "column \"%s\" was given %llu rows of %llu", columns[i].name.c_str(),
           static_cast<unsigned long long>(rows[i]->rows()),
           static_cast<unsigned long long>(count));
}

void MeshSpool::finish() {
  checkSchema(schema_);
  checkRows(schema_.fields, fields_, positions_.rows());
  checkRows(schema_.cell_data, cell_data_, cellCount());
  schema_.vertex_count = static_cast<int64_t>(positions_.rows());
  schema_.cell_count = static_cast<int64_t>(cellCount());
  if (locked_.size() > 0) growLocks();
  positions_.finish();
  for (RowSpool* spool : {&cells_, &wide_cells_}) spool->finish();
  for (Columns* columns : {&fields_, &cell_data_})
    for (auto& rows : *columns) rows->finish();
}

void MeshSpool::finishFaces() {
  schema_.face_count = static_cast<int64_t>(faces_->rows());
  faces_->finish();
}

uint64_t MeshSpool::keepFaces(const std::function<bool(const int64_t*)>& keep) {
  std::unique_ptr<RowSpool> all = std::exchange(faces_, openFaces());
  for (uint64_t i = 0; i < all->rows(); ++i) {
    const auto* row = static_cast<const int64_t*>(all->row(i));
    if (keep(row)) faces_->append(row, 1);
  }
  finishFaces();
  return all->rows() - faces_->rows();
}

void MeshSpool::readPositions(uint64_t first, size_t count, void* out) {
  positions_.read(first, count, out);
}

void MeshSpool::readField(size_t column, uint64_t first, size_t count, void* out) {
  fields_[column]->read(first, count, out);
}

void MeshSpool::readCells(uint64_t first, size_t count, int64_t* out) {
  placed_cells_.read(first, count, 4 * sizeof *out, out,
                     [this](uint64_t index, size_t n, void* to) {
                       readCopiedCells(index, n, static_cast<int64_t*>(to));
                     });
}

void MeshSpool::readCopiedCells(uint64_t first, size_t count, int64_t* out) {
  for (size_t i = 0; i < count; ++i, out += 4) {
    const uint64_t cell = first + i;
    if (cell >= cells_.rows()) {
      std::memcpy(out, wide_cells_.row(cell - cells_.rows()), 4 * sizeof(int64_t));
      continue;
    }
    const auto* narrow = static_cast<const int32_t*>(cells_.row(cell));
    std::copy_n(narrow, 4, out);
  }
}

void MeshSpool::readCellData(size_t column, uint64_t first, size_t count, void* out) {
  cell_data_[column]->read(first, count, out);
}

void MeshSpool::readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
  for (size_t i = 0; i < count; ++i, corners += 3) {
    const auto* row = static_cast<const int64_t*>(faces_->row(first + i));
    std::memcpy(corners, row, 3 * sizeof(int64_t));
    labels[i] = row[3];
  }
}

uint64_t MeshSpool::diskBytes() const {
  uint64_t bytes = positions_.diskBytes() + faces_->diskBytes();
  for (const RowSpool* spool : {&cells_, &wide_cells_}) bytes += spool->diskBytes();
  for (const Columns* columns : {&fields_, &cell_data_})
    for (const auto& rows : *columns) bytes += rows->diskBytes();
  return bytes;
}

}  // namespace tetstream
