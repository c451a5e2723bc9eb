#include "traversal.h"

#include <algorithm>

namespace tetstream {

Traversal::Traversal(const Connectivity& mesh, const Meeting& meet, Account& account,
                     Array<uint32_t>& rank)
    : mesh_(mesh),
      meet_(meet),
      queue_(account, mesh.vertices),
      met_(account, mesh.vertices),
      completes_(account, mesh.vertices),
      taken_corners_(account, mesh.cells),
      rank_(rank) {
  std::fill_n(rank.data(), mesh.vertices, kUnused);
  std::fill_n(met_.data(), mesh.vertices, 0u);
  std::fill_n(completes_.data(), mesh.vertices, uint8_t{0});
  std::fill_n(taken_corners_.data(), mesh.cells, uint8_t{0});
}

void Traversal::goOn() {
  for (; oldest_ < taken_; ++oldest_)
    for (uint32_t next; (next = best(queue_[oldest_])) != kUnused;) take(next);
}

uint32_t Traversal::best(uint32_t vertex) const {
  uint32_t found = kUnused;
  uint64_t most = 0;
  for (const uint32_t* u = meet_.graph.begin(vertex); u < meet_.graph.end(vertex); ++u) {
    if (rank_[*u] != kUnused) continue;
    const uint64_t key = uint64_t{completes_[*u]} << 32 | met_[*u];
    if (found != kUnused && key <= most) continue;
    found = *u;
    most = key;
  }
  return found;
}

void Traversal::take(uint32_t vertex) {
  rank_[vertex] = taken_;
  queue_[taken_++] = vertex;
  for (const uint32_t* u = meet_.graph.begin(vertex); u < meet_.graph.end(vertex); ++u)
    if (rank_[*u] == kUnused && met_[*u] == 0) met_[*u] = ++meetings_;
  const CellLists& lists = meet_.lists;
  for (uint32_t i = lists.first[vertex]; i < lists.first[vertex + 1]; ++i) {
    if (++taken_corners_[lists.cell[i]] != 3) continue;
    for (const uint32_t *v = mesh_.cell(lists.cell[i]), *end = v + 4; v < end; ++v)
      if (rank_[*v] == kUnused) completes_[*v] = 1;
  }
}

}  // namespace tetstream
