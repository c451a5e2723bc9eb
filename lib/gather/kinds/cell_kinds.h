// gather/kinds: cells of other shapes: what they are called, and how they become tetrahedra.
// Depends on nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

enum class CellShape { kPoint, kLine, kTriangle, kQuadrilateral, kTetra, kPyramid, kPrism, kHexa };

// A format's kind of cell. Corners come first; what follows them are nodes of higher order.
struct CellKind {
  CellShape shape;
  int nodes;
};

constexpr int cornersOf(CellShape shape) {
  constexpr int corners[] = {1, 2, 3, 4, 4, 5, 6, 8};
  return corners[static_cast<int>(shape)];
}
constexpr int dimensionOf(CellShape shape) {
  constexpr int dimensions[] = {0, 1, 2, 2, 3, 3, 3, 3};
  return dimensions[static_cast<int>(shape)];
}
const char* nameOf(CellShape shape);  // "hexahedron"

constexpr size_t kMostCorners = 8;  // of one cell
constexpr size_t kMostSplit = 6;    // tetrahedra of one cell

// What readers say of them: in an error after the cell's name, in notes after the number of cells.
constexpr char kOnlyTetrahedra[] =
    "only tetrahedra are read, unless other cells are to be split into them (option split, "
    "--split)";
constexpr char kSplitNote[] = "cells that are no tetrahedra are split into them";
constexpr char kHigherOrderNote[] =
    "cells of higher order are read by their corners: what lies between is left out";

// Splits a cell with four corners or more into tetrahedra, a face into triangles, by its corners'
// ranks alone: each quadrilateral is cut from its smallest corner, so that cells that share it
// agree (J. Dompierre et al., How to Subdivide Pyramids, Prisms and Hexahedra into Tetrahedra,
// 1999); what is inside comes from the cell's smallest corner. Tetrahedra with a corner twice, of
// cells that are collapsed, are left out. Returns how many there are. The orientation is that of
// the formats: seen from within, the first face goes round counter-clockwise.
size_t splitCell(CellShape shape, const int64_t* corners, int64_t (*out)[4]);
size_t splitFace(CellShape shape, const int64_t* corners, int64_t (*out)[3]);

}  // namespace tetstream
