// Sections of Gmsh's files that are there in other forms, or again.
#include <gtest/gtest.h>

#include <algorithm>

#include "gmsh_format.h"
#include "indexed_testing.h"

namespace tetstream {
namespace {

using namespace test;

const std::string kHead2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kNodes2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string kElements2 = "$Elements\n1\n1 4 2 7 1 1 2 3 4\n$EndElements\n";
const std::string kHead4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string kNodes4 =
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string kElements4 = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
const std::vector<double> kPlaces = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

std::string view(const std::string& name, int first) {
  std::string text = "$NodeData\n1\n\"" + name + "\"\n1\n0\n3\n0\n1\n4\n";
  for (int k = 0; k < 4; ++k)
    text += std::to_string(k + 1) + " " + std::to_string(first + k) + "\n";
  return text + "$EndNodeData\n";
}

// As Gmsh saves two views.
TEST(MshSections, OfAMeshThatIsThereAgainAreLeftOut) {
  for (const std::string& mesh : {kHead2 + kNodes2 + kElements2, kHead4 + kNodes4 + kElements4}) {
    std::vector<std::string> notes;
    Input input = openText(openMsh, mesh + view("T", 10) + mesh + view("p", 20), {}, &notes);
    const SvMesh m = readAll(input);
    EXPECT_EQ(m.positions, kPlaces);
    EXPECT_EQ(m.cells.size(), 1u);
    ASSERT_EQ(m.schema.fields.size(), 2u);
    EXPECT_EQ(m.fields[0], (std::vector<double>{10, 11, 12, 13}));
    EXPECT_EQ(m.fields[1], (std::vector<double>{20, 21, 22, 23}));
    EXPECT_TRUE(anyNote(notes, "the section $Nodes is there again: it is left out"));
    EXPECT_TRUE(anyNote(notes, "the section $Elements is there again: it is left out"));
  }
}

TEST(MshSections, OfAnotherMeshAreErrors) {
  const std::string more = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n";
  EXPECT_NE(problemOf(openMsh, kHead2 + kNodes2 + kElements2 + more)
                .find("line 16: a second section of nodes, of 5: the first has 4"),
            std::string::npos)
      << problemOf(openMsh, kHead2 + kNodes2 + kElements2 + more);
  const std::string two = "$Elements\n2\n1 4 2 7 1 1 2 3 4\n2 4 2 7 1 1 2 3 4\n$EndElements\n";
  EXPECT_NE(problemOf(openMsh, kHead2 + kNodes2 + kElements2 + kNodes2 + two)
                .find("a second section of elements, of 2: the first has 1"),
            std::string::npos);
}

TEST(MshSections, OfCommentsMayStandBeforeAll) {
  const std::string comment = "$Comments\nmade by hand\n$EndComments\n";
  for (const std::string& head : {kHead2, comment + kHead2, comment + comment + kHead2}) {
    Input input = openText(openMsh, head + kNodes2 + kElements2);
    EXPECT_EQ(readAll(input).positions, kPlaces);
  }
  EXPECT_NE(problemOf(openMsh, comment + kNodes2).find("where $MeshFormat should be"),
            std::string::npos);
}

// Format 2.0 has no dimensions there; what follows a name is for other programs.
TEST(MshSections, OfNamesAreReadInEachForm) {
  const std::string nodes_and_cells = kNodes2 +
                                      "$Elements\n2\n1 4 2 7 1 1 2 3 4\n"
                                      "2 2 2 9 1 1 2 3\n$EndElements\n";
  const auto namesOf = [&](const std::string& head, const std::string& rows) {
    const std::string names = "$PhysicalNames\n2\n" + rows + "$EndPhysicalNames\n";
    return openText(openMsh, head + names + nodes_and_cells).schema().label_names;
  };
  const std::vector<LabelName> both = {{"", 9, "wall"}, {"gmsh:physical", 7, "steel bar"}};
  EXPECT_EQ(namesOf(kHead2, "3 7 \"steel bar\"\n2 9 \"wall\"\n"), both);
  EXPECT_EQ(namesOf(kHead2, "3 7 \"steel bar\" solid 1\n2 9 \"wall\" lower_dimensional\n"), both);
  const std::vector<LabelName> any =
      namesOf("$MeshFormat\n2 0 8\n$EndMeshFormat\n", "7 \"steel bar\"\n900 \"wall\"\n");
  for (const LabelName& name : {LabelName{"", 900, "wall"}, {"gmsh:physical", 7, "steel bar"}})
    EXPECT_EQ(std::count(any.begin(), any.end(), name), 1) << name.name;
  EXPECT_NE(problemOf(openMsh, kHead2 + "$PhysicalNames\n1\n4 1 \"a\"\n$EndPhysicalNames\n")
                .find("the dimension of a group is 4, not 0 to 3"),
            std::string::npos);
}

// A point, one on a curve, one on a surface, one inside.
TEST(MshSections, ParametricNodesAreNodes) {
  const std::string nodes =
      "$ParametricNodes\n4\n1 0 0 0 0 1\n2 1 0 0 1 2 0.25\n3 0 1 0 2 1 0.5 -1e-3\n4 0 0 1 3 1\n"
      "$EndParametricNodes\n";
  Input input = openText(openMsh, kHead2 + nodes + kElements2);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.positions, kPlaces);
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}}));
  std::string broken = nodes;
  broken.replace(broken.find("0.5 -1e-3"), 9, "0.5");
  EXPECT_NE(problemOf(openMsh, kHead2 + broken + kElements2).find("line "), std::string::npos);
}

// Format 1, as programs wrote it before 2004: no format, other names, nodes counted.
TEST(MshSections, OfTheFirstFormatAreRead) {
  const std::string nodes = "$NOD\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n9 1 1 1\n$ENDNOD\n";
  const std::string elements =
      "$ELM\n4\n1 15 7 1 1 1\n2 2 5 1 3 1 2 3\n3 4 7 1 4 1 2 3 4\n4 4 8 2 4 2 4 3 9\n$ENDELM\n";
  std::vector<std::string> notes;
  Input input = openText(openMsh, nodes + "$NOTES\nx\n$ENDNOTES\n" + elements, {}, &notes);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.positions.size(), 15u);
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {1, 3, 2, 4}}));
  ASSERT_FALSE(m.schema.cell_data.empty());
  EXPECT_EQ(m.schema.cell_data[0].name, "gmsh:physical");
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{7, 8}));
  EXPECT_EQ(m.schema.face_count, 1);
  EXPECT_TRUE(anyNote(notes, "the section $NOTES is left out"));
  const struct {
    std::string text, problem;
  } cases[] = {
      {"$NOD\n", "ends where the number of nodes"},
      {nodes + "$ELM\n1\n1 4 7 1 5 1 2 3 4\n", "line 11: element 1 has 5 nodes, not 4"},
      {nodes + "$ELM\n1\n1 4 7 1 4 1 2 3 8\n", "line 11: element 1 uses node 8"},
      {nodes + "$ELM\n1\n1 4 7 1 4 1 2 3 4\n$EndElements\n", "where $ENDELM should be"},
      {nodes + nodes + elements, "a second section of nodes"},
      {nodes, "no tetrahedron"},
  };
  for (const auto& c : cases)
    EXPECT_NE(problemOf(openMsh, c.text).find(c.problem), std::string::npos)
        << problemOf(openMsh, c.text) << "\nwanted: " << c.problem;
}

// Format 4.0, as text or binary: an entity before its dimension, a node's tag beside its place. Of
// a point of the model, a surface with parameters, and two volumes.
Bytes fileOf40(bool binary) {
  Bytes file;
  const auto say = [&file](const std::string& text) {
    file.insert(file.end(), text.begin(), text.end());
  };
  const auto put = [&](const auto... numbers) {
    const auto one = [&](auto number) {
      if (!binary)
        return say((std::is_integral_v<decltype(number)> ? std::to_string(int64_t(number))
                                                         : std::to_string(number)) +
                   " ");
      const auto* bytes = reinterpret_cast<const unsigned char*>(&number);
      file.insert(file.end(), bytes, bytes + sizeof number);
    };
    (one(numbers), ...);
    if (!binary) say("\n");
  };
  const auto boxed = [&](int32_t tag, auto... more) { put(tag, 0., 0., 0., 1., 1., 1., more...); };
  say(binary ? "$MeshFormat\n4 1 8\n" : "$MeshFormat\n4.0 0 8\n");
  if (binary) put(int32_t{1});
  say("\n$EndMeshFormat\n$Entities\n");
  put(uint64_t{1}, uint64_t{0}, uint64_t{1}, uint64_t{2});
  boxed(1, uint64_t{1}, 3);
  boxed(6, uint64_t{1}, 9, uint64_t{0});
  boxed(1, uint64_t{1}, 4, uint64_t{1}, 6);
  boxed(2, uint64_t{2}, 5, 6, uint64_t{1}, -6);
  say("\n$EndEntities\n$Nodes\n");
  put(uint64_t{2}, uint64_t{5});
  put(6, 2, 1, uint64_t{2});
  put(70, 0., 0., 0., 0.1, 0.2);
  put(3, 1., 0., 0., 0.3, 0.4);
  put(1, 3, 0, uint64_t{3});
  put(90, 0., 1., 0.);
  put(4, 0., 0., 1.);
  put(5, 1., 1., 1.);
  say("\n$EndNodes\n$Elements\n");
  put(uint64_t{3}, uint64_t{3});
  put(6, 2, 2, uint64_t{1});
  put(10, 70, 3, 90);
  put(1, 3, 4, uint64_t{1});
  put(30, 70, 3, 90, 4);
  put(2, 3, 4, uint64_t{1});
  put(20, 3, 90, 4, 5);
  say("\n$EndElements\n");
  return file;
}

TEST(MshSections, OfFormat40AreRead) {
  for (const bool binary : {false, true}) {
    std::vector<std::string> notes;
    Input input = openBytes(openMsh, fileOf40(binary), &notes);
    const SvMesh m = readAll(input);
    EXPECT_EQ(m.positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
    ASSERT_EQ(m.schema.cell_data.size(), 2u);
    EXPECT_EQ(m.cell_data[0], (std::vector<double>{4, 5}));
    EXPECT_EQ(m.cell_data[1], (std::vector<double>{1, 2}));
    EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 9}}));
    EXPECT_TRUE(anyNote(notes, "these are left out: \"gmsh:physical\" 6"));
    expectSurvives(openMsh, fileOf40(binary));
  }
}

// Cells and faces are of the entities that were divided. Faces between parts are none, whether an
// entity lies there, too, or not.
TEST(MshSections, OfPartitionsTellOfTheWhole) {
  const char text[] =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
      "$Entities\n0 0 2 1\n1 0 0 0 1 1 1 1 9 0\n2 0 0 0 1 1 1 1 8 0\n1 0 0 0 1 1 1 1 4 0\n"
      "$EndEntities\n"
      "$PartitionedEntities\n2\n0\n0 0 3 2\n"
      "11 2 1 1 1 0 0 0 1 1 1 1 9 0\n12 3 1 2 1 2 0 0 0 1 1 1 1 4 0\n"
      "13 2 2 1 2 0 0 0 1 1 1 1 8 0\n"
      "21 3 1 1 1 0 0 0 1 1 1 1 4 0\n22 3 1 1 2 0 0 0 1 1 1 1 4 0\n$EndPartitionedEntities\n"
      "$Nodes\n1 5 1 5\n3 21 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
      "$Elements\n5 5 1 5\n2 11 2 1\n1 1 2 3\n2 12 2 1\n2 2 3 4\n2 13 2 1\n3 2 3 4\n"
      "3 21 4 1\n4 1 2 3 4\n3 22 4 1\n5 2 3 4 5\n$EndElements\n";
  std::vector<std::string> notes;
  Input input = openText(openMsh, text, {}, &notes);
  const SvMesh m = readAll(input);
  ASSERT_EQ(m.schema.cell_data.size(), 2u);
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{4, 4}));
  EXPECT_EQ(m.cell_data[1], (std::vector<double>{1, 1}));
  EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 9}, {1, 2, 3, 8}}));
  EXPECT_TRUE(anyNote(notes, "which of the 2 parts of a partition cells are in is left out"));
  EXPECT_TRUE(anyNote(notes, "1 elements between the parts of a partition are left out"));
}

}  // namespace
}  // namespace tetstream
