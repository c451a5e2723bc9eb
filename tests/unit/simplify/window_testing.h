// tests: a whole small mesh in one window, or in one patch of it, ready for collapses by hand.
#pragma once

#include <set>
#include <utility>

#include "collapse.h"
#include "faces.h"
#include "intake.h"
#include "regions.h"
#include "resolve.h"
#include "select.h"
#include "simplify_testing.h"

namespace tetstream::test {

using Edges = std::set<std::pair<uint32_t, uint32_t>>;

// With all that a map and a log need; whether they are told is up to the core's tracer.
inline Plan tracedPlan(Plan plan) {
  plan.traces_vertices = plan.traces_points = true;
  return plan;
}

// That the window holds all of it is known.
inline TestMesh withCount(TestMesh mesh) {
  mesh.schema.cell_count = static_cast<int64_t>(mesh.cellCount());
  return mesh;
}

// The window of the paper's mode has links: cells can be merged in it without a patch.
template <class S>
struct WholeWindow {
  explicit WholeWindow(TestMesh the_mesh, const SimplifyOptions& the_options = inMode(Mode::kPaper),
                       const FaceLabels& labels = {})
      : mesh(withCount(std::move(the_mesh))),
        options(the_options),
        plan(tracedPlan(makePlan(mesh.schema, options))),
        core(plan, options, account, mesh.cellCount() + 1, mesh.vertexCount() + 1, 0),
        intake(core, account),
        regions(core),
        metric(core),
        resolver(core, metric, account) {
    core.report.window_cells = static_cast<int64_t>(mesh.cellCount());
    FacedStream stream(mesh, {}, labels);
    BatchView batch;
    while (stream.next(batch)) {
      intake.startBatch(batch);
      for (size_t row = 0; row < batch.cell_count; ++row) intake.takeCell(row);
      intake.finishBatch();
    }
    intake.finalizeAll();
    regions.take(0, core.window.mesh.cellEnd());
    resolver.resolve(0, intake.finalized(), intake.finalizedCount());
  }

  // The live cells, with the positions as they are.
  TestMesh live() {
    std::vector<double> positions;
    std::vector<int64_t> cells;
    for (uint32_t v = 0; v < core.window.mesh.vertexEnd(); ++v)
      for (int i = 0; i < 3; ++i)
        positions.push_back(static_cast<double>(core.window.values(v)[i]));
    for (uint32_t c = 0; c < core.window.mesh.cellEnd(); ++c)
      if (core.window.mesh.isLive(c))
        for (int j = 0; j < 4; ++j) cells.push_back(core.window.mesh.corners(c)[j]);
    return makeMesh(ScalarType::kFloat64, positions, cells);
  }

  TestMesh mesh;
  SimplifyOptions options;
  Account account;
  Plan plan;
  Core<S> core;
  Intake<S> intake;
  Regions<S> regions;
  Metric<S> metric;
  Resolver<S> resolver;
};

// The whole mesh in a patch: all free vertices are owned.
template <class S>
struct WholePatch : WholeWindow<S> {
  explicit WholePatch(TestMesh the_mesh, const SimplifyOptions& the_options = {},
                      const FaceLabels& labels = {})
      : WholeWindow<S>(std::move(the_mesh), the_options, labels),
        patch(this->account, this->core.window) {
    load();
  }
  void load() {
    const Topology& window = this->core.window.mesh;
    owned.clear();
    std::vector<uint32_t> cells;
    for (uint32_t v = 0; v < window.vertexEnd(); ++v)
      if (window.isFree(v)) owned.push_back(v);
    for (uint32_t c = 0; c < window.cellEnd(); ++c) cells.push_back(c);
    loaded = patch.load(owned.data(), owned.size(), cells.data(), cells.size(), window.liveCells());
  }

  Patch<S> patch;
  std::vector<uint32_t> owned;
  bool loaded = false;
};

}  // namespace tetstream::test
