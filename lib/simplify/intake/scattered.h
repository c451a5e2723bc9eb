// simplify/intake: labels that are scattered over the cells and make no regions. Depends on mesh.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "embedded.h"
#include "topology.h"

namespace tetstream {

using CellPair = std::pair<uint32_t, uint32_t>;

// Some of the pairs of cells that share a face, a few thousand at most: those of the vertices that
// are picked.
std::vector<CellPair> someNeighbours(const Topology& mesh);

// Whether neighbours have different labels about as often as any two cells have, where many do:
// counters, qualities and noise, of which every cell would be a region of its own. Of the smallest
// that are none, cubes with labels by chance, half of the cells' faces lie inside.
bool areScattered(const CellLabels& labels, const std::vector<CellPair>& neighbours);

}  // namespace tetstream
