#include "sv_spool.h"

#include "mesh_spool.h"
#include "status.h"
#include "sv_check.h"

namespace tetstream {

// Corners become ranks, of vertices that stand before the cell.
static void resolve(const SvElements& elements, SvBlock& block, uint64_t vertices) {
  size_t cell = 0;
  for (size_t i = 0; i < block.kinds.size(); ++i) {
    std::string problem;
    if (block.kinds[i] == SvKind::kVertex)
      ++vertices;
    else if (!svResolveIndexed(block.rows.cell(cell++), static_cast<int64_t>(vertices), &problem))
      fail(Status::kBadData, "%s: %s", elements.where(block.places[i]).c_str(), problem.c_str());
  }
}

std::unique_ptr<IndexedSource> spoolSvElements(SvElements& elements, const std::string& temp_dir) {
  auto mesh = std::make_unique<MeshSpool>(elements.schema(), temp_dir);
  SvBlock block(elements.schema());
  while (elements.read(block)) {
    checkSvPositions(elements, block);
    resolve(elements, block, mesh->pointCount());
    mesh->append(block.rows.view());
    block.clear(mesh->pointCount());
  }
  mesh->finish();
  mesh->finishFaces();
  checkSvCounts(elements, mesh->schema().vertex_count, mesh->schema().cell_count);
  return mesh;
}

}  // namespace tetstream
