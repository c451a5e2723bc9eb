// gather: what the cells of a mesh in pieces say of its points, before any of them is read as
// tetrahedra: whether they share some, and whether joining takes corners from one. Depends on
// mesh_pieces.h, joined_points.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "joined_points.h"
#include "mesh_pieces.h"

namespace tetstream {

// Whether no cell shares a point with another, as fields that jump between cells are written, of
// more than a few cells. Takes a bit a point where there are as many points as that needs.
bool cellsAreApart(const MeshPieces& mesh);

// The first cell of which two points become one; none: there is none. What is no point is passed
// over.
std::optional<uint64_t> cellThatLosesACorner(const MeshPieces& mesh, PointJoin& points);
// The same of tetrahedra.
std::optional<uint64_t> cellThatLosesACorner(IndexedSource& mesh, PointJoin& points);

// Those at the same place as one, near ones too unless that takes a corner from a cell; null, and
// which cell, where it does all the same. Tells how many there are. find: as above.
using FindLosing = std::function<std::optional<uint64_t>(PointJoin&)>;
std::shared_ptr<PointJoin> joinKeepingCorners(IndexedSource& mesh, JoinPlan plan,
                                              const FindLosing& find, uint64_t* losing);

}  // namespace tetstream
