// Sections of Gmsh's files that are there in other forms, or again.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tetstream
