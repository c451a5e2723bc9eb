// One collapse at a time, in a window and in a patch of it: what is legal, what is told, what is
// handed over.
#include <array>
#include <cmath>

#include "random.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

class Log final : public LogSink {
 public:
  void begin(const Schema&) override {}
  void put(const LogRows& rows) override {
    kept.insert(kept.end(), rows.kept, rows.kept + rows.count);
    removed.insert(removed.end(), rows.removed, rows.removed + rows.count);
    errors.insert(errors.end(), rows.errors, rows.errors + rows.count);
  }
  void finish() override {}
  std::vector<int64_t> kept, removed;
  std::vector<double> errors;
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

// The window itself, as the paper's mode works.
struct InWindow : WholeWindow<double> {
  explicit InWindow(const TestMesh& the_mesh)
      : WholeWindow<double>(the_mesh, inMode(Mode::kPaper)),
        collapser(core, core.window, account) {}
  uint32_t slot(uint32_t v) const { return v; }
  double* values(uint32_t v) { return core.window.values(v); }
  double* quadric(uint32_t v) { return core.window.quadric(v); }
  int64_t liveCells() { return core.window.liveCells(); }
  void store() {}
  std::unique_ptr<Selector> selector() { return makeRandomSelector(core, collapser, account); }
  Collapser<Window<double>> collapser;
};

// A patch of all of it, as the sweep works; vertices are named by their slots in the window.
struct InPatch : WholePatch<double> {
  explicit InPatch(const TestMesh& the_mesh)
      : WholePatch<double>(the_mesh), collapser(core, patch, account) {
    EXPECT_TRUE(loaded);
  }
  uint32_t slot(uint32_t v) const {
    for (uint32_t p = 0; p < patch.vertexEnd(); ++p)
      if (patch.slotOf(p) == v) return p;
    return kNone;
  }
  double* values(uint32_t v) { return patch.values(slot(v)); }
  double* quadric(uint32_t v) { return patch.quadric(slot(v)); }
  int64_t liveCells() { return patch.liveCells(); }
  void store() { patch.store(); }
  std::unique_ptr<Selector> selector() { return makeExhaustiveSelector(core, collapser); }
  Collapser<Patch<double>> collapser;
};

template <class Place>
class Collapsers : public ::testing::Test {};
using Places = ::testing::Types<InWindow, InPatch>;
TYPED_TEST_SUITE(Collapsers, Places);

template <class Place>
Outcome collapse(Place& w, uint32_t u, uint32_t v, const double* z, double error = 0,
                 int64_t least = 0, float most_price = std::numeric_limits<float>::infinity()) {
  return w.collapser.collapse(w.slot(u), w.slot(v), z, error, least, most_price);
}

TYPED_TEST(Collapsers, TellTheTracerOfEachCollapse) {
  TypeParam w(gridWithField(4));
  Log log;
  Tracer<double> tracer(w.core.window, w.plan, {nullptr, &log}, w.account);
  w.core.tracer = &tracer;
  w.selector()->decimate({100, 90, true}, [] {});
  w.store();
  tracer.flush();
  ASSERT_EQ(static_cast<int64_t>(log.kept.size()), w.core.tally.collapses);
  EXPECT_GT(log.kept.size(), 30u);
  EXPECT_LE(w.core.window.mesh.liveCells(), 100u);
  EXPECT_GE(w.core.window.mesh.liveCells(), 90u);
  double largest = 0;
  std::vector<bool> gone(w.mesh.vertexCount(), false);
  for (size_t i = 0; i < log.kept.size(); ++i) {
    const auto u = static_cast<size_t>(log.kept[i]), v = static_cast<size_t>(log.removed[i]);
    EXPECT_FALSE(gone[u] || gone[v]);
    gone[v] = true;
    largest = std::max(largest, log.errors[i]);
    EXPECT_GE(log.errors[i], 0);
  }
  EXPECT_EQ(largest, w.core.tally.largest_error);
  for (uint32_t v = 0; v < gone.size(); ++v)
    EXPECT_EQ(gone[v], (w.core.window.mesh.vertexFlags(v) & kCollapsed) != 0);
  EXPECT_EQ(topologyChange(factsOf(w.mesh), factsOf(w.live())), "");
}

TYPED_TEST(Collapsers, RefuseToTurnACellOver) {
  TypeParam w(gridWithField(4));
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  double z[4] = {1000, 0, 0, 0};
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kOrientation);
  EXPECT_EQ(w.core.tally.rejected_orientation, 1);
  // Onto the plane of the star's outer faces: flat is as bad as turned over.
  z[0] = 1.5 * w.core.scale[0];
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kOrientation);
  // By little less, and cells are too thin.
  z[0] = 1.49999 * w.core.scale[0];
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kThin);
  EXPECT_EQ(w.core.tally.rejected_orientation, 3);
  EXPECT_EQ(w.core.tally.rejected_thin, 1);
  z[0] = 0;
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kDone);
  EXPECT_EQ(w.values(u)[0], 2.5);
  w.store();
  EXPECT_EQ(w.core.window.values(u)[0], 2.5);
  const MeshFacts facts = factsOf(w.live());
  EXPECT_EQ(topologyChange(factsOf(w.mesh), facts), "");
  EXPECT_NEAR(facts.volume, 64, 1e-12);
  EXPECT_EQ(facts.negative, 0);
}

// What turns a cell over, or makes it thin, at the best place may be legal at an end: all are
// tried.
TEST(Exhaustive, TriesOtherPlacesWhereTheBestMakesCellsThin) {
  EXPECT_TRUE(mayFitElsewhere(Outcome::kOrientation));
  EXPECT_TRUE(mayFitElsewhere(Outcome::kThin));
  EXPECT_TRUE(mayFitElsewhere(Outcome::kNotFinite));
  for (Outcome outcome : {Outcome::kDone, Outcome::kLocked, Outcome::kTooMany, Outcome::kTooFar,
                          Outcome::kVolume, Outcome::kTopology, Outcome::kDear})
    EXPECT_FALSE(mayFitElsewhere(outcome));
}

// Angles between the floor and a dear one are spared, and taken where nobody asks for that; below
// the floor it makes no difference.
TYPED_TEST(Collapsers, SpareCellsOfDearAngles) {
  TypeParam w(gridWithField(4));
  w.core.thin = ThinAngle(3);
  w.core.dear = {ThinAngle(20), ThinAngle(10)};
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  const double distance = 1.5 * w.core.scale[0];  // of the star's outer faces
  double z[4] = {0.98 * distance, 0, 0, 0};
  EXPECT_EQ(collapse(w, u, v, z, 0, 0, 1), Outcome::kThin);
  z[0] = 0.9 * distance;
  EXPECT_EQ(collapse(w, u, v, z, 0, 0, 1), Outcome::kDear);
  EXPECT_EQ(w.core.tally.rejected_other, 1);
  z[0] = 0.8 * distance;  // above the second, below the first
  EXPECT_EQ(collapse(w, u, v, z, 0, 0, 1), Outcome::kDear);
  w.core.dear = {ThinAngle(10)};
  EXPECT_EQ(collapse(w, u, v, z, 0, 0, 1), Outcome::kDone);
}
// The more cells below the smaller dear angle are left, the higher: paid, it is done.
TYPED_TEST(Collapsers, PriceCellsOfTheSmallerDearAngleByTheirNumber) {
  TypeParam w(gridWithField(4));
  w.core.thin = ThinAngle(3);
  w.core.dear = {ThinAngle(20), ThinAngle(10)};
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  double before = 0, z[4] = {0, 0, 0, 0};
  for (double way : {0.8, 0.9, 0.92}) {
    z[0] = way * 1.5 * w.core.scale[0];  // towards the star's outer faces
    ASSERT_EQ(collapse(w, u, v, z, 0, 0, 1), Outcome::kDear) << way;
    const float price = w.collapser.price();
    EXPECT_GE(price, before) << way;
    EXPECT_GE(price, 2) << way;  // without any, beside cells below the larger one
    EXPECT_EQ(price > 2, way > 0.8) << way;
    before = price;
    ASSERT_EQ(collapse(w, u, v, z, 0, 0, 0.99f * price), Outcome::kDear) << way;
  }
  EXPECT_EQ(collapse(w, u, v, z, 0, 0, static_cast<float>(before)), Outcome::kDone);
}

TYPED_TEST(Collapsers, TakeDearAnglesWhereNobodySpares) {
  TypeParam w(gridWithField(4));
  w.core.thin = ThinAngle(3);
  w.core.dear = {ThinAngle(20), ThinAngle(10)};
  double z[4] = {0.9 * 1.5 * w.core.scale[0], 0, 0, 0};
  EXPECT_EQ(collapse(w, slotAt(w.mesh, 2, 2, 2), slotAt(w.mesh, 3, 2, 2), z), Outcome::kDone);
}

TYPED_TEST(Collapsers, RefuseToTakeMoreCellsThanAllowed) {
  TypeParam w(gridWithField(4));
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  const double z[4] = {0, 0, 0, 0};
  // Six cells round an edge of the lattice.
  EXPECT_EQ(collapse(w, u, v, z, 0, 384 - 5), Outcome::kTooMany);
  EXPECT_EQ(collapse(w, u, v, z, 0, 384 - 6), Outcome::kDone);
  EXPECT_EQ(w.liveCells(), 378);
  w.store();
  EXPECT_EQ(w.core.window.mesh.liveCells(), 378u);
}

TYPED_TEST(Collapsers, RefuseWhatIsNotFinite) {
  TypeParam w(gridWithField(3));
  const uint32_t u = slotAt(w.mesh, 1, 1, 1), v = slotAt(w.mesh, 2, 1, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double z[4] = {0, 0, 0, 0}, bad[4] = {0, 0, 0, nan};
  EXPECT_EQ(collapse(w, u, v, z, nan), Outcome::kNotFinite);
  EXPECT_EQ(collapse(w, u, v, bad), Outcome::kNotFinite);
  EXPECT_EQ(w.core.tally.rejected_other, 2);
}

TYPED_TEST(Collapsers, RefuseLockedAndGoneVertices) {
  TestMesh mesh = gridWithField(4);
  const uint32_t u = slotAt(mesh, 2, 2, 2), v = slotAt(mesh, 3, 2, 2), o = slotAt(mesh, 1, 2, 2);
  mesh.locked.assign(mesh.vertexCount(), 0);
  mesh.locked[o] = 1;
  TypeParam w(mesh);
  const double z[4] = {0, 0, 0, 0};
  EXPECT_EQ(collapse(w, u, o, z), Outcome::kLocked);
  EXPECT_EQ(collapse(w, o, u, z), Outcome::kLocked);
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kDone);
  EXPECT_EQ(collapse(w, u, v, z), Outcome::kLocked);
}

TYPED_TEST(Collapsers, RefuseWhatIsNoEdge) {
  TypeParam w(gridWithField(4));
  const double z[4] = {0, 0, 0, 0};
  EXPECT_EQ(collapse(w, slotAt(w.mesh, 1, 2, 2), slotAt(w.mesh, 3, 2, 2), z), Outcome::kTopology);
}

// An edge through the inside, between two sides of a plate one cube thick: its collapse would make
// the plate touch itself.
TYPED_TEST(Collapsers, RefuseToPinch) {
  const TestMesh mesh = fullGrid(4, 4, 1);
  TypeParam w(mesh);
  const double z[3] = {0, 0, 0};
  EXPECT_EQ(collapse(w, slotAt(mesh, 2, 2, 0), slotAt(mesh, 2, 2, 1), z), Outcome::kTopology);
  EXPECT_EQ(w.core.tally.rejected_link, 1);
}

TYPED_TEST(Collapsers, RoundPlacesToTheTypeThatIsWritten) {
  TestMesh mesh = fullGrid(4, 4, 4, 0, ScalarType::kFloat32);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double, double) { return x; });
  TypeParam w(mesh);
  const uint32_t u = slotAt(mesh, 2, 2, 2), v = slotAt(mesh, 3, 2, 2);
  const double z[4] = {0.01, 0.003, 0.0007, 0};
  ASSERT_EQ(collapse(w, u, v, z), Outcome::kDone);
  w.store();
  for (int i = 0; i < 3; ++i) {
    const double x = w.core.window.values(u)[i];
    EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
  }
}

// Volumes stay those of the cells through any number of collapses. Where the body itself changes,
// by three of a hundred here, means over it stay nearly what they were (swept_data_test: sums do
// where it does not).
TYPED_TEST(Collapsers, ConserveMeansOfCellDataOverTheirVolumes) {
  TestMesh mesh = fullGrid(5, 5, 5, 0.1);
  mesh.addCellData({"d", 2, ScalarType::kFloat64},
                   [](size_t c, int i) { return std::sin(0.37 * static_cast<double>(c)) + i; });
  TypeParam w(mesh);
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
  w.selector()->decimate({80, 70, true}, [] {});
  w.store();
  const auto after = sums();
  EXPECT_LE(w.core.window.mesh.liveCells(), 80u);
  double volume = 0;
  const TestMesh live = w.live();
  for (size_t c = 0; c < live.cellCount(); ++c) volume += std::fabs(cellVolume(live, c));
  const double unit = w.core.scale[0];
  EXPECT_NEAR(after[0], unit * unit * unit * volume, 1e-9 * before[0]);
  for (size_t i = 1; i < 3; ++i) EXPECT_NEAR(after[i] / after[0], before[i] / before[0], 2e-3);
}

// The quadric of a merged vertex is the sum, its error what the minimum of the sum is: never less
// than both errors together.
TYPED_TEST(Collapsers, AddQuadrics) {
  TypeParam w(gridWithField(4));
  const uint32_t u = slotAt(w.mesh, 2, 2, 2), v = slotAt(w.mesh, 3, 2, 2);
  const int size = w.core.window.shape().quadric;
  const std::vector<double> a(w.quadric(u), w.quadric(u) + size);
  const std::vector<double> b(w.quadric(v), w.quadric(v) + size);
  const double z[4] = {0, 0, 0, 0};
  ASSERT_EQ(collapse(w, u, v, z, 0.125), Outcome::kDone);
  w.store();
  const double* sum = w.core.window.quadric(u);
  for (int i = 0; i + 1 < size; ++i)
    EXPECT_EQ(sum[i], a[static_cast<size_t>(i)] + b[static_cast<size_t>(i)]);
  EXPECT_EQ(sum[size - 1], 0.125);
}

// The same edges, in the same order, with the same outcome and the same numbers, or numbers within
// `tolerance` of each other; whether or not the collapser has refused some of them before.
void expectSameInAPatch(bool keeps_body, double tolerance) {
  TestMesh mesh = fullGrid(5, 5, 5, 0.1);
  for (size_t c = 0; c < mesh.cellCount(); c += 3)
    std::swap(mesh.cells[4 * c + 1], mesh.cells[4 * c + 2]);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x) * y - z; });
  addPositionField(mesh, {"carried", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y * z; });
  mesh.addIntegerField("label", [](size_t v) { return static_cast<int64_t>(v % 5); });
  SimplifyOptions paper = inMode(Mode::kPaper), sweep;
  paper.fields = sweep.fields = {{"f", 1}};
  WholeWindow<double> a(mesh, paper);
  WholePatch<double> b(mesh, sweep);
  Collapser<Patch<double>> in_patch(b.core, b.patch, b.account);
  a.core.thin = b.core.thin;
  a.core.keeps_body = b.core.keeps_body = keeps_body;
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v)  // without what paper mode leaves out of them
    std::copy_n(b.core.window.quadric(v), b.core.window.shape().quadric, a.core.window.quadric(v));
  Random r(3);
  int done = 0, turned = 0;
  for (int k = 0; k < 3000; ++k) {
    const uint32_t cell = r.below(static_cast<uint32_t>(mesh.cellCount()));
    if (!a.core.window.isLive(cell)) continue;
    ASSERT_TRUE(b.patch.isLive(cell));
    const uint32_t i = r.below(4), j = (i + 1 + r.below(3)) % 4;
    const uint32_t u = a.core.window.vertexOf(cell, i), v = a.core.window.vertexOf(cell, j);
    ASSERT_TRUE(b.owned[u] == u && b.owned[v] == v);  // all are owned: numbers are slots
    double z[4];
    const double error = a.core.kernels.solveEdge(a.core.window.quadric(u), a.core.window.values(u),
                                                  a.core.window.quadric(v), a.core.window.values(v),
                                                  a.core.scale.data(), a.core.plan.dimension, z);
    Collapser<Window<double>> in_window(a.core, a.core.window, a.account);
    const Outcome outcome = in_window.collapse(u, v, z, error, 0);
    ASSERT_EQ(in_patch.collapse(u, v, z, error, 0), outcome);
    if (outcome == Outcome::kOrientation) {
      ++turned;
      EXPECT_EQ(in_patch.collapse(v, u, z, error, 0), outcome);
    }
    done += outcome == Outcome::kDone;
  }
  EXPECT_GT(done, 50);
  EXPECT_GT(turned, 50);
  b.patch.store();
  ASSERT_EQ(a.core.window.liveCells(), b.core.window.liveCells());
  for (uint32_t c = 0; c < mesh.cellCount(); ++c) {
    ASSERT_EQ(a.core.window.isLive(c), b.core.window.isLive(c));
    for (uint32_t j = 0; j < 4 && a.core.window.isLive(c); ++j)
      EXPECT_EQ(a.core.window.vertexOf(c, j), b.core.window.vertexOf(c, j));
  }
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    ASSERT_EQ(a.core.window.mesh.vertexFlags(v), b.core.window.mesh.vertexFlags(v));
    if (a.core.window.mesh.vertexFlags(v) & kCollapsed) continue;
    for (int i = 0; i < a.core.plan.values; ++i)
      EXPECT_NEAR(a.core.window.values(v)[i], b.core.window.values(v)[i], tolerance);
    EXPECT_EQ(a.core.window.picks(v)[0], b.core.window.picks(v)[0]);
  }
}

TEST(Collapser, DoesTheSameInAPatchAsInTheWindow) {
  expectSameInAPatch(false, 0);
}

// Volumes are sums over stars, which a patch and a window list in orders of their own: hundreds of
// collapses make of that some billionths.
TEST(Collapser, KeepsVolumesInAPatchAsInTheWindow) {
  expectSameInAPatch(true, 1e-7);
}

// ---------------------------------------------------------------------------------- Resolver

// Every vertex on the outside knows it, and has the quadric of the faces there.
TEST(Resolver, FindsTheBoundary) {
  for (Mode mode : {Mode::kSweep, Mode::kPaper}) {
    const TestMesh mesh = shellGrid(4);
    WholeWindow<double> w(mesh, inMode(mode));
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
      EXPECT_EQ(w.core.window.mesh.vertexFlags(v), kFinal | kBoundary | kResolved);
    const TestMesh full = fullGrid(3, 3, 3);
    WholeWindow<double> inner(full, inMode(mode));
    int inside = 0;
    for (uint32_t v = 0; v < full.vertexCount(); ++v)
      inside += inner.core.window.mesh.vertexFlags(v) == (kFinal | kResolved);
    EXPECT_EQ(inside, 8);
  }
}

int lockedIn(const TestMesh& mesh) {
  WholeWindow<double> w(mesh);
  int locked = 0;
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
    locked += (w.core.window.mesh.vertexFlags(v) & kLocked) != 0;
  return locked;
}

// Two cubes at a vertex: that one is locked, and no other. At an edge: the edge.
TEST(Resolver, LocksNonManifoldPlaces) {
  EXPECT_EQ(lockedIn(cubesAtVertex(2)), 1);
  EXPECT_EQ(lockedIn(cubesAtEdge(2)), 3);
  EXPECT_EQ(lockedIn(slitGrid(6)), 0);
  EXPECT_EQ(lockedIn(apart(2)), 0);
}

// Two cells over a face, on both sides of it, on the same one, and one of them in its plane.
TEST(Resolver, TellsOfFoldsOnly) {
  for (const double z : {-1.0, 0.0, 0.5}) {
    const std::vector<double> places = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1, 0.3, 0.3, z};
    WholeWindow<double> w(makeMesh(k64, places, {0, 1, 2, 3, 0, 2, 1, 4}));
    EXPECT_EQ(w.core.folds, z > 0) << z;
    EXPECT_EQ(w.core.locked.bad_cells, z > 0 ? 2 : z == 0 ? 1 : 0);
  }
}

// A plate, all of whose vertices are on the boundary, with more corners than are listed at once:
// as with a small one, face by face. In the form of a face each has its share of the same areas.
TEST(Resolver, ListsTheStarsOfAnyNumberOfBoundaryVertices) {
  const int n = slowRun() ? 20 : 60;  // 60 x 60 cubes: 86400 corners
  const TestMesh mesh = fullGrid(n, n, 1);
  WholeWindow<double> w(mesh);
  const TestMesh small = fullGrid(4, 4, 1);
  WholeWindow<double> s(small);
  const auto weight = [](WholeWindow<double>& window, uint32_t v) {
    const double* q = window.core.window.quadric(v);  // twice the area's share, in x y z together
    const double unit = window.core.scale[0];
    return (q[0] + q[2] + q[5]) / unit;
  };
  const double extent_share = static_cast<double>(n) / 4;  // of the boundary's weight
  const double inner = weight(s, slotAt(small, 2, 2, 0)) * extent_share;
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    ASSERT_EQ(w.core.window.mesh.vertexFlags(v), kFinal | kBoundary | kResolved) << v;
    const double x = mesh.position(v, 0), y = mesh.position(v, 1), z = mesh.position(v, 2);
    if (x < 1 || y < 1 || x > n - 1 || y > n - 1 || z > 0) continue;
    ASSERT_NEAR(weight(w, v), inner, 1e-3 * inner) << v;
  }
}

// Many vertices that are locked, more than the lists hold at once.
TEST(Resolver, LocksNonManifoldPlacesInAnyNumber) {
  const int n = slowRun() ? 7 : 21;
  // Cubes at alternate places: they touch at edges and vertices only.
  const TestMesh mesh = cubes(n, n, n, [](int x, int y, int z) { return (x + y + z) % 2 == 0; });
  const MeshFacts facts = factsOf(mesh);
  ASSERT_FALSE(facts.manifold());
  WholeWindow<double> w(mesh);
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    int outside = 0;  // two: on an edge of the whole, a vertex of one cube only
    for (int i = 0; i < 3; ++i) outside += mesh.position(v, i) == 0 || mesh.position(v, i) == n;
    EXPECT_EQ((w.core.window.mesh.vertexFlags(v) & kLocked) != 0, outside < 2) << v;
    EXPECT_TRUE(w.core.window.mesh.vertexFlags(v) & kBoundary);
  }
}

}  // namespace
}  // namespace tetstream::test
