// layout/graph: the lowest eigenvectors of a graph's Laplacian. Depends on laplacian.h.
//
// Found from the coarsest graph to the finest: the vectors of one level, continued on the next, are
// improved there by LOBPCG (Knyazev 2001), matrix-free, preconditioned by the coarser levels, kept
// orthogonal to the constant vector. Own code, because no library at hand serves: shift and invert
// by a direct factorisation (Spectra) takes 12 s at 28,000 vertices and grows with the square of
// their number in 3-D; iterations without a hierarchy (ARPACK, LOBPCG plain) need thousands of
// rounds where the lowest eigenvalues are 1e-5 of the highest, as they are in long meshes.
#pragma once

#include <array>
#include <functional>

#include "laplacian.h"

namespace tetstream {

// The first four vectors above the constant one, of length 1, orthogonal, by rising eigenvalue; the
// first is Fiedler's. Zeros where the graph has not as many. Returns the eigenvalues. About 200
// bytes a vertex.
std::array<double, 4> lowestVectors(const GraphView& graph, Account& account,
                                    const std::function<void()>& tell, Array<Four>& x);

}  // namespace tetstream
