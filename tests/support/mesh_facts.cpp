#include "mesh_facts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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
  size_t cell;
  int sign;
};
using Faces = std::map<Face, std::vector<Side>>;

// +1 or -1: the parity of the permutation that sorts the corners.
int parity(const int64_t* corners_of) {
  int sign = 1;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (corners_of[i] > corners_of[j]) sign = -sign;
  return sign;
}

struct Complex {
  std::vector<Cell> cells;
  Faces faces;
  std::set<Edge> edges;
  std::set<int64_t> vertices;
};

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
      k.faces[faceOf(cell, j)].push_back({c, j % 2 == 0 ? -sorted_sign : sorted_sign});
      k.vertices.insert(cell[j]);
      for (size_t i = 0; i < j; ++i) k.edges.insert({cell[i], cell[j]});
    }
  }
  return k;
}

template <class Simplices, class Vertices>
int64_t componentsOf(const Simplices& simplices, const Vertices& vertices, size_t count) {
  Groups groups(count);
  for (const auto& s : simplices)
    for (size_t j = 1; j < s.size(); ++j)
      groups.join(static_cast<size_t>(s[0]), static_cast<size_t>(s[j]));
  std::set<size_t> roots;
  for (int64_t v : vertices) roots.insert(groups.find(static_cast<size_t>(v)));
  return static_cast<int64_t>(roots.size());
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

void countBoundary(const Complex& k, size_t vertex_count, MeshFacts& facts) {
  std::vector<Face> boundary;
  std::map<Edge, int> edges;
  std::map<int64_t, std::vector<Edge>> links;
  for (const auto& [face, sides] : k.faces) {
    if (sides.size() > 2) ++facts.crowded_faces;
    if (sides.size() == 2 && sides[0].sign * sides[1].sign > 0) ++facts.folded;
    if (sides.size() != 1) continue;
    boundary.push_back(face);
    for (size_t j = 0; j < 3; ++j) {
      const Edge opposite = {face[j == 0 ? 1 : 0], face[j == 2 ? 1 : 2]};
      ++edges[opposite];
      links[face[j]].push_back(opposite);
    }
  }
  std::set<int64_t> vertices;
  for (const auto& [v, link] : links) {
    vertices.insert(v);
    facts.pinched_vertices += !isCircle(link);
  }
  for (const auto& [edge, count] : edges) facts.crowded_edges += count != 2;
  facts.boundary_faces = static_cast<int64_t>(boundary.size());
  facts.boundary_euler = static_cast<int64_t>(vertices.size()) -
                         static_cast<int64_t>(edges.size()) + facts.boundary_faces;
  facts.boundary_components = componentsOf(boundary, vertices, vertex_count);
}

// Vertices whose cells fall apart into pieces that share no face at the vertex.
void countLooseStars(const Complex& k, MeshFacts& facts) {
  std::map<int64_t, std::vector<size_t>> stars;
  for (size_t c = 0; c < k.cells.size(); ++c)
    for (int64_t v : k.cells[c]) stars[v].push_back(c);
  for (const auto& [v, star] : stars) {
    Groups groups(star.size());
    for (size_t a = 0; a < star.size(); ++a)
      for (size_t b = 0; b < a; ++b) {
        int shared = 0;
        for (int64_t w : k.cells[star[a]])
          shared +=
              static_cast<int>(std::count(k.cells[star[b]].begin(), k.cells[star[b]].end(), w));
        if (shared >= 3) groups.join(a, b);
      }
    for (size_t a = 1; a < star.size(); ++a)
      if (groups.find(a) != groups.find(0)) {
        ++facts.pinched_vertices;
        break;
      }
  }
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
  std::set<Cell> different(k.cells.begin(), k.cells.end());
  facts.duplicates = facts.cells - static_cast<int64_t>(different.size());
  facts.euler = static_cast<int64_t>(k.vertices.size()) - static_cast<int64_t>(k.edges.size()) +
                static_cast<int64_t>(k.faces.size()) - static_cast<int64_t>(different.size());
  facts.components = componentsOf(k.cells, k.vertices, mesh.vertexCount());
  countBoundary(k, mesh.vertexCount(), facts);
  countLooseStars(k, facts);
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
