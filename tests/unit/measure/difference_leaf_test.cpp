// What is left of a cell outside the other mesh, samples, and meshes measured in parts.
#include "difference_leaf.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <limits>

#include "field_testing.h"

namespace tetstream::test {
namespace {

const std::vector<double> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// --------------------------------------------------------------------------- what is outside

TEST(DifferenceLeaf, ComparesWhatIsOutsideWithTheNearestBoundary) {
  const Measured m({{kCorner}, linear(5)}, {}, {{kTriangle}, linear(2)});
  expectVolumes(m, {kCornerVolume, 0, kCornerVolume, 0});
  EXPECT_NEAR(m.outside().squares, 9 * kCornerVolume, 1e-14);
  EXPECT_EQ(m.outside().largest, 3);
  EXPECT_EQ(m.inside().squares, 0);
}

// The nearest point of the triangle is that below, from which a value of x + y + 10 z differs by
// 10 z, the most at the top: corners count.
TEST(DifferenceLeaf, FindsTheLargestErrorOutsideAtACorner) {
  const Measured m({{kCorner}, linear(0, 1, 1, 10)}, {}, {{kTriangle}, linear(0, 1, 1, 10)});
  EXPECT_EQ(m.outside().largest, 10);
  expectPlace(m.outside(), 0, 0, 1);
  EXPECT_NEAR(m.outside().squares, 100.0 / 60, 0.5);  // of (10 z)^2, by a few places
}

TEST(DifferenceLeaf, IsInfinitelyFarFromNoBoundary) {
  const Measured m({{kCorner}, linear(5)}, {});
  EXPECT_EQ(m.outside().squares, std::numeric_limits<double>::infinity());
  EXPECT_EQ(m.outside().largest, std::numeric_limits<double>::infinity());
}

TEST(DifferenceLeaf, CountsTheVolumeOutsideOfMeshesThatAreMoved) {
  for (double x : {0.1, 0.3, 0.5}) {
    const Measured m({cubeOf(2), linear(5)}, {moved(cubeOf(3), x, 0, 0), linear(3)},
                     {{kTriangle}, linear(1)});
    expectVolumes(m, {1, 1 - x, x, 0});
    EXPECT_NEAR(m.inside().squares, 4 * (1 - x), 1e-13);
    EXPECT_NEAR(m.outside().squares, 16 * x, 1e-13);
    EXPECT_DOUBLE_EQ(m.outside().largest, 4);
    // By the step of each error: from 10^0.25 on, from 10^0.5 on.
    EXPECT_NEAR(m.inside().histogram.volume[41], 1 - x, 1e-13);
    EXPECT_NEAR(m.outside().histogram.volume[42], x, 1e-13);
  }
}

TEST(DifferenceLeaf, LooksAtNothingOutsideThatIsCovered) {
  for (double x : {0.1, 0.3}) {
    const Measured m({cubeOf(2), linear(0, 1)}, {moved(cubeOf(3), x, 0, 0), linear(0, 1)},
                     {{kTriangle}, linear(0)});
    EXPECT_LE(m.outside().largest, x);
    EXPECT_GT(m.outside().largest, x / 2);
  }
}

// Of a mesh held whole, too, which once was told of at its end alone.
TEST(DifferenceLeaf, TellsOfItsProgress) {
  const Valued original = {cubeOf(19), linear(0, 1)}, simplified = {cubeOf(1), linear(0, 1)};
  ASSERT_GT(original.cells.size(), 2u * 16384);
  for (const int64_t samples : {int64_t{0}, int64_t{50000}}) {
    Measuring how;
    how.sampling.samples = samples;
    how.sampling.volume = 1;
    EXPECT_GE(Measured(original, simplified, {}, how).steps(), 3) << samples;
  }
}

// Too thin for the places that are spread in the cell: three corners are outside.
TEST(DifferenceLeaf, CountsAThinVolumeOutsideAtItsCorners) {
  constexpr double kThin = 1e-5, kInner = 1 - kThin;
  const Measured m({{kCorner}, linear(0, 1)}, {{moved(kCorner, 0, 0, 0, kInner)}, linear(0, 1)},
                   {{kTriangle}, linear(0)});
  const double outside = kCornerVolume * (1 - kInner * kInner * kInner);
  EXPECT_NEAR(m.volumes().outside, outside, 1e-15);
  EXPECT_NEAR(m.outside().squares, outside / 3, 1e-14);  // a third of it at x = 1, the rest at 0
  EXPECT_EQ(m.outside().largest, 1);
}

// A gap between two halves of the cell, at none of its corners.
TEST(DifferenceLeaf, CountsAGapThatIsTooThinAsCovered) {
  constexpr double kGap = 1e-6, kHalf = (1 - kGap) / 2;
  const Cell one = {0, 0, 0, 1, 0, 0, 1 - kHalf, kHalf, 0, 0, 0, 1};
  const Cell other = {0, 0, 0, kHalf, 1 - kHalf, 0, 0, 1, 0, 0, 0, 1};
  const Measured m({{kCorner}, linear(5)}, {{one, other}, linear(5)}, {{kTriangle}, linear(2)});
  EXPECT_NEAR(m.volumes().covered, kCornerVolume * (1 - kGap), 1e-15);
  EXPECT_NEAR(m.volumes().outside, 0, 1e-15);
  EXPECT_EQ(m.outside().squares, 0);
  EXPECT_EQ(m.outside().largest, 0);
}

// --------------------------------------------------------------------------------- by samples

// With that seed, of a cube whose volume is 1.
Measuring sampled(int64_t samples, uint64_t seed = 1) {
  return {.sampling = {samples, seed, 1}};
}

// The integral of x^2 is a third; the standard error of it by so many points a thousandth.
TEST(DifferenceLeaf, SamplesComeNearTheIntegral) {
  const Measured m({cubeOf(3), linear(0, 1)}, {cubeOf(2), linear(0)}, {}, sampled(90000));
  EXPECT_NEAR(m.inside().squares, 1.0 / 3, 0.004);
  EXPECT_NEAR(m.inside().largest, 1, 0.001);
  EXPECT_LE(m.inside().largest, 1);
  EXPECT_NEAR(m.inside().place[0], m.inside().largest, 1e-12);
  EXPECT_NEAR(m.volumes().original, 1, 1e-13);
  EXPECT_NEAR(m.volumes().covered, 1, 0.002);
  EXPECT_EQ(m.volumes().outside, 0);
}

// Most cells have none.
TEST(DifferenceLeaf, SamplesMayBeFewerThanCells) {
  const Measured m({cubeOf(6), linear(2)}, {cubeOf(2), linear(0)}, {}, sampled(400));
  EXPECT_NEAR(m.volumes().covered, 1, 0.15);
  EXPECT_NEAR(m.inside().squares, 4 * m.volumes().covered, 1e-12);
}

// Of two that are in each other, whose values are 1 and 0, whichever comes first.
TEST(DifferenceLeaf, SamplesAreTakenFromTheCellInWhichTheyAreDeepest) {
  const Cell round = moved(kCorner, -1, -1, -1, 8);
  const Values apart = [](const double* at) {
    return std::vector{at[0] < 0 || at[0] > 1 ? 1.0 : 0};
  };
  const Measuring how = {.sampling = {3000, 1, kCornerVolume}};
  const Measured one({{kCorner}, linear(0)}, {{kCorner, round}, apart}, {}, how);
  const Measured other({{kCorner}, linear(0)}, {{round, kCorner}, apart}, {}, how);
  EXPECT_EQ(one.inside().squares, other.inside().squares);
  EXPECT_GT(one.inside().squares, 0.1 * kCornerVolume);
  EXPECT_LT(one.inside().squares, kCornerVolume);
}

TEST(DifferenceLeaf, SamplesOutsideAreComparedWithTheNearestBoundary) {
  const Measured m({cubeOf(2), linear(5)}, {moved(cubeOf(2), 0.25, 0, 0), linear(4)},
                   {{kTriangle}, linear(2)}, sampled(20000));
  EXPECT_NEAR(m.volumes().outside, 0.25, 0.01);
  EXPECT_NEAR(m.volumes().covered, 0.75, 0.01);
  EXPECT_NEAR(m.outside().squares, 9 * m.volumes().outside, 1e-10);
  EXPECT_NEAR(m.inside().squares, m.volumes().covered, 1e-10);
}

TEST(DifferenceLeaf, SamplesAreThoseOfTheSeedWhateverTheOrderOfCells) {
  const Valued other = {cubeOf(2), linear(0)};
  std::vector<Cell> turned = cubeOf(3);
  const Measured m({turned, linear(0, 1)}, other, {}, sampled(3000));
  std::reverse(turned.begin(), turned.end());
  const Measured same({turned, linear(0, 1)}, other, {}, sampled(3000));
  EXPECT_NEAR(m.inside().squares, same.inside().squares, 1e-13);
  EXPECT_EQ(m.inside().largest, same.inside().largest);
  const Measured another({turned, linear(0, 1)}, other, {}, sampled(3000, 2));
  EXPECT_NE(m.inside().largest, another.inside().largest);
}

// ----------------------------------------------------------------------------------- in parts

void expectSame(const FieldSums& sums, const FieldSums& expected) {
  EXPECT_NEAR(sums.squares, expected.squares, 1e-12 * expected.squares);
  EXPECT_DOUBLE_EQ(sums.largest, expected.largest);
  for (int step = 0; step < ErrorHistogram::kSteps; ++step)
    EXPECT_NEAR(sums.histogram.volume[step], expected.histogram.volume[step], 1e-10);
}

void expectSame(const Measured& m, const Measured& expected) {
  expectVolumes(m, expected.volumes());
  expectSame(m.inside(), expected.inside());
  expectSame(m.outside(), expected.outside());
}

// The original is split in space, and the other mesh is looked at some cells at a time.
TEST(DifferenceLeaf, MeshesLargerThanTheMemoryHaveTheSameDifference) {
  const Values curved = [](const double* at) { return std::vector{at[0] * at[0] + at[1] * at[2]}; };
  const Valued original = {cubeOf(5), curved}, other = {moved(cubeOf(4), 0.1, 0.05, 0), curved};
  const Valued surface = {{kTriangle, {0, 0, 0, 0, 1, 0, 0, 0, 1}}, curved};
  for (int64_t samples : {0, 5000}) {
    Measuring how = sampled(samples);
    const Measured whole(original, other, surface, how);
    how.in_core = 16 << 10;
    for (size_t bytes : {16 << 10, 64 << 10}) {
      how.bytes = bytes;
      expectSame(Measured(original, other, surface, how), whole);
    }
  }
}

// Which have no place to be split at.
TEST(DifferenceLeaf, CellsInOnePlaceAreSplitByNumber) {
  const std::vector<Cell> same(300, kCorner);
  const Measuring how = {.in_core = 4 << 10, .bytes = 16 << 10};
  const Measured m({same, linear(3)}, {{kCorner}, linear(1)}, {}, how);
  EXPECT_NEAR(m.volumes().original, 300 * kCornerVolume, 1e-12);
  EXPECT_NEAR(m.volumes().covered, 300 * kCornerVolume, 1e-12);
  EXPECT_NEAR(m.inside().squares, 4 * 300 * kCornerVolume, 1e-12);
}

TEST(DifferenceLeaf, IsTheSameForAnyNumberOfThreads) {
  const Valued original = {cubeOf(6), linear(0, 1)},
               other = {moved(cubeOf(5), 0.1, 0, 0), linear(0)};
  const Valued surface = {{kTriangle}, linear(0)};
  const Tasks tasks(3);
  for (int64_t samples : {0, 10000}) {
    Measuring how = sampled(samples);
    const Measured alone(original, other, surface, how);
    how.tasks = &tasks;
    const Measured helped(original, other, surface, how);
    EXPECT_EQ(helped.inside().squares, alone.inside().squares);
    EXPECT_EQ(helped.outside().squares, alone.outside().squares);
    EXPECT_EQ(helped.volumes().covered, alone.volumes().covered);
    EXPECT_EQ(helped.inside().largest, alone.inside().largest);
  }
}

}  // namespace
}  // namespace tetstream::test
