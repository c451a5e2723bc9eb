// What a dying cell stands for goes to the cells beyond its faces, half to each.
#include "heirs.h"

#include <cmath>
#include <map>

#include "random.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

TestMesh gridWithCellData() {
  TestMesh mesh = fullGrid(7, 7, 7, 0.2);
  mesh.addCellData({"d", 1, ScalarType::kFloat64},
                   [](size_t c, int) { return std::sin(static_cast<double>(c)); });
  return mesh;
}

struct StoodFor {
  double volume, mean;
};

// Cell by cell, each cell of the stars asked for each that dies.
std::map<uint32_t, StoodFor> handedOver(Patch<double>& patch, uint32_t v, const Stars& stars) {
  std::map<uint32_t, StoodFor> after;
  for (const StarCell& dying : stars.ring) {
    std::vector<uint32_t> beside, heirs;
    for (uint32_t t : dying.t)
      if (t != v) beside.push_back(t);
    for (const Star* star : {&stars.u, &stars.v})
      for (const StarCell& s : *star)
        if (s.has(beside[0]) && s.has(beside[1])) heirs.push_back(s.cell);
    for (uint32_t heir : heirs) {
      const double* own = patch.cellMeans(heir);
      StoodFor& to = after.try_emplace(heir, StoodFor{own[0], own[1]}).first->second;
      const double* from = patch.cellMeans(dying.cell);
      const double share = from[0] / static_cast<double>(heirs.size());
      to.mean += (from[1] - to.mean) * (share / (to.volume + share));
      to.volume += share;
    }
  }
  return after;
}

// Of vertices all over a patch of 512, whatever their numbers.
TEST(Heirs, AreTheCellsBeyondTheFacesOfTheDying) {
  WholePatch<double> w(gridWithCellData());
  ASSERT_TRUE(w.loaded);
  Collapser<Patch<double>> collapser(w.core, w.patch, w.account);
  Stars stars(w.account);
  Random random(3);
  const double z[3] = {0, 0, 0};
  int collapses = 0;
  size_t alone = 0, both = 0;
  for (int round = 0; round < 600; ++round) {
    const uint32_t u = random.below(w.patch.ownedEnd());
    if (!w.patch.isFree(u)) continue;
    w.patch.gather(u, kGoneCorner, stars.u, stars.ring);
    const uint32_t v = stars.u[random.below(static_cast<uint32_t>(stars.u.size()))].t[0];
    if (!w.patch.isFree(v)) continue;
    w.patch.gather(u, v, stars.u, stars.ring);
    w.patch.gather(v, u, stars.v, stars.ring_from_v);
    const auto expected = handedOver(w.patch, v, stars);
    if (collapser.collapse(u, v, z, 0, 0) != Outcome::kDone) continue;
    ++collapses;
    for (const auto& [cell, stood_for] : expected) {
      EXPECT_NEAR(w.patch.cellMeans(cell)[0], stood_for.volume, 1e-12 * stood_for.volume);
      EXPECT_NEAR(w.patch.cellMeans(cell)[1], stood_for.mean, 1e-12);
    }
    (expected.size() < 2 * stars.ring.size() ? alone : both) += 1;
  }
  EXPECT_GT(collapses, 100);
  EXPECT_GT(alone, 5u);  // at the boundary some have one heir
  EXPECT_GT(both, 5u);
}

}  // namespace
}  // namespace tetstream::test
