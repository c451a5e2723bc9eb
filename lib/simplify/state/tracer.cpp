#include "tracer.h"

#include <algorithm>

#include "barycentric.h"

namespace tetstream {

template <class S>
Tracer<S>::Tracer(Window<S>& window, const Plan& plan, TraceSinks sinks, Account& account)
    : window_(window), plan_(plan), sinks_(sinks), points_(account), walk_(account) {}

static int64_t idOf(int64_t origin) {
  return origin < 0 ? ~origin : origin;
}

template <class S>
void Tracer<S>::leavePlace(uint32_t v, const S* place) {
  int64_t& origin = window_.origin(v);
  if (origin < 0) return;
  points_.add(origin, place);
  origin = ~origin;
}

template <class S>
void Tracer<S>::collapsed(const TracedCollapse<S>& c) {
  if (sinks_.log) addToLog(c);
  if (!sinks_.map) return;
  if (!std::equal(c.merged, c.merged + 3, c.values_u)) leavePlace(c.u, c.values_u);
  leavePlace(c.v, c.values_v);
  points_.reshaped(window_.firstPoints(), c.before.data(), c.before.size(), c.after.data(),
                   c.after.size());
}

template <class S>
void Tracer<S>::flipped(const uint32_t* before, size_t before_count, const PlacedCell* after,
                        size_t after_count) {
  points_.reshaped(window_.firstPoints(), before, before_count, after, after_count);
}

template <class S>
void Tracer<S>::bringHome(const uint32_t* uses) {
  if (!sinks_.map || points_.count() == 0) return;
  bool started = false;
  for (uint32_t cell = 0; cell < window_.cellEnd(); ++cell) {
    if (!window_.isLive(cell) || window_.firstPoints()[cell] == kNone) continue;
    double corners[4][3];
    CellFrame frame;
    cornersIn(window_, cell, corners);
    frame.set(corners[0]);
    points_.move(window_.firstPoints(), cell, [&](const S* place) {
      const double x[3] = {static_cast<double>(place[0]), static_cast<double>(place[1]),
                           static_cast<double>(place[2])};
      double w[4];
      frame.weights(x, w);
      if (!(*std::min_element(w, w + 4) < -kLeastOutside)) return cell;
      if (!started) walk_.start(window_, uses);
      started = true;
      return walk_.from(cell, x);
    });
  }
}

template <class S>
void Tracer<S>::writeVertex(uint32_t v, int corner, uint64_t rank) {
  const int64_t origin = window_.origin(v);
  if (!sinks_.map || origin < 0) return;
  double weights[4] = {0, 0, 0, 0};
  weights[corner] = 1;
  addToMap(origin, rank, weights);
}

template <class S>
void Tracer<S>::writeCell(uint32_t cell, uint64_t rank) {
  if (!sinks_.map || window_.firstPoints()[cell] == kNone) return;
  double corners[4][3];
  cornersIn(window_, cell, corners);
  points_.take(window_.firstPoints()[cell], [&](int64_t id, const S* place) {
    const double x[3] = {static_cast<double>(place[0]), static_cast<double>(place[1]),
                         static_cast<double>(place[2])};
    double weights[4];
    barycentricWeights(corners, x, weights);
    addToMap(id, rank, weights);
  });
}

template <class S>
void Tracer<S>::addToMap(int64_t vertex, uint64_t cell, const double weights[4]) {
  map_.vertices.push_back(vertex);
  map_.cells.push_back(static_cast<int64_t>(cell));
  map_.weights.insert(map_.weights.end(), weights, weights + 4);
  if (map_.vertices.size() == kTraceRows) flushMap();
}

// As a column of that type holds it in the output.
template <class S>
static double storedAs(ScalarType type, S value) {
  return type == ScalarType::kFloat32 ? static_cast<double>(static_cast<float>(value))
                                      : static_cast<double>(value);
}

// note: the position has its column's type already (merged_place.h), for it decides on the cells.
template <class S>
void Tracer<S>::addToLog(const TracedCollapse<S>& c) {
  log_.kept.push_back(idOf(window_.origin(c.u)));
  log_.removed.push_back(idOf(window_.origin(c.v)));
  for (int i = 0; i < 3; ++i) log_.positions.push_back(static_cast<double>(c.merged[i]));
  for (size_t k = 0; k < plan_.fields.size(); ++k) {
    if (plan_.fields[k].treatment == Treatment::kPicked) continue;
    const S* from = c.merged + plan_.fields[k].offset;
    const Column& column = plan_.schema.fields[k];
    for (int i = 0; i < column.components; ++i)
      log_.values.push_back(storedAs(column.type, from[i]));
  }
  log_.errors.push_back(c.error);
  if (log_.kept.size() == kTraceRows) flushLog();
}

template <class S>
void Tracer<S>::flushMap() {
  if (map_.vertices.empty()) return;
  MapRows rows;
  rows.count = map_.vertices.size();
  rows.vertices = map_.vertices.data();
  rows.cells = map_.cells.data();
  rows.weights = map_.weights.data();
  sinks_.map->put(rows);
  map_.vertices.clear();
  map_.cells.clear();
  map_.weights.clear();
}

template <class S>
void Tracer<S>::flushLog() {
  if (log_.kept.empty()) return;
  LogRows rows;
  rows.count = log_.kept.size();
  rows.kept = log_.kept.data();
  rows.removed = log_.removed.data();
  rows.positions = log_.positions.data();
  rows.values = log_.values.empty() ? nullptr : log_.values.data();
  rows.errors = log_.errors.data();
  sinks_.log->put(rows);
  log_.kept.clear();
  log_.removed.clear();
  log_.positions.clear();
  log_.values.clear();
  log_.errors.clear();
}

template <class S>
void Tracer<S>::flush() {
  flushMap();
  flushLog();
}

template class Tracer<float>;
template class Tracer<double>;

}  // namespace tetstream
