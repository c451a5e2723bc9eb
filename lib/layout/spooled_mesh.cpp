#include "spooled_mesh.h"

#include "status.h"

namespace tetstream {

SpooledMesh::SpooledMesh(const Schema& schema, const std::string& temp_dir)
    : mesh_(schema, temp_dir),
      origins_(sizeof(int64_t), temp_dir, kSpooledInSequence),
      face_numbers_(sizeof(int64_t), temp_dir, kSpooledInSequence) {}

void SpooledMesh::put(const BatchView& batch) {
  const uint64_t faces_before = mesh_.faceCount();
  mesh_.append(batch);
  if (batch.origins) origins_.append(batch.origins, batch.vertex_count);
  if (batch.face_origins) face_numbers_.append(batch.face_origins, batch.face_count);
  lock(batch);
  for (size_t i = 0; batch.face_locks && i < batch.face_count; ++i)
    if (batch.face_locks[i]) lock("locked face", faces_before + i, batch.faces + 3 * i, 3);
  for (size_t i = 0; i < batch.edge_count; ++i)
    lock("locked edge", edges_read_++, batch.locked_edges + 2 * i, 2);
}

void SpooledMesh::lock(const BatchView& batch) {
  const uint64_t first = mesh_.pointCount() - batch.vertex_count;
  for (size_t i = 0; batch.locked && i < batch.vertex_count; ++i)
    if (batch.locked[i]) mesh_.lock(first + i);
}

void SpooledMesh::lock(const char* what, uint64_t row, const int64_t* vertices, size_t count) {
  for (size_t j = 0; j < count; ++j) {
    if (vertices[j] < 0 || static_cast<uint64_t>(vertices[j]) >= mesh_.pointCount())
      fail(Status::kBadData, "%s %llu: vertex %lld is not declared before it", what,
           static_cast<unsigned long long>(row), static_cast<long long>(vertices[j]));
    mesh_.lock(static_cast<uint64_t>(vertices[j]));
  }
}

void SpooledMesh::finish() {
  mesh_.finish();
  mesh_.finishFaces();
  origins_.finish();
  face_numbers_.finish();
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

int64_t SpooledMesh::faceNumber(uint64_t row) {
  if (face_numbers_.rows() == 0) return IndexedSource::faceNumber(row);
  return *static_cast<const int64_t*>(face_numbers_.row(row));
}

void SpooledMesh::readOrigins(uint64_t first, size_t count, int64_t* out) {
  if (!hasOrigins()) return IndexedSource::readOrigins(first, count, out);
  origins_.read(first, count, out);
}

uint64_t SpooledMesh::diskBytes() const {
  return mesh_.diskBytes() + origins_.diskBytes() + face_numbers_.diskBytes();
}

}  // namespace tetstream
