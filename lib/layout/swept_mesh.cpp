#include "swept_mesh.h"

#include "vertex_keys.h"

namespace tetstream {

SweptMesh::SweptMesh(IndexedSource& source, Order order, const OrderOptions& options,
                     size_t memory_bytes, Account& account, const Tell& tell) {
  const bool is_spectral = order == Order::kSpectral;
  {
    OrderOptions by_place = options;
    by_place.order = nameOf(is_spectral ? Order::kHilbert : Order::kSpatial);
    by_place.tell = [&](double share) { tell(0.4 * share); };
    OrderedSource swept(source, by_place);
    unused_ = swept.unusedVertices();
    if (!is_spectral)
      rank(*swept.again(Part::kAll), memory_bytes, account, options.temp_dir,
           [&](double share) { tell(0.4 + 0.4 * share); });
    mesh_ = spoolStream(swept, options.temp_dir, [&](double share) { tell(0.8 + 0.1 * share); });
    disk_ = swept.diskBytes() + mesh_->diskBytes() + (ranks_ ? ranks_->diskBytes() : 0);
  }
  if (!is_spectral) return;
  clusters_.emplace(*mesh_, RankedVertices::Budget{memory_bytes, account, options.temp_dir},
                    [&](double share) { tell(0.9 + 0.1 * share); });
  disk_ = std::max(disk_, mesh_->diskBytes() + clusters_->diskBytes());
}

void SweptMesh::rank(Source& swept, size_t memory_bytes, Account& account,
                     const std::string& temp_dir, const Tell& tell) {
  ranks_.emplace(memory_bytes, account, temp_dir);
  const auto all = static_cast<double>(std::max<int64_t>(swept.schema().cell_count, 1));
  double seen = 0;
  for (BatchView batch; swept.next(batch); tell(seen / all)) {
    ranks_->put(batch);
    seen += static_cast<double>(batch.cell_count);
  }
  ranks_->finish();
}

VertexKey SweptMesh::key() {
  if (clusters_)
    return [this](uint64_t point, const double place[3]) {
      return keyOfNumber(clusters_->valueAt(point, place));
    };
  return [this](uint64_t, const double[3]) { return ranks_->next(); };
}

}  // namespace tetstream
