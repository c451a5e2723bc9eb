#include "mesh_collector.h"

#include "status.h"

namespace tetstream {

void MeshCollector::note(const std::string& text) const {
  if (options_.note) options_.note(bytes_->name() + ": " + text);
}

void MeshCollector::noteRounded(const std::string& array) const {
  note("\"" + array + "\" has integers that a float64 does not hold: they are rounded");
}

void MeshCollector::begin(const Schema& schema) {
  checkSchema(schema);
  mesh_ = std::make_unique<MeshSpool>(schema, options_.temp_dir);
}

void MeshCollector::put(const BatchView& batch) {
  const uint64_t first = mesh_->pointCount();
  mesh_->append(batch);
  if (!holdsLocks()) return dropped_.lookAtLocks(batch);
  dropped_.lookAtLockedFaces(batch);
  for (size_t i = 0; batch.locked && i < batch.vertex_count; ++i)
    if (batch.locked[i]) mesh_->lock(first + i);
}

void MeshCollector::finish() {
  mesh_->finish();
  mesh_->finishFaces();
  write(*mesh_);
  bytes_->commit();
}

}  // namespace tetstream
