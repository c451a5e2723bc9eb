// What is done where the memory budget refuses a patch.
#include "lane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "window_testing.h"

namespace tetstream::test {
namespace {

enum class Refused { kBeforeCollapses, kAfterCollapses };

// A lane with a budget of its own, which work on more than half of the vertices passes.
struct Narrow {
  explicit Narrow(const TestMesh& mesh) : w(mesh), before(w.live()), lane(w.core, budget) {
    lane.begin({0, 0, false}, 1);
  }

  Status work(Refused refused) {
    std::vector<uint32_t> cells(w.core.window.mesh.cellEnd());
    std::iota(cells.begin(), cells.end(), 0u);
    const auto onOne = [&] {
      const bool is_large = lane.sweep().patch().ownedEnd() > w.owned.size() / 2 + 1;
      if (is_large && refused == Refused::kBeforeCollapses) budget.charge(budget.limit());
      const int64_t so_far = lane.sweep().tally().collapses;
      if (!is_large && worked == 0) was_forgotten = isAsBefore();
      lane.sweep().sweep(1e30f);
      EXPECT_GT(lane.sweep().tally().collapses, so_far);
      if (is_large) budget.charge(budget.limit());
      collapses += lane.sweep().tally().collapses - so_far;
      lane.sweep().store();
      ++worked;
    };
    return thrownBy([&] {
             lane.onPatch(w.owned.data(), w.owned.size(), cells.data(), cells.size(), false, onOne);
           })
        .first;
  }

  bool isAsBefore() {
    const TestMesh now = w.live();
    return now.cells == before.cells && now.positions.bytes == before.positions.bytes;
  }

  WholePatch<double> w;
  const TestMesh before;
  Account budget{64 << 20};
  Lane<double> lane;
  int worked = 0;
  int64_t collapses = 0;
  bool was_forgotten = false;
};

TestMesh body() {
  TestMesh mesh = fullGrid(6, 6, 6);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x) * y + z; });
  return mesh;
}

void expectHalves(const TestMesh& mesh, Refused refused) {
  Narrow narrow(mesh);
  EXPECT_EQ(narrow.work(refused), Status::kOk);
  EXPECT_EQ(narrow.worked, 2);
  EXPECT_TRUE(narrow.was_forgotten);
  EXPECT_EQ(narrow.lane.takeRefusals(), 1);
  EXPECT_EQ(narrow.lane.sweep().takeTally().collapses, narrow.collapses);
}

TEST(Lane, WorksOnHalvesOfAPatchThatIsRefused) {
  expectHalves(body(), Refused::kBeforeCollapses);
  expectHalves(body(), Refused::kAfterCollapses);
}

// Integers and cell data are changed where they lie, curves with each collapse.
TEST(Lane, CannotForgetWhatIsKnownBesideThePatch) {
  TestMesh numbered = body(), filled = body(), labelled = body(), halved = body();
  numbered.addIntegerField("number", [](size_t v) { return static_cast<int64_t>(v); });
  filled.addCellData({"d", 1, ScalarType::kFloat64}, [](size_t c, int) { return 1.0 + c % 3; });
  labelled.addIntegerCellData("id", [](size_t) { return int64_t{1}; });
  halved.addIntegerCellData("region", [&](size_t c) {
    return halved.position(static_cast<size_t>(halved.cells[4 * c]), 0) < 3 ? 1 : 2;
  });
  for (const TestMesh& mesh : {numbered, filled, labelled, halved}) {
    Narrow narrow(mesh);
    EXPECT_EQ(narrow.work(Refused::kAfterCollapses), Status::kNoMemory);
    EXPECT_EQ(narrow.worked, 0);
    expectHalves(mesh, Refused::kBeforeCollapses);
  }
}

}  // namespace
}  // namespace tetstream::test
