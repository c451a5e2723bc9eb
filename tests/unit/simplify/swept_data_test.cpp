// Float cell data: what they sum up to stays, constants stay constant, nothing leaves the range of
// what is round it, and regions keep theirs.
#include "swept_data.h"

#include <cmath>

#include "random.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// Waves, a constant, a step; of two regions if wanted, each with a number of its own.
TestMesh gridWithCellData(bool has_regions) {
  TestMesh mesh = fullGrid(7, 7, 7, 0.2);
  const auto isHigh = [](size_t c) { return c > 6u * 7 * 7 * 3; };
  mesh.addCellData({"d", 4, ScalarType::kFloat64}, [&](size_t c, int i) {
    const double values[] = {std::sin(0.01 * static_cast<double>(c)), 0.7,
                             static_cast<double>(c % 50 < 25), isHigh(c) ? 5.0 : 1.0};
    return values[i];
  });
  if (has_regions) mesh.addIntegerCellData("material", [&](size_t c) { return isHigh(c) ? 2 : 1; });
  return mesh;
}

struct Sums {
  double volume = 0, parts[4] = {0, 0, 0, 0}, least[4], most[4];
};

// Over the cells of both stars, those of the edge once.
Sums sumsOver(Patch<double>& patch, const std::vector<uint32_t>& cells) {
  Sums sums;
  std::fill_n(sums.least, 4, 1e300);
  std::fill_n(sums.most, 4, -1e300);
  for (uint32_t cell : cells) {
    if (!patch.isLive(cell)) continue;
    double p[4][3];
    for (uint32_t k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) p[k][i] = patch.values(patch.vertexOf(cell, k))[i];
    const double volume = std::fabs(sixVolume(p)) / 6;
    const double* row = patch.cellMeans(cell) + 1;
    sums.volume += volume;
    for (int i = 0; i < 4; ++i) {
      sums.parts[i] += volume * row[i];
      sums.least[i] = std::min(sums.least[i], row[i]);
      sums.most[i] = std::max(sums.most[i], row[i]);
    }
  }
  return sums;
}

struct Collapses {
  int all = 0, exact = 0, inside = 0;
};

// Of edges all over a patch, towards places beside their middles.
Collapses collapseMany(bool has_regions,
                       const std::function<void(const Sums&, const Sums&)>& look) {
  WholePatch<double> w(gridWithCellData(has_regions));
  EXPECT_TRUE(w.loaded);
  Collapser<Patch<double>> collapser(w.core, w.patch, w.account);
  Stars stars(w.account);
  Random random(3);
  const double scale = w.core.scale[0];
  Collapses count;
  for (int round = 0; round < 900; ++round) {
    const uint32_t u = random.below(w.patch.ownedEnd());
    if (!w.patch.isFree(u)) continue;
    w.patch.gather(u, kGoneCorner, stars.u, stars.ring);
    const uint32_t v = stars.u[random.below(static_cast<uint32_t>(stars.u.size()))].t[0];
    if (!w.patch.isFree(v)) continue;
    w.patch.gather(u, v, stars.u, stars.ring);
    w.patch.gather(v, u, stars.v, stars.ring_from_v);
    std::vector<uint32_t> cells;
    for (const Star* star : {&stars.u, &stars.v, &stars.ring})
      for (const StarCell& s : *star) cells.push_back(s.cell);
    const bool is_inside = !w.patch.isBoundary(u) && !w.patch.isBoundary(v);
    const auto shift = [&] {
      return scale * 0.2 * (static_cast<double>(random.below(101)) / 50 - 1);
    };
    const double z[3] = {is_inside ? shift() : 0, is_inside ? shift() : 0, is_inside ? shift() : 0};
    const Sums before = sumsOver(w.patch, cells);
    if (collapser.collapse(u, v, z, 0, 0) != Outcome::kDone) continue;
    const Sums after = sumsOver(w.patch, cells);
    ++count.all;
    look(before, after);
    if (!is_inside) continue;
    ++count.inside;
    const double off = std::fabs(after.parts[0] - before.parts[0]);
    EXPECT_LT(off, 0.02 * before.volume);
    count.exact += off < 1e-10 * before.volume;
  }
  return count;
}

TEST(SweptData, KeepSumsAndRanges) {
  const Collapses count = collapseMany(false, [](const Sums& before, const Sums& after) {
    EXPECT_NEAR(after.least[1], 0.7, 1e-12);
    EXPECT_NEAR(after.most[1], 0.7, 1e-12);
    for (int i : {0, 2, 3}) {
      EXPECT_GE(after.least[i], before.least[i] - 1e-12);
      EXPECT_LE(after.most[i], before.most[i] + 1e-12);
    }
  });
  EXPECT_GT(count.all, 100);
  EXPECT_GT(count.inside, 50);
  // Where a cell loses no more than it has.
  EXPECT_GT(count.exact, 0.9 * count.inside);
}

// Of a run of the default mode, which keeps the body's volume.
TEST(SweptData, KeepIntegralsOfARun) {
  TestMesh mesh = fullGrid(slowRun() ? 8 : 16, 8, 8, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double) {
    return std::sin(0.5 * x) * std::cos(0.4 * y);
  });
  mesh.addCellData({"rho", 1, ScalarType::kFloat64}, [&](size_t c, int) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const double x = mesh.position(static_cast<size_t>(mesh.cells[4 * c]), i) - 3;
      square += x * x;
    }
    return std::exp(-0.3 * square);
  });
  const auto integral = [](const TestMesh& of) {
    double sum = 0;
    for (size_t c = 0; c < of.cellCount(); ++c)
      sum += std::fabs(cellVolume(of, c)) * of.cellValue(0, c);
    return sum;
  };
  const Result r = simplified(mesh, toRatio(0.1));
  expectReached(r);
  EXPECT_NEAR(integral(r.out.mesh), integral(mesh), 1e-3 * integral(mesh));
}

TEST(SweptData, StayWithTheirRegions) {
  int mixed = 0;
  const Collapses count = collapseMany(true, [&](const Sums&, const Sums& after) {
    mixed += after.least[3] < after.most[3];
    for (double value : {after.least[3], after.most[3]})
      EXPECT_LT(std::min(std::fabs(value - 1), std::fabs(value - 5)), 1e-12);
  });
  EXPECT_GT(count.all, 100);
  EXPECT_GT(mixed, 5);
}

}  // namespace
}  // namespace tetstream::test
