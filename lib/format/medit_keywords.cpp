#include "medit_keywords.h"

namespace tetstream {

namespace {

constexpr CellKind kTriangle = {CellShape::kTriangle, 3}, kTriangle6 = {CellShape::kTriangle, 6},
                   kQuad = {CellShape::kQuadrilateral, 4}, kQuad9 = {CellShape::kQuadrilateral, 9},
                   kTetra = {CellShape::kTetra, 4}, kTetra10 = {CellShape::kTetra, 10},
                   kPrism = {CellShape::kPrism, 6}, kHexa = {CellShape::kHexa, 8},
                   kHexa27 = {CellShape::kHexa, 27}, kPyramid = {CellShape::kPyramid, 5};

// Those without a kind of cell are here for their names, where they are left out.
constexpr MeditKeyword kKeywords[] = {
    {"MeshVersionFormatted", 1, nullptr},
    {"Dimension", kMeditDimension, nullptr},
    {"Vertices", kMeditVertices, nullptr},
    {"Edges", 5, nullptr},
    {"Triangles", kMeditTriangles, &kTriangle},
    {"Quadrilaterals", 7, &kQuad},
    {"Tetrahedra", kMeditTetrahedra, &kTetra},
    {"Prisms", 9, &kPrism},
    {"Hexahedra", 10, &kHexa},
    {"Corners", 13, nullptr},
    {"Ridges", 14, nullptr},
    {"RequiredVertices", kMeditRequiredVertices, nullptr},
    {"RequiredEdges", 16, nullptr},
    {"RequiredTriangles", 17, nullptr},
    {"RequiredQuadrilaterals", 18, nullptr},
    {"TangentAtEdgeVertices", 19, nullptr},
    {"NormalAtVertices", 20, nullptr},
    {"NormalAtTriangleVertices", 21, nullptr},
    {"NormalAtQuadrilateralVertices", 22, nullptr},
    {"AngleOfCornerBound", 23, nullptr},
    {"TrianglesP2", 24, &kTriangle6},
    {"EdgesP2", 25, nullptr},
    {"QuadrilateralsQ2", 27, &kQuad9},
    {"TetrahedraP2", 30, &kTetra10},
    {"HexahedraQ2", 33, &kHexa27},
    {"Pyramids", 49, &kPyramid},
    {"BoundingBox", 50, nullptr},
    {"End", kMeditEnd, nullptr},
    {"Tangents", 59, nullptr},
    {"Normals", 60, nullptr},
    {"TangentAtVertices", 61, nullptr},
    {"SolAtVertices", kMeditSolAtVertices, nullptr},
    {"SolAtTriangles", 64, nullptr},
    {"SolAtTetrahedra", kMeditSolAtTetrahedra, nullptr},
};

}  // namespace

const MeditKeyword* meditKeyword(std::string_view name) {
  for (const MeditKeyword& keyword : kKeywords)
    if (name == keyword.name) return &keyword;
  return nullptr;
}

const MeditKeyword* meditKeyword(int64_t number) {
  for (const MeditKeyword& keyword : kKeywords)
    if (number == keyword.number) return &keyword;
  return nullptr;
}

}  // namespace tetstream
