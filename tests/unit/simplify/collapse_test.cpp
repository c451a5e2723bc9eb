// One collapse at a time: what is legal, what is told, what is handed over.
#include <cmath>

#include "window_testing.h"

namespace tetstream::test {
namespace {

struct Told {
  uint32_t u, v;
  double error;
};

class Listener final : public CollapseObserver {
 public:
  void collapsed(uint32_t u, uint32_t v, double error) override { told.push_back({u, v, error}); }
  std::vector<Told> told;
};

uint32_t slotAt(const TestMesh& mesh, double x, double y, double z) {
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.position(v, 0) == x && mesh.position(v, 1) == y && mesh.position(v, 2) == z)
      return static_cast<uint32_t>(v);
  return kNone;
}

TestMesh gridWithField(int n) {
  TestMesh mesh = fullGrid(n, n, n);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y - z; });
  return mesh;
}

TEST(Collapser, TellsItsObserverOfEachCollapse) {
  WholeWindow<double> w(gridWithField(4), {});
  Listener listener;
  w.collapser.observe(&listener);
  const auto selector = makeRandomSelector(w.core, w.collapser, w.account);
  selector->decimate({100, 90, true}, [] {});
  ASSERT_EQ(static_cast<int64_t>(listener.told.size()), w.core.report.collapses);
  EXPECT_GT(listener.told.size(), 30u);
  EXPECT_LE(w.core.window.mesh.liveCells(), 100u);
  EXPECT_GE(w.core.window.mesh.liveCells(), 90u);
  double largest = 0;
  std::vector<bool> gone(w.mesh.vertexCount(), false);
  for (const Told& t : listener.told) {
    EXPECT_FALSE(gone[t.u] || gone[t.v]);
    gone[t.v] = true;
    largest = std::max(largest, t.error);
    EXPECT_GE(t.error, 0);
  }
  EXPECT_EQ(largest, w.core.report.largest_error);
  for (uint32_t v = 0; v < gone.size(); ++v)
    EXPECT_EQ(gone[v], (w.core.window.mesh.vertexFlags(v) & kCollapsed) != 0);
}

TEST(Collapser, RefusesToTurnACellOver) {
  WholeWindow<double> w(gridWithField(4), {});
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  double z[4] = {1000, 0, 0, 0};
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kOrientation);
  EXPECT_EQ(w.core.report.rejected_orientation, 1);
  // Onto the plane of the star's outer faces: flat is as bad as turned over.
  z[0] = 1.5 * w.core.scale[0];
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kOrientation);
  // By little less, and cells are too thin.
  z[0] = 1.49999 * w.core.scale[0];
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kOrientation);
  z[0] = 0;
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kDone);
  EXPECT_EQ(w.core.window.values(u)[0], 2.5);
  const MeshFacts facts = factsOf(w.live());
  EXPECT_EQ(topologyChange(factsOf(w.mesh), facts), "");
  EXPECT_NEAR(facts.volume, 64, 1e-12);
  EXPECT_EQ(facts.negative, 0);
}

TEST(Collapser, RefusesToTakeMoreCellsThanAllowed) {
  WholeWindow<double> w(gridWithField(4), {});
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  const double z[4] = {0, 0, 0, 0};
  // Six cells round an edge of the lattice.
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 384 - 5), Outcome::kTooMany);
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 384 - 6), Outcome::kDone);
  EXPECT_EQ(w.core.window.mesh.liveCells(), 378u);
}

TEST(Collapser, RefusesWhatIsNotFinite) {
  WholeWindow<double> w(gridWithField(3), {});
  const uint32_t u = slotAt(w.mesh, 1, 1, 1), v = slotAt(w.mesh, 2, 1, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double z[4] = {0, 0, 0, 0}, bad[4] = {0, 0, 0, nan};
  EXPECT_EQ(w.collapser.collapse(u, v, z, nan, 0), Outcome::kNotFinite);
  EXPECT_EQ(w.collapser.collapse(u, v, bad, 0, 0), Outcome::kNotFinite);
  EXPECT_EQ(w.core.report.rejected_other, 2);
}

TEST(Collapser, RefusesLockedAndGoneVertices) {
  TestMesh mesh = gridWithField(4);
  const uint32_t u = slotAt(mesh, 2, 2, 2), v = slotAt(mesh, 3, 2, 2), o = slotAt(mesh, 1, 2, 2);
  mesh.locked.assign(mesh.vertexCount(), 0);
  mesh.locked[o] = 1;
  WholeWindow<double> w(mesh, {});
  const double z[4] = {0, 0, 0, 0};
  EXPECT_EQ(w.collapser.collapse(u, o, z, 0, 0), Outcome::kLocked);
  EXPECT_EQ(w.collapser.collapse(o, u, z, 0, 0), Outcome::kLocked);
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kDone);
  EXPECT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kLocked);
}

TEST(Collapser, RefusesWhatIsNoEdge) {
  WholeWindow<double> w(gridWithField(4), {});
  const double z[4] = {0, 0, 0, 0};
  EXPECT_EQ(w.collapser.collapse(slotAt(w.mesh, 1, 2, 2), slotAt(w.mesh, 3, 2, 2), z, 0, 0),
            Outcome::kTopology);
}

// An edge through the inside, between two sides of a plate one cube thick: its collapse would make
// the plate touch itself.
TEST(Collapser, RefusesToPinch) {
  TestMesh mesh = fullGrid(4, 4, 1);
  WholeWindow<double> w(mesh, {});
  const double z[3] = {0, 0, 0};
  EXPECT_EQ(w.collapser.collapse(slotAt(mesh, 2, 2, 0), slotAt(mesh, 2, 2, 1), z, 0, 0),
            Outcome::kTopology);
  EXPECT_EQ(w.core.report.rejected_link, 1);
}

TEST(Collapser, RoundsPlacesToTheTypeThatIsWritten) {
  TestMesh mesh = fullGrid(4, 4, 4, 0, ScalarType::kFloat32);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double, double) { return x; });
  WholeWindow<double> w(mesh, {});
  const uint32_t u = slotAt(mesh, 2, 2, 2), v = slotAt(mesh, 3, 2, 2);
  const double z[4] = {0.01, 0.003, 0.0007, 0};
  ASSERT_EQ(w.collapser.collapse(u, v, z, 0, 0), Outcome::kDone);
  for (int i = 0; i < 3; ++i) {
    const double x = w.core.window.values(u)[i];
    EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
  }
}

// The volumes that cells stand for, and the sums of their data over them, outlive any number of
// collapses: every dying cell has an heir.
TEST(Collapser, ConservesCellDataOverTheVolumesTheyStandFor) {
  TestMesh mesh = fullGrid(5, 5, 5, 0.1);
  mesh.addCellData({"d", 2, ScalarType::kFloat64},
                   [](size_t c, int i) { return std::sin(0.37 * static_cast<double>(c)) + i; });
  WholeWindow<double> w(mesh, {});
  const auto sums = [&w] {
    std::array<double, 3> sum = {};
    for (uint32_t c = 0; c < w.core.window.mesh.cellEnd(); ++c) {
      if (!w.core.window.mesh.isLive(c)) continue;
      const double* m = w.core.window.cellMeans(c);
      sum[0] += m[0];
      for (int i = 0; i < 2; ++i) sum[static_cast<size_t>(i) + 1] += m[0] * m[i + 1];
    }
    return sum;
  };
  const auto before = sums();
  makeRandomSelector(w.core, w.collapser, w.account)->decimate({80, 70, true}, [] {});
  const auto after = sums();
  EXPECT_LE(w.core.window.mesh.liveCells(), 80u);
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(after[i], before[i], 1e-9 * before[0]);
}

// The quadric of a merged vertex is the sum, its error what the minimum of the sum is: never less
// than both errors together.
TEST(Collapser, AddsQuadrics) {
  WholeWindow<double> w(gridWithField(4), {});
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  const int size = quadricSize(4);
  const std::vector<double> a(w.core.window.quadric(u), w.core.window.quadric(u) + size);
  const std::vector<double> b(w.core.window.quadric(v), w.core.window.quadric(v) + size);
  const double z[4] = {0, 0, 0, 0};
  ASSERT_EQ(w.collapser.collapse(u, v, z, 0.125, 0), Outcome::kDone);
  for (int i = 0; i + 1 < size; ++i)
    EXPECT_EQ(w.core.window.quadric(u)[i], a[static_cast<size_t>(i)] + b[static_cast<size_t>(i)]);
  EXPECT_EQ(w.core.window.quadric(u)[size - 1], 0.125);
}

// Every vertex on the outside knows it, and has the quadric of the faces there.
TEST(Resolver, FindsTheBoundary) {
  const TestMesh mesh = shellGrid(4);
  WholeWindow<double> w(mesh, {});
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
    EXPECT_EQ(w.core.window.mesh.vertexFlags(v), kFinal | kBoundary | kResolved);
  const TestMesh full = fullGrid(3, 3, 3);
  WholeWindow<double> inner(full, {});
  int inside = 0;
  for (uint32_t v = 0; v < full.vertexCount(); ++v)
    inside += inner.core.window.mesh.vertexFlags(v) == (kFinal | kResolved);
  EXPECT_EQ(inside, 8);
}

// Two cubes at a vertex: that one is locked, and no other. At an edge: the edge.
TEST(Resolver, LocksNonManifoldPlaces) {
  const auto lockedIn = [](const TestMesh& mesh) {
    WholeWindow<double> w(mesh, {});
    int locked = 0;
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
      locked += (w.core.window.mesh.vertexFlags(v) & kLocked) != 0;
    return locked;
  };
  EXPECT_EQ(lockedIn(cubesAtVertex(2)), 1);
  EXPECT_EQ(lockedIn(cubesAtEdge(2)), 3);
  EXPECT_EQ(lockedIn(slitGrid(6)), 0);
  EXPECT_EQ(lockedIn(apart(2)), 0);
}

}  // namespace
}  // namespace tetstream::test
