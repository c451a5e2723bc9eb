// gather/pieces: which of the time steps of a file is read. Depends on file_format.h,
// mesh_pieces.h.
#pragma once

#include <functional>
#include <optional>

#include "file_format.h"
#include "mesh_pieces.h"

namespace tetstream {

// When a step is; none: that is not known. Empty where no step tells.
using StepTimes = std::function<std::optional<double>(uint64_t)>;

// "first", "last" or a number from 0, as ReadOptions has it; throws kBadArgument.
int64_t parseStep(const std::string& text);

// Of the values, if it is told and not known yet; that one is not finite is noted.
void takeTime(MeshPieces& mesh, std::optional<double> time);

// What `read` gives. That a file's time cannot be read is no reason not to read its mesh: where it
// throws kBadData or kUnsupported there is none, and a note tells why.
std::optional<double> readTime(MeshPieces& mesh,
                               const std::function<std::optional<double>()>& read);

// The one of that step, out of a list.
double timeIn(Values& times, uint64_t step = 0);

// Of `count` time steps, at least one, the one that the options want, from 0; a note tells how many
// there are, where there are several. Throws kBadArgument if it is none of them. The time of the
// step is the mesh's; of a single one it is read as in readTime.
uint64_t chooseStep(MeshPieces& mesh, uint64_t count, const ReadOptions& options,
                    const StepTimes& time);

}  // namespace tetstream
