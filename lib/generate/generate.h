// generate: meshes made on the fly, in constant memory. Depends on stream.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "source.h"

namespace tetstream {

// kind "fluid": [0,1] x [0,1] x [0,4], n x n x 4n cubes of six cells, vertices jittered, emitted
// along z so that the front is at most 6 n^2 + 3 n + 5 cells (6.5 n^2 from n = 8 on). Fields:
// float32 "density" (a Rayleigh-Taylor-like mixing layer) and "velocity" (3). kind "ball": a unit
// ball with a curved boundary, n x n x n cubes, n even, same fields; its front is at most
// 6 n^2 + 6 n + 12 cells. "fluid+stress", "ball+stress": the same with a third field, "stress" (6,
// a symmetric tensor, see stress.h). The count is the one nearest to `cells`; the same arguments
// give the same bytes on every machine. The schema says counts, front and box: of positions
// exactly, of fields bounds. Memory does not depend on `cells`. Throws kBadArgument: another kind,
// `cells` outside 1 ... 10^15.
std::unique_ptr<Source> generate(const std::string& kind, int64_t cells, int64_t seed);

}  // namespace tetstream
