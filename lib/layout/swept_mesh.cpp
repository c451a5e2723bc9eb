#include "swept_mesh.h"

namespace tetstream {

SweptMesh::SweptMesh(IndexedSource& source, const OrderOptions& options, size_t memory_bytes,
                     Account& account, const Tell& tell)
    : ranks_(memory_bytes, account, options.temp_dir) {
  OrderOptions sweep = options;
  sweep.order = nameOf(Order::kSpatial);
  sweep.tell = [&](double share) { tell(0.4 * share); };
  OrderedSource swept(source, sweep);
  unused_ = swept.unusedVertices();
  const std::unique_ptr<Source> first = swept.again();
  const auto all = static_cast<double>(std::max<int64_t>(swept.schema().cell_count, 1));
  double seen = 0;
  for (BatchView batch; first->next(batch); tell(0.4 + 0.4 * seen / all)) {
    ranks_.put(batch);
    seen += static_cast<double>(batch.cell_count);
  }
  ranks_.finish();
  mesh_ = std::make_unique<SpooledMesh>(swept, options.temp_dir,
                                        [&](double share) { tell(0.8 + 0.2 * share); });
  disk_ = swept.diskBytes() + mesh_->diskBytes() + ranks_.diskBytes();
}

VertexKey SweptMesh::key() {
  return [this](uint64_t, const double[3]) { return ranks_.next(); };
}

}  // namespace tetstream
