#include "breadth_first.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "order_front.h"
#include "vertex_graph.h"

namespace tetstream {

namespace {

constexpr size_t kStarts = 48;  // looked at; a search each
constexpr size_t kTries = 4;    // of them followed to the end; seven searches each
constexpr uint32_t kFar = std::numeric_limits<uint32_t>::max();

struct Meeting {
  explicit Meeting(Account& account) : lists(account), graph(account) {}
  CellLists lists;
  VertexGraph graph;
};

// The traversal itself, from one start after the other.
class Traversal {
 public:
  Traversal(const Connectivity& mesh, const Meeting& meet, Account& account, Array<uint32_t>& rank)
      : mesh_(mesh),
        meet_(meet),
        queue_(account, mesh.vertices),
        met_(account, mesh.vertices),
        completes_(account, mesh.vertices),
        taken_corners_(account, mesh.cells),
        rank_(rank) {
    std::fill_n(rank.data(), mesh.vertices, kUnused);
    std::fill_n(met_.data(), mesh.vertices, 0u);
    std::fill_n(completes_.data(), mesh.vertices, uint8_t{0});
    std::fill_n(taken_corners_.data(), mesh.cells, uint8_t{0});
  }

  // Ranks the whole component of the start.
  void from(uint32_t start) {
    if (rank_[start] != kUnused) return;
    uint32_t oldest = taken_;
    take(start);
    for (; oldest < taken_; ++oldest)
      for (uint32_t next; (next = best(queue_[oldest])) != kUnused;) take(next);
  }

 private:
  uint32_t best(uint32_t vertex) const {
    uint32_t found = kUnused;
    uint64_t most = 0;
    for (const uint32_t* u = meet_.graph.begin(vertex); u < meet_.graph.end(vertex); ++u) {
      if (rank_[*u] != kUnused) continue;
      const uint64_t key = uint64_t{completes_[*u]} << 32 | met_[*u];
      if (found != kUnused && key <= most) continue;
      found = *u;
      most = key;
    }
    return found;
  }

  void take(uint32_t vertex) {
    rank_[vertex] = taken_;
    queue_[taken_++] = vertex;
    for (const uint32_t* u = meet_.graph.begin(vertex); u < meet_.graph.end(vertex); ++u)
      if (rank_[*u] == kUnused && met_[*u] == 0) met_[*u] = ++meetings_;
    const CellLists& lists = meet_.lists;
    for (uint32_t i = lists.first[vertex]; i < lists.first[vertex + 1]; ++i) {
      if (++taken_corners_[lists.cell[i]] != 3) continue;
      for (const uint32_t *v = mesh_.cell(lists.cell[i]), *end = v + 4; v < end; ++v)
        if (rank_[*v] == kUnused) completes_[*v] = 1;
    }
  }

  const Connectivity& mesh_;
  const Meeting& meet_;
  Array<uint32_t> queue_;
  Array<uint32_t> met_;           // when a neighbour was first taken, from 1; 0: not yet
  Array<uint8_t> completes_;      // whether it is the last vertex of some cell
  Array<uint8_t> taken_corners_;  // of each cell
  Array<uint32_t>& rank_;
  uint32_t taken_ = 0, meetings_ = 0;
};

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

  // Starts far from each other, those with the narrowest levels first, kTries at most.
  void rank(uint32_t component, uint32_t* starts) {
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
    search.rank(c, starts.data() + kTries * c);
  }
}

}  // namespace

void orderBreadthFirst(const Connectivity& mesh, Account& account,
                       const std::function<void()>& tell, Array<uint32_t>& rank) {
  Meeting meet(account);
  listCells(mesh, meet.lists);
  tell();
  buildGraph(mesh, meet.lists, account, meet.graph);
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
