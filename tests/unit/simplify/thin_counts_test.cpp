// Thin cells of an edge's stars are counted as they are, before and after collapses, whether they
// are remembered or not.
#include "thin_counts.h"

#include <array>

#include "random.h"
#include "thinness.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// Layers a tenth of a cell high: there are cells on both sides of each of the angles.
template <class S>
struct Layers : WholePatch<S> {
  Layers() : WholePatch<S>(mesh()), collapser(this->core, this->patch, this->account) {
    this->core.thin = ThinAngle(4);
    this->core.dear = {ThinAngle(12), ThinAngle(6)};
  }
  static TestMesh mesh() {
    const TestMesh grid = fullGrid(6, 6, 6, 0.2);
    std::vector<double> positions;
    for (size_t v = 0; v < grid.vertexCount(); ++v)
      for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) * (i == 2 ? 0.1 : 1));
    const bool single = std::is_same_v<S, float>;
    return makeMesh(single ? ScalarType::kFloat32 : ScalarType::kFloat64, positions, grid.cells);
  }
  double cos2Of(unsigned angle) const {
    return angle == 0 ? this->core.thin.cos2 : this->core.dear[angle - 1].cos2;
  }
  // Cell by cell, each once.
  size_t thinIn(const Stars& stars, unsigned angle) const {
    size_t thin = 0;
    for (const Star* star : {&stars.u, &stars.ring, &stars.v})
      for (const StarCell& s : *star) {
        double p[4][3];
        for (uint32_t k = 0; k < 4; ++k)
          for (uint32_t i = 0; i < 3; ++i)
            p[k][i] = static_cast<double>(this->patch.values(this->patch.vertexOf(s.cell, k))[i]);
        thin += thinness(p) > cos2Of(angle);
      }
    return thin;
  }
  Collapser<Patch<S>> collapser;
};

template <class S>
class ThinCountsOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ThinCountsOf, Scalars);

TYPED_TEST(ThinCountsOf, StarsAreThoseOfTheirCellsAlsoAfterCollapses) {
  Layers<TypeParam> layers;
  ASSERT_TRUE(layers.loaded);
  using Counts = ThinCounts<Patch<TypeParam>>;
  Counts counts(layers.core, layers.patch, layers.account);
  Stars stars(layers.account);
  Random random(5);
  const std::vector<TypeParam> z(3, TypeParam(0));
  std::array<size_t, 3> found{};
  int collapses = 0;
  for (int round = 0; round < 400; ++round) {
    const auto u = static_cast<uint32_t>(random.below(layers.patch.ownedEnd()));
    if (!layers.patch.isFree(u)) continue;
    layers.patch.gather(u, kGoneCorner, stars.u, stars.ring);
    if (stars.ring.size() + stars.u.size() == 0) continue;
    const Star& all = stars.ring.size() > 0 ? stars.ring : stars.u;
    const uint32_t v = all[random.below(all.size())].t[0];
    if (v == u || !layers.patch.isFree(v)) continue;
    layers.patch.gather(u, v, stars.u, stars.ring);
    layers.patch.gather(v, u, stars.v, stars.ring_from_v);
    for (unsigned angle = 0; angle < 3; ++angle) {
      const size_t thin = counts.count(u, v, stars, static_cast<typename Counts::Angle>(angle));
      EXPECT_EQ(thin, layers.thinIn(stars, angle)) << angle;
      found[angle] += thin;
    }
    if (layers.collapser.collapse(u, v, z.data(), 0, 0) != Outcome::kDone) continue;
    counts.merged(layers.collapser.stars());
    ++collapses;
  }
  EXPECT_GT(collapses, 20);
  EXPECT_GT(found[0], 0u);
  EXPECT_GT(found[2], found[0]);  // the second dear angle, and the floor
  EXPECT_GT(found[1], found[2]);
}

// With other angles what was known is forgotten.
TYPED_TEST(ThinCountsOf, OtherAnglesAreCountedAnew) {
  Layers<TypeParam> layers;
  using Counts = ThinCounts<Patch<TypeParam>>;
  Counts counts(layers.core, layers.patch, layers.account);
  Stars stars(layers.account);
  const uint32_t u = 0;
  layers.patch.gather(u, kGoneCorner, stars.u, stars.ring);
  const uint32_t v = stars.u.size() > 0 ? stars.u[0].t[0] : stars.ring[0].t[0];
  layers.patch.gather(u, v, stars.u, stars.ring);
  layers.patch.gather(v, u, stars.v, stars.ring_from_v);
  const size_t before = counts.count(u, v, stars, Counts::kFirstDear);
  layers.core.dear = {ThinAngle(89), ThinAngle(88)};
  EXPECT_EQ(counts.count(u, v, stars, Counts::kFirstDear), before);
  counts.forget();
  EXPECT_EQ(counts.count(u, v, stars, Counts::kFirstDear),
            stars.u.size() + stars.ring.size() + stars.v.size());
}

}  // namespace
}  // namespace tetstream::test
