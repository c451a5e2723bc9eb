// What a sampler takes of a memory budget beside the window of its sample, which gets the rest.
#include <gtest/gtest.h>
#include <cmath>

#include "heap_meter.h"
#include "sampler.h"
#include "shapes.h"
#include "slow_run.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

void feed(const TestMesh& mesh, Sampler& sampler, void (Sampler::*take)(const BatchView&, size_t)) {
  MeshStream stream(mesh, {});
  BatchView batch;
  while (stream.next(batch)) (sampler.*take)(batch, 0);
}

// `span` of the front: the larger, the more rows are noted.
void expectWithinBudget(const TestMesh& mesh, Schema schema, int64_t span, int64_t budget) {
  SCOPED_TRACE(::testing::Message() << "a span of " << span << " in " << budget << " bytes");
  schema.front_span = span;
  SimplifyOptions options;
  options.memory_bytes = budget;
  ASSERT_TRUE(Sampler::serves(schema, options));
  const size_t before = peak_bytes = held_bytes;
  Sampler sampler(schema, options);
  feed(mesh, sampler, &Sampler::count);
  sampler.takeBricks();
  feed(mesh, sampler, &Sampler::put);
  EXPECT_LE(peak_bytes - before, static_cast<size_t>(budget));
  EXPECT_GT(sampler.mesh().cell_count, 4000u);
  const auto held = static_cast<int64_t>(held_bytes - before);
  EXPECT_GT(sampler.windowBytes(), budget / 3);
  EXPECT_LE(held + sampler.windowBytes(), budget);
  EXPECT_TRUE(sampler.simplify().known());
}

TEST(SamplerMemory, IsOfItsBudget) {
  TestMesh mesh = fullGrid(slowRun() ? 30 : 60, 16, 16, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x) * y * z; });
  Schema schema = mesh.schema;
  schema.vertex_count = static_cast<int64_t>(mesh.vertexCount());
  schema.cell_count = static_cast<int64_t>(mesh.cellCount());
  schema.box_min = {0, 0, 0, -256};
  schema.box_max = {slowRun() ? 30.0 : 60.0, 16, 16, 256};
  for (int64_t budget : {5000000, 8400000})
    for (int64_t part : {1000, 20}) {
      if (slowRun() && (budget > 5000000) == (part == 1000)) continue;
      expectWithinBudget(mesh, schema, budget / part, budget);
    }
}

}  // namespace
}  // namespace tetstream::test
