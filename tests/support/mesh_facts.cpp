#include "mesh_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "exact_reference.h"
#include "groups.h"

namespace tetstream::test {
namespace {

using Edge = std::array<int64_t, 2>;
using Face = std::array<int64_t, 3>;
using Cell = std::array<int64_t, 4>;

void corners(const TestMesh& mesh, size_t cell, double p[4][3]) {
  for (size_t j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i)
      p[j][i] = mesh.position(static_cast<size_t>(mesh.cells[4 * cell + j]), i);
}

double determinant(const double p[4][3], double* magnitude) {
  double e[3][3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = p[k + 1][i] - p[0][i];
  double det = 0;
  *magnitude = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    det += e[0][i] * (e[1][j] * e[2][k] - e[1][k] * e[2][j]);
    *magnitude +=
        std::fabs(e[0][i]) * (std::fabs(e[1][j] * e[2][k]) + std::fabs(e[1][k] * e[2][j]));
  }
  return det;
}

Face faceOf(const Cell& cell, size_t without) {
  Face face;
  for (size_t j = 0, k = 0; j < 4; ++j)
    if (j != without) face[k++] = cell[j];
  return face;  // sorted, as the cell is
}

// A cell beside a face: its number, and on which side of the sorted face it lies.
struct Side {
  Face face;
  size_t cell;
  int sign;
};

// +1 or -1: the parity of the permutation that sorts the corners.
int parity(const int64_t* corners_of) {
  int sign = 1;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (corners_of[i] > corners_of[j]) sign = -sign;
  return sign;
}

// All sorted, each simplex once but for the sides of faces.
struct Complex {
  std::vector<Cell> cells;  // with its corners sorted, where it is in the mesh
  std::vector<Side> sides;
  std::vector<Edge> edges;
  std::vector<int64_t> vertices;
};

template <class Simplex>
void sortOut(std::vector<Simplex>& simplices) {
  std::sort(simplices.begin(), simplices.end());
  simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
}

Complex complexOf(const TestMesh& mesh, const std::vector<int>& signs) {
  Complex k;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    Cell cell;
    std::copy_n(&mesh.cells[4 * c], 4, cell.begin());
    const int sorted_sign = signs[c] * parity(cell.data());
    std::sort(cell.begin(), cell.end());
    k.cells.push_back(cell);
    for (size_t j = 0; j < 4; ++j) {
      // The corner opposite: (f0 f1 f2 j) is an even or odd permutation of the sorted cell.
      k.sides.push_back({faceOf(cell, j), c, j % 2 == 0 ? -sorted_sign : sorted_sign});
      k.vertices.push_back(cell[j]);
      for (size_t i = 0; i < j; ++i) k.edges.push_back({cell[i], cell[j]});
    }
  }
  std::sort(k.sides.begin(), k.sides.end(),
            [](const Side& a, const Side& b) { return a.face < b.face; });
  sortOut(k.edges);
  sortOut(k.vertices);
  return k;
}

// Calls use(sides) with those of each face.
template <class Use>
void forEachFace(const Complex& k, const Use& use) {
  for (auto begin = k.sides.begin(); begin != k.sides.end();) {
    const auto end = std::find_if(begin, k.sides.end(),
                                  [&](const Side& side) { return side.face != begin->face; });
    use(std::span<const Side>(begin, end));
    begin = end;
  }
}

template <class Simplices>
int64_t componentsOf(const Simplices& simplices, const std::vector<int64_t>& vertices,
                     size_t count) {
  Groups groups(count);
  for (const auto& s : simplices)
    for (size_t j = 1; j < s.size(); ++j)
      groups.join(static_cast<size_t>(s[0]), static_cast<size_t>(s[j]));
  return std::count_if(vertices.begin(), vertices.end(), [&](int64_t v) {
    return groups.find(static_cast<size_t>(v)) == static_cast<size_t>(v);
  });
}

// The boundary faces round a vertex, as edges of its link, form one circle.
bool isCircle(const std::vector<Edge>& link) {
  std::map<int64_t, std::vector<int64_t>> next;
  for (const Edge& e : link) next[e[0]].push_back(e[1]), next[e[1]].push_back(e[0]);
  for (const auto& [v, others] : next)
    if (others.size() != 2) return false;
  int64_t before = -1, at = next.begin()->first;
  size_t walked = 0;
  do {
    const auto& others = next[at];
    const int64_t to = others[0] != before ? others[0] : others[1];
    before = at;
    at = to;
    ++walked;
  } while (at != next.begin()->first && walked <= next.size());
  return walked == next.size();
}

// Returns the number of faces.
int64_t countFaces(const Complex& k, size_t vertex_count, MeshFacts& facts) {
  int64_t count = 0;
  std::vector<Face> boundary;
  std::map<Edge, int> edges;
  std::map<int64_t, std::vector<Edge>> links;
  forEachFace(k, [&](std::span<const Side> sides) {
    ++count;
    if (sides.size() > 2) ++facts.crowded_faces;
    if (sides.size() == 2 && sides[0].sign * sides[1].sign > 0) ++facts.folded;
    if (sides.size() != 1) return;
    const Face& face = sides[0].face;
    boundary.push_back(face);
    for (size_t j = 0; j < 3; ++j) {
      const Edge opposite = {face[j == 0 ? 1 : 0], face[j == 2 ? 1 : 2]};
      ++edges[opposite];
      links[face[j]].push_back(opposite);
    }
  });
  std::vector<int64_t> vertices;
  for (const auto& [v, link] : links) {
    vertices.push_back(v);
    facts.pinched_vertices += !isCircle(link);
  }
  for (const auto& [edge, sides] : edges) facts.crowded_edges += sides != 2;
  facts.boundary_faces = static_cast<int64_t>(boundary.size());
  facts.boundary_euler = static_cast<int64_t>(vertices.size()) -
                         static_cast<int64_t>(edges.size()) + facts.boundary_faces;
  facts.boundary_components = componentsOf(boundary, vertices, vertex_count);
  return count;
}

// Vertices whose cells fall apart into pieces that share no face at the vertex.
void countLooseStars(const Complex& k, size_t vertex_count, MeshFacts& facts) {
  const auto cornerAt = [&](size_t cell, int64_t v) {
    const Cell& corners = k.cells[cell];
    return 4 * cell +
           static_cast<size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  };
  Groups groups(4 * k.cells.size());
  forEachFace(k, [&](std::span<const Side> sides) {
    for (const Side& side : sides.subspan(1))
      for (int64_t v : side.face) groups.join(cornerAt(sides[0].cell, v), cornerAt(side.cell, v));
  });
  std::vector<int> pieces(vertex_count, 0);
  for (size_t corner = 0; corner < 4 * k.cells.size(); ++corner)
    if (groups.find(corner) == corner)
      ++pieces[static_cast<size_t>(k.cells[corner / 4][corner % 4])];
  facts.pinched_vertices +=
      std::count_if(pieces.begin(), pieces.end(), [](int count) { return count > 1; });
}

}  // namespace

int cellSign(const TestMesh& mesh, size_t cell) {
  double p[4][3], magnitude;
  corners(mesh, cell, p);
  const double det = determinant(p, &magnitude);
  if (std::fabs(det) > 1e-12 * magnitude) return det > 0 ? 1 : -1;
  return referenceOrientation(p[0], p[1], p[2], p[3]);
}

double cellVolume(const TestMesh& mesh, size_t cell) {
  double p[4][3], magnitude;
  corners(mesh, cell, p);
  return std::fabs(determinant(p, &magnitude)) / 6;
}

MeshFacts factsOf(const TestMesh& mesh) {
  MeshFacts facts;
  std::vector<int> signs;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    signs.push_back(cellSign(mesh, c));
    facts.flat += signs[c] == 0;
    facts.positive += signs[c] > 0;
    facts.negative += signs[c] < 0;
    facts.volume += cellVolume(mesh, c);
  }
  const Complex k = complexOf(mesh, signs);
  facts.cells = static_cast<int64_t>(k.cells.size());
  std::vector<Cell> different = k.cells;
  sortOut(different);
  facts.duplicates = facts.cells - static_cast<int64_t>(different.size());
  const int64_t faces = countFaces(k, mesh.vertexCount(), facts);
  facts.euler = static_cast<int64_t>(k.vertices.size()) - static_cast<int64_t>(k.edges.size()) +
                faces - static_cast<int64_t>(different.size());
  facts.components = componentsOf(k.cells, k.vertices, mesh.vertexCount());
  countLooseStars(k, mesh.vertexCount(), facts);
  return facts;
}

std::string topologyChange(const MeshFacts& before, const MeshFacts& after) {
  std::string change;
  const auto compare = [&change](const char* what, int64_t a, int64_t b, bool bad) {
    if (bad)
      change += std::string(what) + " " + std::to_string(a) + " -> " + std::to_string(b) + "; ";
  };
  const auto same = [&](const char* what, int64_t a, int64_t b) { compare(what, a, b, a != b); };
  const auto noMore = [&](const char* what, int64_t a, int64_t b) { compare(what, a, b, b > a); };
  same("Euler characteristic", before.euler, after.euler);
  same("components", before.components, after.components);
  same("Euler characteristic of the boundary", before.boundary_euler, after.boundary_euler);
  same("components of the boundary", before.boundary_components, after.boundary_components);
  noMore("faces of more than two cells", before.crowded_faces, after.crowded_faces);
  noMore("non-manifold boundary edges", before.crowded_edges, after.crowded_edges);
  noMore("pinched vertices", before.pinched_vertices, after.pinched_vertices);
  noMore("duplicate cells", before.duplicates, after.duplicates);
  noMore("flat cells", before.flat, after.flat);
  noMore("folded faces", before.folded, after.folded);
  return change;
}

}  // namespace tetstream::test
