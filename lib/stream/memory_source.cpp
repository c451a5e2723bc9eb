#include "memory_source.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

MemorySource::MemorySource(const Schema& schema, const BatchView& mesh, bool narrow_cells)
    : schema_(schema),
      fields_(mesh.fields, mesh.fields + schema.fields.size()),
      cell_data_(mesh.cell_data, mesh.cell_data + schema.cell_data.size()),
      mesh_(mesh),
      narrow_cells_(narrow_cells) {
  mesh_.fields = fields_.data();
  mesh_.cell_data = cell_data_.data();
  schema_.vertex_count = static_cast<int64_t>(mesh.vertex_count);
  schema_.cell_count = static_cast<int64_t>(mesh.cell_count);
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
  if (narrow_cells_) {
    const auto* const narrow = reinterpret_cast<const int32_t*>(mesh_.cells) + 4 * first;
    std::copy(narrow, narrow + 4 * count, out);
  } else {
    copyRows(mesh_.cells, first, count, 4 * sizeof(int64_t), out);
  }
  for (size_t i = 0; i < 4 * count; ++i)
    if (out[i] < 0 || out[i] >= schema_.vertex_count)
      fail(Status::kBadData, "cell %llu: vertex %lld is not one of the mesh's %lld",
           static_cast<unsigned long long>(first + i / 4), static_cast<long long>(out[i]),
           static_cast<long long>(schema_.vertex_count));
}

void MemorySource::readCellData(size_t column, uint64_t first, size_t count, void* out) {
  copyRows(mesh_.cell_data[column], first, count, schema_.cell_data[column].bytesPerRow(), out);
}

}  // namespace tetstream
