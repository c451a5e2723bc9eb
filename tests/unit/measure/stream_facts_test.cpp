// Counts, box and front of a passing stream, against the arrays it was made of.
#include "stream_facts.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

Schema factsAbout(const TestMesh& mesh, const Cut& cut) {
  MeshStream stream(mesh, cut);
  StreamFacts facts(stream.schema());
  BatchView batch;
  while (stream.next(batch)) facts.put(batch);
  facts.finish();
  EXPECT_EQ(facts.figures().front.width, facts.schema().front_width);
  EXPECT_LE(facts.figures().mean_width, static_cast<double>(facts.schema().front_width));
  return facts.schema();
}

TEST(StreamFacts, AreThoseOfTheArrays) {
  TestMesh mesh = shuffled(fullGrid(3, 2, 4, 0.1, ScalarType::kFloat32), 9);
  addPositionField(mesh, {"f", 2, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y - 5 * z; });
  mesh.addIntegerField("n", [](size_t v) { return int64_t(v) * int64_t(v) - 7; });
  mesh = inStreamOrder(mesh);
  for (size_t batch : {size_t{1}, size_t{13}, size_t{5000}}) {
    Cut cut;
    cut.batch_cells = batch;
    cut.say_counts = batch != 13;
    cut.empty_batches = true;
    const Schema s = factsAbout(mesh, cut);
    EXPECT_EQ(s.vertex_count, static_cast<int64_t>(mesh.vertexCount()));
    EXPECT_EQ(s.cell_count, static_cast<int64_t>(mesh.cellCount()));
    ASSERT_TRUE(s.hasBox());
    ASSERT_EQ(s.box_min.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
      const auto value = [&](size_t v) {
        return i < 3   ? mesh.position(v, static_cast<int>(i))
               : i < 5 ? mesh.field(0, v, static_cast<int>(i) - 3)
                       : mesh.field(1, v);
      };
      double low = value(0), high = value(0);
      for (size_t v = 0; v < mesh.vertexCount(); ++v) {
        low = std::min(low, value(v));
        high = std::max(high, value(v));
      }
      EXPECT_EQ(s.box_min[i], low);
      EXPECT_EQ(s.box_max[i], high);
    }
    EXPECT_EQ(s.fields.size(), 2u);
    EXPECT_GT(s.front_width, 3);
    EXPECT_GE(s.front_span, s.front_width);
  }
}

// One cell: four vertices at once, none left after it.
TEST(StreamFacts, OfOneCell) {
  const Schema s = factsAbout(oneCell(), {});
  EXPECT_EQ(s.front_width, 4);
  EXPECT_EQ(s.front_span, 4);
  EXPECT_EQ(s.front_cells, 0);  // all its vertices are final with it
  EXPECT_EQ(s.box_max, (std::vector<double>{1, 1, 1}));
}

TEST(StreamFacts, OfNothing) {
  const Schema s = factsAbout(makeMesh(ScalarType::kFloat64, {}, {}), {});
  EXPECT_EQ(s.vertex_count, 0);
  EXPECT_EQ(s.cell_count, 0);
  EXPECT_FALSE(s.hasBox());
}

TEST(StreamFacts, RefuseABadStream) {
  TestMesh mesh = oneCell();
  StreamFacts facts(mesh.schema);
  mesh.cells[1] = 9;
  EXPECT_THROW(facts.put(mesh.view()), Error);
}

}  // namespace
}  // namespace tetstream::test
