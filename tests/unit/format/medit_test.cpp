// MEDIT's meshes: all versions, text and binary, with solutions beside them.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "indexed_testing.h"
#include "medit_format.h"
#include "pipes.h"

namespace tetstream {
namespace {

using namespace test;

// A folder that is gone at the end.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / "tetstream_medit.XXXXXX") {
    EXPECT_NE(::mkdtemp(path_.data()), nullptr);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

const char kMeditText[] =
    "MeshVersionFormatted 2 # two cells\nDimension\n3\n"
    "Triangles 1\n1 2 3 7\n"  // before the vertices that they use
    "Vertices\n5\n0 0 0 0\n1.0D+00 0 0 2\n0 1 0 0\n0 0 1 0\n1 1 1 0\n"
    "Tetrahedra\n2\n1 2 3 4 11\n2 3 4 5 12\nRidges\n1\n1\nRequiredVertices\n1\n5\nEnd\n";

SvMesh twoCells(ScalarType position_type, ScalarType field_type, ScalarType label_type) {
  Schema schema;
  schema.position_type = position_type;
  schema.fields = {{"medit:ref", 1, label_type}, {"sol", 1, field_type}, {"sol1", 3, field_type}};
  schema.cell_data = {{"medit:ref", 1, label_type}};
  SvMesh m = indexedMesh(schema, 12);
  const double scale = label_type == ScalarType::kInt64 ? 1e12 : 1;
  for (size_t i = 0; i < m.cells.size(); ++i)
    m.cell_data[0][i] = scale * static_cast<double>(1 + i % 3);
  for (size_t v = 0; v < m.vertexCount(); ++v) m.fields[0][v] = static_cast<double>(v % 2 + 1);
  return m;
}

void writeTo(const std::string& path, const SvMesh& m, bool binary) {
  WriteOptions options;
  options.path = path;
  putStream(m, *(binary ? createMeshb : createMesh)(createFile(path), options), 3);
}

SvMesh readFrom(const std::string& path) {
  ReadOptions options;
  options.path = path;
  Input input = openMedit(openFile(path), options);
  return readAll(input);
}

TEST(Medit, ReadsTextWithReferencesFacesAndLocks) {
  std::vector<std::string> notes;
  Input input = openText(openMedit, kMeditText, {}, &notes);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{11, 12}));
  EXPECT_EQ(m.schema.cell_data[0].name, "medit:ref");
  EXPECT_EQ(m.fields[0], (std::vector<double>{0, 2, 0, 0, 0}));
  EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 7}}));
  ASSERT_NE(input.indexed->locked(), nullptr);
  EXPECT_EQ(input.indexed->locked()[3], 0);
  EXPECT_EQ(input.indexed->locked()[4], 1);
  EXPECT_TRUE(anyNote(notes, "the section Ridges is left out"));
}

std::vector<int> locksOf(const Input& input) {
  const uint8_t* const locked = input.indexed->locked();
  if (!locked) return {};
  return {locked, locked + input.indexed->schema().vertex_count};
}

const std::string kFiveVertices =
    "MeshVersionFormatted 2\nDimension 3\n"
    "Vertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n"
    "Tetrahedra\n2\n1 2 3 4 0\n2 3 4 5 0\n";

TEST(Medit, LocksTheVerticesOfRequiredEdgesAndTriangles) {
  const std::string faces = "Quadrilaterals 1\n1 2 3 4 9\nTriangles 2\n1 2 3 7\n3 4 5 7\n";
  const std::string edges = "Edges 2\n1 2 0\n4 1 0\n";
  const std::string required = "RequiredTriangles 1\n2\n", one_edge = "RequiredEdges 1\n2\n";
  const auto locks = [](const std::string& text) {
    const Input input = openText(openMedit, kFiveVertices + text + "End\n");
    return locksOf(input);
  };
  EXPECT_EQ(locks(faces + edges), std::vector<int>{});
  EXPECT_EQ(locks(faces + required), (std::vector<int>{0, 0, 1, 1, 1}));
  EXPECT_EQ(locks(edges + one_edge), (std::vector<int>{1, 0, 0, 1, 0}));
  EXPECT_EQ(locks(faces + edges + required + one_edge), (std::vector<int>{1, 0, 1, 1, 1}));
  // Numbers go on in further sections, and those that were told stay.
  const std::string more = "Triangles 1\n1 2 4 7\n", third = "RequiredTriangles 1\n3\n";
  EXPECT_EQ(locks(faces + required + more), (std::vector<int>{0, 0, 1, 1, 1}));
  EXPECT_EQ(locks(faces + more + third), (std::vector<int>{1, 1, 0, 1, 0}));
  EXPECT_EQ(locks(faces + required + "Triangles 0\n"), (std::vector<int>{0, 0, 1, 1, 1}));
}

TEST(Medit, NotesRequiredThingsThatNobodyHasToldOf) {
  std::vector<std::string> notes;
  const Input input =
      openText(openMedit, kFiveVertices + "RequiredTriangles 2\n1\n3\nEnd\n", {}, &notes);
  EXPECT_EQ(locksOf(input), std::vector<int>{});
  EXPECT_TRUE(anyNote(notes, "2 required triangles, before which no triangles come, are left out"));
}

// The sixth vertex is no cell's.
TEST(Medit, LeavesOutTrianglesWithPointsThatNoCellHas) {
  const std::string text =
      "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "1 1 1 0\n2 2 2 0\nTriangles 4\n1 2 3 7\n1 2 6 8\n3 4 5 9\n6 6 6 1\n"
      "Tetrahedra 2\n1 2 3 4 0\n2 3 4 5 0\nEnd\n";
  std::vector<std::string> notes;
  Input input = openText(openMedit, text, {}, &notes);
  EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 7}, {2, 3, 4, 9}}));
  EXPECT_TRUE(anyNote(notes, "2 triangles that are no faces of cells are left out"));
}

TEST(Medit, GivesBackWhatItHasWritten) {
  const struct {
    ScalarType positions, fields, labels;
    int version;  // of binary
  } cases[] = {{ScalarType::kFloat32, ScalarType::kFloat32, ScalarType::kInt32, 1},
               {ScalarType::kFloat64, ScalarType::kFloat32, ScalarType::kInt32, 2},
               {ScalarType::kFloat64, ScalarType::kFloat64, ScalarType::kInt64, 4}};
  for (const auto& c : cases)
    for (bool binary : {false, true}) {
      SCOPED_TRACE(std::string(binary ? "binary " : "text ") + std::to_string(c.version));
      const Folder folder;
      const std::string path = folder.file(binary ? "a.meshb" : "a.mesh");
      const SvMesh m = twoCells(c.positions, c.fields, c.labels);
      writeTo(path, m, binary);
      const SvMesh r = readFrom(path);
      EXPECT_EQ(r.positions, m.positions);
      EXPECT_EQ(r.cells, m.cells);
      EXPECT_EQ(r.fields, m.fields);
      EXPECT_EQ(r.cell_data, m.cell_data);
      EXPECT_EQ(r.schema.position_type, binary ? c.positions : ScalarType::kFloat64);
      if (!binary) continue;
      unsigned char head[8] = {};
      openFile(path)->readAt(0, head, sizeof head);
      EXPECT_EQ(head[4], c.version);
    }
}

// A stream of one cell with a labelled face and a field of integers, in memory and beside it.
struct OneCell {
  int64_t label = 1;
  int64_t numbers[4] = {1, 2, 3, 4};

  std::vector<std::string> writeTo(const std::string& path, bool binary) const {
    const double places[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int64_t cell[4] = {0, 1, 2, 3}, face[3] = {0, 1, 2};
    const int32_t references[4] = {0, 0, 0, 0};
    std::vector<std::string> notes;
    WriteOptions options;
    options.path = path;
    options.note = [&](const std::string& note) { notes.push_back(note); };
    const auto sink = (binary ? createMeshb : createMesh)(createFile(path), options);
    Schema schema;
    schema.position_type = ScalarType::kFloat64;
    schema.fields = {{"medit:ref", 1, ScalarType::kInt32}, {"big", 1, ScalarType::kInt64}};
    const void* const fields[] = {references, numbers};
    BatchView batch;
    batch.vertex_count = 4;
    batch.positions = places;
    batch.fields = fields;
    batch.cell_count = 1;
    batch.cells = cell;
    batch.face_count = 1;
    batch.faces = face;
    batch.face_labels = &label;
    sink->begin(schema);
    sink->put(batch);
    sink->finish();
    return notes;
  }
};

TEST(Medit, TellsPlacesOf64BitsWhereTheMeshOrItsSolutionIsLong) {
  Schema schema;
  EXPECT_FALSE(meditNeedsWidePlaces(schema, 5000000, 25000000, 1000000));
  EXPECT_TRUE(meditNeedsWidePlaces(schema, 20000000, 100000000, 1000000));
  schema.cell_data.push_back({"stress", 9, ScalarType::kFloat64});
  EXPECT_FALSE(meditNeedsWidePlaces(schema, 5000000, 18000000, 1000000));
  EXPECT_TRUE(meditNeedsWidePlaces(schema, 5000000, 25000000, 1000000));
  schema.cell_data.clear();
  schema.fields.push_back({"velocity", 3, ScalarType::kFloat64});
  EXPECT_TRUE(meditNeedsWidePlaces(schema, 60000000, 15000000, 0));
}

TEST(Medit, HoldsLabelsOfFacesOfAnySize) {
  for (const bool binary : {false, true})
    for (const int64_t label : {int64_t{7}, int64_t{-7000000000}}) {
      const Folder folder;
      const std::string path = folder.file(binary ? "a.meshb" : "a.mesh");
      OneCell mesh;
      mesh.label = label;
      mesh.writeTo(path, binary);
      Input input = openMedit(openFile(path), {});
      EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, label}})) << binary;
    }
}

TEST(Medit, TellsOfIntegersThatBinaryRounds) {
  for (const bool binary : {false, true})
    for (const int64_t number : {int64_t{1} << 53, (int64_t{1} << 60) + 1}) {
      const Folder folder;
      OneCell mesh;
      mesh.numbers[2] = number;
      const auto notes = mesh.writeTo(folder.file(binary ? "a.meshb" : "a.mesh"), binary);
      EXPECT_EQ(anyNote(notes, "\"big\" has integers that a float64 does not hold"),
                binary && number > int64_t{1} << 53);
    }
}

// The same bytes in the other byte order.
TEST(Medit, ReadsEitherByteOrder) {
  Bytes file;
  putStream(twoCells(ScalarType::kFloat32, ScalarType::kFloat32, ScalarType::kInt32),
            *createMeshb(createMemory(file), {}), 3);
  Bytes swapped = file;  // of version 1 all numbers have four bytes
  for (size_t at = 0; at + 4 <= swapped.size(); at += 4)
    std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(at),
                 swapped.begin() + static_cast<std::ptrdiff_t>(at) + 4);
  const SvMesh a = readBytes(openMedit, file), b = readBytes(openMedit, swapped);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.cell_data, b.cell_data);
}

TEST(Medit, SaysThatFieldsNeedAFileBeside) {
  Bytes file;
  std::vector<std::string> notes;
  WriteOptions options;
  options.note = [&](const std::string& note) { notes.push_back(note); };
  putStream(twoCells(ScalarType::kFloat32, ScalarType::kFloat32, ScalarType::kInt32),
            *createMesh(createMemory(file), options), 3);
  EXPECT_TRUE(anyNote(notes, "fields and cell data are left out"));
  EXPECT_TRUE(anyNote(notes, "\"sol\", \"sol1\""));
}

TEST(Medit, ReadsTextBehindAByteOrderMark) {
  const Bytes data = bytesOf(std::string("\xef\xbb\xbf") + kMeditText);
  for (size_t step : {1, 2, 3, 4, 1000}) {
    Input input = openMedit(std::make_unique<PipeSource>(data, step, "mesh"), ReadOptions());
    EXPECT_EQ(readAll(input).cells.size(), 2u) << step << " bytes at a time";
  }
}

// As sfepy's meshes do; not where the last number may have been cut.
TEST(Medit, ReadsAWholeLastLineWithoutEndWithANote) {
  std::string text(kMeditText);
  text.resize(text.rfind("End"));
  std::vector<std::string> notes;
  Input input = openText(openMedit, text, {}, &notes);
  EXPECT_EQ(readAll(input).cells.size(), 2u);
  EXPECT_TRUE(anyNote(notes, "without the word End"));
  text.pop_back();
  EXPECT_NE(problemOf(openMedit, text).find("without the word End"), std::string::npos);
}

TEST(Medit, SaysWhatIsWrongAndWhere) {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  const std::string vertices = head + "Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
  const struct {
    std::string text, problem;
  } cases[] = {
      {"", "where MeshVersionFormatted should be"},
      {"MeshVersionFormatted 5\n", "version 5; 1 to 4 are read"},
      {"MeshVersionFormatted 2\nDimension 2\n", "dimension 2"},
      {head + "Vertices 1152921504606846976\n", "vertices cannot be in the"},
      {head + "Vertices 4\n0 0 0 0\n", "line 3: 4 vertices cannot be in the 9 bytes"},
      {vertices + "Tetrahedra 1\n1 2 3 5 0\nEnd\n", "line 9: vertex 5, where there are 1 to 4"},
      {vertices + "Triangles 1\n1 2 -9223372036854775808 0\nEnd\n",
       "line 9: vertex -9223372036854775808, where there are 1 to 4"},
      {vertices + "Tetrahedra 1\n1 2 3 0 0\nEnd\n", "vertex 0"},
      {vertices + "Tetrahedra 1\n1 2 3 4 0", "without the word End"},
      {vertices + "Prisms 1\n1 2 3 4 1 2 0\nEnd\n", "cell 1 is a prism"},
      {vertices + "Triangles 1\n1 2 3 0\nRequiredTriangles 1\n2\nEnd\n",
       "line 11: number 2 of required triangles, where there are 1 to 1"},
      {vertices + "Edges 1\n1 2 0\nRequiredEdges 1\n0\nEnd\n",
       "line 11: number 0 of required edges"},
      {vertices + "Edges 1\n1 5 0\nRequiredEdges 1\n1\nEnd\n",
       "a required edge or triangle has vertex 5, where there are 1 to 4"},
      {head + "Edges 1\n1 2 0\nRequiredEdges 1\n1\nVertices 1\n0 0 0 0\nEnd\n",
       "a required edge or triangle has vertex 2, where there are 1 to 1"},
      {vertices + "End\n", "no tetrahedron"},
      {head + "Tetrahedra 1\n1 2 3 9 0\nVertices 1\n0 0 0 0\nEnd\n",
       "tetrahedron 0 uses point 1, counted from 0; there are 1"},
  };
  for (const auto& c : cases)
    EXPECT_NE(problemOf(openMedit, c.text).find(c.problem), std::string::npos)
        << problemOf(openMedit, c.text) << "\nwanted: " << c.problem;
}

// Column by column of the upper triangle, as Mmg and FreeFEM read and write them.
TEST(Medit, HasSymmetricMatricesInAnOrderOfItsOwn) {
  const Folder folder;
  const std::string path = folder.file("a.mesh");
  const std::string rows = "11 12 22 13 23 33\n";
  std::ofstream(path) << kFiveVertices << "End\n";
  std::ofstream(folder.file("a.sol"))
      << "MeshVersionFormatted 2\nDimension 3\nSolAtVertices 5\n1 3\n"
      << rows << rows << rows << rows << rows << "End\n";
  const SvMesh m = readFrom(path);
  ASSERT_EQ(m.schema.fields.size(), 1u);
  EXPECT_EQ(std::vector<double>(m.fields[0].begin(), m.fields[0].begin() + 6),
            (std::vector<double>{11, 22, 33, 12, 23, 13}));
  Schema schema;
  schema.position_type = ScalarType::kFloat64;
  schema.fields = {{"stress", 6, ScalarType::kFloat64}};
  SvMesh written = indexedMesh(schema, 2);
  for (size_t i = 0; i < written.fields[0].size(); ++i) written.fields[0][i] = m.fields[0][i % 6];
  writeTo(folder.file("b.mesh"), written, false);
  std::ostringstream text;
  text << std::ifstream(folder.file("b.sol")).rdbuf();
  EXPECT_NE(text.str().find("1 3 \n11 12 22 13 23 33 \n11 12"), std::string::npos) << text.str();
  writeTo(folder.file("c.meshb"), written, true);
  EXPECT_EQ(readFrom(folder.file("c.meshb")).fields, written.fields);
}

TEST(Medit, RefusesASolutionOfAnotherMesh) {
  const Folder folder;
  const std::string path = folder.file("a.mesh");
  writeTo(path, twoCells(ScalarType::kFloat64, ScalarType::kFloat64, ScalarType::kInt32), false);
  std::FILE* sol = std::fopen(folder.file("a.sol").c_str(), "w");
  std::fputs("MeshVersionFormatted 2\nDimension 3\nSolAtVertices 1\n1 1\n0.5\nEnd\n", sol);
  std::fclose(sol);
  try {
    readFrom(path);
    ADD_FAILURE() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(error.text().find("a.sol: line 3: 1 values for "), std::string::npos) << error.text();
  }
}

TEST(Medit, SurvivesEveryCutAndEveryFlippedBit) {
  expectSurvives(openMedit, bytesOf(kMeditText));
  Bytes file;
  Schema schema;
  schema.position_type = ScalarType::kFloat64;
  schema.cell_data = {{"medit:ref", 1, ScalarType::kInt64}};
  putStream(indexedMesh(schema, 2), *createMeshb(createMemory(file), {}), 3);
  expectSurvives(openMedit, file);
}

}  // namespace
}  // namespace tetstream
