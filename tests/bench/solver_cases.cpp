#include "solver_cases.h"

#include <algorithm>
#include <cmath>

#include "random.h"
#include "status.h"

namespace tetstream::bench {
namespace {

constexpr int at(int i, int j) {
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

double uniform(Random& r) {
  return static_cast<double>(r.next() >> 11) * 0x1p-53 - 0.5;
}

// -------------------------------------------------------------------------- synthetic meshes

Mesh jitteredGrid(uint32_t n) {
  static constexpr uint8_t kPaths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
  Mesh mesh;
  Random random(7);
  const auto point = [n](uint32_t x, uint32_t y, uint32_t z) {
    return (z * (n + 1) + y) * (n + 1) + x;
  };
  for (uint32_t z = 0; z <= n; ++z)
    for (uint32_t y = 0; y <= n; ++y)
      for (uint32_t x = 0; x <= n; ++x)
        mesh.points.push_back({(x + 0.3 * uniform(random)) / n, (y + 0.3 * uniform(random)) / n,
                               (z + 0.3 * uniform(random)) / n});
  for (uint32_t z = 0; z < n; ++z)
    for (uint32_t y = 0; y < n; ++y)
      for (uint32_t x = 0; x < n; ++x)
        for (const auto& path : kPaths) {  // of corners of the cube, bits x y z, from 0 to 7
          std::array<uint32_t, 4> cell;
          const uint32_t corners[4] = {0, path[0], path[1], 7};
          for (size_t k = 0; k < 4; ++k)
            cell[k] = point(x + (corners[k] & 1), y + (corners[k] >> 1 & 1), z + (corners[k] >> 2));
          mesh.cells.push_back(cell);
        }
  return mesh;
}

double smoothField(const std::array<double, 3>& p) {
  return std::sin(5 * p[0]) * std::cos(4 * p[1]) + std::exp(-p[2]) * p[0];
}

// ---------------------------------------------------------------------------- exact quadrics

Wide squareRoot(Wide value) {
  if (!(value > 0)) return 0;
  Wide root = static_cast<Wide>(std::sqrt(static_cast<double>(value)));
  if (!(root > 0)) return 0;
  for (int i = 0; i < 3; ++i) root = (root + value / root) / 2;
  return root;
}

Wide absolute(Wide value) {
  return value < 0 ? -value : value;
}

WideVector times(const std::array<Wide, kPacked>& a, const WideVector& x) {
  WideVector y{};
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) y[i] += a[at(i, j)] * x[j];
  return y;
}

Wide dot(const WideVector& a, const WideVector& b) {
  Wide sum = 0;
  for (int i = 0; i < kN; ++i) sum += a[i] * b[i];
  return sum;
}

// Jacobi's eigenvalues, on the diagonal in the end, and eigenvectors, in columns.
void diagonalize(Wide (&a)[kN][kN], Wide (&vectors)[kN][kN]) {
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) vectors[i][j] = i == j;
  for (int sweep = 0; sweep < 60; ++sweep)
    for (int p = 0; p < kN; ++p)
      for (int q = p + 1; q < kN; ++q) {
        if (a[p][q] == 0) continue;
        const Wide theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const Wide t = (theta < 0 ? -1 : 1) / (absolute(theta) + squareRoot(theta * theta + 1));
        const Wide c = 1 / squareRoot(t * t + 1), s = t * c;
        for (int k = 0; k < kN; ++k) {
          const Wide kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < kN; ++k) {
          const Wide pk = a[p][k], qk = a[q][k], vp = vectors[k][p], vq = vectors[k][q];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          vectors[k][p] = c * vp - s * vq;
          vectors[k][q] = s * vp + c * vq;
        }
      }
}

// The solution of A z = r nearest to 0.
WideVector nearestSolution(const std::array<Wide, kPacked>& a, const WideVector& r) {
  static constexpr double kNothing = 1e-12;
  Wide dense[kN][kN], vectors[kN][kN], largest = 0;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) dense[i][j] = a[at(i, j)];
  diagonalize(dense, vectors);
  for (int i = 0; i < kN; ++i) largest = std::max(largest, dense[i][i]);
  WideVector z{};
  for (int k = 0; k < kN; ++k) {
    if (!(dense[k][k] > kNothing * largest)) continue;
    Wide along = 0;
    for (int i = 0; i < kN; ++i) along += vectors[i][k] * r[i];
    for (int i = 0; i < kN; ++i) z[i] += along / dense[k][k] * vectors[i][k];
  }
  return z;
}

// The quadrics of vertices on their cells, exactly for coordinates of type S.
template <class S>
class Gatherer {
 public:
  Gatherer(const Mesh& mesh, const Place& place, CaseSet<S>& set) : mesh_(mesh), set_(set) {
    list(mesh);
    layOut(place);
  }

  // False if it is left out.
  bool gather(uint32_t u, uint32_t v, size_t merged, EdgeCase<S>& edge);
  uint32_t neighbour(uint32_t u, Random& random) const {
    const uint32_t cell = cells_[begin_[u] + random.below(begin_[u + 1] - begin_[u])];
    return mesh_.cells[cell][random.below(4)];
  }

 private:
  // (A, p, e) with p in space and field, exactly but for the rounding of Wide.
  struct Sum {
    std::array<Wide, kPacked> a{};
    WideVector b{};  // sum of A_i p_i, normalised, about the first vertex
    Wide c = 0;
  };
  struct End {
    std::vector<uint32_t> vertices;
    Sum exact;
    S form[kPacked + 1], p[kN];
  };

  void list(const Mesh& mesh);
  void layOut(const Place& place);
  WideVector normalised(const S* p) const {
    WideVector x;
    for (int i = 0; i < kN; ++i) x[i] = static_cast<Wide>(p[i]) * static_cast<Wide>(set_.scale[i]);
    return x;
  }
  const S* at(uint32_t v) const { return &values_[size_t{v} * kN]; }
  void chooseVertices(uint32_t u, uint32_t other, size_t merged, std::vector<uint32_t>& out) const;
  bool addCell(uint32_t cell, Sum& sum, EdgeCase<S>& edge) const;
  bool addVertex(uint32_t v, End& end, EdgeCase<S>& edge) const;
  void placeEnd(End& end) const;

  const Mesh& mesh_;
  CaseSet<S>& set_;
  std::vector<uint32_t> begin_, cells_;  // of each vertex its cells
  std::vector<S> values_;
  WideVector origin_{};  // of the sums: no place is far from it
};

template <class S>
void Gatherer<S>::list(const Mesh& mesh) {
  begin_.assign(mesh.points.size() + 1, 0);
  for (const auto& cell : mesh.cells)
    for (uint32_t v : cell) ++begin_[v + 1];
  for (size_t v = 0; v < mesh.points.size(); ++v) begin_[v + 1] += begin_[v];
  cells_.resize(begin_.back());
  std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (size_t c = 0; c < mesh.cells.size(); ++c)
    for (uint32_t v : mesh.cells[c]) cells_[next[v]++] = static_cast<uint32_t>(c);
}

template <class S>
void Gatherer<S>::layOut(const Place& place) {
  std::array<double, 4> low, high;
  low.fill(1e300), high.fill(-1e300);
  const auto value = [&](size_t v, size_t i) {
    return i < 3 ? mesh_.points[v][i] : mesh_.field[v];
  };
  for (size_t v = 0; v < mesh_.points.size(); ++v)
    for (size_t i = 0; i < 4; ++i) {
      low[i] = std::min(low[i], value(v, i));
      high[i] = std::max(high[i], value(v, i));
    }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  double longest = 0;
  for (const auto& cell : mesh_.cells)
    for (size_t i = 0; i < 3; ++i)
      longest += std::fabs(mesh_.points[cell[1]][i] - mesh_.points[cell[0]][i]);
  const double edge = longest / static_cast<double>(mesh_.cells.size());
  const double range = mesh_.field_range > 0 ? mesh_.field_range : high[3] - low[3];
  const double unit = place.normalised ? std::exp2(-std::round(std::log2(edge * place.unit))) : 1;
  for (size_t i = 0; i < 3; ++i) set_.scale[i] = static_cast<S>(unit);
  set_.scale[3] = static_cast<S>(range > 0 ? unit * extent * place.unit / range : 0);
  for (size_t v = 0; v < mesh_.points.size(); ++v)
    for (size_t i = 0; i < 4; ++i) {
      const double moved = value(v, i) - (low[i] + high[i]) / 2 + place.offset * extent;
      values_.push_back(static_cast<S>(i < 3 ? place.unit * moved : value(v, i)));
    }
  origin_ = normalised(at(0));
}

// u and vertices round it that are not round the other end.
template <class S>
void Gatherer<S>::chooseVertices(uint32_t u, uint32_t other, size_t merged,
                                 std::vector<uint32_t>& out) const {
  out.assign(1, u);
  for (size_t next = 0; next < out.size() && out.size() < merged; ++next)
    for (uint32_t k = begin_[out[next]]; k < begin_[out[next] + 1] && out.size() < merged; ++k)
      for (uint32_t w : mesh_.cells[cells_[k]]) {
        if (out.size() == merged) break;
        if (w != other && std::find(out.begin(), out.end(), w) == out.end()) out.push_back(w);
      }
}

// A quarter of 1 / V n n^T, its least volume as in the kernels; about the origin of the sums, and
// in the classical form about that of the coordinates, by double numbers summed in S.
template <class S>
bool Gatherer<S>::addCell(uint32_t cell, Sum& sum, EdgeCase<S>& edge) const {
  WideVector x[4], e[3], n;
  for (int k = 0; k < 4; ++k) x[k] = normalised(at(mesh_.cells[cell][static_cast<size_t>(k)]));
  Wide size = 0;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < kN; ++i) {
      e[k][i] = x[k + 1][i] - x[0][i];
      if (i < 3) size += e[k][i] * e[k][i];
    }
  Wide c[3][3];
  for (int k = 0; k < 3; ++k) {
    const WideVector &p = e[(k + 1) % 3], &q = e[(k + 2) % 3];
    for (int i = 0; i < 3; ++i)
      c[k][i] = p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
  }
  Wide det = 0;
  for (int i = 0; i < 3; ++i) {
    det += e[0][i] * c[0][i];
    n[i] = e[0][3] * c[0][i] + e[1][3] * c[1][i] + e[2][3] * c[2][i];
  }
  n[3] = -det;
  if (det == 0) return false;
  const Wide volume = std::max(absolute(det), kFlatVolume * size * squareRoot(size));
  const Wide w = 1 / (24 * volume);
  WideVector from{};
  for (int i = 0; i < kN; ++i) from[i] = x[0][i] - origin_[i];
  const Wide d = dot(n, from), d0 = dot(n, x[0]);
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j <= i; ++j) {
      sum.a[bench::at(i, j)] += w * n[i] * n[j];
      edge.a[bench::at(i, j)] += static_cast<S>(static_cast<double>(w * n[i] * n[j]));
    }
    sum.b[i] += w * d * n[i];
    edge.b[i] += static_cast<S>(static_cast<double>(w * d0 * n[i]));
  }
  sum.c += w * d * d;
  edge.c += static_cast<S>(static_cast<double>(w * d0 * d0));
  return true;
}

// With its cells' quadrics as the kernels have them.
template <class S>
bool Gatherer<S>::addVertex(uint32_t v, End& end, EdgeCase<S>& edge) const {
  S others[4][kPacked + 1];
  for (uint32_t k = begin_[v]; k < begin_[v + 1]; ++k) {
    const auto& cell = mesh_.cells[cells_[k]];
    if (!addCell(cells_[k], end.exact, edge)) return false;
    const S* x[4];
    S* q[4];
    for (size_t j = 0; j < 4; ++j) {
      x[j] = at(cell[j]);
      q[j] = cell[j] == v ? end.form : others[j];
      if (q[j] != end.form) std::fill_n(others[j], kPacked + 1, S(0));
    }
    quadricKernels<S>(QuadricLayout::kFields, kN).addCell(x, set_.scale, kN, 0, q);
  }
  return true;
}

// p, where the quadric of several vertices has its minimum, is rounded as values are; e is what the
// exact quadric has there.
template <class S>
void Gatherer<S>::placeEnd(End& end) const {
  std::copy_n(at(end.vertices[0]), kN, end.p);
  if (end.vertices.size() == 1) return;
  const WideVector start = normalised(end.p);
  WideVector to_start{}, r = end.exact.b;
  for (int i = 0; i < kN; ++i) to_start[i] = start[i] - origin_[i];
  const WideVector moved = times(end.exact.a, to_start);
  for (int i = 0; i < kN; ++i) r[i] -= moved[i];
  const WideVector z = nearestSolution(end.exact.a, r);
  for (int i = 0; i < kN; ++i)
    if (set_.scale[i] > 0)
      end.p[i] =
          static_cast<S>(static_cast<double>((start[i] + z[i]) / static_cast<Wide>(set_.scale[i])));
  WideVector from{};
  const WideVector p = normalised(end.p);
  for (int i = 0; i < kN; ++i) from[i] = p[i] - origin_[i];
  const Wide e = dot(from, times(end.exact.a, from)) - 2 * dot(end.exact.b, from) + end.exact.c;
  end.form[kPacked] = static_cast<S>(static_cast<double>(std::max<Wide>(e, 0)));
}

template <class S>
bool Gatherer<S>::gather(uint32_t u, uint32_t v, size_t merged, EdgeCase<S>& edge) {
  if (u == v) return false;
  edge = {};
  End ends[2] = {};
  chooseVertices(u, v, merged, ends[0].vertices);
  chooseVertices(v, u, merged, ends[1].vertices);
  for (End& end : ends) {
    for (uint32_t w : end.vertices)
      if (!addVertex(w, end, edge)) return false;
    placeEnd(end);
  }
  std::copy_n(ends[0].form, kPacked + 1, edge.q1);
  std::copy_n(ends[1].form, kPacked + 1, edge.q2);
  std::copy_n(ends[0].p, kN, edge.x1);
  std::copy_n(ends[1].p, kN, edge.x2);
  const WideVector p1 = normalised(edge.x1), p2 = normalised(edge.x2);
  ExactQuadric& exact = edge.exact;
  WideVector middle, from;
  Wide length = 0;
  for (int i = 0; i < kN; ++i) {
    exact.half[i] = (p2[i] - p1[i]) / 2;
    length += exact.half[i] * exact.half[i];
    middle[i] = (p1[i] + p2[i]) / 2;
    from[i] = middle[i] - origin_[i];
    edge.middle[i] = static_cast<S>(static_cast<double>(middle[i]));
  }
  if (length == 0) return false;
  Sum sum = ends[0].exact;
  for (int i = 0; i < kPacked; ++i) exact.a[i] = sum.a[i] + ends[1].exact.a[i];
  const WideVector there = times(exact.a, from);
  for (int i = 0; i < kN; ++i) exact.r[i] = sum.b[i] + ends[1].exact.b[i] - there[i];
  exact.at_middle = dot(from, there) + sum.c + ends[1].exact.c;
  for (int i = 0; i < kN; ++i) exact.at_middle -= 2 * from[i] * (sum.b[i] + ends[1].exact.b[i]);
  exact.nearest = nearestSolution(exact.a, exact.r);
  exact.least = exact.at(exact.nearest);
  return true;
}

}  // namespace

Wide ExactQuadric::at(const WideVector& z) const {
  return at_middle - 2 * dot(r, z) + dot(z, times(a, z));
}

Wide ExactQuadric::betterEnd() const {
  WideVector other = half;
  for (Wide& x : other) x = -x;
  return std::min(at(half), at(other));
}

Mesh syntheticMesh(const std::string& name) {
  Mesh mesh = jitteredGrid(8);
  for (auto& p : mesh.points) {
    if (name == "smooth" || name == "thin")
      mesh.field.push_back(smoothField(p));
    else if (name == "homogeneous")
      mesh.field.push_back(0.7);
    else if (name == "linear")
      mesh.field.push_back(2 * p[0] - p[1] + 0.5 * p[2]);
    else if (name == "one-dimensional")
      mesh.field.push_back(std::sin(5 * p[0]));
    else
      fail(Status::kBadArgument, "there is no case %s", name.c_str());
    if (name == "thin") p[2] *= 1e-3;
  }
  if (name == "homogeneous") mesh.field_range = 1;
  return mesh;
}

template <class S>
CaseSet<S> casesOf(const Mesh& mesh, const Place& place, size_t count, size_t merged) {
  CaseSet<S> set;
  Gatherer<S> gatherer(mesh, place, set);
  Random random(3);
  for (size_t tries = 0; set.edges.size() < count && tries < 10 * count; ++tries) {
    const uint32_t cell = random.below(static_cast<uint32_t>(mesh.cells.size()));
    const uint32_t u = mesh.cells[cell][random.below(4)], v = gatherer.neighbour(u, random);
    EdgeCase<S> edge;
    if (gatherer.gather(u, v, merged, edge))
      set.edges.push_back(edge);
    else
      set.left_out += u != v;
  }
  return set;
}

template CaseSet<float> casesOf(const Mesh&, const Place&, size_t, size_t);
template CaseSet<double> casesOf(const Mesh&, const Place&, size_t, size_t);

}  // namespace tetstream::bench
