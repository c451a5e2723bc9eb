// Gmsh's files: every version and encoding, tags at will, groups, data, and what is wrong.
#include <gtest/gtest.h>

#include <cstring>

#include "msh_testing.h"

namespace tetstream {
namespace {

using namespace test;

// Two cells that share a face; tags with gaps, in no order; groups of both dimensions.
const char kSparse2[] =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n2 9 \"outer wall\"\n3 4 \"steel\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n70 0 0 0\n3 1 0 0\n900000000000 0 1 0\n4 0 0 1\n5 1 1 +1e0\n$EndNodes\n"
    "$Elements\n4\n"
    "8 15 2 0 1 70\n"
    "10 2 2 9 1 70 3 900000000000\n"
    "30 4 2 4 1 70 3 900000000000 4\n"
    "20 4 3 5 2 0 3 900000000000 4 5\n$EndElements\n"
    "$NodeData\n1\n\"p q\"\n1\n0.5\n3\n0\n1\n5\n5 50\n4 40\n3 30\n70 700\n900000000000 900\n"
    "$EndNodeData\n"
    "$ElementData\n1\n\"E\"\n1\n0\n3\n0\n3\n3\n10 1 1 1\n20 2 2 2\n30 3 3 3\n$EndElementData\n";

const char kSparse4[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$Entities\n0 0 1 2\n1 0 0 0 1 1 1 1 9 0\n1 0 0 0 1 1 1 1 4 0\n2 0 0 0 1 1 1 2 5 6 0\n"
    "$EndEntities\n"
    "$Nodes\n2 5 3 900000000000\n2 1 1 2\n70\n3\n0 0 0 0.1 0.2\n1 0 0 0.3 0.4\n"
    "3 1 0 3\n900000000000\n4\n5\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
    "$Elements\n3 3 10 30\n2 1 2 1\n10 70 3 900000000000\n3 1 4 1\n30 70 3 900000000000 4\n"
    "3 2 4 1\n20 3 900000000000 4 5\n$EndElements\n"
    "$NodeData\n1\n\"p q\"\n1\n0.5\n3\n0\n1\n5\n5 50\n4 40\n3 30\n70 700\n900000000000 900\n"
    "$EndNodeData\n"
    "$ElementData\n1\n\"E\"\n1\n0\n3\n0\n3\n3\n10 1 1 1\n20 2 2 2\n30 3 3 3\n$EndElementData\n";

TEST(Msh, ReadsTagsWithGapsGroupsFacesAndData) {
  for (const char* text : {kSparse2, kSparse4}) {
    std::vector<std::string> notes;
    Input input = openText(openMsh, text, {}, &notes);
    const SvMesh m = readAll(input);
    EXPECT_EQ(m.positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
    ASSERT_EQ(m.schema.cell_data.size(), 3u);
    EXPECT_EQ(m.schema.cell_data[0].name, "gmsh:physical");
    EXPECT_EQ(m.cell_data[0], (std::vector<double>{4, 5}));
    EXPECT_EQ(m.schema.cell_data[1].name, "gmsh:geometrical");
    EXPECT_EQ(m.cell_data[1], (std::vector<double>{1, 2}));
    EXPECT_EQ(m.schema.cell_data[2].name, "E");
    EXPECT_EQ(m.cell_data[2], (std::vector<double>{3, 3, 3, 2, 2, 2}));
    ASSERT_EQ(m.schema.fields.size(), 1u);
    EXPECT_EQ(m.schema.fields[0].name, "p q");
    EXPECT_EQ(m.fields[0], (std::vector<double>{700, 30, 900, 40, 50}));
    EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 9}}));
  }
}

TEST(Msh, ReadsTheNamesOfGroupsAndTellsWhatIsLeftOut) {
  std::vector<std::string> notes;
  std::string text = kSparse2;
  text.replace(text.find("2\n2 9"), 5, "3\n1 9 \"edge\"\n2 9");
  const Input input = openText(openMsh, text, {}, &notes);
  EXPECT_EQ(input.schema().label_names,
            (std::vector<LabelName>{{"", 9, "outer wall"}, {"gmsh:physical", 4, "steel"}}));
  EXPECT_TRUE(anyNote(notes, "1 names of physical groups that label no cells or faces are left"));
  EXPECT_TRUE(anyNote(notes, "1 elements of one point are left out"));
  notes.clear();
  openText(openMsh, kSparse4, {}, &notes);
  EXPECT_TRUE(anyNote(notes, "these are left out: \"gmsh:physical\" 6"));
}

// Physical groups label faces if one has any, wherever it comes; entities do where none has.
TEST(Msh, LabelsFacesByGroupsIfThereAreAny) {
  const std::string before(kSparse2, std::strstr(kSparse2, "$Elements"));
  const auto facesWith = [&](const char* first, const char* second, const char* third,
                             std::vector<std::string>* notes) {
    Input input = openText(openMsh,
                           before + "$Elements\n5\n10 2 2 " + first + " 70 3 4\n11 2 2 " + second +
                               " 3 4 5\n12 2 2 " + third +
                               " 70 3 900000000000\n20 4 2 4 1 70 3 900000000000 4\n"
                               "30 4 2 4 1 3 900000000000 4 5\n$EndElements\n",
                           {}, notes);
    return facesOf(input);
  };
  std::vector<std::string> notes;
  EXPECT_EQ(facesWith("0 6", "0 7", "9 8", &notes), (std::vector<TestFace>{{0, 1, 2, 9}}));
  EXPECT_TRUE(anyNote(notes, "2 triangles without a label are left out"));
  notes.clear();
  EXPECT_EQ(facesWith("9 6", "0 7", "0 8", &notes), (std::vector<TestFace>{{0, 1, 3, 9}}));
  EXPECT_TRUE(anyNote(notes, "2 triangles without a label are left out"));
  EXPECT_EQ(facesWith("0 6", "0 7", "0 8", &notes),
            (std::vector<TestFace>{{0, 1, 3, 6}, {1, 3, 4, 7}, {0, 1, 2, 8}}));
}

// A node whose value comes twice has the last one, and stands for no other.
TEST(Msh, CountsTheNodesThatHaveNoValue) {
  const std::string before(kSparse2, std::strstr(kSparse2, "$NodeData"));
  const std::string head = "$NodeData\n1\n\"p\"\n1\n0.5\n3\n0\n1\n5\n";
  for (const char* rows : {"5 50\n4 40\n5 51\n70 700\n900000000000 900\n",
                           "70 700\n900000000000 900\n4 40\n4 40\n5 51\n"}) {
    std::vector<std::string> notes;
    Input input = openText(openMsh, before + head + rows + "$EndNodeData\n", {}, &notes);
    const SvMesh m = readAll(input);
    EXPECT_EQ(m.fields[0], (std::vector<double>{700, 0, 900, 40, 51}));
    EXPECT_TRUE(anyNote(notes, "\"p\" has no value at 1 points, where it is taken as 0")) << rows;
  }
}

// As Gmsh writes version 2: an element is there for each group that its entity is in, with a number
// of its own; faces of a negative group are the other way round.
TEST(Msh, ReadsElementsOfSeveralGroupsOnce) {
  std::string before(kSparse2, std::strstr(kSparse2, "$Elements"));
  before.replace(before.find("2\n2 9"), 5, "3\n3 5 \"all\"\n2 9");
  const std::string text =
      before +
      "$Elements\n8\n10 2 2 9 1 70 3 900000000000\n11 2 2 -8 1 3 70 900000000000\n"
      "20 4 2 4 1 70 3 900000000000 4\n21 4 2 5 1 70 3 900000000000 4\n"
      "22 4 2 6 1 70 3 900000000000 4\n30 4 2 4 1 3 900000000000 4 5\n"
      "31 4 2 5 1 3 900000000000 4 5\n40 2 2 9 1 3 4 5\n$EndElements\n"
      "$ElementData\n1\n\"E\"\n1\n0\n3\n0\n1\n5\n20 2\n21 2\n22 2\n30 3\n31 3\n$EndElementData\n";
  std::vector<std::string> notes;
  Input input = openText(openMsh, text, {}, &notes);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{4, 4}));
  EXPECT_EQ(m.cell_data[2], (std::vector<double>{2, 3}));
  EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 9}, {1, 3, 4, 9}}));
  EXPECT_TRUE(
      anyNote(notes, "4 elements that are there once more, in another physical group, are"));
  EXPECT_TRUE(
      anyNote(notes, "left out: faces 8, \"gmsh:physical\" 5 \"all\", \"gmsh:physical\" 6"));
}

// Binary: in blocks of one.
TEST(Msh, ReadsElementsOfSeveralGroupsOnceInBinary) {
  Bytes file = bytesOf("$MeshFormat\n2.2 1 8\n");
  const auto put = [&](const auto& numbers) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    file.insert(file.end(), bytes, bytes + numbers.size() * sizeof numbers[0]);
  };
  const auto say = [&](const std::string& text) {
    file.insert(file.end(), text.begin(), text.end());
  };
  put(std::vector<int32_t>{1});
  say("\n$EndMeshFormat\n$Nodes\n4\n");
  for (int32_t node = 1; node <= 4; ++node) {
    put(std::vector<int32_t>{node});
    put(std::vector<double>{node == 2 ? 1.0 : 0, node == 3 ? 1.0 : 0, node == 4 ? 1.0 : 0});
  }
  say("\n$EndNodes\n$Elements\n2\n");
  put(std::vector<int32_t>{4, 1, 2, 7, 10, 1, 1, 2, 3, 4, 4, 1, 2, 8, 11, 1, 1, 2, 3, 4});
  say("\n$EndElements\n");
  const SvMesh m = readBytes(openMsh, file);
  EXPECT_EQ(m.cells.size(), 1u);
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{10}));
}

TEST(Msh, GivesBackWhatItHasWrittenInAllFourWays) {
  const SvMesh m = indexedMesh(richSchema(), 300);
  for (bool binary : {false, true})
    for (bool newest : {false, true}) {
      SCOPED_TRACE(std::string(binary ? "binary " : "text ") + (newest ? "4.1" : "2.2"));
      const SvMesh r = readBytes(openMsh, write(m, binary, newest));
      EXPECT_EQ(r.schema.position_type, m.schema.position_type);
      EXPECT_EQ(r.positions, m.positions);
      EXPECT_EQ(r.cells, m.cells);
      EXPECT_EQ(r.fields, m.fields);
      ASSERT_EQ(r.schema.fields.size(), m.schema.fields.size());
      for (size_t i = 0; i < m.schema.fields.size(); ++i)
        EXPECT_EQ(r.schema.fields[i].type, m.schema.fields[i].type);
      // Random labels are no groups, so both columns are data.
      EXPECT_EQ(r.cell_data, m.cell_data);
    }
}

// Two names that the format cannot tell apart: the one that it can hold keeps it.
TEST(Msh, GivesEachArrayANameOfItsOwn) {
  Schema schema;
  for (const char* name : {"T \"old\"", "T _old_", "T \nold\r", "p"})
    schema.fields.push_back({name, 1, ScalarType::kFloat64});
  const SvMesh m = indexedMesh(schema, 20);
  for (const bool newest : {false, true}) {
    std::vector<std::string> notes;
    const SvMesh r = readBytes(openMsh, write(m, true, newest, &notes));
    ASSERT_EQ(r.schema.fields.size(), 4u);
    EXPECT_EQ(r.schema.fields[0].name, "T _old__");
    EXPECT_EQ(r.schema.fields[1].name, "T _old_");
    EXPECT_EQ(r.schema.fields[2].name, "T _old___");
    EXPECT_EQ(r.fields, m.fields);
    EXPECT_TRUE(anyNote(notes, "cannot hold: it is \"T _old___\""));
    EXPECT_EQ(notes.size(), 2u);
  }
}

// A tetrahedron with labelled faces.
Bytes writeFaces(const std::vector<TestFace>& faces, bool binary, bool newest) {
  Bytes out;
  WriteOptions options;
  options.binary = binary;
  options.newest = newest;
  const std::unique_ptr<Sink> sink = createMsh(createMemory(out), options);
  Batch batch(Schema{});
  batch.clear(0);
  batch.addVertices(4);
  const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::memcpy(batch.position(0), corners, sizeof corners);
  batch.addCells(1);
  for (int64_t k = 0; k < 4; ++k) batch.cell(0)[k] = k;
  for (const TestFace& face : faces) {
    const int64_t points[3] = {face.a, face.b, face.c};
    batch.addFace(points, face.label);
  }
  sink->begin(Schema{});
  sink->put(batch.view());
  sink->finish();
  return out;
}

// The cells beside them have a group for other programs' sake, which is no array of ours.
TEST(Msh, KeepsFacesAndTheirLabels) {
  for (bool binary : {false, true})
    for (bool newest : {false, true}) {
      const TestFace kept = {0, 1, 2, 12}, of_no_group = {1, 2, 3, -1};
      const Bytes out = writeFaces({kept, of_no_group}, binary, newest);
      Input again = openMsh(openMemory(out.data(), out.size(), "mesh"), {});
      EXPECT_EQ(facesOf(again), std::vector<TestFace>{kept});
      EXPECT_TRUE(again.indexed->schema().cell_data.empty());
      if (!binary) {
        EXPECT_NE(std::string(out.begin(), out.end())
                      .find(newest ? "\n1 0 0 0 1 1 1 1 1 0 \n$EndEnt" : "\n2 4 2 1 1 1 2 3 4 \n"),
                  std::string::npos);
      }
    }
}

// Each surface is one block, whatever order the labels come in.
TEST(Msh, BringsFacesTogetherByTheirLabels) {
  const TestFace a = {0, 1, 2, 9}, b = {0, 1, 3, 4}, c = {0, 2, 3, 9}, d = {1, 2, 3, 4};
  for (bool binary : {false, true})
    for (bool newest : {false, true}) {
      const Bytes out = writeFaces({a, b, c, d}, binary, newest);
      Input again = openMsh(openMemory(out.data(), out.size(), "mesh"), {});
      EXPECT_EQ(facesOf(again), (std::vector<TestFace>{b, d, a, c}));
      if (!binary && newest) {
        const std::string text(out.begin(), out.end());
        EXPECT_NE(text.find("$Elements\n3 5 1 5 \n2 4 2 2 \n"), std::string::npos) << text;
      }
    }
}

std::string unitCube(int type, const char* corners) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
         "5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n1\n77 " +
         std::to_string(type) + " 2 1 1 " + corners + "\n$EndElements\n";
}

TEST(Msh, NamesACellThatIsNoTetrahedronAndSplitsItIfAsked) {
  const std::string cube = unitCube(5, "1 2 3 4 5 6 7 8");
  EXPECT_EQ(problemOf(openMsh, cube).find("mesh: line 17: cell 77 is a hexahedron"), 0u)
      << problemOf(openMsh, cube);
  ReadOptions options;
  options.split = true;
  const struct {
    std::string text;
    size_t cells;
    double volume;
  } cases[] = {{cube, 6, 1},
               {unitCube(6, "1 2 4 5 6 8"), 3, 0.5},
               {unitCube(7, "1 2 3 4 5"), 2, 1.0 / 3},
               {unitCube(5, "8 5 1 4 7 6 2 3"), 6, 1}};
  for (const auto& c : cases) {
    std::vector<std::string> notes;
    Input input = openText(openMsh, c.text, options, &notes);
    const SvMesh m = readAll(input);
    ASSERT_EQ(m.cells.size(), c.cells);
    double volume = 0;
    for (size_t i = 0; i < m.cells.size(); ++i) {
      EXPECT_GT(volumeOf(m, i), 0);
      volume += volumeOf(m, i);
    }
    EXPECT_NEAR(volume, c.volume, 1e-12);
    EXPECT_EQ(m.cell_data[0], std::vector<double>(c.cells, 1.0));
    EXPECT_TRUE(anyNote(notes, "1 cells that are no tetrahedra are split"));
  }
}

TEST(Msh, ReadsCellsOfHigherOrderByTheirCorners) {
  std::vector<std::string> notes;
  Input input = openText(openMsh, unitCube(11, "1 2 4 5 3 6 7 8 3 6"), {}, &notes);
  EXPECT_EQ(readAll(input).cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 3, 4}}));
  EXPECT_TRUE(anyNote(notes, "1 cells of higher order are read by their corners"));
}

TEST(Msh, SaysWhatIsWrongAndWhere) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = head + "$Nodes\n1\n5 0 0 0\n$EndNodes\n";
  const struct {
    std::string text, problem;
  } cases[] = {
      {"", "where $MeshFormat should be"},
      {"$MeshFormat\n1 0 8\n", "version 1 of Gmsh's format"},
      {"$MeshFormat\n4.2 0 8\n", "version 4.2 of Gmsh's format"},
      {"$MeshFormat\n4.1 1 5\n", "the size of numbers is 5, not 4 or 8"},
      {head + "$Nodes\n1152921504606846976\n", "1152921504606846976 nodes cannot be in the"},
      {head + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "node 1 is there twice"},
      {head + "$Nodes\n1\n1 0 zero 0\n", "line 6: \"zero\" is no number"},
      {head + "$Nodes\n1\n1 0 nan 0\n", "is not a finite number"},
      {nodes + "$Elements\n1\n1 4 2 0 0 5 5 5 6\n$EndElements\n",
       "line 10: element 1 uses node 6, which is not there"},
      {nodes + "$Elements\n1\n1 140 2 0 0 5 5 5 5\n$EndElements\n", "element of type 140"},
      {nodes + "$Elements\n9999999999\n", "elements cannot be in the"},
      {nodes, "no tetrahedron"},
      {head, "no section $Nodes"},
      {nodes + "$Periodic\n1\n", "ends without \"$EndPeriodic\""},
      {nodes + "rubbish", "\"rubbish\" where a section should begin"},
  };
  for (const auto& c : cases)
    EXPECT_NE(problemOf(openMsh, c.text).find(c.problem), std::string::npos)
        << problemOf(openMsh, c.text) << "\nwanted: " << c.problem;
}

TEST(Msh, NotesDataThatAreNotEverywhere) {
  std::string text = kSparse2;
  text.replace(text.find("5\n5 50\n"), 7, "4\n");
  std::vector<std::string> notes;
  Input input = openText(openMsh, text, {}, &notes);
  EXPECT_TRUE(anyNote(notes, "\"p q\" has no value at 1 points"));
  EXPECT_EQ(readAll(input).fields[0], (std::vector<double>{700, 30, 900, 40, 0}));
}

TEST(Msh, SurvivesEveryCutAndEveryFlippedBit) {
  const std::string sparse2(kSparse2), sparse4(kSparse4);
  expectSurvives(openMsh, bytesOf(sparse4));
  Schema schema;
  schema.fields = {{"f", 1, ScalarType::kFloat32}};
  const SvMesh m = indexedMesh(schema, 2);
  expectSurvives(openMsh, write(m, true, true));
  expectSurvives(openMsh, write(m, true, false));
}

}  // namespace
}  // namespace tetstream
