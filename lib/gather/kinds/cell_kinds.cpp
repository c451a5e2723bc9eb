#include "cell_kinds.h"

#include <algorithm>

namespace tetstream {

namespace {

// The faces of a cell, counter-clockwise seen from within; the fourth corner of a triangle is -1.
struct Faces {
  size_t count;
  int8_t corners[6][4];
};

constexpr Faces kTetraFaces = {4, {{0, 1, 2, -1}, {0, 3, 1, -1}, {1, 3, 2, -1}, {2, 3, 0, -1}}};
constexpr Faces kPyramidFaces = {
    5, {{0, 1, 2, 3}, {0, 4, 1, -1}, {1, 4, 2, -1}, {2, 4, 3, -1}, {3, 4, 0, -1}}};
constexpr Faces kPrismFaces = {
    5, {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}};
constexpr Faces kHexaFaces = {
    6, {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};

const Faces& facesOf(CellShape shape) {
  if (shape == CellShape::kPyramid) return kPyramidFaces;
  if (shape == CellShape::kPrism) return kPrismFaces;
  return shape == CellShape::kHexa ? kHexaFaces : kTetraFaces;
}

}  // namespace

const char* nameOf(CellShape shape) {
  constexpr const char* names[] = {"point",       "line",    "triangle", "quadrilateral",
                                   "tetrahedron", "pyramid", "prism",    "hexahedron"};
  return names[static_cast<int>(shape)];
}

size_t splitFace(CellShape shape, const int64_t* corners, int64_t (*out)[3]) {
  if (shape == CellShape::kTriangle) {
    std::copy_n(corners, 3, out[0]);
    return 1;
  }
  const auto first = static_cast<size_t>(std::min_element(corners, corners + 4) - corners);
  size_t made = 0;
  for (size_t k = 1; k < 3; ++k) {
    int64_t* to = out[made];
    to[0] = corners[first];
    to[1] = corners[(first + k) % 4];
    to[2] = corners[(first + k + 1) % 4];
    if (to[0] != to[1] && to[1] != to[2] && to[2] != to[0]) ++made;
  }
  return made;
}

size_t splitCell(CellShape shape, const int64_t* corners, int64_t (*out)[4]) {
  if (shape == CellShape::kTetra) {
    std::copy_n(corners, 4, out[0]);
    return 1;
  }
  const int64_t top = *std::min_element(corners, corners + cornersOf(shape));
  const Faces& faces = facesOf(shape);
  size_t made = 0;
  for (size_t f = 0; f < faces.count; ++f) {
    const int8_t* places = faces.corners[f];
    const bool triangle = places[3] < 0;
    int64_t face[4], triangles[2][3];
    for (size_t k = 0; k < (triangle ? 3u : 4u); ++k) face[k] = corners[places[k]];
    const size_t count =
        splitFace(triangle ? CellShape::kTriangle : CellShape::kQuadrilateral, face, triangles);
    for (size_t t = 0; t < count; ++t) {
      const int64_t* c = triangles[t];
      if (c[0] == top || c[1] == top || c[2] == top) continue;
      if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
      std::copy_n(c, 3, out[made]);
      out[made++][3] = top;
    }
  }
  return made;
}

}  // namespace tetstream
