#include "vtk_cells.h"

#include <utility>

namespace tetstream {

namespace {

constexpr int kVtkPixel = 8, kVtkVoxel = 11, kVtkWedge = 13;
constexpr CellKind kNoKind = {CellShape::kPoint, 0};

using Shape = CellShape;

// Up to this one, rows stand in the place of their number.
constexpr int kInPlace = 16;

constexpr VtkCell kVtkCells[] = {
    {0, "an empty cell", VtkCell::kEmpty, kNoKind},
    {1, "a vertex", VtkCell::kKnown, {Shape::kPoint, 1}},
    {2, "a set of vertices", VtkCell::kLower, kNoKind},
    {3, "a line", VtkCell::kKnown, {Shape::kLine, 2}},
    {4, "a polyline", VtkCell::kLower, kNoKind},
    {kVtkTriangle, "a triangle", VtkCell::kKnown, {Shape::kTriangle, 3}},
    {6, "a triangle strip", VtkCell::kLower, kNoKind},
    {7, "a polygon", VtkCell::kLower, kNoKind},
    {kVtkPixel, "a pixel", VtkCell::kKnown, {Shape::kQuadrilateral, 4}},
    {9, "a quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 4}},
    {kVtkTetra, "a tetrahedron", VtkCell::kKnown, {Shape::kTetra, 4}},
    {kVtkVoxel, "a voxel", VtkCell::kKnown, {Shape::kHexa, 8}},
    {12, "a hexahedron", VtkCell::kKnown, {Shape::kHexa, 8}},
    {kVtkWedge, "a wedge", VtkCell::kKnown, {Shape::kPrism, 6}},
    {14, "a pyramid", VtkCell::kKnown, {Shape::kPyramid, 5}},
    {15, "a pentagonal prism", VtkCell::kOther, kNoKind},
    {16, "a hexagonal prism", VtkCell::kOther, kNoKind},
    {21, "a quadratic line", VtkCell::kKnown, {Shape::kLine, 3}},
    {22, "a quadratic triangle", VtkCell::kKnown, {Shape::kTriangle, 6}},
    {23, "a quadratic quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 8}},
    {24, "a quadratic tetrahedron", VtkCell::kKnown, {Shape::kTetra, 10}},
    {25, "a quadratic hexahedron", VtkCell::kKnown, {Shape::kHexa, 20}},
    {26, "a quadratic wedge", VtkCell::kKnown, {Shape::kPrism, 15}},
    {27, "a quadratic pyramid", VtkCell::kKnown, {Shape::kPyramid, 13}},
    {28, "a biquadratic quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 9}},
    {29, "a triquadratic hexahedron", VtkCell::kKnown, {Shape::kHexa, 27}},
    {30, "a quadratic linear quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 6}},
    {31, "a quadratic linear wedge", VtkCell::kKnown, {Shape::kPrism, 12}},
    {32, "a biquadratic wedge", VtkCell::kKnown, {Shape::kPrism, 18}},
    {33, "a biquadratic hexahedron", VtkCell::kKnown, {Shape::kHexa, 24}},
    {34, "a biquadratic triangle", VtkCell::kKnown, {Shape::kTriangle, 7}},
    {35, "a cubic line", VtkCell::kKnown, {Shape::kLine, 4}},
    {36, "a quadratic polygon", VtkCell::kLower, kNoKind},
    {37, "a triquadratic pyramid", VtkCell::kKnown, {Shape::kPyramid, 19}},
    {41, "a convex set of points", VtkCell::kOther, kNoKind},
    {42, "a polyhedron", VtkCell::kOther, kNoKind},
    {68, "a Lagrange line", VtkCell::kKnown, {Shape::kLine, 0}},
    {69, "a Lagrange triangle", VtkCell::kKnown, {Shape::kTriangle, 0}},
    {70, "a Lagrange quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 0}},
    {71, "a Lagrange tetrahedron", VtkCell::kKnown, {Shape::kTetra, 0}},
    {72, "a Lagrange hexahedron", VtkCell::kKnown, {Shape::kHexa, 0}},
    {73, "a Lagrange wedge", VtkCell::kKnown, {Shape::kPrism, 0}},
    {74, "a Lagrange pyramid", VtkCell::kKnown, {Shape::kPyramid, 0}},
    {75, "a Bezier line", VtkCell::kKnown, {Shape::kLine, 0}},
    {76, "a Bezier triangle", VtkCell::kKnown, {Shape::kTriangle, 0}},
    {77, "a Bezier quadrilateral", VtkCell::kKnown, {Shape::kQuadrilateral, 0}},
    {78, "a Bezier tetrahedron", VtkCell::kKnown, {Shape::kTetra, 0}},
    {79, "a Bezier hexahedron", VtkCell::kKnown, {Shape::kHexa, 0}},
    {80, "a Bezier wedge", VtkCell::kKnown, {Shape::kPrism, 0}},
    {81, "a Bezier pyramid", VtkCell::kKnown, {Shape::kPyramid, 0}},
};

}  // namespace

const VtkCell& vtkCell(int64_t type) {
  static constexpr VtkCell unknown = {-1, "no tetrahedron", VtkCell::kOther, kNoKind};
  static_assert(kVtkCells[kInPlace].type == kInPlace);
  if (type >= 0 && type <= kInPlace) return kVtkCells[type];
  for (const VtkCell& row : kVtkCells)
    if (row.type == type) return row;
  return unknown;
}

bool hasRowCorners(int64_t type) {
  return type == kVtkPixel || type == kVtkVoxel;
}

void orderVtkCorners(int64_t type, int64_t* corners) {
  if (hasRowCorners(type)) std::swap(corners[2], corners[3]);
  if (type == kVtkVoxel) std::swap(corners[6], corners[7]);
  if (type != kVtkWedge) return;
  std::swap(corners[1], corners[2]);
  std::swap(corners[4], corners[5]);
}

}  // namespace tetstream
