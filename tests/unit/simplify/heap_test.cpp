// What a run allocates beside its account: the budget would mean little if lists of the window's
// size lay outside it.
#include "heap_meter.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

class Nothing final : public Sink {
 public:
  void begin(const Schema&) override {}
  void put(const BatchView&) override {}
  void finish() override {}
};

// Batches of a few thousand cells and what is as small may lie outside; nothing that grows with
// the window may.
TEST(SimplifierMemory, IsAllInTheAccount) {
  const int n = slowRun() ? 8 : 24;
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y * z; });
  mesh.addIntegerCellData("id", [](size_t c) { return static_cast<int64_t>(c); });
  for (Mode mode : kModes) {
    Nothing out;
    Cut cut;
    cut.batch_cells = 1000;
    MeshStream stream(mesh, cut);
    const auto window = static_cast<int64_t>(mesh.cellCount());
    Simplifier simplifier(toRatio(0.1, window, mode), out, {});
    simplifier.begin(stream.schema());
    BatchView batch;
    const size_t before = held_bytes;
    peak_bytes = held_bytes;
    while (stream.next(batch)) simplifier.put(batch);
    simplifier.finish();
    EXPECT_LT(peak_bytes - before, size_t{1} << 20)
        << "beside an account of " << simplifier.report().peak_window_bytes;
  }
}

}  // namespace
}  // namespace tetstream::test
