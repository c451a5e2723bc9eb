// The weight of the boundary beside the fields: lowered where the boundary bends so much more than
// they do that it would take nearly all vertices, and nowhere else.
#include "balance.h"

#include <cmath>
#include <functional>
#include <limits>

#include "field_error.h"
#include "shapes.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

RemovalCosts costsOf(Removal inside, double inside_vertices, Removal outer, double outer_vertices) {
  RemovalCosts costs;
  costs.inside = {std::vector<Ways>(64, {inside}), inside_vertices};
  costs.outer = {std::vector<Ways>(64, {outer}), outer_vertices};
  return costs;
}

Balance chosen(const RemovalCosts& costs, double ratio) {
  Balance balance;
  chooseBalance(costs, ratio, &balance);
  return balance;
}

// As many vertices inside as on it, and a boundary that costs a million times as much.
TEST(Balance, LowersARoughBoundaryBesideASmoothField) {
  const Balance balance = chosen(costsOf({1e-4, 0}, 500, {1e-4, 1}, 500), 0.1);
  EXPECT_TRUE(balance.knows_outer);
  EXPECT_LT(balance.outer, 0.05);
}

TEST(Balance, LeavesABoundaryThatCostsNothing) {
  EXPECT_EQ(chosen(costsOf({1, 0}, 500, {1, 0}, 500), 0.1).outer, 1);
  EXPECT_EQ(chosen(costsOf({1, 0}, 500, {1, 1e-9}, 500), 0.1).outer, 1);
}

TEST(Balance, LeavesABoundaryBesideAFieldThatCostsAsMuch) {
  EXPECT_EQ(chosen(costsOf({1, 0}, 500, {1, 1}, 500), 0.1).outer, 1);
}

TEST(Balance, LeavesABoundaryThatTouchesItself) {
  RemovalCosts costs = costsOf({1e-4, 0}, 500, {1e-4, 1}, 500);
  costs.touching = 0.01;
  EXPECT_LT(chosen(costs, 0.1).outer, 0.05);
  costs.touching = 0.1;
  const Balance balance = chosen(costs, 0.1);
  EXPECT_TRUE(balance.knows_outer);
  EXPECT_EQ(balance.outer, 1);
}

// Vertices of the sheet may go one way that costs the field much and the sheet little, or another
// that costs the sheet hardly more and the field next to nothing.
TEST(Balance, LowersABoundaryThatChoosesTheWrongWaysForTheField) {
  RemovalCosts costs = costsOf({1e-4, 0}, 500, {}, 500);
  costs.outer.sample.assign(64, {{1, 1}, {0.01, 1.5}});
  costs.is_whole = true;
  EXPECT_LT(chosen(costs, 0.1).outer, 1);
  costs.outer.sample.assign(64, {{1, 1}, {0.9, 1.5}});
  EXPECT_EQ(chosen(costs, 0.1).outer, 1);
}

// A part of the boundary, as ridges and corners, costs so much that all of it is kept, and is no
// error: that the rest may be off by little is not lost beside it.
TEST(Balance, CountsNoErrorForWhatIsKept) {
  const auto balanceWith = [](double ridges) {
    RemovalCosts costs = costsOf({1e-3, 0}, 5000, {1e-3, 1e-3}, 1000);
    costs.outer.sample.resize(72, {{1e-3, ridges}});
    costs.is_whole = true;
    return chosen(costs, 0.2).outer;
  };
  EXPECT_EQ(balanceWith(1e-3), 1);
  EXPECT_EQ(balanceWith(1e6), 1);
}

// A boundary with few of the vertices cannot starve those inside.
TEST(Balance, LeavesTheBoundaryOfABulkyBody) {
  EXPECT_EQ(chosen(costsOf({1e-6, 0}, 1e6, {1e-6, 1e-4}, 5e3), 0.1).outer, 1);
}

TEST(Balance, KnowsNothingOfTooFewVertices) {
  RemovalCosts costs = costsOf({1e-6, 0}, 500, {1e-6, 1}, 500);
  costs.outer.vertices = kLeastVertices - 1;
  const Balance balance = chosen(costs, 0.1);
  EXPECT_FALSE(balance.knows_outer);
  EXPECT_EQ(balance.outer, 1);
  costs.inside.vertices = costs.outer.vertices;
  costs.outer.vertices = 2 * kLeastVertices;
  EXPECT_FALSE(chosen(costs, 0.1).knows_outer);
}

// Where a stream begins with fields that have no errors yet, what comes next is to tell.
TEST(Balance, WaitsForFieldsThatHaveErrors) {
  RemovalCosts costs = costsOf({1e-12, 0}, 500, {1e-12, 1}, 500);
  costs.least_field = 1e-4;
  const Balance early = chosen(costs, 0.1);
  EXPECT_FALSE(early.knows_outer);
  EXPECT_EQ(early.outer, 1);
  costs.inside.sample.assign(64, {{1e-4, 0}});
  EXPECT_TRUE(chosen(costs, 0.1).knows_outer);
  costs.inside.sample.assign(64, {{1e-12, 0}});
  costs.is_whole = true;
  EXPECT_TRUE(chosen(costs, 0.1).knows_outer) << "nothing is to come";
}

// Nothing is inside: down to where what it adds is no more than so many times the field's. What is
// to come of a stream may have an inside.
TEST(Balance, LowersTheBoundaryOfAWallWhereItDrownsTheField) {
  RemovalCosts wall = costsOf({}, 0, {1e-6, 1}, 500);
  wall.inside.sample.clear();
  EXPECT_EQ(chosen(wall, 0.1).outer, 1);
  wall.is_whole = true;
  EXPECT_EQ(chosen(wall, 0.1).outer, 1.0 / 128);
  wall.outer = {std::vector<Ways>(64, {{1, 64 * 8}}), 500};
  EXPECT_LT(chosen(wall, 0.1).outer, 1);
  EXPECT_GT(chosen(wall, 0.1).outer, 1.0 / 16);
  wall.outer = {std::vector<Ways>(64, {{1, 60}}), 500};
  EXPECT_EQ(chosen(wall, 0.1).outer, 1);
  wall.outer = {std::vector<Ways>(64, {{1, 0}}), 500};
  EXPECT_EQ(chosen(wall, 0.1).outer, 1);
}

// Of a wall of one cell, of which every vertex of the boundary may go these ways and has so much
// free sight.
double balanceOfAWall(const Ways& ways, double gap) {
  RemovalCosts wall = costsOf({}, 0, {}, 500);
  wall.inside.sample.clear();
  wall.outer.sample.assign(64, ways);
  wall.is_whole = true;
  wall.gaps.assign(8, gap);
  return chosen(wall, 0.1).outer;
}
constexpr double kEverywhere = std::numeric_limits<double>::infinity();

TEST(Balance, LowersTheBoundaryOfAWallWhereThereIsRoom) {
  const Ways ways = {{1, 20}, {0.01, 21.5}};
  EXPECT_LT(balanceOfAWall(ways, kEverywhere), 1);
  EXPECT_EQ(balanceOfAWall(ways, 1e6), balanceOfAWall(ways, kEverywhere));
  EXPECT_EQ(balanceOfAWall(ways, 1), 1);
}

// Both would gain by the other way, but plane sides would leave their planes for it.
TEST(Balance, LeavesTheBoundaryOfAWallThatAddsLessThanTheField) {
  EXPECT_EQ(balanceOfAWall({{10, 1}, {0.8, 11}}, kEverywhere), 1);
  EXPECT_LT(balanceOfAWall({{1, 20}, {0.01, 21.5}}, kEverywhere), 1);
}

TEST(Balance, ComesToAnEndWithoutFieldErrors) {
  EXPECT_EQ(chosen(costsOf({0, 0}, 500, {0, 1}, 500), 0.1).outer, 1);
  EXPECT_EQ(chosen(costsOf({0, 0}, 500, {0, 0}, 500), 0.1).outer, 1);
  EXPECT_EQ(chosen({}, 0.1).outer, 1);
}

// Of which every vertex lies off its neighbours' mean by a part of an edge, and its neighbours to
// the same side or to the other, from 1 to -1.
RemovalCosts bentCosts(size_t pairs, double part, double same_side, double field) {
  RemovalCosts costs;
  costs.interfaces = {std::vector<Ways>(pairs, {{field, 1}}), 100};
  const double square = part * part * static_cast<double>(pairs);
  costs.jitter = {pairs, part > 0.01 ? pairs : 0, square, same_side * square};
  costs.least_field = 1e-3;
  return costs;
}

// By few of them, and without knowing anything of the rest.
TEST(Balance, LowersInterfacesThatAreRough) {
  const Balance balance = chosen(bentCosts(kLeastPairs, 0.05, -0.1, 1), 0.1);
  EXPECT_TRUE(balance.knows_interfaces);
  EXPECT_TRUE(balance.rough_interfaces);
  EXPECT_LT(balance.interfaces, 0.01);
  EXPECT_FALSE(balance.knows_outer);
}

// Or by half as many that leave no doubt.
TEST(Balance, LowersInterfacesThatAreSurelyRough) {
  const size_t few = kLeastPairs / 2;
  EXPECT_LT(chosen(bentCosts(few, 0.05, -0.3, 1), 0.1).interfaces, 0.01);
  EXPECT_EQ(chosen(bentCosts(few, 0.05, -0.2, 1), 0.1).interfaces, 1);
  EXPECT_EQ(chosen(bentCosts(few - 1, 0.05, -0.3, 1), 0.1).interfaces, 1);
  RemovalCosts costs = bentCosts(few, 0.05, -0.3, 1);
  costs.jitter.off -= 1;
  EXPECT_EQ(chosen(costs, 0.1).interfaces, 1);
}

TEST(Balance, LeavesInterfacesThatAreSmoothOrPlaneOrFewOrCostFieldsNothing) {
  for (const RemovalCosts& costs :
       {bentCosts(kLeastPairs, 0.05, 0.1, 1), bentCosts(kLeastPairs, 0.001, -0.1, 1),
        bentCosts(kLeastPairs - 1, 0.05, -0.1, 1), bentCosts(kLeastPairs, 0.05, -0.1, 1e-6)}) {
    EXPECT_EQ(chosen(costs, 0.1).interfaces, 1);
    EXPECT_FALSE(chosen(costs, 0.1).knows_interfaces);
  }
}

// Where most pairs lie in a plane, as on thin plates, those at rims are off to either side by
// chance.
TEST(Balance, LeavesPlanesWithRims) {
  RemovalCosts costs = bentCosts(128, 0.05, -0.1, 1);
  costs.jitter.off = 90;
  EXPECT_EQ(chosen(costs, 0.1).interfaces, 1);
  costs.jitter.off = 100;
  EXPECT_LT(chosen(costs, 0.1).interfaces, 0.01);
  costs.jitter.product = -0.02 * costs.jitter.square;
  EXPECT_EQ(chosen(costs, 0.1).interfaces, 1);
}

// Rough interfaces do not keep the boundary from being lowered as far as it would be.
TEST(Balance, LowersARoughBoundaryBesideRoughInterfaces) {
  RemovalCosts costs = costsOf({1e-4, 0}, 500, {1e-4, 1}, 500);
  const double alone = chosen(costs, 0.1).outer;
  costs.interfaces = {std::vector<Ways>(64, {{1e-4, 1e-4}}), 10};
  costs.jitter = bentCosts(64, 0.05, -0.3, 1).jitter;
  EXPECT_LT(chosen(costs, 0.1).interfaces, 0.01);
  EXPECT_NEAR(std::log2(chosen(costs, 0.1).outer), std::log2(alone), 1.01);
}

// Interfaces, which count fifty times as much, take what would be left of the boundary: both fall,
// but interfaces no further than to count as much as that.
TEST(Balance, LowersTheBoundaryAndInterfacesTogether) {
  RemovalCosts costs = costsOf({1e-4, 0}, 500, {1e-4, 1}, 500);
  costs.interfaces = {std::vector<Ways>(64, {{1e-4, kInterfaceShare}}), 500};
  const Balance balance = chosen(costs, 0.1);
  EXPECT_TRUE(balance.knows_interfaces);
  EXPECT_LT(balance.outer, 0.05);
  EXPECT_LT(balance.interfaces, 0.1);
  EXPECT_GE(kInterfaceShare * balance.interfaces, 1);
  costs.interfaces.sample.assign(64, {{1e-4, 1e-12}});  // that are plane
  EXPECT_EQ(chosen(costs, 0.1).interfaces, 1);
}

SimplifyOptions unbalanced(SimplifyOptions options) {
  options.balance = BalanceUse::kNever;
  return options;
}

// Half of the error of the field for as many cells; of a stream less is gained, since some windows
// go by before enough is known.
TEST(SimplifierBalance, FollowsASmoothFieldInARoughBody) {
  const TestMesh mesh = roughSlab(slowRun() ? 12 : 24, 0.2);
  const double gain = slowRun() ? 0.85 : 0.6;
  for (int64_t window : {0, 1500}) {
    if (slowRun() && window > 0) continue;  // too few vertices in any window
    const Result with = simplified(mesh, toRatio(0.2, window));
    const Result without = simplified(mesh, unbalanced(toRatio(0.2, window)));
    expectSound(mesh, with);
    expectReached(with);
    EXPECT_NE(with.report.balance.find("the boundary counts 1/"), std::string::npos);
    EXPECT_EQ(without.report.balance, "");
    EXPECT_LT(fieldErrors(mesh, with.out.mesh)[0],
              (window > 0 ? 0.9 : gain) * fieldErrors(mesh, without.out.mesh)[0]);
    EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(with.out.mesh)), "");
  }
}

// How far the farthest vertex is from all that were there.
double farthestOut(const TestMesh& mesh, const TestMesh& from) {
  double farthest = 0;
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    double nearest = 1e9;
    for (size_t w = 0; w < from.vertexCount(); ++w) {
      double square = 0;
      for (int i = 0; i < 3; ++i) square += std::pow(mesh.position(v, i) - from.position(w, i), 2);
      nearest = std::min(nearest, square);
    }
    farthest = std::max(farthest, nearest);
  }
  return std::sqrt(farthest);
}

// What touches along edges stays, so that the target is out of reach; what the boundary is allowed
// to be off by until that is plain does not grow with what it counts less.
TEST(SimplifierBalance, KeepsTheShapeOfBlocksThatStayAsTheyAre) {
  const int side = slowRun() ? 4 : 5, n = 4 * side;
  TestMesh mesh = cubes(
      n, n, n, [side](int x, int y, int z) { return (x / side + y / side + z / side) % 2 == 0; });
  addPositionField(mesh, {"f", 1, k32}, [n](double x, double y, double z) {
    return std::sin(6 * x / n) * y / n + z * z / n / n;
  });
  const Result result = simplified(mesh, toRatio(0.02));
  EXPECT_NE(result.report.balance, "");
  EXPECT_NE(result.report.limited_by, "");
  EXPECT_LT(farthestOut(result.out.mesh, mesh), slowRun() ? 2 : 1.5);
}

void expectBytesOfUnbalanced(const TestMesh& mesh, const SimplifyOptions& options,
                             const char* told = "") {
  const Result with = simplified(mesh, options);
  const Result without = simplified(mesh, unbalanced(options));
  EXPECT_EQ(with.report.balance, told);
  EXPECT_EQ(with.out.mesh.cells, without.out.mesh.cells);
  EXPECT_EQ(with.out.mesh.positions.bytes, without.out.mesh.positions.bytes);
}

TEST(SimplifierBalance, IsNotForPlaneBoundaries) {
  expectBytesOfUnbalanced(roughSlab(12, 0), toRatio(0.2));
}

// One slab on another, which it touches all over, and a field that jumps between them.
TEST(SimplifierBalance, IsNotForBodiesInContact) {
  const int n = 12;
  const TestMesh low = roughSlab(n, 0.2);
  const size_t points = low.vertexCount();
  std::vector<double> positions;
  std::vector<int64_t> cells = low.cells;
  for (size_t v = 0; v < 2 * points; ++v)
    for (int i = 0; i < 3; ++i)
      positions.push_back(low.position(v % points, i) + (v >= points && i == 2 ? 4 : 0));
  for (int64_t v : low.cells) cells.push_back(v + static_cast<int64_t>(points));
  TestMesh mesh = makeMesh(k64, positions, cells);
  mesh.addField({"f", 1, k64},
                [&](size_t v, int) { return low.field(0, v % points) + (v >= points ? 1 : 0); });
  expectBytesOfUnbalanced(mesh, toRatio(0.2));
}

TEST(SimplifierBalance, LeavesAWeightThatIsAskedFor) {
  SimplifyOptions options = toRatio(0.2);
  options.boundary_weight = 100;
  expectBytesOfUnbalanced(roughSlab(12, 0.2), options);
}

TEST(SimplifierBalance, IsNotForThePaper) {
  expectBytesOfUnbalanced(roughSlab(6, 0.2), toRatio(0.2, 0, Mode::kPaper));
}

// Nothing is gained for them, and rounding would choose.
TEST(SimplifierBalance, IsNotForFieldsWithoutError) {
  TestMesh mesh = roughSlab(12, 0.2);
  mesh.fields.clear();
  mesh.schema.fields.clear();
  addPositionField(mesh, {"constant", 1, k64}, [](double, double, double) { return 3.0; });
  expectBytesOfUnbalanced(mesh, toRatio(0.2), "constant: constant");
  addPositionField(mesh, {"linear", 1, k64},
                   [](double x, double y, double z) { return 0.3 * x - 0.7 * y + z; });
  expectBytesOfUnbalanced(mesh, toRatio(0.2), "constant: constant");
}

TEST(SimplifierBalance, KnowsNothingOfVerticesWithoutCells) {
  TestMesh none = makeMesh(k64, {0, 0, 0}, {});
  addPositionField(none, {"f", 1, k64}, [](double, double, double) { return 1.0; });
  EXPECT_EQ(simplified(none, toRatio(0.5)).report.balance, "");
  const TestMesh mesh = roughSlab(12, 0.2);
  std::vector<double> positions;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(mesh.position(v, i));
  positions.insert(positions.end(), 9000, 5);
  TestMesh more = makeMesh(k64, positions, mesh.cells);
  addPositionField(more, {"f", 1, k64},
                   [](double x, double y, double z) { return std::sin(x / 4 + y / 6) + z / 40; });
  TestMesh same = mesh;
  same.fields.clear();
  same.schema.fields.clear();
  addPositionField(same, {"f", 1, k64},
                   [](double x, double y, double z) { return std::sin(x / 4 + y / 6) + z / 40; });
  const Result with = simplified(inStreamOrder(more, true), toRatio(0.2));
  const Result without = simplified(inStreamOrder(same), toRatio(0.2));
  EXPECT_EQ(with.report.unused_vertices, 3000);
  EXPECT_NE(with.report.balance, "");
  EXPECT_EQ(with.report.balance, without.report.balance);
}

// What was chosen depends on what was read, not on how it came.
TEST(SimplifierBalance, IsTheSameForAnyBatches) {
  const TestMesh mesh = roughSlab(12, 0.2);
  const Result whole = simplified(mesh, toRatio(0.2, 800));
  Cut cut;
  cut.batch_cells = 7;
  const Result cut_up = simplified(mesh, toRatio(0.2, 800), cut);
  EXPECT_EQ(whole.report.balance, cut_up.report.balance);
  EXPECT_EQ(whole.out.mesh.cells, cut_up.out.mesh.cells);
  EXPECT_EQ(whole.out.mesh.positions.bytes, cut_up.out.mesh.positions.bytes);
}

// Cells have the label of the side of a slanted plane that their centres lie on, or of a plane
// between layers of cells, in a grid that is shaken by a part of an edge, and then bent.
TestMesh labelledAfterwards(int n, double slant, double jitter, double bend = 0) {
  const TestMesh grid = fullGrid(n, n, n, jitter);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double x = grid.position(v, 0), y = grid.position(v, 1), z = grid.position(v, 2);
    positions.insert(positions.end(), {x, y, z + bend * std::sin(6 * x / n) * std::cos(5 * y / n)});
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [n](double x, double y, double z) {
    return std::sin(3 * x / n) + std::cos(2 * y / n) + 0.2 * std::sin(4 * z / n);
  });
  mesh.addIntegerCellData("material", [&](size_t c) {
    double height = 0;
    for (size_t j = 0; j < 4; ++j) {
      const auto v = static_cast<size_t>(grid.cells[4 * c + j]);
      height += (grid.position(v, 2) + slant * grid.position(v, 0)) / 4;
    }
    return height < 0.5 * (1 + slant) * n ? 3 : 8;
  });
  return mesh;
}

void expectSmoothed(const TestMesh& mesh, double error) {
  const Result with = simplified(mesh, toRatio(0.1));
  const Result without = simplified(mesh, unbalanced(toRatio(0.1)));
  expectSound(mesh, with);
  expectReached(with);
  EXPECT_NE(with.report.balance.find("being rough"), std::string::npos) << with.report.balance;
  EXPECT_LT(fieldErrors(mesh, with.out.mesh)[0], error * fieldErrors(mesh, without.out.mesh)[0]);
  for (int64_t label : {3, 8}) {
    const double volume = regionVolume(mesh, label);
    EXPECT_NEAR(regionVolume(with.out.mesh, label), volume, 0.01 * volume);
  }
}

TEST(SimplifierBalance, SmoothsInterfacesOfLabelsGivenToCells) {
  expectSmoothed(labelledAfterwards(slowRun() ? 10 : 20, 0.7, 0.1), 0.8);
}

TEST(SimplifierBalance, SmoothsPlaneInterfacesWhoseVerticesWereShaken) {
  expectSmoothed(labelledAfterwards(slowRun() ? 10 : 20, 0, 0.15), 0.9);
}

// Of 6144 cells, whose labels are those of four discs in a block: as long as the steps were taken
// for shape 3071 of them were left, or, at any error, the block was given up.
TEST(SimplifierBalance, SmoothsFewInterfaces) {
  TestMesh mesh = fullGrid(8, 8, 16, 0.15);
  addPositionField(mesh, {"f", 1, k64}, [](double x, double y, double z) {
    return std::sin(0.4 * x + 0.2 * y + 0.1 * z);
  });
  mesh.addIntegerCellData("material", [&](size_t c) {
    double x[3] = {0, 0, 0};
    for (size_t j = 0; j < 4; ++j)
      for (size_t i = 0; i < 3; ++i)
        x[i] += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), i) / 4;
    return std::hypot(x[0] - 4, x[1] - 4) < 2.8 ? 1 + static_cast<int64_t>(x[2] / 4) % 2 : 3;
  });
  const Result result = simplified(mesh, toRatio(0.1));
  expectSound(mesh, result);
  expectReached(result);
  EXPECT_NE(result.report.balance.find("being rough"), std::string::npos);
  EXPECT_EQ(result.report.regions, "by material");  // and no word of volumes
  EXPECT_LT(result.report.estimated_error, 20);
}

TEST(SimplifierBalance, LeavesInterfacesThatArePlaneOrBend) {
  for (double bend : {0.0, 1.5}) {
    const Result with =
        simplified(labelledAfterwards(slowRun() ? 10 : 20, 0, 0, bend), toRatio(0.1));
    EXPECT_EQ(with.report.balance.find("rough"), std::string::npos) << with.report.balance;
  }
}

}  // namespace
}  // namespace tetstream::test
