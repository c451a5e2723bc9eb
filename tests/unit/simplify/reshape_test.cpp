// Flips in patches of real windows: what stays as it was, and who is told.
#include "reshape.h"

#include <cmath>
#include <map>
#include <set>

#include "mix.h"
#include "vector3.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// Jittered until many cells are thin, and a few nearly turned over.
TestMesh squeezed(int n) {
  TestMesh mesh = fullGrid(n, n, n, 0.25);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x) * y + 0.2 * z * z; });
  mesh.addCellData({"amount", 1, ScalarType::kFloat64},
                   [](size_t c, int) { return static_cast<double>(c % 7); });
  mesh.addIntegerCellData("material", [&](size_t c) {
    double z = 0;
    for (size_t j = 0; j < 4; ++j)
      z += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), 2) / 4;
    return z < n / 2.0 ? 1 : 2;
  });
  return mesh;
}

TestMesh squeezedWithLocked(int n, uint32_t every) {
  TestMesh mesh = squeezed(n);
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % every == 0);
  return mesh;
}

struct Squeezed : WholePatch<double> {
  explicit Squeezed(const std::string& region_names = "auto")
      : Squeezed(squeezed(8), options(region_names)) {}
  explicit Squeezed(TestMesh the_mesh, const SimplifyOptions& the_options = {})
      : WholePatch<double>(std::move(the_mesh), the_options),
        reshaper(core, patch, core.tally, account) {
    core.poor = thinnessOfAngle(25);
    mergeSome();
  }
  static SimplifyOptions options(const std::string& region_names) {
    SimplifyOptions options;
    options.regions = region_names;
    return options;
  }
  // Slots for further cells come from cells that died.
  void mergeSome() {
    Collapser<Patch<double>> collapser(core, patch, account);
    std::vector<double> z(core.scale.size());
    for (uint32_t c = 0; c < patch.cellEnd(); c += 9) {
      if (!patch.isLive(c)) continue;
      const uint32_t u = patch.vertexOf(c, 0), v = patch.vertexOf(c, 1);
      if (!patch.isFree(u) || !patch.isFree(v)) continue;
      collapser.endOf(u, v, false, z.data());
      collapser.collapse(u, v, z.data(), 0, 0);
    }
  }
  bool reshape(int64_t least_cells, int64_t most_cells, bool any_moved = true) {
    return reshaper.reshape(least_cells, most_cells, error, [&](uint32_t) { return any_moved; });
  }
  int poorCells() {
    Reconnector<double> look(patch, account);
    look.start(false);
    int count = 0;
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      count += patch.isLive(c) && look.thinnessOfCell(c) > core.poor;
    return count;
  }
  // Calls use(number, means) with each cell's.
  template <class Use>
  void forMeans(const Use& use) {
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      if (patch.isLive(c)) use(c, patch.cellMeans(c));
  }
  // Float cell data times volume, by region.
  std::map<int64_t, double> amounts() {
    std::map<int64_t, double> all;
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      if (patch.isLive(c)) {
        const double* means = patch.cellMeans(c);
        all[core.window.cellPicks(patch.cellSlotOf(c))[0]] += means[0] * means[1];
      }
    return all;
  }
  // Whether each vertex on the boundary has its cells; returns how many of them are of the rim.
  int expectBoundaryStars() {
    std::map<uint32_t, std::set<uint32_t>> cells;
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      for (uint32_t j = 0; j < 4 && patch.isLive(c); ++j) cells[patch.vertexOf(c, j)].insert(c);
    int rim = 0;
    Star star(account);
    for (const auto& [v, of_v] : cells) {
      if (!patch.isBoundary(v)) continue;
      EXPECT_TRUE(patch.gatherOnBoundary(v, 1000, star));
      std::set<uint32_t> found;
      for (const StarCell& cell : star) found.insert(cell.cell);
      EXPECT_EQ(found, of_v) << v;
      rim += v >= patch.ownedEnd();
    }
    return rim;
  }
  double error = core.volume;  // of the whole: any change of the field is allowed
  Reshaper<double> reshaper;
};

TEST(Reshape, KeepsTheDomainItsTopologyAndWhatCellsStandFor) {
  Squeezed s;
  ASSERT_TRUE(s.loaded);
  const auto amounts = s.amounts();
  const int poor = s.poorCells();
  Squeezed untouched;  // the same, for what was before
  untouched.patch.store();
  const MeshFacts before = factsOf(untouched.live());
  ASSERT_TRUE(s.reshape(0, 1 << 30));
  EXPECT_GT(s.core.tally.flips, 30);
  EXPECT_LT(s.poorCells(), 0.6 * poor);
  const auto after_amounts = s.amounts();
  ASSERT_EQ(after_amounts.size(), amounts.size());
  for (auto [label, amount] : amounts)
    EXPECT_NEAR(after_amounts.at(label), amount, 1e-9 * amount) << label;
  s.patch.store();
  const MeshFacts after = factsOf(s.live());
  EXPECT_EQ(topologyChange(before, after), "");
  EXPECT_EQ(after.boundary_faces, before.boundary_faces);
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
}

// Values that are not finite have no mean, and those that are as large as can be no sum.
TEST(Reshape, LetsValuesThatAreNotFiniteNeitherGrowNorVanish) {
  Squeezed s;
  s.forMeans(
      [](uint64_t c, double* means) { means[1] = mix(c + 1) % 4 == 0 ? std::nan("") : 1e308; });
  const auto unknown = [&] {
    double share = 0, all = 0;
    s.forMeans([&](uint64_t, const double* means) {
      EXPECT_FALSE(std::isinf(means[1]));
      all += means[0];
      share += std::isnan(means[1]) ? means[0] : 0;
    });
    return share / all;
  };
  const double before = unknown();
  ASSERT_NEAR(before, 0.25, 0.05);
  ASSERT_TRUE(s.reshape(0, 1 << 30));
  ASSERT_GT(s.core.tally.flips, 100);
  EXPECT_NEAR(unknown(), before, 0.02);
}

TEST(Reshape, LeavesTheStarsOnTheBoundaryKnown) {
  Squeezed s;
  s.patch.store();
  Topology& mesh = s.core.window.mesh;
  for (uint32_t v = 0; v < mesh.vertexEnd(); v += 4) mesh.flagVertex(v, kLocked);  // for a rim
  s.load();
  s.mergeSome();
  EXPECT_GT(s.expectBoundaryStars(), 30);
  ASSERT_TRUE(s.reshape(0, 1 << 30));
  EXPECT_GT(s.core.tally.flips, 10);
  s.expectBoundaryStars();
}

TEST(Reshape, StaysWithinTheLimitsOfCells) {
  for (int64_t room : {0, 3}) {
    Squeezed s;
    const int64_t live = s.patch.liveCells();
    s.reshape(live - room, live + room);
    EXPECT_GE(s.patch.liveCells(), live - room);
    EXPECT_LE(s.patch.liveCells(), live + room);
  }
}

// Where the field comes first: fewer thin cells, no more of others, and the change is an error
// made.
TEST(Reshape, ThinsOutForALittleOfTheBound) {
  Squeezed s;
  const int poor = s.poorCells();
  const int64_t live = s.patch.liveCells();
  const auto anywhere = [](uint32_t) { return true; };
  const double before = s.core.tally.error, bound = 1e-3 * s.core.volume;
  EXPECT_FALSE(s.reshaper.thinOut(0, 1e-12 * bound, anywhere));
  ASSERT_TRUE(s.reshaper.thinOut(0, bound, anywhere));
  const int64_t few = s.core.tally.flips;
  EXPECT_GT(few, 0);
  EXPECT_LE(s.poorCells(), poor - few);
  EXPECT_LE(s.patch.liveCells(), live);
  EXPECT_GT(s.core.tally.error, before);
  EXPECT_LE(s.core.tally.error, before + 0.01 * bound * static_cast<double>(few));
  const int left = s.poorCells();
  ASSERT_TRUE(s.reshaper.thinOut(0, 1e6 * bound, anywhere));
  EXPECT_LT(s.poorCells(), left);
  EXPECT_LE(s.patch.liveCells(), live);
  s.patch.store();
  EXPECT_EQ(topologyChange(factsOf(s.mesh), factsOf(s.live())), "");
}

TEST(Reshape, ThinsOutWithinTheLimitOfTheError) {
  Squeezed s;
  s.core.error_limit = s.core.tally.error;
  s.reshaper.thinOut(0, s.core.volume, [](uint32_t) { return true; });
  EXPECT_EQ(s.core.tally.error, s.core.error_limit);
}

TEST(Reshape, LeavesFieldsAloneThatWouldChange) {
  Squeezed s;
  s.error = 0;
  EXPECT_FALSE(s.reshape(0, 1 << 30));
}

// A cell at which no flip was found is looked at again when something near it has moved.
TEST(Reshape, PassesOverCellsRoundWhichNothingChanged) {
  Squeezed s;
  s.error = 0;
  ASSERT_FALSE(s.reshape(0, 1 << 30));
  s.error = s.core.volume;
  EXPECT_FALSE(s.reshape(0, 1 << 30, false));
  EXPECT_EQ(s.core.tally.flips, 0);
  const uint32_t moved = s.patch.ownedEnd() / 8;
  EXPECT_TRUE(s.reshaper.reshape(0, 1 << 30, s.error, [&](uint32_t v) { return v < moved; }));
  const int64_t near = s.core.tally.flips;
  EXPECT_TRUE(s.reshape(0, 1 << 30));
  EXPECT_GT(s.core.tally.flips, near);
}

// Cells of one material are not made of those of two.
TEST(Reshape, KeepsRegionsApart) {
  Squeezed with, without("none");
  const auto volumes = [](Squeezed& s) {
    s.patch.store();
    std::map<int64_t, double> all;
    const TestMesh live = s.live();
    size_t row = 0;
    for (uint32_t c = 0; c < s.core.window.cellEnd(); ++c)
      if (s.core.window.isLive(c))
        all[s.core.window.cellPicks(c)[0]] += std::fabs(cellVolume(live, row++));
    return all;
  };
  Squeezed untouched;
  const auto before = volumes(untouched);
  ASSERT_TRUE(with.reshape(0, 1 << 30));
  for (auto [label, volume] : volumes(with)) EXPECT_NEAR(volume, before.at(label), 1e-9) << label;
  ASSERT_TRUE(without.reshape(0, 1 << 30));
  double change = 0;  // where labels are no regions the flips cross them
  for (auto [label, volume] : volumes(without)) change += std::fabs(volume - before.at(label));
  EXPECT_GT(change, 0.01);
}

Edges edgesOf(const Squeezed& s) {
  Edges edges;
  for (uint32_t c = 0; c < s.patch.cellEnd(); ++c) {
    if (!s.patch.isLive(c)) continue;
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t j = 0; j < 4; ++j)
        if (s.patch.vertexOf(c, i) < s.patch.vertexOf(c, j))
          edges.emplace(s.patch.vertexOf(c, i), s.patch.vertexOf(c, j));
  }
  return edges;
}

// Of the edges that flips do away with, those stay whose ends the caller locked.
TEST(Reshape, KeepsLockedEdges) {
  Squeezed free;
  const Edges before = edgesOf(free);
  ASSERT_TRUE(free.reshape(0, 1 << 30));
  const Edges after = edgesOf(free);
  Squeezed locked;
  Edges kept;
  for (const auto& edge : before) {
    if (after.count(edge)) continue;
    kept.insert(edge);
    for (uint32_t v : {edge.first, edge.second})
      locked.core.window.mesh.flagVertex(locked.patch.slotOf(v), kLocked | kCallerLocked);
  }
  ASSERT_GT(kept.size(), 10u);
  ASSERT_TRUE(locked.reshape(0, 1 << 30));
  const Edges left = edgesOf(locked);
  for (const auto& edge : kept) EXPECT_TRUE(left.count(edge));
}

// Between vertices that are not free, all of whose cells the patch need not have, edges are made in
// meshes that do not fold only.
TEST(Reshape, MakesNoEdgeThatFoldedCellsMayHave) {
  const auto edgesMade = [](bool folds) {
    Squeezed s(squeezedWithLocked(8, 2));
    EXPECT_FALSE(s.core.folds);
    s.core.folds = folds;
    const Edges before = edgesOf(s);
    EXPECT_TRUE(s.reshape(0, 1 << 30));
    int made = 0;
    for (const auto& edge : edgesOf(s))
      made += edge.first >= s.patch.ownedEnd() && !before.count(edge);
    return made;
  };
  EXPECT_GT(edgesMade(false), 0);
  EXPECT_EQ(edgesMade(true), 0);
}

// What it is told suffices to follow every cell.
class FlipLedger final : public FlipObserver {
 public:
  void flipped(const uint32_t* before, size_t before_count, const PlacedCell* after,
               size_t after_count) override {
    double gone = 0, made = 0;
    for (size_t i = 0; i < before_count; ++i) {
      const auto cell = volume_of.find(before[i]);
      ASSERT_NE(cell, volume_of.end());
      gone += cell->second;
      volume_of.erase(cell);
    }
    for (size_t i = 0; i < after_count; ++i) {
      const double volume = sixVolume(after[i].corner);
      EXPECT_GT(volume, 0);
      made += volume;
      EXPECT_TRUE(volume_of.emplace(after[i].cell, volume).second);
    }
    EXPECT_NEAR(made, gone, 1e-12 * gone + 1e-15);
  }
  std::map<uint32_t, double> volume_of;
};

TEST(Reshape, TellsWhichCellsMadeWayForWhich) {
  Squeezed s;
  FlipLedger ledger;
  const auto volumes = [&] {
    std::map<uint32_t, double> all;
    for (uint32_t c = 0; c < s.patch.cellEnd(); ++c) {
      if (!s.patch.isLive(c)) continue;
      double p[4][3];
      for (uint32_t k = 0; k < 4; ++k) std::copy_n(s.patch.values(s.patch.vertexOf(c, k)), 3, p[k]);
      all[s.patch.cellSlotOf(c)] = sixVolume(p);
    }
    return all;
  };
  ledger.volume_of = volumes();
  s.reshaper.observe(&ledger);
  ASSERT_TRUE(s.reshape(0, 1 << 30));
  EXPECT_TRUE(ledger.volume_of == volumes());
}

}  // namespace
}  // namespace tetstream::test
