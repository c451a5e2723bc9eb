// generate: meshes made on the fly, in memory of the size of their front. Depends on stream.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "source.h"

namespace tetstream {

// kind "fluid": [0,1] x [0,1] x [0,4], n x n x 4n cubes of six cells, vertices jittered, emitted
// along z so that the front is at most 6.5 n^2 cells. Fields: float32 "density" (a
// Rayleigh-Taylor-like mixing layer) and "velocity" (3). kind "ball": a unit ball with a curved
// boundary, same fields. About `cells` cells; the same arguments give the same bytes. The schema
// says counts, box and front. Throws kBadArgument.
std::unique_ptr<Source> generate(const std::string& kind, int64_t cells, int64_t seed);

}  // namespace tetstream
