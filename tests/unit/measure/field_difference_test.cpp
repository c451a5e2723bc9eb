// The difference of two meshes' fields where its integral is known.
#include "field_difference.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <numeric>

#include "field_testing.h"

namespace tetstream::test {
namespace {

double histogramVolume(const FieldSums& sums) {
  const double* volume = sums.histogram.volume;
  return std::accumulate(volume, volume + ErrorHistogram::kSteps, 0.0);
}

// Of values d at the corners: volume / 20 times (the square of their sum + the sum of squares).
TEST(FieldDifference, OverOneCellIsTheIntegralOfTheSquare) {
  const Measured m({{kCorner}, linear(1, 1, -5, 2)}, {{kCorner}, linear(0)});  // 1, 2, -4, 3
  expectVolumes(m, {kCornerVolume, kCornerVolume, 0, 0});
  EXPECT_NEAR(m.inside().squares, kCornerVolume / 20 * (4 + 30), 1e-15);
  EXPECT_DOUBLE_EQ(m.inside().largest, 4);
  expectPlace(m.inside(), 0, 1, 0);
  EXPECT_EQ(m.outside().squares, 0);
  EXPECT_EQ(m.outside().largest, 0);
}

TEST(FieldDifference, OfALinearFieldIsNothingWhateverTheCells) {
  const Values field = linear(1, 2, -3, 0.5);
  for (int side : {1, 2, 4}) {
    const Measured m({cubeOf(3), field}, {cubeOf(side), field});
    expectVolumes(m, {1, 1, 0, 0});
    EXPECT_LT(m.inside().squares, 1e-28);
    EXPECT_LT(m.inside().largest, 1e-14);
    EXPECT_NEAR(m.inside().histogram.volume[0], 1, 1e-14);
  }
}

// x^2 at the corners of 1 / n, against its line from 0 to 1: the integral of (x - x^2)^2 is 1 / 30,
// less what the chords leave out, and more chords leave less.
TEST(FieldDifference, OfACurvedFieldIsThatOfItsChords) {
  const Values square = [](const double* at) { return std::vector{at[0] * at[0]}; };
  for (int side : {2, 4}) {
    double expected = 0;  // over each chord, from d to e: width / 3 (d^2 + de + e^2)
    for (int i = 0; i < side; ++i) {
      const double a = static_cast<double>(i) / side, b = static_cast<double>(i + 1) / side;
      const double d = a - a * a, e = b - b * b;
      expected += (b - a) / 3 * (d * d + d * e + e * e);
    }
    const Measured m({cubeOf(side), square}, {cubeOf(1), square});
    EXPECT_NEAR(m.inside().squares, expected, 1e-15);
    EXPECT_NEAR(m.inside().largest, 0.25, 1e-15);
    EXPECT_NEAR(m.inside().place[0], 0.5, 1e-14);
  }
}

// A cell moved by s along the diagonal shares with the other one the cell of side h = 1 - 3s from
// (s, s, s) on, over which x^2 = (s + h u)^2 has the integral h^3 (s^2 / 6 + 2 s h / 24 + h^2 /
// 60).
TEST(FieldDifference, OfCellsThatOverlapIsThatOfTheirCommonPart) {
  for (double s : {0.1, 0.2, 0.3}) {
    const double h = 1 - 3 * s, common = h * h * h / 6;
    const Measured m({{kCorner}, linear(0, 1)}, {{moved(kCorner, s, s, s)}, linear(0)});
    expectVolumes(m, {kCornerVolume, common, kCornerVolume - common, 0});
    EXPECT_NEAR(m.inside().squares, h * h * h * (s * s / 6 + s * h / 12 + h * h / 60), 1e-15);
    EXPECT_NEAR(m.inside().largest, s + h, 1e-14);
    expectPlace(m.inside(), s + h, s, s);
    EXPECT_NEAR(histogramVolume(m.inside()), common, 1e-14);
  }
}

TEST(FieldDifference, CountsWhatIsCoveredTwice) {
  const Cell half = moved(kCorner, 0, 0, 0, 0.5);
  const Measured m({{kCorner}, linear(3)}, {{kCorner, half}, linear(1)});
  expectVolumes(m, {kCornerVolume, kCornerVolume * 9 / 8, 0, kCornerVolume / 8});
  EXPECT_NEAR(m.inside().squares, 4 * kCornerVolume * 9 / 8, 1e-15);
}

TEST(FieldDifference, OfCellsThatOnlyTouchOrAreFlatIsNone) {
  const Cell flat = {0, 0, 0.2, 1, 0, 0.2, 0, 1, 0.2, 0.2, 0.2, 0.2};
  const Measured m({{kCorner}, linear(3)}, {{flat, moved(kCorner, -1, 0, 0)}, linear(1)});
  expectVolumes(m, {kCornerVolume, 0, kCornerVolume, 0});
  EXPECT_EQ(m.inside().squares, 0);
  EXPECT_EQ(m.inside().largest, 0);
}

TEST(FieldDifference, OfNoOriginalIsNothing) {
  const Measured m({{}, linear(3)}, {{kCorner}, linear(1)});
  expectVolumes(m, {});
  EXPECT_EQ(m.inside().squares + m.outside().squares, 0);
}

// A number, then a vector that is told in halves.
TEST(FieldDifference, TellsFieldsApart) {
  const std::vector<ComparedField> fields = {{0, 1, 10, 1}, {1, 2, 0, 0.5}};
  const Values three = [](const double* at) { return std::vector{1.0, 6 * at[0], 8 * at[0]}; };
  const Values none = [](const double*) { return std::vector<double>(3); };
  const Measured m({{kCorner}, three}, {{kCorner}, none}, {}, {}, {4, 3}, fields);
  EXPECT_NEAR(m.inside(0).squares, kCornerVolume, 1e-15);
  EXPECT_DOUBLE_EQ(m.inside(0).largest, 1);
  EXPECT_NEAR(m.inside(1).squares, 25.0 / 60, 1e-15);  // of (5 x)^2
  EXPECT_DOUBLE_EQ(m.inside(1).largest, 5);
  expectPlace(m.inside(1), 1, 0, 0);
  EXPECT_NEAR(histogramVolume(m.inside(0)), kCornerVolume, 1e-15);
  EXPECT_EQ(histogramVolume(m.inside(1)), 0);  // of a field without a range
}

// ------------------------------------------------------------------------------- sums of it

TEST(ComparedField, IsComparedInItsUnitByItsComponents) {
  const ComparedField vector = {1, 2, 1, 0.5};
  const double values[4] = {100, 7, 1, 100}, others[4] = {0, 1, 9, 0};
  EXPECT_EQ(vector.squareBetween(values, others), 25);
}

TEST(ErrorHistogram, CountsInStepsOfAQuarterOfADecade) {
  for (int step = 0; step < ErrorHistogram::kSteps; ++step) {
    ErrorHistogram histogram;
    const double low = ErrorHistogram::lowerEnd(step);
    histogram.add(low * 1.001, 1);
    histogram.add(ErrorHistogram::lowerEnd(step + 1) * 0.999, 2);
    EXPECT_EQ(histogram.volume[step], 3) << step;
  }
  EXPECT_DOUBLE_EQ(ErrorHistogram::lowerEnd(0), 1e-10);
  EXPECT_DOUBLE_EQ(ErrorHistogram::lowerEnd(ErrorHistogram::kSteps), 10);
}

TEST(ErrorHistogram, CountsWhatIsBeyondInItsEnds) {
  ErrorHistogram histogram, twice;
  for (double small : {0.0, 1e-320, 1e-11}) histogram.add(small, 1);
  for (double large : {11.0, 1e300, std::numeric_limits<double>::infinity(), std::nan("")})
    histogram.add(large, 1);
  EXPECT_EQ(histogram.volume[0], 3);
  EXPECT_EQ(histogram.volume[ErrorHistogram::kSteps - 1], 4);
  twice.add(histogram);
  twice.add(histogram);
  EXPECT_EQ(twice.volume[0], 6);
}

TEST(FieldSums, KeepTheLargestAndItsPlace) {
  const double here[3] = {1, 2, 3}, there[3] = {4, 5, 6};
  FieldSums sums, more;
  sums.take(2, here);
  sums.take(2, there);  // no larger
  sums.take(std::nan(""), there);
  EXPECT_EQ(sums.largest, 2);
  EXPECT_EQ(sums.place[0], 1);
  more.take(3, there);
  more.squares = 7;
  sums.add(more);
  sums.add(FieldSums());
  EXPECT_EQ(sums.largest, 3);
  EXPECT_EQ(sums.place[2], 6);
  EXPECT_EQ(sums.squares, 7);
}

}  // namespace
}  // namespace tetstream::test
