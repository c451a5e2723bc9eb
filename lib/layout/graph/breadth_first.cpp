#include "breadth_first.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "traversal.h"

namespace tetstream {

namespace {

constexpr size_t kStarts = 48;        // looked at; a search each
constexpr size_t kTries = 4;          // of them followed to the end; seven searches each
constexpr uint32_t kQuick = 1 << 16;  // vertices, that are searched in no time
constexpr uint32_t kFar = std::numeric_limits<uint32_t>::max();

// Searches of single components, to find good starts.
class Search {
 public:
  Search(const VertexGraph& graph, const Array<uint8_t>& boundary, Account& account)
      : graph_(graph),
        boundary_(boundary),
        member_(account),
        start_(account),
        distance_(account, graph.vertices),
        reached_(account, graph.vertices),
        queue_(account, graph.vertices) {
    findComponents(graph, account, member_, start_);
    std::fill_n(reached_.data(), graph.vertices, 0u);
  }
  uint32_t components() const { return static_cast<uint32_t>(start_.size() - 1); }

  // Starts far from each other, those with the narrowest levels first, kTries at most. Calls tell
  // for each of those that are looked at, of a component that takes its time.
  void rank(uint32_t component, const std::function<void()>& tell, uint32_t* starts) {
    const bool is_large = start_[component + 1] - start_[component] > kQuick;
    std::array<std::pair<uint32_t, uint32_t>, kStarts> rated;
    forget(component);
    spread(member_[start_[component]]);
    const uint32_t end = farthest(component);
    forget(component);
    spread(end);  // a double sweep: the first start is the end that is farthest from this one
    for (auto& [width, start] : rated) {
      start = farthest(component);
      width = levelWidth(start);
      spread(start);
      if (is_large) tell();
    }
    std::stable_sort(rated.begin(), rated.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 0; i < kTries; ++i) starts[i] = rated[i].second;
  }

 private:
  void forget(uint32_t component) {
    for (uint32_t i = start_[component]; i < start_[component + 1]; ++i)
      distance_[member_[i]] = kFar;
  }

  // Lowers distances to those from `source` where they are less.
  void spread(uint32_t source) {
    uint32_t at = 0, end = 0;
    distance_[source] = 0;
    queue_[end++] = source;
    for (; at < end; ++at)
      for (const uint32_t* u = graph_.begin(queue_[at]); u < graph_.end(queue_[at]); ++u) {
        if (distance_[*u] <= distance_[queue_[at]] + 1) continue;
        distance_[*u] = distance_[queue_[at]] + 1;
        queue_[end++] = *u;
      }
  }

  // On the boundary, if there is such a vertex at that distance.
  uint32_t farthest(uint32_t component) const {
    const auto key = [this](uint32_t v) { return 2 * uint64_t{distance_[v]} + boundary_[v]; };
    uint32_t found = member_[start_[component]];
    for (uint32_t i = start_[component]; i < start_[component + 1]; ++i)
      if (key(member_[i]) > key(found)) found = member_[i];
    return found;
  }

  // The most vertices in two levels that follow each other: the front is about as wide.
  uint32_t levelWidth(uint32_t source) {
    ++searches_;
    uint32_t at = 0, end = 0, before = 0, widest = 1;
    reached_[source] = searches_;
    queue_[end++] = source;
    while (at < end) {
      const uint32_t level_end = end;
      for (; at < level_end; ++at)
        for (const uint32_t* u = graph_.begin(queue_[at]); u < graph_.end(queue_[at]); ++u) {
          if (reached_[*u] == searches_) continue;
          reached_[*u] = searches_;
          queue_[end++] = *u;
        }
      widest = std::max(widest, end - before);
      before = level_end;
    }
    return widest;
  }

  const VertexGraph& graph_;
  const Array<uint8_t>& boundary_;
  Array<uint32_t> member_, start_, distance_;
  Array<uint32_t> reached_;  // number of the last search that met the vertex
  Array<uint32_t> queue_;
  uint32_t searches_ = 0;
};

// [components][kTries]
void findStarts(const VertexGraph& graph, const Array<uint8_t>& boundary, Account& account,
                const std::function<void()>& tell, Array<uint32_t>& starts) {
  Search search(graph, boundary, account);
  starts.resize(kTries * size_t{search.components()});
  for (uint32_t c = 0; c < search.components(); ++c) {
    tell();
    search.rank(c, tell, starts.data() + kTries * c);
  }
}

}  // namespace

void orderBreadthFirst(const Connectivity& mesh, Account& account,
                       const std::function<void()>& tell, Array<uint32_t>& rank) {
  Meeting meet(account);
  meet.find(mesh, account);
  Array<uint8_t> boundary(account);
  markBoundary(mesh, meet.lists, boundary);
  tell();
  Array<uint32_t> starts(account);
  findStarts(meet.graph, boundary, account, tell, starts);
  rank.resize(mesh.vertices);
  Array<uint32_t> candidate(account, mesh.vertices);
  int64_t least = -1;
  for (size_t i = 0; i < kTries; ++i) {
    tell();
    {
      Traversal traversal(mesh, meet, account, candidate);
      for (size_t at = i; at < starts.size(); at += kTries) traversal.from(starts[at]);
    }
    const int64_t span = frontOfRanks(mesh, candidate, account).front_span;
    if (least >= 0 && span >= least) continue;
    least = span;
    rank.swap(candidate);
  }
}

}  // namespace tetstream
