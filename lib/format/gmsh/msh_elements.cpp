#include "msh_elements.h"

#include <numeric>

namespace tetstream {

MshElements::MshElements(MeshSpool& mesh, MshLabels& labels, const WriteOptions& options)
    : mesh_(mesh), labels_(labels), options_(options) {
  if (!options.newest || labels.cellsAreTogether()) return;
  std::map<int64_t, uint64_t> counts;
  for (const auto& [key, volume] : labels.volumes()) counts[volume.rank] = volume.cells;
  auto grouped = std::make_unique<GroupedRows<Cell>>(counts, options.temp_dir);
  forEachInStream([&](uint64_t number, const MshVolume& volume, const int64_t* corners) {
    grouped->add(volume.rank, {{corners[0], corners[1], corners[2], corners[3]}, number});
  });
  grouped->finish();
  cells_ = std::move(grouped);
}

std::unique_ptr<OrderedRows> MshElements::inOrder(size_t column, size_t bytes) {
  std::vector<uint64_t> next(labels_.volumes().size() + 1, 0);  // place of each volume, by its rank
  for (const auto& [key, volume] : labels_.volumes())
    next[static_cast<size_t>(volume.rank) + 1] = volume.cells;
  std::partial_sum(next.begin(), next.end(), next.begin());
  auto rows = std::make_unique<OrderedRows>(mesh_.cellCount(), bytes, options_.temp_dir);
  std::vector<unsigned char> held(kRowsAtOnce * bytes);
  labels_.forEachCell([&](uint64_t cell, const MshVolume& volume) {
    const size_t at = cell % kRowsAtOnce;
    if (at == 0) mesh_.readCellData(column, cell, rowsFrom(cell), held.data());
    rows->put(next[static_cast<size_t>(volume.rank)]++, held.data() + at * bytes);
  });
  rows->finish();
  return rows;
}

}  // namespace tetstream
