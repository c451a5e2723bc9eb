#include "memory_source.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

// note: of a mesh without rows the caller may have no array of pointers either.
static std::vector<const void*> columnsOf(const void* const* columns, size_t count, size_t rows) {
  using Columns = std::vector<const void*>;
  return rows > 0 ? Columns(columns, columns + count) : Columns(count);
}

MemorySource::MemorySource(const Schema& schema, const BatchView& mesh, Ids ids)
    : schema_(schema),
      fields_(columnsOf(mesh.fields, schema.fields.size(), mesh.vertex_count)),
      cell_data_(columnsOf(mesh.cell_data, schema.cell_data.size(), mesh.cell_count)),
      mesh_(mesh),
      locked_(account_),
      ids_(ids) {
  mesh_.fields = fields_.data();
  mesh_.cell_data = cell_data_.data();
  schema_.vertex_count = static_cast<int64_t>(mesh.vertex_count);
  schema_.cell_count = static_cast<int64_t>(mesh.cell_count);
  schema_.face_count = static_cast<int64_t>(mesh.face_count);
  if (mesh.edge_count > 0 || mesh.face_locks) lockVertices();
}

void MemorySource::lockVertices() {
  locked_.resize(mesh_.vertex_count);
  std::fill_n(locked_.data(), mesh_.vertex_count, uint8_t{0});
  if (mesh_.locked) std::copy_n(mesh_.locked, mesh_.vertex_count, locked_.data());
  for (size_t i = 0; i < mesh_.edge_count; ++i)
    lock("locked edge", i, mesh_.locked_edges + 2 * i, 2);
  for (size_t i = 0; mesh_.face_locks && i < mesh_.face_count; ++i)
    if (mesh_.face_locks[i]) lock("locked face", i, mesh_.faces + 3 * i, 3);
  mesh_.locked = locked_.data();
}

// The vertex's rank.
int64_t MemorySource::checked(const char* what, uint64_t row, int64_t vertex) const {
  if (vertex < ids_.first || vertex - ids_.first >= schema_.vertex_count)
    fail(Status::kBadData, "%s %llu: vertex %lld is not one of the mesh's %lld", what,
         static_cast<unsigned long long>(row) + static_cast<unsigned long long>(ids_.first),
         static_cast<long long>(vertex), static_cast<long long>(schema_.vertex_count));
  return vertex - ids_.first;
}

void MemorySource::lock(const char* what, size_t row, const int64_t* vertices, size_t count) {
  for (size_t j = 0; j < count; ++j)
    locked_[static_cast<size_t>(checked(what, row, vertices[j]))] = 1;
}

static void copyRows(const void* from, uint64_t first, size_t count, size_t stride, void* out) {
  if (count) std::memcpy(out, static_cast<const char*>(from) + first * stride, count * stride);
}

void MemorySource::readPositions(uint64_t first, size_t count, void* out) {
  copyRows(mesh_.positions, first, count, 3 * sizeOf(schema_.position_type), out);
}

void MemorySource::readField(size_t column, uint64_t first, size_t count, void* out) {
  copyRows(mesh_.fields[column], first, count, schema_.fields[column].bytesPerRow(), out);
}

void MemorySource::readCells(uint64_t first, size_t count, int64_t* out) {
  if (ids_.narrow_cells) {
    const int32_t* const narrow = ids_.narrow_cells + 4 * first;
    std::copy(narrow, narrow + 4 * count, out);
  } else {
    copyRows(mesh_.cells, first, count, 4 * sizeof(int64_t), out);
  }
  for (size_t i = 0; i < 4 * count; ++i) out[i] = checked("cell", first + i / 4, out[i]);
}

void MemorySource::readCellData(size_t column, uint64_t first, size_t count, void* out) {
  copyRows(mesh_.cell_data[column], first, count, schema_.cell_data[column].bytesPerRow(), out);
}

void MemorySource::readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) {
  copyRows(mesh_.faces, first, count, 3 * sizeof(int64_t), corners);
  copyRows(mesh_.face_labels, first, count, sizeof(int64_t), labels);
  for (size_t i = 0; i < 3 * count; ++i)
    corners[i] = checked("labelled face", first + i / 3, corners[i]);
}

}  // namespace tetstream
