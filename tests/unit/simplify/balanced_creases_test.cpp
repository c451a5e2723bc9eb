// The weight of the boundary of bodies with plane sides: vertices on their straight edges go along
// them. What interfaces count beside such a boundary.
#include <cmath>

#include "balance.h"
#include "shapes.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

constexpr Removal kAlong = {1e-4, 0}, kAway = {1e-4, 1};
const Ways kOfCrease = {kAlong, kAlong, kAway, kAway, kAway, kAway};

// A fifth of the boundary's vertices lie on creases, of which so many are corners.
RemovalCosts creased(size_t corners) {
  RemovalCosts costs;
  costs.is_whole = true;
  costs.inside = {std::vector<Ways>(100, {{1e-4, 0}}), 1000};
  costs.outer.vertices = 1000;
  for (size_t i = 0; i < 100; ++i) {
    const bool on_crease = i % 5 == 0;
    const Ways all = on_crease ? kOfCrease : Ways(6, kAlong);
    const Ways along = !on_crease ? all : i / 5 < corners ? Ways(6, kAway) : Ways(2, kAlong);
    costs.outer.sample.push_back(all);
    costs.outer.along_creases.push_back(along);
  }
  return costs;
}

double outerWeight(const RemovalCosts& costs, double ratio) {
  Balance balance;
  chooseBalance(costs, ratio, &balance);
  return balance.outer;
}

TEST(BalancedCreases, CostNothingAlongThem) {
  RemovalCosts costs = creased(0);
  EXPECT_EQ(outerWeight(costs, 0.1), 1);
  costs.outer.along_creases.clear();
  EXPECT_LE(outerWeight(costs, 0.1), 0.25);
}

// Ten corners of a hundred vertices are a hundred of a thousand.
TEST(BalancedCreases, AreLeftWhereNotEvenCornersCanBe) {
  RemovalCosts costs = creased(10);
  RemovalCosts by_all = costs;
  by_all.outer.along_creases.clear();
  EXPECT_EQ(outerWeight(costs, 0.04), outerWeight(by_all, 0.04));
  EXPECT_GT(outerWeight(costs, 0.06), outerWeight(by_all, 0.06));
}

TEST(BalancedCreases, LeaveInterfacesAllOfTheBalance) {
  RemovalCosts costs = creased(0);
  costs.interfaces = {std::vector<Ways>(100, {{1e-4, kInterfaceShare}}), 1000};
  Balance balance;
  chooseBalance(costs, 0.1, &balance);
  EXPECT_EQ(balance.outer, 1);
  EXPECT_LT(balance.interfaces, 1.0 / 128);
  EXPECT_GE(balance.interfaces, 1.0 / 1024);
}

// A strut of four cells with a field that is smooth along it.
TEST(BalancedCreases, KeepPlaneSidesOfStruts) {
  const int n = slowRun() ? 40 : 80;
  TestMesh strut = cubes(n, 4, 4, [](int, int, int) { return true; });
  addPositionField(strut, {"f", 1, k64}, [n](double x, double y, double) {
    return std::sin(9 * x / n) + 0.1 * std::cos(y / 2);
  });
  for (double ratio : {0.2, 0.08}) {
    const Result with = simplified(strut, toRatio(ratio));
    SimplifyOptions options = toRatio(ratio);
    options.balance = BalanceUse::kNever;
    const Result without = simplified(strut, options);
    EXPECT_EQ(with.report.balance, "");
    EXPECT_EQ(with.out.mesh.cells, without.out.mesh.cells);
    EXPECT_EQ(with.out.mesh.positions.bytes, without.out.mesh.positions.bytes);
  }
}

}  // namespace
}  // namespace tetstream::test
