// The budget that a sentence says should do: once, and none where nobody has as much.
#include <string>

#include "simplify_testing.h"
#include "thrown_by.h"
#include "window_size.h"

namespace tetstream::test {
namespace {

std::string toldBy(const Schema& schema, const SimplifyOptions& options, double waiting) {
  const auto [status, text] =
      thrownBy([&] { WindowSize(schema, options, 100, 100).fail("why", 0, waiting); });
  EXPECT_EQ(status, Status::kNoMemory);
  return text;
}

TEST(BudgetTold, IsNoneThatNobodyHas) {
  Schema schema;
  SimplifyOptions options = toRatio(0.5);
  options.memory_bytes = 100000;
  EXPECT_NE(toldBy(schema, options, 0).find("should do"), std::string::npos);
  EXPECT_EQ(toldBy(schema, options, 1e16), "why");
  EXPECT_EQ(toldBy(schema, options, 1e30), "why");
  for (const int64_t window : {int64_t{1} << 31, int64_t{1} << 60, int64_t{0x7fffffffffffffff}}) {
    options.window_cells = window;
    EXPECT_EQ(toldBy(schema, options, 0), "why");
  }
}

// Of a front that does not fit, after less was put up with.
TEST(BudgetTold, IsToldOnce) {
  TestMesh mesh = fullGrid(12, 12, 12, 0.05);
  addPositionField(mesh, {"f", 1, k64}, [](double x, double y, double z) { return x * y + z; });
  mesh.addField({"v", 3, k64}, [](size_t v, int i) { return static_cast<double>(v * 7 % 5) + i; });
  mesh.addIntegerCellData("side", [](size_t c) { return static_cast<int64_t>(c / 5000); });
  Cut cut;
  cut.say_counts = false;
  cut.all_vertices_first = true;
  cut.batch_cells = mesh.cellCount();
  int refused = 0;
  for (int64_t limit = 100000; limit < 2000000; limit += limit / 40) {
    SimplifyOptions options = toRatio(0.2);
    options.memory_bytes = limit;
    Recorder out;
    Simplifier simplifier(options, out, {});
    MeshStream stream(mesh, cut);
    const auto [status, text] = thrownBy([&] {
      simplifier.begin(stream.schema());
      BatchView batch;
      while (stream.next(batch)) {
        batch.last_uses = nullptr;  // all is front
        simplifier.put(batch);
      }
      simplifier.finish();
    });
    if (status != Status::kNoMemory) continue;
    ++refused;
    EXPECT_EQ(text.find(" should do"), text.rfind(" should do")) << text;
  }
  EXPECT_GT(refused, 3);
}

}  // namespace
}  // namespace tetstream::test
