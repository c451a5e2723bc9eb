#include "laplacian.h"

#include <algorithm>
#include <numeric>

namespace tetstream {

constexpr uint32_t kCoarsest = 32;  // vertices of which all eigenvectors are taken: O(n^3)
constexpr uint32_t kNobody = 0xffffffffu;

namespace {

// Whether the edge at `entry` is heavier than the one at `other`; equal ones: to the lower number.
bool isHeavier(const GraphView& graph, uint32_t entry, uint32_t other) {
  const float a = graph.weightAt(entry), b = graph.weightAt(other);
  return a != b ? a > b : graph.neighbour[entry] < graph.neighbour[other];
}

// The entry of v's heaviest edge to a vertex that is still alone, or, where `any`, to anybody.
uint32_t heaviest(const GraphView& graph, uint32_t v, const Array<uint32_t>& parent, bool any) {
  uint32_t found = kNobody;
  for (uint32_t i = graph.first[v]; i < graph.first[v + 1]; ++i)
    if ((any || parent[graph.neighbour[i]] == kNobody) &&
        (found == kNobody || isHeavier(graph, i, found)))
      found = i;
  return found;
}

// Pairs along heavy edges; who is left over joins the pair of its heaviest edge. So there are at
// most half as many parents as vertices, if there are two. Returns how many.
uint32_t pairUp(const GraphView& graph, Array<uint32_t>& parent) {
  std::fill_n(parent.data(), graph.vertices, kNobody);
  uint32_t parents = 0;
  for (uint32_t v = 0; v < graph.vertices; ++v) {
    if (parent[v] != kNobody) continue;
    const uint32_t entry = heaviest(graph, v, parent, false);
    if (entry == kNobody) continue;
    parent[v] = parent[graph.neighbour[entry]] = parents++;
  }
  for (uint32_t v = 0; v < graph.vertices; ++v) {
    if (parent[v] != kNobody) continue;
    const uint32_t entry = heaviest(graph, v, parent, true);
    parent[v] = entry == kNobody ? parents++ : parent[graph.neighbour[entry]];
  }
  return parents;
}

// x_i = (b_i + sum of w_ij x_j) / d_i, one vertex after the other.
void relax(const GraphView& graph, const Array<float>& inverse_diagonal, uint32_t i, const Four* b,
           Four* x) {
  Four sum = b[i];
  for (uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
    sum += graph.weightAt(k) * x[graph.neighbour[k]];
  x[i] = sum * inverse_diagonal[i];
}

}  // namespace

void applyLaplacian(const GraphView& graph, const Four* x, Four* product) {
  for (uint32_t i = 0; i < graph.vertices; ++i) {
    Four sum = {};
    for (uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
      sum += graph.weightAt(k) * (x[i] - x[graph.neighbour[k]]);
    product[i] = sum;
  }
}

LaplacianLevels::Level::Level(Account& account)
    : first(account),
      neighbour(account),
      weight(account),
      inverse_diagonal(account),
      parent(account),
      right(account),
      solution(account) {}

LaplacianLevels::LaplacianLevels(const GraphView& finest, Account& account) : account_(account) {
  levels_.push_back(std::make_unique<Level>(account));
  levels_[0]->graph = finest;
  levels_[0]->invertDiagonal();
  while (levels_.back()->graph.vertices > kCoarsest) addCoarser();
  prepareCoarsest();
}

// Pairs of pairs.
void LaplacianLevels::addCoarser() {
  Level& fine = *levels_.back();
  fine.parent.resize(fine.graph.vertices);
  const uint32_t pairs = pairUp(fine.graph, fine.parent);
  const auto half = join(fine.graph, fine.parent, pairs);
  half->parent.resize(pairs);
  const uint32_t vertices = pairUp(half->graph, half->parent);
  levels_.push_back(join(half->graph, half->parent, vertices));
  for (uint32_t v = 0; v < fine.graph.vertices; ++v) fine.parent[v] = half->parent[fine.parent[v]];
  Level& added = *levels_.back();
  added.right.resize(vertices);
  added.solution.resize(vertices);
  added.invertDiagonal();
}

void LaplacianLevels::prepareCoarsest() {
  const GraphView& graph = levels_.back()->graph;
  const size_t n = graph.vertices;
  std::vector<double> matrix(n * n, 0.0);
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
      const auto weight = static_cast<double>(graph.weightAt(k));
      matrix[i * n + graph.neighbour[k]] -= weight;
      matrix[i * n + i] += weight;
    }
  coarsest_ = symmetricEigen(std::move(matrix), n);
}

void LaplacianLevels::Level::invertDiagonal() {
  inverse_diagonal.resize(graph.vertices);
  for (uint32_t i = 0; i < graph.vertices; ++i) {
    float sum = 0;
    for (uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) sum += graph.weightAt(k);
    inverse_diagonal[i] = sum > 0 ? 1 / sum : 0;
  }
}

// Children of each parent: child[start[p]] up to child[start[p + 1] - 1].
static void listChildren(const Array<uint32_t>& parent, uint32_t children, uint32_t parents,
                         Array<uint32_t>& start, Array<uint32_t>& child) {
  std::fill_n(start.data(), size_t{parents} + 1, 0u);
  for (uint32_t v = 0; v < children; ++v) ++start[parent[v]];
  std::partial_sum(start.data(), start.data() + start.size(), start.data());
  for (uint32_t v = children; v-- > 0;) child[--start[parent[v]]] = v;
}

// Edges between the same two parents become one with the sum of their weights.
std::unique_ptr<LaplacianLevels::Level> LaplacianLevels::join(const GraphView& fine,
                                                              const Array<uint32_t>& parent,
                                                              uint32_t vertices) {
  auto level = std::make_unique<Level>(account_);
  Array<uint32_t> child(account_, fine.vertices), start(account_, size_t{vertices} + 1);
  listChildren(parent, fine.vertices, vertices, start, child);
  level->first.resize(size_t{vertices} + 1);
  level->neighbour.resize(fine.first[fine.vertices] - fine.first[0]);
  level->weight.resize(level->neighbour.size());
  Array<uint32_t> entry(account_, vertices);  // of the last edge to each parent
  std::fill_n(entry.data(), vertices, kNobody);
  uint32_t end = 0;
  const auto add = [&](uint32_t p, uint32_t other, float weight) {
    if (other == p) return;
    if (entry[other] == kNobody || entry[other] < level->first[p]) {
      entry[other] = end++;
      level->neighbour[entry[other]] = other;
      level->weight[entry[other]] = 0;
    }
    level->weight[entry[other]] += weight;
  };
  for (uint32_t p = 0; p < vertices; ++p) {
    level->first[p] = end;
    for (uint32_t i = start[p]; i < start[p + 1]; ++i)
      for (uint32_t k = fine.first[child[i]]; k < fine.first[child[i] + 1]; ++k)
        add(p, parent[fine.neighbour[k]], fine.weightAt(k));
  }
  level->first[vertices] = end;
  level->neighbour.resize(end);
  level->weight.resize(end);
  level->graph = {vertices, level->first.data(), level->neighbour.data(), level->weight.data()};
  return level;
}

std::array<double, 4> LaplacianLevels::lowest(Four* x) const {
  const size_t n = levels_.back()->graph.vertices;
  std::array<double, 4> values{};
  std::fill_n(x, n, Four{});
  for (size_t k = 0; k < 4 && k + 1 < n; ++k) {
    values[k] = coarsest_.values[k + 1];
    for (size_t i = 0; i < n; ++i) x[i][k] = static_cast<float>(coarsest_.vectors[(k + 1) * n + i]);
  }
  return values;
}

// By all eigenvectors but the constant one.
void LaplacianLevels::solveCoarsest(const Four* b, Four* x) const {
  const size_t n = levels_.back()->graph.vertices;
  std::fill_n(x, n, Four{});
  for (size_t k = 1; k < n; ++k) {
    const double* vector = &coarsest_.vectors[k * n];
    Four product = {};
    for (size_t i = 0; i < n; ++i) product += static_cast<float>(vector[i]) * b[i];
    product /= static_cast<float>(coarsest_.values[k]);
    for (size_t i = 0; i < n; ++i) x[i] += static_cast<float>(vector[i]) * product;
  }
}

// What is missing of A x = b, summed up for the next level.
void LaplacianLevels::restrictRest(const Level& fine, const Four* b, const Four* x, Level& next) {
  const GraphView& graph = fine.graph;
  std::fill_n(next.right.data(), next.graph.vertices, Four{});
  for (uint32_t i = 0; i < graph.vertices; ++i) {
    Four rest = b[i];
    for (uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
      rest -= graph.weightAt(k) * (x[i] - x[graph.neighbour[k]]);
    next.right[fine.parent[i]] += rest;
  }
}

// Gauss-Seidel forwards, a correction from the next level, Gauss-Seidel backwards. Corrections that
// are constant on each parent are too short; made longer, they save rounds.
void LaplacianLevels::solveRoughly(size_t level, const Four* b, Four* x) {
  constexpr float kLonger = 1.6f;
  if (level + 1 == levels_.size()) return solveCoarsest(b, x);
  const Level& fine = *levels_[level];
  Level& next = *levels_[level + 1];
  const uint32_t n = fine.graph.vertices;
  std::fill_n(x, n, Four{});
  for (uint32_t i = 0; i < n; ++i) relax(fine.graph, fine.inverse_diagonal, i, b, x);
  restrictRest(fine, b, x, next);
  solveRoughly(level + 1, next.right.data(), next.solution.data());
  for (uint32_t i = 0; i < n; ++i) x[i] += kLonger * next.solution[fine.parent[i]];
  for (uint32_t i = n; i-- > 0;) relax(fine.graph, fine.inverse_diagonal, i, b, x);
}

}  // namespace tetstream
