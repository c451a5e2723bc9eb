#include "front_growth.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tetstream {

constexpr uint32_t kNowhere = 0xffffffffu, kClosed = 0xfffffffeu;

FrontGrowth::FrontGrowth(const GraphView& graph, Account& account)
    : graph_(graph),
      closed_by_(account, graph.vertices),
      key_(account, graph.vertices),
      heap_(account, graph.vertices),
      place_(account, graph.vertices),
      opened_(account, graph.vertices) {}

uint32_t FrontGrowth::run(const float* guide, uint32_t* sequence) {
  guide_ = guide;
  heap_size_ = active_ = 0;
  for (uint32_t v = 0; v < graph_.vertices; ++v)
    closed_by_[v] = graph_.first[v + 1] - graph_.first[v] + 1;
  std::fill_n(place_.data(), graph_.vertices, kNowhere);
  std::fill_n(opened_.data(), graph_.vertices, uint8_t{0});
  offer(static_cast<uint32_t>(std::min_element(guide, guide + graph_.vertices) - guide));
  uint32_t widest = 0;
  while (heap_size_ > 0) {
    const uint32_t vertex = takeLeast();
    if (!opened_[vertex]) open(vertex);
    for (uint32_t i = graph_.first[vertex]; i < graph_.first[vertex + 1]; ++i)
      if (!opened_[graph_.neighbour[i]]) open(graph_.neighbour[i]);
    widest = std::max(widest, active_--);
    *sequence++ = vertex;
  }
  return widest;
}

void FrontGrowth::open(uint32_t vertex) {
  opened_[vertex] = 1;
  ++active_;
  --closed_by_[vertex];
  offer(vertex);
  for (uint32_t i = graph_.first[vertex]; i < graph_.first[vertex + 1]; ++i) {
    --closed_by_[graph_.neighbour[i]];
    offer(graph_.neighbour[i]);
  }
}

// Puts a vertex among the candidates, or further to the front.
void FrontGrowth::offer(uint32_t vertex) {
  if (place_[vertex] == kClosed) return;
  key_[vertex] = closed_by_[vertex] == 0 ? -std::numeric_limits<float>::infinity()
                                         : guide_[vertex] + static_cast<float>(closed_by_[vertex]);
  if (place_[vertex] == kNowhere) {
    place_[vertex] = heap_size_;
    heap_[heap_size_++] = vertex;
  }
  rise(place_[vertex]);
}

uint32_t FrontGrowth::takeLeast() {
  const uint32_t least = heap_[0];
  place_[least] = kClosed;
  if (--heap_size_ > 0) {
    heap_[0] = heap_[heap_size_];
    place_[heap_[0]] = 0;
    sink(0);
  }
  return least;
}

void FrontGrowth::rise(uint32_t place) {
  const uint32_t vertex = heap_[place];
  for (uint32_t above; place > 0 && isBefore(vertex, heap_[above = (place - 1) / 2]);
       place = above) {
    heap_[place] = heap_[above];
    place_[heap_[place]] = place;
  }
  heap_[place] = vertex;
  place_[vertex] = place;
}

void FrontGrowth::sink(uint32_t place) {
  const uint32_t vertex = heap_[place];
  for (uint32_t below; (below = 2 * place + 1) < heap_size_; place = below) {
    if (below + 1 < heap_size_ && isBefore(heap_[below + 1], heap_[below])) ++below;
    if (!isBefore(heap_[below], vertex)) break;
    heap_[place] = heap_[below];
    place_[heap_[place]] = place;
  }
  heap_[place] = vertex;
  place_[vertex] = place;
}

uint32_t findLayers(const GraphView& graph, const uint32_t* sequence, Account& account,
                    float* layer) {
  Array<uint8_t> opened(account, graph.vertices);
  std::fill_n(opened.data(), graph.vertices, uint8_t{0});
  uint32_t active = 0, widest = 0;
  double sum = 0;
  const auto open = [&](uint32_t vertex) {
    active += !opened[vertex];
    opened[vertex] = 1;
  };
  for (const uint32_t* v = sequence; v < sequence + graph.vertices; ++v) {
    open(*v);
    for (uint32_t i = graph.first[*v]; i < graph.first[*v + 1]; ++i) open(graph.neighbour[i]);
    widest = std::max(widest, active);
    layer[*v] = static_cast<float>(sum += 1.0 / active--);
  }
  return widest;
}

}  // namespace tetstream
