#include "mesh_collector.h"

#include <cstring>

namespace tetstream {

MeshCollector::MeshCollector(const Schema& schema) : schema_(schema), mesh_(schema) {
  mesh_.clear(0);
}

// note: an array without rows may be null, and so may the list of such arrays.
static void copyRows(void* to, const void* from, size_t rows, size_t stride) {
  if (rows) std::memcpy(to, from, rows * stride);
}

void MeshCollector::put(const BatchView& batch) {
  const size_t vertices = batch.vertex_count, cells = batch.cell_count;
  const size_t vertex = mesh_.addVertices(vertices), cell = mesh_.addCells(cells);
  copyRows(mesh_.position(vertex), batch.positions, vertices, 3 * sizeOf(schema_.position_type));
  for (size_t i = 0; vertices && i < schema_.fields.size(); ++i)
    copyRows(mesh_.field(i, vertex), batch.fields[i], vertices, schema_.fields[i].bytesPerRow());
  for (size_t i = 0; batch.locked && i < vertices; ++i)
    if (batch.locked[i]) mesh_.lock(vertex + i);
  copyRows(mesh_.cell(cell), batch.cells, cells, 4 * sizeof(int64_t));
  for (size_t i = 0; cells && i < schema_.cell_data.size(); ++i)
    copyRows(mesh_.cellData(i, cell), batch.cell_data[i], cells,
             schema_.cell_data[i].bytesPerRow());
}

std::unique_ptr<IndexedSource> MeshCollector::source() {
  return std::make_unique<MemorySource>(schema_, mesh_.view());
}

}  // namespace tetstream
