// What the .vtu writer writes, read back.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "meshes.h"
#include "pipes.h"
#include "status.h"
#include "vtk_format.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

// Columns of every type; `step` vertices and cells to a batch.
struct Written {
  SmallMesh grid = gridMesh(11, 10, 9);
  std::vector<float> vectors;
  std::vector<int64_t> labels;
  std::vector<int32_t> tags;
  std::vector<double> heat;
  Schema schema;

  Written() {
    std::mt19937 random(1);
    for (size_t i = 0; i < 3 * grid.vertexCount(); ++i)
      vectors.push_back(static_cast<float>(random()) * 1e-9f);
    for (size_t i = 0; i < grid.vertexCount(); ++i) tags.push_back(static_cast<int32_t>(random()));
    for (size_t i = 0; i < grid.cellCount(); ++i) {
      labels.push_back(static_cast<int64_t>(random()) << 20);
      heat.push_back(1.0 / (1.0 + static_cast<double>(i)));
    }
    schema.position_type = ScalarType::kFloat64;
    schema.fields = {{"tag", 1, ScalarType::kInt32},
                     {"f", 1, ScalarType::kFloat64},
                     {"v", 3, ScalarType::kFloat32}};
    schema.cell_data = {{"label", 1, ScalarType::kInt64}, {"heat", 1, ScalarType::kFloat64}};
  }

  void write(Sink& sink, size_t step) {
    sink.begin(schema);
    for (size_t i = 0; i < grid.vertexCount(); i += step) {
      const void* fields[] = {&tags[i], &grid.field[i], &vectors[3 * i]};
      BatchView batch;
      batch.first_vertex = i;
      batch.vertex_count = std::min(step, grid.vertexCount() - i);
      batch.positions = &grid.positions[3 * i];
      batch.fields = fields;
      sink.put(batch);
    }
    for (size_t i = 0; i < grid.cellCount(); i += step) {
      const void* columns[] = {&labels[i], &heat[i]};
      BatchView batch;
      batch.cell_count = std::min(step, grid.cellCount() - i);
      batch.cells = &grid.cells[4 * i];
      batch.cell_data = columns;
      sink.put(batch);
    }
    sink.finish();
  }

  template <class T>
  static bool same(const std::string& bytes, const std::vector<T>& values) {
    return bytes.size() == values.size() * sizeof(T) &&
           std::memcmp(bytes.data(), values.data(), bytes.size()) == 0;
  }
};

std::string writeWith(Written& mesh, size_t step, bool compress) {
  Bytes file;
  int commits = 0;
  WriteOptions options;
  options.compress = compress;
  const std::unique_ptr<Sink> sink = createVtu(std::make_unique<PipeSink>(file, &commits), options);
  mesh.write(*sink, step);
  EXPECT_EQ(commits, 1);
  return std::string(file.begin(), file.end());
}

TEST(VtuWriter, GivesBackEveryArrayBitForBit) {
  Written mesh;
  for (bool compress : {true, false}) {
    const VtuMesh read = readVtu(writeWith(mesh, 500, compress));
    EXPECT_EQ(read.schema.position_type, ScalarType::kFloat64);
    EXPECT_TRUE(Written::same(read.positions, mesh.grid.positions));
    EXPECT_EQ(read.cells, mesh.grid.cells);
    ASSERT_EQ(read.fields.size(), 3u);
    EXPECT_EQ(read.schema.fields[2].name, "v");
    EXPECT_EQ(read.schema.fields[2].components, 3);
    EXPECT_TRUE(Written::same(read.fields[0], mesh.tags));
    EXPECT_TRUE(Written::same(read.fields[1], mesh.grid.field));
    EXPECT_TRUE(Written::same(read.fields[2], mesh.vectors));
    ASSERT_EQ(read.cell_data.size(), 2u);
    EXPECT_TRUE(Written::same(read.cell_data[0], mesh.labels));
    EXPECT_TRUE(Written::same(read.cell_data[1], mesh.heat));
    EXPECT_TRUE(read.notes.empty());
  }
}

TEST(VtuWriter, WritesTheSameBytesHoweverTheStreamIsCut) {
  Written mesh;
  for (bool compress : {true, false}) {
    const std::string file = writeWith(mesh, 500, compress);
    EXPECT_TRUE(file == writeWith(mesh, 7, compress));
    EXPECT_TRUE(file == writeWith(mesh, 1 << 20, compress));
  }
}

TEST(VtuWriter, MarksTheFirstFloatFieldsForViewers) {
  Written mesh;
  const std::string file = writeWith(mesh, 500, true);
  EXPECT_NE(file.find("<PointData Scalars=\"f\" Vectors=\"v\">"), std::string::npos);
  EXPECT_NE(file.find("<CellData Scalars=\"heat\">"), std::string::npos);
}

TEST(VtuWriter, WritesNamesThatXmlWouldTakeForItsOwn) {
  const std::vector<std::string> names = {"a & b", "<x>", "\"q\" 'r'", "tab\there\nand\r there",
                                          "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"};
  Schema schema;
  for (const std::string& name : names) schema.fields.push_back({name, 1, ScalarType::kFloat32});
  schema.fields.push_back({"bad \x01 \xFF \xC3", 1, ScalarType::kFloat32});
  std::vector<unsigned char> out;
  const std::unique_ptr<Sink> sink = createVtu(createMemory(out), {});
  sink->begin(schema);
  sink->finish();
  const VtuMesh read = readVtu(std::string(out.begin(), out.end()));
  ASSERT_EQ(read.schema.fields.size(), names.size() + 1);
  for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(read.schema.fields[i].name, names[i]);
  EXPECT_EQ(read.schema.fields.back().name, "bad _ _ _");
  EXPECT_EQ(read.schema.vertex_count, 0);
}

// Names that XML cannot hold become others, that no other array has, and each is told.
TEST(VtuWriter, TellsOfNamesThatItChanges) {
  const std::vector<std::string> names = {"p\xE9", "p\xE8", "p_", "q\x01"};
  Schema schema;
  for (const std::string& name : names) schema.fields.push_back({name, 1, ScalarType::kFloat32});
  schema.cell_data = {{"p\xE9", 1, ScalarType::kInt32}};
  std::vector<std::string> notes;
  WriteOptions options;
  options.note = [&](const std::string& text) { notes.push_back(text); };
  std::vector<unsigned char> out;
  const std::unique_ptr<Sink> sink = createVtu(createMemory(out), options);
  sink->begin(schema);
  sink->finish();
  const VtuMesh read = readVtu(std::string(out.begin(), out.end()));
  EXPECT_TRUE(read.notes.empty());
  ASSERT_EQ(read.schema.fields.size(), names.size());
  const std::vector<std::string> held = {"p__", "p___", "p_", "q_"};
  for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(read.schema.fields[i].name, held[i]);
  EXPECT_EQ(read.schema.cell_data[0].name, "p_");
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_NE(notes[1].find("\"p\xE8\" has characters that the format cannot hold: it is \"p___\""),
            std::string::npos)
      << notes[1];
}

TEST(VtuWriter, SaysOnceWhatItDrops) {
  std::vector<std::string> notes;
  WriteOptions options;
  options.note = [&](const std::string& text) { notes.push_back(text); };
  std::vector<unsigned char> out;
  const std::unique_ptr<Sink> sink = createVtu(createMemory(out), options);
  sink->begin(Schema());
  const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint8_t locked[4] = {0, 0, 1, 0};
  const int64_t cells[4] = {0, 1, 2, 3};
  BatchView batch;
  batch.vertex_count = 4;
  batch.positions = positions;
  batch.locked = locked;
  sink->put(batch);
  BatchView second;
  second.cell_count = 1;
  second.cells = cells;
  sink->put(second);
  batch.first_vertex = 4;
  sink->put(batch);
  sink->finish();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("locks"), std::string::npos);
  const VtuMesh read = readVtu(std::string(out.begin(), out.end()));
  EXPECT_EQ(read.schema.vertex_count, 8);  // the last four are used by no cell
  EXPECT_EQ(read.cells, (std::vector<int64_t>{0, 1, 2, 3}));
}

TEST(VtuWriter, CommitsNothingUnlessItFinishes) {
  Bytes file;
  int commits = 0;
  {
    const std::unique_ptr<Sink> sink = createVtu(std::make_unique<PipeSink>(file, &commits), {});
    sink->begin(Schema());
  }
  EXPECT_EQ(commits, 0);
  EXPECT_TRUE(file.empty());
}

}  // namespace
}  // namespace tetstream
