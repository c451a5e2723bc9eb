#include "spooled_mesh.h"

#include <cstring>

#include "status.h"

namespace tetstream {

constexpr SpoolShape kInSequence = {2, 256 << 10};
constexpr size_t kFaceWords = 5;

static std::vector<std::unique_ptr<RowSpool>> spoolsFor(const std::vector<Column>& columns,
                                                        const std::string& temp_dir) {
  std::vector<std::unique_ptr<RowSpool>> spools;
  spools.reserve(columns.size());
  for (const Column& c : columns)
    spools.push_back(std::make_unique<RowSpool>(c.bytesPerRow(), temp_dir, kInSequence));
  return spools;
}

SpooledMesh::SpooledMesh(const Schema& schema, const std::string& temp_dir)
    : schema_(schema),
      temp_dir_(temp_dir),
      positions_(3 * sizeOf(schema_.position_type), temp_dir, kInSequence),
      cells_(4 * sizeof(int64_t), temp_dir, kInSequence),
      faces_(kFaceWords * sizeof(int64_t), temp_dir, kInSequence),
      fields_(spoolsFor(schema_.fields, temp_dir)),
      cell_data_(spoolsFor(schema_.cell_data, temp_dir)),
      locked_(account_) {}

// Arrays without rows may be null, and so may the lists of them.
void SpooledMesh::put(const BatchView& batch) {
  if (batch.vertex_count > 0) takeVertices(batch);
  if (batch.face_count > 0) takeFaces(batch);
  for (size_t i = 0; i < batch.edge_count; ++i)
    lock("locked edge", edges_read_++, batch.locked_edges + 2 * i, 2);
  if (batch.cell_count > 0) {
    cells_.append(batch.cells, batch.cell_count);
    for (size_t k = 0; k < cell_data_.size(); ++k)
      cell_data_[k]->append(batch.cell_data[k], batch.cell_count);
  }
}

void SpooledMesh::takeVertices(const BatchView& batch) {
  if (batch.locked) lock(batch);
  positions_.append(batch.positions, batch.vertex_count);
  for (size_t f = 0; f < fields_.size(); ++f)
    fields_[f]->append(batch.fields[f], batch.vertex_count);
  if (batch.origins && !origins_)
    origins_ = std::make_unique<RowSpool>(sizeof(int64_t), temp_dir_, kInSequence);
  if (batch.origins) origins_->append(batch.origins, batch.vertex_count);
}

void SpooledMesh::takeFaces(const BatchView& batch) {
  for (size_t i = 0; i < batch.face_count; ++i) {
    if (batch.face_locks && batch.face_locks[i])
      lock("locked face", faces_.rows(), batch.faces + 3 * i, 3);
    const int64_t* v = batch.faces + 3 * i;
    const auto place = static_cast<int64_t>(faces_.rows());
    const int64_t number = batch.face_origins ? batch.face_origins[i] : place;
    const int64_t row[kFaceWords] = {v[0], v[1], v[2], batch.face_labels[i], number};
    faces_.append(row, 1);
  }
}

void SpooledMesh::lock(const BatchView& batch) {
  const auto before = static_cast<size_t>(positions_.rows());
  makeRoomForLocks(before + batch.vertex_count);
  std::copy_n(batch.locked, batch.vertex_count, locked_.data() + before);
  any_locked_ = true;
}

void SpooledMesh::lock(const char* what, uint64_t row, const int64_t* vertices, size_t count) {
  makeRoomForLocks(static_cast<size_t>(positions_.rows()));
  any_locked_ = true;
  for (size_t j = 0; j < count; ++j) {
    if (vertices[j] < 0 || static_cast<uint64_t>(vertices[j]) >= positions_.rows())
      fail(Status::kBadData, "%s %llu: vertex %lld is not declared before it", what,
           static_cast<unsigned long long>(row), static_cast<long long>(vertices[j]));
    locked_[static_cast<size_t>(vertices[j])] = 1;
  }
}

void SpooledMesh::finish() {
  schema_.vertex_count = static_cast<int64_t>(positions_.rows());
  schema_.cell_count = static_cast<int64_t>(cells_.rows());
  schema_.face_count = static_cast<int64_t>(faces_.rows());
  if (any_locked_) makeRoomForLocks(static_cast<size_t>(positions_.rows()));
  for (RowSpool* spool : {&positions_, &cells_, &faces_}) spool->finish();
  if (origins_) origins_->finish();
  for (auto* columns : {&fields_, &cell_data_})
    for (auto& spool : *columns) spool->finish();
}

std::unique_ptr<SpooledMesh> spoolStream(Source& source, const std::string& temp_dir,
                                         const Tell& tell) {
  auto mesh = std::make_unique<SpooledMesh>(source.schema(), temp_dir);
  const auto all = static_cast<double>(std::max<int64_t>(source.schema().cell_count, 1));
  double seen = 0;
  for (BatchView batch; source.next(batch); tell(std::min(seen / all, 1.0))) {
    mesh->put(batch);
    seen += static_cast<double>(batch.cell_count);
  }
  mesh->finish();
  return mesh;
}

void SpooledMesh::makeRoomForLocks(size_t vertices) {
  const size_t known = locked_.size();
  if (known >= vertices) return;
  locked_.resize(vertices + vertices / 2);
  std::fill(locked_.data() + known, locked_.data() + locked_.size(), uint8_t{0});
}

void SpooledMesh::readPositions(uint64_t first, size_t count, void* out) {
  positions_.read(first, count, out);
}
void SpooledMesh::readField(size_t column, uint64_t first, size_t count, void* out) {
  fields_[column]->read(first, count, out);
}
void SpooledMesh::readCells(uint64_t first, size_t count, int64_t* out) {
  cells_.read(first, count, out);
}
void SpooledMesh::readCellData(size_t column, uint64_t first, size_t count, void* out) {
  cell_data_[column]->read(first, count, out);
}

void SpooledMesh::readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
  for (size_t i = 0; i < count; ++i) {
    const auto* row = static_cast<const unsigned char*>(faces_.row(first + i));
    std::memcpy(corners + 3 * i, row, 3 * sizeof(int64_t));
    std::memcpy(labels + i, row + 3 * sizeof(int64_t), sizeof(int64_t));
  }
}

int64_t SpooledMesh::faceNumber(uint64_t row) {
  return static_cast<const int64_t*>(faces_.row(row))[kFaceWords - 1];
}

void SpooledMesh::readOrigins(uint64_t first, size_t count, int64_t* out) {
  if (!origins_) return IndexedSource::readOrigins(first, count, out);
  origins_->read(first, count, out);
}

uint64_t SpooledMesh::diskBytes() const {
  uint64_t bytes = positions_.diskBytes() + cells_.diskBytes() + faces_.diskBytes();
  if (origins_) bytes += origins_->diskBytes();
  for (const auto* columns : {&fields_, &cell_data_})
    for (const auto& spool : *columns) bytes += spool->diskBytes();
  return bytes;
}

}  // namespace tetstream
