// What a run allocates beside its account: the budget would mean little if lists of the window's
// size lay outside it.
#include <cstdlib>
#include <new>

#include "simplify_testing.h"

// Every allocation carries its size in front of it.
static size_t held_bytes = 0, peak_bytes = 0;
constexpr size_t kFront = alignof(std::max_align_t);

__attribute__((noinline)) void* operator new(size_t size) {
  auto* block = static_cast<char*>(std::malloc(size + kFront));
  if (!block) throw std::bad_alloc();
  *reinterpret_cast<size_t*>(block) = size;
  held_bytes += size;
  if (held_bytes > peak_bytes) peak_bytes = held_bytes;
  return block + kFront;
}
// Sanitizers' own would not call the one above.
__attribute__((noinline)) void* operator new(size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
__attribute__((noinline)) void operator delete(void* p) noexcept {
  if (!p) return;
  char* block = static_cast<char*>(p) - kFront;
  held_bytes -= *reinterpret_cast<size_t*>(block);
  std::free(block);
}
__attribute__((noinline)) void operator delete(void* p, size_t) noexcept {
  operator delete(p);
}

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
