// The meter against brute force: at each cell, count what is active.
#include "front_meter.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <set>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

// By definition: vertices count from the first cell that introduces them or a later rank, to their
// finalization; a cell counts once read while one of its vertices is not final.
FrontStatistics bruteForce(const TestMesh& mesh) {
  const auto cells = static_cast<int64_t>(mesh.cellCount());
  std::vector<int64_t> first(mesh.vertexCount(), cells), last(mesh.vertexCount(), -1);
  int64_t introduced = -1;
  for (int64_t c = 0; c < cells; ++c)
    for (size_t j = 0; j < 4; ++j) {
      const int64_t v = mesh.cells[4 * static_cast<size_t>(c) + j];
      for (; introduced < v; ++introduced) first[static_cast<size_t>(introduced + 1)] = c;
      last[static_cast<size_t>(v)] = c;
    }
  FrontStatistics s;
  for (int64_t at = 0; at < cells; ++at) {
    int64_t active = 0, low = -1, high = -1, open = 0;
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      if (first[v] > at || last[v] < at) continue;
      ++active;
      if (low < 0) low = static_cast<int64_t>(v);
      high = static_cast<int64_t>(v);
    }
    for (int64_t c = 0; c <= at; ++c) {
      int64_t end = -1;
      for (size_t j = 0; j < 4; ++j)
        end = std::max(end, last[static_cast<size_t>(mesh.cells[4 * static_cast<size_t>(c) + j])]);
      open += end > at;
    }
    s.width = std::max(s.width, active);
    s.span = std::max(s.span, high - low + 1);
    s.cells = std::max(s.cells, open);
  }
  return s;
}

FrontStatistics measured(const TestMesh& mesh, const Cut& cut) {
  Account account;
  FrontMeter meter(account);
  MeshStream stream(mesh, cut);
  BatchView batch;
  while (stream.next(batch)) meter.put(batch);
  EXPECT_EQ(meter.cellsSeen(), mesh.cellCount());
  return meter.statistics();
}

void expectBruteForce(const TestMesh& mesh) {
  const FrontStatistics wanted = bruteForce(mesh);
  for (size_t batch : {size_t{1}, size_t{5}, size_t{10000}})
    for (int form = 0; form < 4; ++form) {
      Cut cut;
      cut.batch_cells = batch;
      cut.all_vertices_first = form & 1;
      cut.explicit_final = form & 2;
      const FrontStatistics got = measured(mesh, cut);
      EXPECT_EQ(got.width, wanted.width);
      EXPECT_EQ(got.span, wanted.span);
      // An explicit finalization comes after the cell that a last use belongs to.
      if (!cut.explicit_final) {
        EXPECT_EQ(got.cells, wanted.cells);
      }
    }
}

TEST(FrontMeter, IsBruteForceOnGrids) {
  expectBruteForce(fullGrid(2, 2, 2));
  expectBruteForce(fullGrid(2, 2, 5));
  expectBruteForce(ringGrid(4));
  expectBruteForce(oneCell());
}
TEST(FrontMeter, IsBruteForceOnShuffledMeshes) {
  for (uint64_t seed = 1; seed < 5; ++seed)
    expectBruteForce(inStreamOrder(shuffled(fullGrid(2, 2, 3), seed)));
}
// Ranks that are introduced in another order than that of their first use.
TEST(FrontMeter, IsBruteForceWhenVerticesComeInAnotherOrder) {
  for (uint64_t seed = 1; seed < 5; ++seed) expectBruteForce(shuffled(fullGrid(2, 2, 3), seed));
}

TEST(FrontMeter, OfNothingIsZero) {
  const FrontStatistics s = measured(makeMesh(ScalarType::kFloat32, {}, {}), {});
  EXPECT_EQ(s.width + s.span + s.cells, 0);
}

// ---------------------------------------------------------------------------- bad streams

std::string refusalOf(const std::vector<int64_t>& cells, const std::vector<uint8_t>& last_uses,
                      const std::vector<int64_t>& finalized) {
  Account account;
  FrontMeter meter(account);
  BatchView batch;
  batch.vertex_count = 6;
  batch.cell_count = cells.size() / 4;
  batch.cells = cells.data();
  batch.last_uses = last_uses.empty() ? nullptr : last_uses.data();
  batch.finalized_count = finalized.size();
  batch.finalized = finalized.data();
  try {
    meter.put(batch);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadData);
    return error.text();
  }
  return "";
}

TEST(FrontMeter, RefusesBadReferencesWithASentence) {
  EXPECT_EQ(refusalOf({0, 1, 2, 3, 1, 2, 3, 4}, {1, 0}, {1, 5}), "");
  EXPECT_EQ(refusalOf({0, 1, 2, 6}, {}, {}), "cell 0: vertex 6 is not declared before it");
  EXPECT_EQ(refusalOf({0, 1, 2, -1}, {}, {}), "cell 0: vertex -1 is not declared before it");
  EXPECT_EQ(refusalOf({0, 1, 2, 3, 0, 1, 2, 4}, {8 + 2, 0}, {}),
            "cell 1: vertex 1 was finalized before it");
  EXPECT_EQ(refusalOf({0, 1, 2, 3, 1, 2, 1, 4}, {}, {}), "cell 1: vertex 1 is there twice");
  EXPECT_EQ(refusalOf({0, 1, 2, 3}, {1}, {0}), "vertex 0 is finalized twice");
  EXPECT_EQ(refusalOf({0, 1, 2, 3}, {}, {6}), "finalized vertex 6 is not declared");
  EXPECT_EQ(refusalOf({0, 1, 2, 3}, {}, {-9}), "finalized vertex -9 is not declared");
}

TEST(FrontMeter, TakesMemoryForTheFrontOnly) {
  const TestMesh mesh = fullGrid(3, 3, slowRun() ? 20 : 400);
  Account account;
  FrontMeter meter(account);
  MeshStream stream(mesh, {});
  BatchView batch;
  ASSERT_TRUE(stream.next(batch));
  meter.put(batch);
  const size_t early = account.used();
  while (stream.next(batch)) meter.put(batch);
  EXPECT_EQ(account.used(), early);
}

}  // namespace
}  // namespace tetstream::test
