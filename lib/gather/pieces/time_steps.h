// gather/pieces: which of the time steps of a file is read. Depends on file_format.h,
// mesh_pieces.h.
#pragma once

#include <functional>

#include "file_format.h"
#include "mesh_pieces.h"

namespace tetstream {

// "first", "last" or a number from 0, as ReadOptions has it; throws kBadArgument.
int64_t parseStep(const std::string& text);

// Of the values, unless it is known or not finite.
void takeTime(MeshPieces& mesh, double time);

// Of `count` time steps, at least one, the one that the options want, from 0; a note tells how many
// there are, where there are several. Throws kBadArgument if it is none of them. `time` tells when
// a step is, and that is the mesh's then; it may be empty.
uint64_t chooseStep(MeshPieces& mesh, uint64_t count, const ReadOptions& options,
                    const std::function<double(uint64_t)>& time);

}  // namespace tetstream
