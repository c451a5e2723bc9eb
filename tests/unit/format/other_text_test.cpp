// SU2's and TetGen's meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "indexed_testing.h"
#include "su2_format.h"
#include "tetgen_format.h"

namespace tetstream {
namespace {

using namespace test;

const char kSu2[] =
    "% two zones\nNZONE=2\nIZONE=1\nNDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4\n0 0 0 0\n"
    "1 0 0 1\n0 1 0 2\n0 0 1 3\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n5 0 1 2\n"
    "IZONE= 2\nNDIME= 3\nNELEM= 1\n10 0 1 2 3 0\nNPOIN= 4 4\n5 0 0 0\n6 0 0 1\n5 1 0 2\n5 0 1 3\n"
    "NMARK= 2\nMARKER_TAG= inlet\nMARKER_ELEMS= 1\n5 1 2 3\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n"
    "5 0 1 2\n";

TEST(Su2, ReadsZonesAndMarkers) {
  Input input = openText(openSu2, kSu2);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  EXPECT_EQ(m.positions[12], 5);
  EXPECT_EQ(m.cell_data[0], (std::vector<double>{1, 2}));
  EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 1}, {5, 6, 7, 2}, {4, 5, 6, 1}}));
  EXPECT_EQ(input.schema().label_names,
            (std::vector<LabelName>{{"", 1, "wall"}, {"", 2, "inlet"}}));
}

TEST(Su2, ReadsTextBehindAByteOrderMark) {
  std::vector<std::string> notes;
  Input input = openText(openSu2, std::string("\xef\xbb\xbf") + (kSu2 + 12), {}, &notes);
  EXPECT_EQ(readAll(input).cells.size(), 2u);
  EXPECT_FALSE(anyNote(notes, "is left out"));
  EXPECT_EQ(problemOf(openSu2, "\xef\xbb"), "mesh: line 1: \"??\" where NAME= should be");
}

// Of a mesh for shape optimisation; rows of the box name markers.
TEST(Su2, LeavesOutBoxes) {
  std::vector<std::string> notes;
  const std::string boxes =
      "NPERIODIC= 1\nPERIODIC_INDEX= 0\n0.0 0.0 0.0\n-1 +2 .5\nFFD_NBOX = 1\nFFD_TAG= MAIN_BOX\n"
      "FFD_CORNER_POINTS= 2\n0.1 0 0\n1 0 1\nFFD_SURFACE_POINTS= 2\nwall 0 0.1 0.2 0.3\n"
      "wall=left 1 0.1 0.2 0.3\nFFD_PARENTS= 0\n";
  Input input = openText(openSu2, boxes + (kSu2 + 12) + boxes, {}, &notes);
  EXPECT_EQ(readAll(input).cells.size(), 2u);
  EXPECT_TRUE(anyNote(notes, "boxes for shape optimisation"));
  EXPECT_TRUE(anyNote(notes, "what PERIODIC_INDEX= says is left out"));
}

TEST(Su2, SaysWhatIsWrongAndWhere) {
  const struct {
    std::string text, problem;
  } cases[] = {
      {"", "no section NPOIN="},
      {"NDIME= 2\n", "dimension 2"},
      {"NDIME= 3\nNELEM= 1152921504606846976\n", "cannot be in the"},
      {"NDIME= 3\nNELEM= 1\n10 0 1 2 4\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
       "uses point 4, but there are 4"},
      {"NDIME= 3\nNELEM= 1\n12 0 1 2 3 4 5 6 7 0\n", "cell 0 is a hexahedron"},
      {"NDIME= 3\nNELEM= 1\n77 0 1\n", "element of type 77"},
  };
  for (const auto& c : cases)
    EXPECT_NE(problemOf(openSu2, c.text).find(c.problem), std::string::npos)
        << problemOf(openSu2, c.text) << "\nwanted: " << c.problem;
}

TEST(Su2, SurvivesEveryCutAndEveryFlippedBit) {
  expectSurvives(openSu2, bytesOf(kSu2));
}

class Tetgen : public testing::Test {
 protected:
  Tetgen() : folder_(std::filesystem::temp_directory_path() / "tetstream_tetgen.XXXXXX") {
    EXPECT_NE(::mkdtemp(folder_.data()), nullptr);
  }
  ~Tetgen() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* extension) const { return folder_ + "/m" + extension; }
  void put(const char* extension, const std::string& text) const {
    std::ofstream(path(extension)) << text;
  }
  Input open(const char* extension = ".ele", std::vector<std::string>* notes = nullptr) const {
    ReadOptions options;
    options.path = path(extension);
    if (notes) options.note = [notes](const std::string& note) { notes->push_back(note); };
    return openTetgen(openFile(options.path), options);
  }
  std::string problem() const {
    try {
      open();
    } catch (const Error& error) {
      return error.text();
    }
    return "";
  }

 private:
  std::string folder_;
};

TEST_F(Tetgen, ReadsPointsCellsAndFacesFromZeroOrOne) {
  for (int base : {0, 1}) {
    const auto n = [base](int number) { return std::to_string(number + base) + " "; };
    put(".node", "# points\n4 3 1 1\n" + n(0) + "0 0 0 0.5 0\n" + n(1) + "1 0 0 1.5 3\n" + n(2) +
                     "0 1 0 2.5 0\n" + n(3) + "0 0 1 3.5 0\n");
    put(".ele", "1 4 2\n" + n(0) + n(0) + n(1) + n(2) + n(3) + "8 0.25\n");
    put(".face", "2 1\n" + n(0) + n(0) + n(1) + n(2) + "5\n" + n(1) + n(1) + n(2) + n(3) + "0\n");
    for (const char* extension : {".ele", ".node"}) {
      std::vector<std::string> notes;
      Input input = open(extension, &notes);
      const SvMesh m = readAll(input);
      EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}}));
      ASSERT_EQ(m.fields.size(), 2u);
      EXPECT_EQ(m.schema.fields[0].name, "marker");
      EXPECT_EQ(m.fields[0], (std::vector<double>{0, 3, 0, 0}));
      EXPECT_EQ(m.fields[1], (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
      ASSERT_EQ(m.cell_data.size(), 2u);
      EXPECT_EQ(m.schema.cell_data[0].name, "region");
      EXPECT_EQ(m.schema.cell_data[0].type, ScalarType::kInt32);
      EXPECT_EQ(m.cell_data[0], (std::vector<double>{8}));
      EXPECT_EQ(m.cell_data[1], (std::vector<double>{0.25}));
      EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 5}}));
      EXPECT_TRUE(anyNote(notes, "1 faces whose marker is 0"));
    }
  }
}

// As TetGen itself, and several of its users' programs that write markers without telling of them.
TEST_F(Tetgen, PassesOverWhatLinesHaveBeyondTheirHeader) {
  put(".node", "4 3 1 0\n0 0 0 0 0.5 7 # first\n1 1 0 0 1.5 7\n2 0 1 0 2.5\n3 0 0 1 3.5 7 8\n");
  put(".ele", "2 4 0\n0 0 1 2 3 -1 1\n1 0 1 2 3 -1 1\n");
  std::vector<std::string> notes;
  Input input = open(".ele", &notes);
  const SvMesh m = readAll(input);
  EXPECT_EQ(m.cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}, {0, 1, 2, 3}}));
  ASSERT_EQ(m.fields.size(), 1u);
  EXPECT_EQ(m.fields[0], (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  EXPECT_TRUE(anyNote(notes, "m.node: what each line has at its end is left out: 1 more than"));
  EXPECT_TRUE(anyNote(notes, "m.ele what each line has at its end is left out: 2 more than"));
  put(".node", "4 3 1 0\n0 0 0 0 0.5 7\n1 1 0 0\n2 0 1 0 2.5 7\n3 0 0 1 3.5 7\n");
  EXPECT_NE(problem().find("m.node: line "), std::string::npos) << problem();
}

// As tetgen -o2 writes them, and with -nn, by which cells follow the marker; three nodes are those
// of a face of first order, however many cells have.
TEST_F(Tetgen, ReadsMarkersBehindTheNodesOfFacesOfSecondOrder) {
  std::string nodes = "10 3 0 0\n";
  for (const char* point :
       {"0 0 0", "2 0 0", "0 2 0", "0 0 2", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"})
    nodes += std::to_string(std::count(nodes.begin(), nodes.end(), '\n')) + " " + point + "\n";
  put(".node", nodes);
  put(".ele", "1 10 0\n1 1 2 3 4 9 10 8 6 7 5\n");
  for (const char* rows :
       {"  1  1 2 3 6 7 5  14\n 2 2 3 4 10 9 6 0\n",
        "\n# faces\n1 1 2 3 6 7 5 14 1 -1\n2 2 3 4 10 "
        "9 6 0 1 -1 # the last\n",
        "1 1 2 3 14\r\n2 2 3 4 0\r\n", "1\t1 2 3 14 1 -1 # of\n2 2 3 4 0 1 -1\n"}) {
    put(".face", std::string("2 1\n") + rows);
    std::vector<std::string> notes;
    Input input = open(".ele", &notes);
    EXPECT_EQ(readAll(input).cells, (std::vector<std::array<int64_t, 4>>{{0, 1, 2, 3}})) << rows;
    EXPECT_EQ(facesOf(input), (std::vector<TestFace>{{0, 1, 2, 14}})) << rows;
    EXPECT_TRUE(anyNote(notes, "1 faces whose marker is 0")) << rows;
  }
  put(".face", "1 1\n1 1 2 3 6 7 11 14\n");
  EXPECT_NE(problem().find("m.face: line 2: a corner of a cell is 11"), std::string::npos)
      << problem();
}

TEST_F(Tetgen, SaysWhatIsWrongAndWhere) {
  put(".node", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n");
  put(".ele", "1 4 0\n1 1 2 3 5\n");
  EXPECT_NE(problem().find("m.ele: line 2: a corner of a cell is 5, not 1 to 4"), std::string::npos)
      << problem();
  put(".ele", "1152921504606846976 4 0\n");
  EXPECT_NE(problem().find("cells cannot be in the"), std::string::npos) << problem();
  put(".node", "2 3 0 0\n1 0 0 0\n3 1 0 0\n");
  EXPECT_NE(problem().find("m.node: line 3: point 3"), std::string::npos) << problem();
  std::filesystem::remove(path(".node"));
  EXPECT_NE(problem().find("m.node: cannot open"), std::string::npos) << problem();
}

TEST_F(Tetgen, IsNotReadWithoutAName) {
  EXPECT_NE(problemOf(openTetgen, "1 4 0\n").find("two files"), std::string::npos);
}

}  // namespace
}  // namespace tetstream
