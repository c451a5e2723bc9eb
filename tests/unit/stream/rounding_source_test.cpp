#include "rounding_source.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>

#include "memory_source.h"
#include "meshes.h"
#include "status.h"

namespace tetstream {
namespace {

// A grid whose numbers are not floats.
test::SmallMesh thirds() {
  test::SmallMesh mesh = test::gridMesh(2, 2, 2);
  for (double& x : mesh.positions) x /= 3;
  for (double& f : mesh.field) f /= 7;
  return mesh;
}

TEST(RoundingSource, IsNeededOnlyForFloat64) {
  Schema schema;
  EXPECT_FALSE(Rounding::needed(schema));
  schema.fields = {{"labels", 1, ScalarType::kInt64}};
  schema.cell_data = {{"exact", 1, ScalarType::kFloat64}};
  EXPECT_FALSE(Rounding::needed(schema));
  schema.fields.push_back({"exact", 1, ScalarType::kFloat64});
  EXPECT_TRUE(Rounding::needed(schema));
  schema.fields.pop_back();
  schema.position_type = ScalarType::kFloat64;
  EXPECT_TRUE(Rounding::needed(schema));
}

TEST(RoundingSource, RoundsToNearestAndLeavesIntegersAndCellDataAlone) {
  Schema schema;
  schema.position_type = ScalarType::kFloat64;
  schema.fields = {{"label", 1, ScalarType::kInt64}, {"f", 2, ScalarType::kFloat64}};
  schema.cell_data = {{"c", 1, ScalarType::kFloat64}};
  schema.box_min = {0.1, 0, 0, 5, -0.1, 0};
  schema.box_max = {1.1, 1, 1, 6, 0.1, 1};
  const double positions[3] = {0.1, 1e-50, -2.0 / 3}, f[2] = {1.0 / 3, 4}, c = 0.7;
  const int64_t label = INT64_MAX;
  const void* const fields[2] = {&label, f};
  const void* const cell_data[1] = {&c};
  BatchView batch;
  batch.vertex_count = 1;
  batch.positions = positions;
  batch.fields = fields;
  batch.cell_data = cell_data;

  Rounding rounding(schema);
  const Schema& rounded = rounding.schema();
  EXPECT_EQ(rounded.position_type, ScalarType::kFloat32);
  EXPECT_EQ(rounded.fields[0].type, ScalarType::kInt64);
  EXPECT_EQ(rounded.fields[1].type, ScalarType::kFloat32);
  EXPECT_EQ(rounded.cell_data[0].type, ScalarType::kFloat64);
  EXPECT_EQ(rounded.box_min[0], static_cast<double>(0.1f));
  EXPECT_EQ(rounded.box_max[3], 6);

  const BatchView out = rounding.round(batch);
  const float* x = static_cast<const float*>(out.positions);
  EXPECT_EQ(x[0], 0.1f);
  EXPECT_EQ(x[1], 0.0f);
  EXPECT_EQ(x[2], -2.0f / 3);
  EXPECT_EQ(static_cast<const float*>(out.fields[1])[0], 1.0f / 3);
  EXPECT_EQ(out.fields[0], &label);
  EXPECT_EQ(out.cell_data[0], &c);
}

TEST(RoundingSource, KeepsWhatIsNotFiniteAndRefusesWhatWouldBecomeSo) {
  Schema schema;
  schema.fields = {{"f", 2, ScalarType::kFloat64}};
  Rounding rounding(schema);
  const float position[9] = {};
  double f[6] = {0, HUGE_VAL, NAN, -HUGE_VAL, FLT_MAX, -1};
  const void* fields[1] = {f};
  BatchView batch;
  batch.first_vertex = 40;
  batch.vertex_count = 3;
  batch.positions = position;
  batch.fields = fields;
  const float* out = static_cast<const float*>(rounding.round(batch).fields[0]);
  EXPECT_TRUE(std::isinf(out[1]));
  EXPECT_TRUE(std::isnan(out[2]));
  f[5] = -3.5e38;
  try {
    rounding.round(batch);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kUnsupported);
    EXPECT_NE(error.text().find("vertex 42"), std::string::npos) << error.text();
    EXPECT_NE(error.text().find("f"), std::string::npos);
  }
}

// A stream in one batch, which can be read again if it is said so.
class OneBatch final : public Source {
 public:
  OneBatch(test::SmallMesh& mesh, bool twice)
      : mesh_(mesh), schema_(mesh.schema()), twice_(twice) {}
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override {
    if (done_) return false;
    batch = mesh_.view();
    return done_ = true;
  }
  Part part() const { return part_; }  // asked for last
  std::unique_ptr<Source> again(Part part) override {
    part_ = part;
    return twice_ ? std::make_unique<OneBatch>(mesh_, false) : nullptr;
  }

 private:
  test::SmallMesh& mesh_;
  Schema schema_;
  bool twice_, done_ = false;
  Part part_ = Part::kAll;
};

TEST(RoundingSource, CanBeReadAgainIfItsSourceCan) {
  test::SmallMesh mesh = thirds();
  OneBatch once(mesh, false), twice(mesh, true);
  EXPECT_EQ(RoundingSource(once).again(Part::kAll), nullptr);
  RoundingSource first(twice);
  const std::unique_ptr<Source> second = first.again(Part::kPositions);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(twice.part(), Part::kPositions);
  for (Source* source : {second.get(), static_cast<Source*>(&first)}) {
    EXPECT_EQ(source->schema().fields[0].type, ScalarType::kFloat32);
    BatchView batch;
    ASSERT_TRUE(source->next(batch));
    const float* x = static_cast<const float*>(batch.positions);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
      EXPECT_EQ(x[i], static_cast<float>(mesh.positions[i]));
    EXPECT_FALSE(source->next(batch));
  }
}

TEST(RoundingSource, IndexedRangesEqualTheRoundedWhole) {
  test::SmallMesh mesh = thirds();
  MemorySource exact(mesh.schema(), mesh.view());
  RoundingIndexedSource rounded(exact);
  EXPECT_EQ(rounded.schema().fields[0].type, ScalarType::kFloat32);
  EXPECT_EQ(rounded.schema().cell_count, 48);
  for (size_t first = 0; first < mesh.vertexCount(); first += 5) {
    const size_t count = std::min<size_t>(5, mesh.vertexCount() - first);
    float positions[15], field[5];
    rounded.readPositions(first, count, positions);
    rounded.readField(0, first, count, field);
    for (size_t i = 0; i < 3 * count; ++i)
      EXPECT_EQ(positions[i], static_cast<float>(mesh.positions[3 * first + i]));
    for (size_t i = 0; i < count; ++i)
      EXPECT_EQ(field[i], static_cast<float>(mesh.field[first + i]));
  }
  int64_t cells[8];
  rounded.readCells(3, 2, cells);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(cells[i], mesh.cells[12 + i]);
}

}  // namespace
}  // namespace tetstream
