#include "medit_keywords.h"

namespace tetstream {

namespace {

constexpr CellKind kTriangleCell = {CellShape::kTriangle, 3},
                   kTriangle6Cell = {CellShape::kTriangle, 6},
                   kQuadCell = {CellShape::kQuadrilateral, 4},
                   kQuad9Cell = {CellShape::kQuadrilateral, 9}, kTetraCell = {CellShape::kTetra, 4},
                   kTetra10Cell = {CellShape::kTetra, 10}, kPrismCell = {CellShape::kPrism, 6},
                   kHexaCell = {CellShape::kHexa, 8}, kHexa27Cell = {CellShape::kHexa, 27},
                   kPyramidCell = {CellShape::kPyramid, 5};

// Those without a kind of cell are here for their names, where they are left out.
constexpr MeditKeyword kMeditKeywords[] = {
    {"MeshVersionFormatted", 1, nullptr},
    {"Dimension", kMeditDimension, nullptr},
    {"Vertices", kMeditVertices, nullptr},
    {"Edges", kMeditEdges, nullptr},
    {"Triangles", kMeditTriangles, &kTriangleCell},
    {"Quadrilaterals", 7, &kQuadCell},
    {"Tetrahedra", kMeditTetrahedra, &kTetraCell},
    {"Prisms", 9, &kPrismCell},
    {"Hexahedra", 10, &kHexaCell},
    {"Corners", 13, nullptr},
    {"Ridges", 14, nullptr},
    {"RequiredVertices", kMeditRequiredVertices, nullptr},
    {"RequiredEdges", kMeditRequiredEdges, nullptr},
    {"RequiredTriangles", kMeditRequiredTriangles, nullptr},
    {"RequiredQuadrilaterals", 18, nullptr},
    {"TangentAtEdgeVertices", 19, nullptr},
    {"NormalAtVertices", 20, nullptr},
    {"NormalAtTriangleVertices", 21, nullptr},
    {"NormalAtQuadrilateralVertices", 22, nullptr},
    {"AngleOfCornerBound", 23, nullptr},
    {"TrianglesP2", 24, &kTriangle6Cell},
    {"EdgesP2", 25, nullptr},
    {"QuadrilateralsQ2", 27, &kQuad9Cell},
    {"TetrahedraP2", 30, &kTetra10Cell},
    {"HexahedraQ2", 33, &kHexa27Cell},
    {"Pyramids", 49, &kPyramidCell},
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
  for (const MeditKeyword& keyword : kMeditKeywords)
    if (name == keyword.name) return &keyword;
  return nullptr;
}

const MeditKeyword* meditKeyword(int64_t number) {
  for (const MeditKeyword& keyword : kMeditKeywords)
    if (number == keyword.number) return &keyword;
  return nullptr;
}

}  // namespace tetstream
