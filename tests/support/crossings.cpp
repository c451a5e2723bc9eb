#include "crossings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "exact_reference.h"
#include "vector3.h"

namespace tetstream::test {
namespace {

struct Triangle {
  Face corner;
  double at[3][3], low[3], high[3];
};

std::vector<Triangle> boundaryOf(const TestMesh& mesh) {
  std::map<Face, int> uses;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t without = 0; without < 4; ++without) {
      Face face;
      for (size_t j = 0, k = 0; j < 4; ++j)
        if (j != without) face[k++] = mesh.cells[4 * c + j];
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  std::vector<Triangle> all;
  for (const auto& [face, count] : uses) {
    if (count != 1) continue;
    Triangle& t = all.emplace_back(Triangle{face, {}, {}, {}});
    for (int i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) t.at[k][i] = mesh.position(static_cast<size_t>(face[k]), i);
      t.low[i] = std::min({t.at[0][i], t.at[1][i], t.at[2][i]});
      t.high[i] = std::max({t.at[0][i], t.at[1][i], t.at[2][i]});
    }
  }
  return all;
}

// By integers where doubles do not tell.
int signOf(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double e[3][3], det = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    e[0][i] = b[i] - a[i];
    e[1][i] = c[i] - a[i];
    e[2][i] = d[i] - a[i];
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double more = e[0][i] * e[1][j] * e[2][k], less = e[0][i] * e[1][k] * e[2][j];
    det += more - less;
    size += std::fabs(more) + std::fabs(less);
  }
  if (std::fabs(det) > 1e-12 * size) return det > 0 ? 1 : -1;
  return referenceOrientation(a, b, c, d);
}

bool holds(const Triangle& t, int64_t v) {
  return std::find(t.corner.begin(), t.corner.end(), v) != t.corner.end();
}

bool passes(const Triangle& from, size_t k, const Triangle& through) {
  const size_t next = (k + 1) % 3;
  if (holds(through, from.corner[k]) || holds(through, from.corner[next])) return false;
  const double *a = from.at[k], *b = from.at[next];
  const auto& t = through.at;
  if (signOf(t[0], t[1], t[2], a) * signOf(t[0], t[1], t[2], b) >= 0) return false;
  const int side = signOf(a, b, t[0], t[1]);
  return side != 0 && signOf(a, b, t[1], t[2]) == side && signOf(a, b, t[2], t[0]) == side;
}

bool cross(const Triangle& a, const Triangle& b) {
  for (int i = 0; i < 3; ++i)
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  for (size_t k = 0; k < 3; ++k)
    if (passes(a, k, b) || passes(b, k, a)) return true;
  return false;
}

// From the edge to the face's third corner, upright on the edge.
void acrossEdge(const Triangle& t, const Triangle& other, double out[3]) {
  size_t apex = 0;
  while (holds(other, t.corner[apex])) ++apex;
  const double *a = t.at[(apex + 1) % 3], *b = t.at[(apex + 2) % 3];
  double edge[3], side[3];
  subtract(b, a, edge);
  subtract(t.at[apex], a, side);
  const double along = dot(side, edge) / dot(edge, edge);
  for (int i = 0; i < 3; ++i) out[i] = side[i] - along * edge[i];
}

bool isFolded(const Triangle& a, const Triangle& b) {
  double p[3], q[3];
  acrossEdge(a, b, p);
  acrossEdge(b, a, q);
  return dot(p, q) > std::cos(std::acos(-1) / 180) * std::sqrt(dot(p, p) * dot(q, q));
}

}  // namespace

int64_t foldedEdges(const TestMesh& mesh) {
  const std::vector<Triangle> all = boundaryOf(mesh);
  std::map<std::pair<int64_t, int64_t>, const Triangle*> first;
  int64_t folded = 0;
  for (const Triangle& t : all)
    for (size_t k = 0; k < 3; ++k) {
      const auto [it, is_new] = first.emplace(std::minmax(t.corner[k], t.corner[(k + 1) % 3]), &t);
      folded += !is_new && isFolded(t, *it->second);
    }
  return folded;
}

int64_t crossingPairs(const TestMesh& mesh) {
  const std::vector<Triangle> all = boundaryOf(mesh);
  int64_t pairs = 0;
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = i + 1; j < all.size(); ++j) pairs += cross(all[i], all[j]);
  return pairs;
}

}  // namespace tetstream::test
