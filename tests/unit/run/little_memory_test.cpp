// Which memory a run gives to ordering: what is copied or looked at takes little of it by itself,
// a simplification the default of ordering, and each what it was told to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "run.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

// Cells so wide that some thousands of them are more than 128 MiB and less than 512.
class WideCells final : public IndexedSource {
 public:
  WideCells() : mesh_(fullGrid(10, 10, 11)), schema_(mesh_.schema) {
    schema_.vertex_count = static_cast<int64_t>(mesh_.vertexCount());
    schema_.cell_count = kCells;
    for (size_t i = 0; i < kColumns; ++i)
      schema_.cell_data.push_back({"d" + std::to_string(i), 9, ScalarType::kFloat64});
  }
  static uint64_t bytes() { return kCells * kColumns * 72; }

  const Schema& schema() const override { return schema_; }
  void readPositions(uint64_t first, size_t count, void* out) override {
    const size_t row = 3 * sizeOf(schema_.position_type);
    std::memcpy(out, mesh_.positions.bytes.data() + first * row, count * row);
  }
  void readField(size_t, uint64_t, size_t, void*) override {}
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    std::copy_n(mesh_.cells.begin() + static_cast<long>(4 * first), 4 * count, out);
  }
  void readCellData(size_t column, uint64_t, size_t count, void* out) override {
    std::fill_n(static_cast<double*>(out), 9 * count, static_cast<double>(column));
  }

 private:
  static constexpr size_t kCells = 6 * 10 * 10 * 11, kColumns = 300;
  TestMesh mesh_;
  Schema schema_;
};

Input wideCells() {
  Input input;
  input.indexed = std::make_unique<WideCells>();
  return input;
}

// Takes everything, keeps nothing.
struct Nowhere final : Sink {
  void begin(const Schema&) override {}
  void put(const BatchView&) override {}
  void finish() override {}
};

// What does not fit is on disk twice at once: as sorted runs and as rows.
bool isSpilled(uint64_t disk) {
  return disk > WideCells::bytes() / 4 * 7;
}

RunOptions inMemory(int64_t bytes) {
  RunOptions options;
  options.simplify.memory_bytes = bytes;
  options.simplify.ratio = 0.5;
  return options;
}

struct Enough {};

// Whether a run means to spill, which it tells before it begins to.
template <class Run>
bool plansToSpill(Run run) {
  Input input = wideCells();
  Nowhere out;
  uint64_t disk = 0;
  const ProgressFunction progress = [&](const Progress& p) {
    disk = static_cast<uint64_t>(p.temporary_bytes);
    throw Enough();
  };
  try {
    run(input, out, progress);
    ADD_FAILURE() << "there is no progress";
  } catch (const Enough&) {
  }
  return isSpilled(disk);
}

bool convertSpills(int64_t memory) {
  return plansToSpill([&](Input& input, Sink& out, const ProgressFunction& progress) {
    convert(input, out, inMemory(memory), progress);
  });
}

bool inspectSpills(int64_t memory) {
  return plansToSpill([&](Input& input, Sink&, const ProgressFunction& progress) {
    inspect(input, inMemory(memory), progress);
  });
}

bool simplifySpills(int64_t memory) {
  return plansToSpill([&](Input& input, Sink& out, const ProgressFunction& progress) {
    SimplifyRun(inMemory(memory), out, progress).run(input);
  });
}

TEST(LittleMemory, IsForWhatIsCopiedOrLookedAtUnlessItIsToldOtherwise) {
  EXPECT_TRUE(convertSpills(0));
  EXPECT_TRUE(inspectSpills(0));
  EXPECT_FALSE(simplifySpills(0));
  for (const int64_t memory : {64, 512}) {
    const int64_t bytes = memory << 20;
    EXPECT_EQ(convertSpills(bytes), memory < 128);
    EXPECT_EQ(inspectSpills(bytes), memory < 128);
    EXPECT_EQ(simplifySpills(bytes), memory < 128);
  }
}

TEST(LittleMemory, SpillsWhatDoesNotFit) {
  Input input = wideCells();
  Nowhere out;
  const LayoutReport report = convert(input, out, {}, {});
  EXPECT_EQ(report.cells, input.schema().cell_count);
  EXPECT_TRUE(isSpilled(report.temporary_bytes));
}

}  // namespace
}  // namespace tetstream::test
