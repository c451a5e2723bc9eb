// simplify/state: where the vertices of the input went, told while they go: the vertex map and the
// log of collapses. Depends on plan.h, mesh, stream (traces).
//
// A vertex that stands where it stood is told with the first cell that leaves with it. One that was
// moved or merged becomes a traced point, which is told when the cell that it lies in leaves. So
// the map's rows come in the order of the output's cells.
#pragma once

#include <vector>

#include "cell_walk.h"
#include "flip_observer.h"
#include "plan.h"
#include "traced_points.h"
#include "traces.h"
#include "window.h"

namespace tetstream {

// A collapse, in slots of the window: v was merged into u. `after` are the cells round the merged
// vertex, which come first among those `before`, round the two.
template <class S>
struct TracedCollapse {
  uint32_t u, v;
  const S *values_u, *values_v;  // as they were
  const S* merged;               // as they are
  double error;                  // in the report's unit
  const std::vector<uint32_t>& before;
  const std::vector<PlacedCell>& after;
};

template <class S>
class Tracer final : public FlipObserver {
 public:
  Tracer(Window<S>& window, const Plan& plan, TraceSinks sinks, Account& account);

  bool tracesPoints() const { return sinks_.map != nullptr; }
  bool keepsLog() const { return sinks_.log != nullptr; }
  void collapsed(const TracedCollapse<S>& collapse);
  void flipped(const uint32_t* before, size_t before_count, const PlacedCell* after,
               size_t after_count) override;
  // Before cells leave: of points that lie outside of their cells, since the boundary was moved
  // away and perhaps back, those that lie in other cells of the window now go there, the others to
  // where they are beside the boundary. uses[v]: how many live cells v has.
  void bringHome(const uint32_t* uses);
  // A cell leaves, with that rank; at `corner`, with its vertex, which no cell has left with.
  void writeVertex(uint32_t v, int corner, uint64_t rank);
  void writeCell(uint32_t cell, uint64_t rank);
  void flush();

  size_t pointCount() const { return points_.count(); }
  size_t pointRoom() const { return points_.capacity(); }
  static constexpr size_t pointBytes() { return sizeof(typename TracedPoints<S>::Point); }
  // What a map takes for each cell and each vertex of the window, beside the points.
  static constexpr size_t kCellBytes = sizeof(uint32_t) + CellWalk<S>::kCellBytes;
  static constexpr size_t kVertexBytes = CellWalk<S>::kVertexBytes;

 private:
  // Rows of the two tables, column by column.
  struct MapTable {
    std::vector<int64_t> vertices, cells;
    std::vector<double> weights;
  };
  struct LogTable {
    std::vector<int64_t> kept, removed;
    std::vector<double> positions, values, errors;
  };

  void leavePlace(uint32_t v, const S* place);
  void addToMap(int64_t vertex, uint64_t cell, const double weights[4]);
  void addToLog(const TracedCollapse<S>& collapse);
  void flushMap();
  void flushLog();

  Window<S>& window_;
  const Plan& plan_;
  TraceSinks sinks_;
  TracedPoints<S> points_;
  CellWalk<S> walk_;
  MapTable map_;
  LogTable log_;
};

}  // namespace tetstream
