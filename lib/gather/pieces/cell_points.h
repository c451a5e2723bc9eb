// gather/pieces: what the cells of a mesh in pieces say of its points, before any of them is read
// as tetrahedra: whether they share some, and whether joining takes corners from one. Depends on
// mesh_pieces.h, kept_corners.h.
#pragma once

#include <optional>

#include "kept_corners.h"
#include "mesh_pieces.h"

namespace tetstream {

// Whether no cell shares a point with another, as fields that jump between cells are written, of
// more than a few cells. Takes a bit a point where there are as many points as that needs.
bool cellsAreApart(const MeshPieces& mesh);

// The first cell of which two points become one; none: there is none. What is no point is passed
// over.
std::optional<uint64_t> cellThatLosesACorner(const MeshPieces& mesh, PointJoin& points);

}  // namespace tetstream
