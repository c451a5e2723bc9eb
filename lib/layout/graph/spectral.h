// layout/graph: the spectral order of a mesh's vertices. Depends on fiedler.h, front_growth.h,
// vertex_graph.h.
#pragma once

#include <functional>

#include "connectivity.h"

namespace tetstream {

// Ranks vertices along the lowest eigenvectors of their graph's Laplacian (Vo et al. 2007, section
// 3.2, with unit weights): along the combination of them with the narrowest front, vertices of
// about the same value so that the front grows least. Components come one after the other; places
// in space play no part. `tell` is called now and then and may throw. About 270 bytes a vertex,
// 16 a cell for a while.
void orderSpectral(const Connectivity& mesh, Account& account, const std::function<void()>& tell,
                   Array<uint32_t>& rank);

// The values of that combination, which vary smoothly over the mesh: from i to i + 1 in the i-th
// component.
void findSpectralValues(const Connectivity& mesh, Account& account,
                        const std::function<void()>& tell, Array<float>& value);

}  // namespace tetstream
