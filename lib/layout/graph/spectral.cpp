#include "spectral.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "fiedler.h"
#include "front_growth.h"
#include "vertex_graph.h"

namespace tetstream {

namespace {

// The mesh's graph, its vertices renumbered: component by component, in breadth-first order, so
// that neighbours are near in memory. Neighbours are counted from the component's first vertex.
struct Components {
  Components(const Connectivity& mesh, Account& account, const std::function<void()>& tell);
  uint32_t count() const { return static_cast<uint32_t>(start.size() - 1); }
  GraphView graph(uint32_t component) const {
    return {start[component + 1] - start[component], first.data() + start[component],
            neighbour.data(), nullptr};
  }
  Array<uint32_t> member, start;  // as findComponents has them
  Array<uint32_t> first, neighbour;
};

Components::Components(const Connectivity& mesh, Account& account,
                       const std::function<void()>& tell)
    : member(account), start(account), first(account), neighbour(account) {
  VertexGraph graph(account);
  {
    CellLists lists(account);
    listCells(mesh, lists);
    tell();
    buildGraph(mesh, lists, account, graph);
  }
  tell();
  findComponents(graph, account, member, start);
  Array<uint32_t> number(account, mesh.vertices);
  for (uint32_t c = 0; c < count(); ++c)
    for (uint32_t i = start[c]; i < start[c + 1]; ++i) number[member[i]] = i - start[c];
  first.resize(size_t{mesh.vertices} + 1);
  neighbour.resize(graph.neighbour.size());
  uint32_t end = 0;
  for (uint32_t i = 0; i < mesh.vertices; ++i) {
    first[i] = end;
    for (const uint32_t* u = graph.begin(member[i]); u < graph.end(member[i]); ++u)
      neighbour[end++] = number[*u];
  }
  first[mesh.vertices] = end;
}

// The sequence in which the vertices of one component are closed, best of several.
class ComponentOrder {
 public:
  ComponentOrder(const GraphView& graph, Account& account, const std::function<void()>& tell)
      : graph_(graph),
        account_(account),
        tell_(tell),
        vectors_(account),
        keys_(account, graph.vertices),
        layer_(account, graph.vertices),
        guide_(account, graph.vertices),
        trial_(account, graph.vertices),
        best_(account, graph.vertices) {}

  // Scaled to [0, 1].
  void findValues(float* value) {
    lowestVectors(graph_, account_, tell_, vectors_);
    const Four direction = findDirection();
    for (uint32_t v = 0; v < graph_.vertices; ++v) value[v] = along(direction, v);
    const auto [low, high] = std::minmax_element(value, value + graph_.vertices);
    const float least = *low, range = std::max(*high - *low, 1e-30f);
    for (uint32_t v = 0; v < graph_.vertices; ++v) value[v] = (value[v] - least) / range;
  }

  const Array<uint32_t>& find() {
    lowestVectors(graph_, account_, tell_, vectors_);
    const Four direction = findDirection();
    FrontGrowth growth(graph_, account_);
    for (const float sign : {1.0f, -1.0f}) {
      sweep(sign * direction);
      grow(growth);
      smoothen(growth);
    }
    return best_;
  }

 private:
  float along(Four direction, uint32_t v) const {
    const Four part = direction * vectors_[v];
    return part[0] + part[1] + part[2] + part[3];
  }
  uint32_t sweep(Four direction);
  Four findDirection();
  void keep(uint32_t width);
  uint32_t grow(FrontGrowth& growth);
  void smoothen(FrontGrowth& growth);
  void blur();

  const GraphView graph_;
  Account& account_;
  const std::function<void()>& tell_;
  Array<Four> vectors_;
  Array<uint64_t> keys_;
  Array<float> layer_, guide_;
  Array<uint32_t> trial_, best_;
  uint32_t least_ = 0xffffffffu;  // width of `best_`
};

// A number that is ordered as the values are.
uint32_t ordered(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits >> 31 ? ~bits : bits | 1u << 31;
}

// The trial becomes the sweep along a combination of the eigenvectors. Returns its width.
uint32_t ComponentOrder::sweep(Four direction) {
  tell_();
  for (uint32_t v = 0; v < graph_.vertices; ++v)
    keys_[v] = uint64_t{ordered(along(direction, v))} << 32 | v;
  std::sort(keys_.data(), keys_.data() + graph_.vertices);
  for (uint32_t i = 0; i < graph_.vertices; ++i) trial_[i] = static_cast<uint32_t>(keys_[i]);
  return findLayers(graph_, trial_.data(), account_, layer_.data());
}

// Where eigenvalues are near each other, as in compact domains, any combination of their vectors is
// as good an eigenvector, and the fronts differ. From the best single vector, steps of a pattern
// search that shrink.
Four ComponentOrder::findDirection() {
  Four best = {1, 0, 0, 0};
  uint32_t least = sweep(best);
  const auto tryOne = [&](Four direction) {
    const uint32_t width = sweep(direction);
    if (width >= least) return false;
    least = width;
    best = direction;
    return true;
  };
  for (size_t k = 1; k < 4; ++k) {
    Four single = {};
    single[k] = 1;
    tryOne(single);
  }
  for (float step = 1; step > 0.1f; step /= 2) {
    for (size_t k = 0; k < 4; ++k)
      for (const float sign : {1.0f, -1.0f}) {
        Four direction = best;
        direction[k] += sign * step;
        if (tryOne(direction)) break;
      }
  }
  return best;
}

void ComponentOrder::keep(uint32_t width) {
  if (width >= least_) return;
  least_ = width;
  std::copy_n(trial_.data(), graph_.vertices, best_.data());
}

// Lets the front grow by the layers. The less they pull, the narrower it is, if only a little, and
// the longer some vertices stay.
uint32_t ComponentOrder::grow(FrontGrowth& growth) {
  tell_();
  const uint32_t width = growth.run(layer_.data(), trial_.data());
  keep(width);
  return width;
}

// Takes the layers of what was found, smoothed, as the next guide.
void ComponentOrder::smoothen(FrontGrowth& growth) {
  constexpr int kRounds = 4, kBlurs = 10;
  for (int round = 0; round < kRounds; ++round) {
    findLayers(graph_, trial_.data(), account_, layer_.data());
    for (int i = 0; i < kBlurs; ++i) blur();
    grow(growth);
  }
}

void ComponentOrder::blur() {
  for (uint32_t v = 0; v < graph_.vertices; ++v) {
    float sum = layer_[v];
    for (uint32_t i = graph_.first[v]; i < graph_.first[v + 1]; ++i)
      sum += layer_[graph_.neighbour[i]];
    guide_[v] = sum / static_cast<float>(graph_.first[v + 1] - graph_.first[v] + 1);
  }
  layer_.swap(guide_);
}

}  // namespace

void orderSpectral(const Connectivity& mesh, Account& account, const std::function<void()>& tell,
                   Array<uint32_t>& rank) {
  rank.resize(mesh.vertices);
  const Components components(mesh, account, tell);
  for (uint32_t c = 0; c < components.count(); ++c) {
    const uint32_t start = components.start[c], end = components.start[c + 1];
    if (end - start == 1) {
      rank[components.member[start]] = start;
      continue;
    }
    ComponentOrder order(components.graph(c), account, tell);
    const Array<uint32_t>& sequence = order.find();
    for (uint32_t i = 0; i < end - start; ++i)
      rank[components.member[start + sequence[i]]] = end - 1 - i;
  }
}

void findSpectralValues(const Connectivity& mesh, Account& account,
                        const std::function<void()>& tell, Array<float>& value) {
  value.resize(mesh.vertices);
  const Components components(mesh, account, tell);
  for (uint32_t c = 0; c < components.count(); ++c) {
    const uint32_t start = components.start[c], count = components.start[c + 1] - start;
    Array<float> of_component(account, count);
    of_component[0] = 0;
    if (count > 1)
      ComponentOrder(components.graph(c), account, tell).findValues(of_component.data());
    for (uint32_t i = 0; i < count; ++i)
      value[components.member[start + i]] = static_cast<float>(c) + of_component[i];
  }
}

}  // namespace tetstream
