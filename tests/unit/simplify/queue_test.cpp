// Mode queue: the heap of edges by itself, and the cheapest legal edge first.
#include <algorithm>
#include <cmath>
#include <map>

#include "field_error.h"
#include "queued_edges.h"
#include "random.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// ----------------------------------------------------------------------------------- the heap

const auto kAll = [](const QueuedEdge&) { return true; };

std::vector<float> popped(QueuedEdges& edges) {
  std::vector<float> errors;
  while (!edges.empty()) errors.push_back(edges.pop().error);
  return errors;
}

TEST(QueuedEdges, ComeInOrderOfTheirErrorsThenOfTheirEnds) {
  Account account;
  QueuedEdges edges(account);
  edges.push({2, 1, 5, 0}, kAll);
  edges.push({1, 7, 8, 0}, kAll);
  edges.push({2, 1, 4, 0}, kAll);
  edges.push({2, 0, 9, 0}, kAll);
  EXPECT_EQ(edges.pop().u, 7u);
  EXPECT_EQ(edges.pop().u, 0u);
  EXPECT_EQ(edges.pop().v, 4u);
  EXPECT_EQ(edges.pop().v, 5u);
  EXPECT_TRUE(edges.empty());
}

// Against a map, through many times the room that it starts with: what is up to date is never
// lost, whether it is queued or waits, and no more room is taken than it needs.
TEST(QueuedEdges, KeepWhatIsUpToDateAndNoMoreWhereRoomIsNeeded) {
  Account account;
  QueuedEdges edges(account);
  std::map<uint32_t, uint32_t> stamp_of;  // by u: the newest
  const auto is_current = [&](const QueuedEdge& e) { return stamp_of.at(e.u) == e.stamp; };
  Random r(5);
  uint32_t stamp = 0;
  size_t waiting = 0;
  for (int i = 0; i < 100000; ++i) {
    const uint32_t u = r.below(1000);
    if (i % 50 == 49 && !edges.empty()) {
      const QueuedEdge e = edges.pop();
      edges.wait(e);
      ++waiting;
    } else {
      stamp_of[u] = ++stamp;
      edges.push({static_cast<float>(u % 100), u, 0, stamp}, is_current);
    }
  }
  EXPECT_GT(waiting, 1000u);
  EXPECT_LT(account.peak(), 4000 * sizeof(QueuedEdge));
  edges.wakeAll();
  std::map<uint32_t, int> found;
  float last = 0;
  while (!edges.empty()) {
    const QueuedEdge e = edges.pop();
    EXPECT_GE(e.error, last);
    last = e.error;
    if (is_current(e)) ++found[e.u];
  }
  EXPECT_EQ(found.size(), stamp_of.size());
  for (auto [u, times] : found) EXPECT_EQ(times, 1) << u;
}

// 256 edges fit, half as many more and 256 do not: under that budget it grows by less.
TEST(QueuedEdges, FillTheirBudgetWhereTheyNeedIt) {
  Account account(400 * sizeof(QueuedEdge));
  QueuedEdges edges(account);
  const auto push = [&](uint32_t n) { edges.push({static_cast<float>(n), n, n + 1, 0}, kAll); };
  for (uint32_t n = 0; n < 300; ++n) push(n);
  edges.wait(edges.pop());
  for (uint32_t n = 300; n < 370; ++n) push(n);
  EXPECT_EQ(popped(edges).size(), 369u);
  edges.wakeAll();
  EXPECT_EQ(popped(edges), (std::vector<float>{0}));
}

TEST(QueuedEdges, ThatWaitComeAgainOnceTheyAreWoken) {
  Account account;
  QueuedEdges edges(account);
  for (float error : {3.f, 1.f, 2.f}) edges.push({error, 0, 1, 0}, kAll);
  const QueuedEdge first = edges.pop();
  edges.wait(first);
  EXPECT_EQ(popped(edges), (std::vector<float>{2, 3}));
  edges.wakeAll();
  EXPECT_EQ(popped(edges), (std::vector<float>{1}));
}

// ------------------------------------------------------------------------------- the selector

TestMesh rippledGrid(int n) {
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(1.3 * x) * std::cos(y) + 0.2 * z;
  });
  return mesh;
}

struct Errors final : LogSink {
  void begin(const Schema&) override {}
  void put(const LogRows& rows) override {
    all.insert(all.end(), rows.errors, rows.errors + rows.count);
  }
  void finish() override {}
  std::vector<double> all;
};

struct Queue : WholeWindow<double> {
  explicit Queue(TestMesh the_mesh)
      : WholeWindow(std::move(the_mesh), inMode(Mode::kQueue)),
        tracer(core.window, plan, {nullptr, &errors}, account),
        collapser(core, core.window, account),
        selector(makeQueueSelector(core, collapser, account)) {
    core.tracer = &tracer;
  }
  void collapseTo(int64_t cells) {
    selector->decimate({cells, 0, false}, [] {});
    tracer.flush();
  }

  Errors errors;
  Tracer<double> tracer;
  Collapser<Window<double>> collapser;
  std::unique_ptr<Selector> selector;
};

// The errors of all edges that are legal now, each tried in a window of its own.
double leastLegalError(const TestMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t j = i + 1; j < 4; ++j) {
        WholeWindow<double> w(mesh, inMode(Mode::kQueue));
        Collapser<Window<double>> collapser(w.core, w.core.window, w.account);
        Window<double>& window = w.core.window;
        const auto cell = static_cast<uint32_t>(c);
        const uint32_t u = window.vertexOf(cell, i), v = window.vertexOf(cell, j);
        double z[4];
        const double error = w.core.kernels.minimizeEdge(
            window.quadric(u), window.values(u), window.quadric(v), window.values(v),
            w.core.scale.data(), w.core.plan.dimension, z);
        const double told = error * w.core.error_unit;
        if (told < least && collapser.collapse(u, v, z, error, 0) == Outcome::kDone) least = told;
      }
  return least;
}

TEST(QueueSelector, TakesTheCheapestLegalEdgeFirst) {
  Queue queue(rippledGrid(slowRun() ? 2 : 3));
  const int64_t cells = queue.core.window.liveCells();
  queue.collapseTo(cells - 1);
  ASSERT_EQ(queue.errors.all.size(), 1u);
  EXPECT_DOUBLE_EQ(queue.errors.all[0], leastLegalError(queue.mesh));
}

// A merged vertex has dearer edges than its parts had, but for those that were not legal before:
// the errors rise nearly always.
TEST(QueueSelector, TakesEdgesNearlyInOrderOfTheirErrors) {
  Queue queue(rippledGrid(slowRun() ? 4 : 8));
  queue.collapseTo(queue.core.window.liveCells() / 2);
  const std::vector<double>& all = queue.errors.all;
  ASSERT_GT(all.size(), 20u);
  size_t falls = 0;
  for (size_t i = 1; i < all.size(); ++i) falls += all[i] < all[i - 1];
  EXPECT_LT(falls, all.size() / 10);
}

TEST(QueueSelector, GoesOnUntilNothingLegalIsLeft) {
  Queue queue(rippledGrid(3));
  queue.collapseTo(0);
  const auto left = queue.core.window.liveCells();
  EXPECT_LT(left, 100);  // of 162
  const size_t done = queue.errors.all.size();
  queue.collapseTo(0);
  EXPECT_EQ(queue.errors.all.size(), done);
}

// On a field with much to choose from, all of a window's edges give a smaller error than eight.
TEST(QueueSelector, HasASmallerErrorThanRandomChoice) {
  const TestMesh mesh = rippledGrid(slowRun() ? 6 : 20);
  const auto errorIn = [&](Mode mode) {
    const Result result = simplified(mesh, toRatio(0.2, 1 << 20, mode));
    expectSound(mesh, result);
    expectReached(result);
    return fieldErrors(mesh, result.out.mesh)[0];
  };
  EXPECT_LT(errorIn(Mode::kQueue), errorIn(Mode::kPaper));
}

}  // namespace
}  // namespace tetstream::test
