#include "order_front.h"

#include <algorithm>

namespace tetstream {

namespace {

// The highest number that the corners of a cell have.
uint32_t highest(const uint32_t* v, const Array<uint32_t>& number) {
  return std::max({number[v[0]], number[v[1]], number[v[2]], number[v[3]]});
}

// A counting sort.
void sortCells(const Connectivity& mesh, const Array<uint32_t>& rank, Account& account,
               Array<uint32_t>& cell_at) {
  Array<uint32_t> start(account, size_t{mesh.vertices} + 1);
  std::fill_n(start.data(), start.size(), 0u);
  for (uint32_t c = 0; c < mesh.cells; ++c) ++start[highest(mesh.cell(c), rank) + 1];
  for (uint32_t i = 0; i < mesh.vertices; ++i) start[i + 1] += start[i];
  for (uint32_t c = 0; c < mesh.cells; ++c) cell_at[start[highest(mesh.cell(c), rank)]++] = c;
}

// Ranks of the stream: vertices in the order of their first use.
void rankByUse(const Connectivity& mesh, StreamOrder& order) {
  std::fill_n(order.rank.data(), mesh.vertices, kUnused);
  order.used_vertices = 0;
  for (uint32_t place = 0; place < mesh.cells; ++place) {
    const uint32_t* v = mesh.cell(order.cell_at[place]);
    for (int j = 0; j < 4; ++j) {
      if (order.rank[v[j]] == kUnused) order.rank[v[j]] = order.used_vertices++;
      order.last_use[v[j]] = place;
    }
  }
}

// Walks through the order once.
class Walk {
 public:
  Walk(const Connectivity& mesh, Account& account, StreamOrder& order)
      : mesh_(mesh),
        order_(order),
        last_of_rank_(account, order.used_vertices),
        leave_(account, mesh.cells) {}

  void measure() {
    for (uint32_t v = 0; v < mesh_.vertices; ++v)
      if (order_.rank[v] != kUnused) last_of_rank_[order_.rank[v]] = order_.last_use[v];
    std::fill_n(leave_.data(), leave_.size(), 0u);
    double sum = 0;
    for (uint32_t place = 0; place < mesh_.cells; ++place) sum += static_cast<double>(step(place));
    if (mesh_.cells) order_.mean_width = sum / mesh_.cells;
  }

 private:
  // A cell leaves at the last use of any of its vertices, which is not before its own place.
  // Returns how many vertices are active while the cell at this place comes.
  int64_t step(uint32_t place) {
    const uint32_t* v = mesh_.cell(order_.cell_at[place]);
    ++leave_[highest(v, order_.last_use)];
    for (int j = 0; j < 4; ++j) {
      if (order_.rank[v[j]] < introduced_) continue;
      introduced_ = order_.rank[v[j]] + 1;
      ++active_;
    }
    const int64_t width = active_;
    order_.front_width = std::max(order_.front_width, width);
    order_.front_span = std::max<int64_t>(order_.front_span, introduced_ - oldest_);
    for (; oldest_ < introduced_ && last_of_rank_[oldest_] <= place; ++oldest_) {
    }
    for (int j = 0; j < 4; ++j) active_ -= order_.last_use[v[j]] == place && isFirst(v, j);
    cells_ += 1 - int64_t{leave_[place]};
    order_.front_cells = std::max(order_.front_cells, cells_);
    return width;
  }

  // Whether no corner before the j-th has the same vertex.
  static bool isFirst(const uint32_t* v, int j) { return std::find(v, v + j, v[j]) == v + j; }

  const Connectivity& mesh_;
  StreamOrder& order_;
  Array<uint32_t> last_of_rank_;
  Array<uint32_t> leave_;  // how many cells leave the front at each place
  int64_t cells_ = 0, active_ = 0;
  uint32_t introduced_ = 0, oldest_ = 0;
};

}  // namespace

void followCells(const Connectivity& mesh, Account& account, StreamOrder& order) {
  static_cast<OrderFront&>(order) = {};
  order.rank.resize(mesh.vertices);
  order.last_use.resize(mesh.vertices);
  rankByUse(mesh, order);
  Walk(mesh, account, order).measure();
}

void makeStream(const Connectivity& mesh, Account& account, StreamOrder& order) {
  order.cell_at.resize(mesh.cells);
  sortCells(mesh, order.rank, account, order.cell_at);
  followCells(mesh, account, order);
}

OrderFront frontOfRanks(const Connectivity& mesh, const Array<uint32_t>& rank, Account& account) {
  StreamOrder order(account);
  order.rank.resize(mesh.vertices);
  std::copy_n(rank.data(), mesh.vertices, order.rank.data());
  makeStream(mesh, account, order);
  return static_cast<const OrderFront&>(order);
}

}  // namespace tetstream
