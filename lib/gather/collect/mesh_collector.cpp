#include "mesh_collector.h"

#include "status.h"

namespace tetstream {

void MeshCollector::note(const std::string& text) const {
  if (options_.note) options_.note(bytes_->name() + ": " + text);
}

void MeshCollector::begin(const Schema& schema) {
  checkSchema(schema);
  mesh_ = std::make_unique<MeshSpool>(schema.position_type, options_.temp_dir);
  for (const Column& c : schema.fields) mesh_->addField(c);
  for (const Column& c : schema.cell_data) mesh_->addCellData(c);
  mesh_->nameLabels(schema.label_names);
}

void MeshCollector::put(const BatchView& batch) {
  if (batch.vertex_count > 0) {
    const uint64_t first = mesh_->pointCount();
    mesh_->appendPositions(batch.positions, batch.vertex_count);
    for (size_t i = 0; i < mesh_->schema().fields.size(); ++i)
      mesh_->appendField(i, batch.fields[i], batch.vertex_count);
    for (size_t i = 0; batch.locked && holdsLocks() && i < batch.vertex_count; ++i)
      if (batch.locked[i]) mesh_->lock(first + i);
  }
  if (batch.cell_count > 0) {
    mesh_->appendCells(batch.cells, batch.cell_count);
    for (size_t i = 0; i < mesh_->schema().cell_data.size(); ++i)
      mesh_->appendCellData(i, batch.cell_data[i], batch.cell_count);
  }
  for (size_t i = 0; i < batch.face_count; ++i)
    mesh_->appendFace(batch.faces + 3 * i, batch.face_labels[i]);
  BatchView lost = batch;
  if (holdsLocks()) lost.locked = nullptr;
  dropped_.lookAtLocks(lost);
}

void MeshCollector::finish() {
  mesh_->finish();
  mesh_->finishFaces();
  write(*mesh_);
  bytes_->commit();
}

}  // namespace tetstream
