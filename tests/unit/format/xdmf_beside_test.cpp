// XDMF files with grids beside the mesh that have its points and cells or faces of their own, as
// dolfinx writes labels.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "status.h"
#include "vtu_mesh_testing.h"
#include "xdmf_testing.h"

namespace tetstream {
namespace {

using namespace test;

std::string besideTwoCells(const std::string& name, const std::string& topology,
                           const std::string& values) {
  return xdmfFile(kXdmfTwoCellGrid + xdmfGrid(name, kXdmfSamePoints + topology + values));
}

TEST(XdmfBeside, ACellArrayComesFromAGridOfAllCells) {
  const std::string text = besideTwoCells(
      "cells", xdmfTopology("Tetrahedron", "2 4", "3 2 1 0 1 4 2 3"),  // corners in any order
      xdmfValues("tag", "2 1", "7 -8") + xdmfValues("w", "2 3", "1 2 3 4 5 6.5") +
          xdmfValues("p", "5", "1 2 3 4 5", "Node") + xdmfValues("g", "1", "1", "Grid"));
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", text, step);
    EXPECT_EQ(mesh.cells, kTwoCells);
    ASSERT_EQ(mesh.schema.cell_data.size(), 2u);
    EXPECT_EQ(mesh.schema.cell_data[0].name, "tag");
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{7, -8}));
    EXPECT_EQ(mesh.schema.cell_data[1].components, 3);
    EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), (std::vector<float>{1, 2, 3, 4, 5, 6.5}));
    ASSERT_EQ(mesh.fields.size(), 1u);
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_TRUE(hasNote(mesh, "array \"g\" is left out: it is of Grid"));
  }
}

TEST(XdmfBeside, CellsThatAreNotNamedGetZero) {
  const VtuMesh mesh =
      readAs("xdmf", besideTwoCells("some", xdmfTopology("Tetrahedron", "1 4", "1 2 3 4"),
                                    xdmfValues("tag", "1", "7") + xdmfValues("w", "1 2", "0.5 2")));
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{0, 7}));
  EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), (std::vector<float>{0, 0, 0.5, 2}));
  EXPECT_TRUE(hasNote(mesh, "grid \"some\" names 1 of 2 cells: at the others its arrays are 0"));
}

// Text of which the type is not told; what it is told of and numbers that are not whole stay.
TEST(XdmfBeside, WholeNumbersAreIntegers) {
  const auto column = [](const std::string& values, const std::string& words = "") {
    return readAs("xdmf", besideTwoCells("cells", kXdmfTwoCells,
                                         xdmfValues("tag", "2", values, "Cell", words)))
        .schema.cell_data.at(0)
        .type;
  };
  EXPECT_EQ(column("7 8"), ScalarType::kInt32);
  EXPECT_EQ(column("7.0 8e1"), ScalarType::kInt32);
  EXPECT_EQ(column("2147483647 -2147483648"), ScalarType::kInt32);
  EXPECT_EQ(column("2147483648 0"), ScalarType::kInt64);
  EXPECT_EQ(column("9007199254740992 0"), ScalarType::kInt64);
  EXPECT_EQ(column("9007199254740994 0"), ScalarType::kFloat32);
  EXPECT_EQ(column("7 8.5"), ScalarType::kFloat32);
  EXPECT_EQ(column("7 nan"), ScalarType::kFloat32);
  EXPECT_EQ(column("7 inf"), ScalarType::kFloat32);
  EXPECT_EQ(column("7 8", "NumberType=\"Float\""), ScalarType::kFloat32);
  EXPECT_EQ(column("7 8", "NumberType=\"Float\" Precision=\"8\""), ScalarType::kFloat64);
  EXPECT_EQ(column("7 8", "NumberType=\"Int\" Precision=\"8\""), ScalarType::kInt64);
}

// More stretches of cells than are held in memory, wherever a reading begins.
TEST(XdmfBeside, ScatteredCellsAreReadByRange) {
  constexpr int kCells = 6000;
  std::string points, cells, named, tags, pairs;
  std::vector<int32_t> wanted_tags;
  std::vector<float> wanted_pairs;
  const auto cell = [](int i) {
    std::string text;
    for (int k = 0; k < 4; ++k) text += std::to_string(i + k) + " ";
    return text;
  };
  int rows = 0;
  for (int i = 0; i < kCells + 3; ++i)
    points += std::to_string(i) + " " + std::to_string(i * i % 97) + " " +
              std::to_string(i * i % 89) + "\n";
  for (int i = 0; i < kCells; ++i) {
    cells += cell(i) + "\n";
    const bool is_named = i % 5 != 1 && i % 7 != 3 && (i < 1000 || i > 1900) && i < kCells - 400;
    wanted_tags.push_back(is_named ? 100000 + i : 0);
    wanted_pairs.push_back(is_named ? static_cast<float>(i) + 0.5f : 0);
    wanted_pairs.push_back(is_named ? static_cast<float>(-i) : 0);
    if (!is_named) continue;
    ++rows;
    named += cell(i) + "\n";
    tags += std::to_string(100000 + i) + "\n";
    pairs += std::to_string(i) + ".5 " + std::to_string(-i) + "\n";
  }
  const std::string count = std::to_string(rows);
  const std::string text =
      xdmfFile(xdmfGrid("mesh", xdmfTopology("Tetrahedron", std::to_string(kCells) + " 4", cells) +
                                    xdmfGeometry(std::to_string(kCells + 3) + " 3", points)) +
               xdmfGrid("some", kXdmfSamePoints + xdmfTopology("Tetrahedron", count + " 4", named) +
                                    xdmfValues("tag", count + " 1", tags) +
                                    xdmfValues("pair", count + " 2", pairs)));
  for (const size_t step : {7, 256, 100000}) {
    const VtuMesh mesh = readAs("xdmf", text, step);
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), wanted_tags);
    EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), wanted_pairs);
    EXPECT_TRUE(hasNote(mesh, "names " + count + " of 6000 cells"));
  }
}

TEST(XdmfBeside, SaysWhyAGridIsLeftOut) {
  const auto note = [](const std::string& topology, const std::string& values,
                       const std::string& part) {
    const VtuMesh mesh = readAs("xdmf", besideTwoCells("tags", topology, values));
    EXPECT_TRUE(mesh.schema.cell_data.empty() && mesh.face_labels.empty()) << part;
    EXPECT_TRUE(hasNote(mesh, "grid \"tags\" is left out: " + part))
        << (mesh.notes.empty() ? "no note" : mesh.notes[0]);
  };
  const std::string one = xdmfValues("t", "1", "7"), two = xdmfValues("t", "2", "7 8");
  note(xdmfTopology("Tetrahedron", "1 4", "0 1 2 4"), one, "its cell 0 is none of the mesh, or");
  note(xdmfTopology("Tetrahedron", "2 4", "1 2 3 4 0 1 2 3"), two, "its cell 1 is none of the");
  note(xdmfTopology("Tetrahedron", "2 4", "0 1 2 3 0 1 2 3"), two, "its cell 1 is none of the");
  note(xdmfTopology("Tetrahedron", "0 4", ""), xdmfValues("t", "0", ""), "it has no cells");
  note(xdmfTopology("Triangle", "0 3", ""), xdmfValues("t", "0", ""), "it has no faces");
  note(xdmfTopology("Pyramid", "1 5", "0 1 2 3 4"), one, "its cells are of another type than");
  note(xdmfTopology("Polyline", "2 2", "0 1 1 2"), two,
       "its topology of the type \"Polyline\" is none of cells or of faces of one type");
  note(xdmfTopology("Mixed", "5", "6 0 1 2 3"), one, "its topology of the type \"Mixed\" is");
  note(xdmfTopology("Heptagon", "1 7", "0 1 2 3 4 0 1"), one, "its topology of the type \"Hepta");
  note(xdmfTopology("Tetrahedron", "1 4", "0 1 2 3"), xdmfValues("t", "5", "1 2 3 4 5", "Node"),
       "it has other cells than the mesh, and no array of them");
  const std::string face = xdmfTopology("Triangle", "1 3", "0 1 2");
  for (const char* labels : {"0.5", "nan", "1e30"})
    note(face, xdmfValues("t", "1", labels), "its array \"t\" is no label of faces");
  note(face, xdmfValues("t", "2", "1 2"), "its array \"t\" is no label of faces");
}

// Whose points are in another place have another mesh, unless all of it is equal.
TEST(XdmfBeside, PointsOfItsOwnMakeAnotherMesh) {
  const auto read = [](const std::string& points) {
    return readAs(
        "xdmf", xdmfFile(kXdmfTwoCellGrid +
                         xdmfGrid("other", points + kXdmfTwoCells + xdmfValues("t", "2", "1 2"))));
  };
  const VtuMesh mesh = read(replaced(kXdmfFivePoints, "1 1 1", "1 1 2"));
  EXPECT_TRUE(mesh.schema.cell_data.empty());
  EXPECT_TRUE(hasNote(mesh, "grid \"other\" is left out: it has another mesh"));
  EXPECT_EQ(read(kXdmfFivePoints).schema.cell_data.size(), 1u);
}

TEST(XdmfBeside, TrianglesLabelFaces) {
  const auto grid = [](const std::string& name, const std::string& cells, const std::string& sizes,
                       const std::string& values) {
    return xdmfGrid(name, kXdmfSamePoints + xdmfTopology("Triangle", sizes + " 3", cells) + values);
  };
  const std::string text =
      xdmfFile(kXdmfTwoCellGrid +
               grid("walls", "2 1 0 1 2 4", "2",
                    xdmfValues("w", "2 1", "7 5000000000") + xdmfValues("more", "2", "1 1") +
                        xdmfValues("p", "5", "1 2 3 4 5", "Node")) +
               grid("inner", "3 2 1 0 1 2", "2",
                    xdmfValues("i", "2", "-1 9", "Cell", "NumberType=\"Float\" Precision=\"8\"")));
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", text, step);
    EXPECT_EQ(labelsOfFaces(mesh),
              (LabelsOfFaces{{{0, 1, 2}, 7}, {{1, 2, 4}, 5000000000}, {{1, 2, 3}, -1}}));
    EXPECT_EQ(mesh.schema.face_count, 3);
    EXPECT_TRUE(mesh.schema.cell_data.empty());
    EXPECT_EQ(mesh.schema.fields.size(), 1u);
    EXPECT_TRUE(hasNote(mesh, "grid \"walls\" labels faces"));
    EXPECT_TRUE(hasNote(mesh, "grid \"inner\" labels faces"));
    EXPECT_TRUE(hasNote(mesh, "array \"more\" is left out: the faces of grid \"walls\" are"));
    EXPECT_TRUE(hasNote(mesh, "1 faces are in grids of labels more than once: the first one"));
  }
}

// Two tetrahedra with nodes between their corners; a face of six nodes, and one of three.
TEST(XdmfBeside, CornersAreWhatCounts) {
  const std::string points =
      xdmfGeometry("9 3", "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 .5 0 0 0 .5 0 0 0 .5 .5 .5 0");
  const std::string text =
      xdmfFile(xdmfGrid("mesh", xdmfTopology("Tetrahedron_10", "2 10",
                                             "0 1 2 3 5 5 5 5 5 5 1 2 3 4 6 6 6 6 6 6") +
                                    points) +
               xdmfGrid("cells", kXdmfSamePoints + xdmfTopology("Tetrahedron", "1 4", "4 3 2 1") +
                                     xdmfValues("c", "1", "3")) +
               xdmfGrid("six", kXdmfSamePoints + xdmfTopology("Triangle_6", "1 6", "0 1 2 8 8 8") +
                                   xdmfValues("s", "1", "4")) +
               xdmfGrid("three", kXdmfSamePoints + xdmfTopology("Triangle", "1 3", "0 1 3") +
                                     xdmfValues("t", "1", "5")));
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("xdmf", text, 1000, options);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{0, 3}));
  EXPECT_EQ(labelsOfFaces(mesh), (LabelsOfFaces{{{0, 1, 2}, 4}, {{0, 1, 3}, 5}}));
}

TEST(XdmfBeside, QuadrilateralsAreSplitAsTheirCellsAre) {
  const std::string text = xdmfFile(
      xdmfGrid("mesh", xdmfTopology("Hexahedron", "1 8", "0 1 2 3 4 5 6 7") +
                           xdmfGeometry("8 3", "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1")) +
      xdmfGrid("sides", kXdmfSamePoints + xdmfTopology("Quadrilateral", "2 4", "0 1 2 3 7 6 5 4") +
                            xdmfValues("side", "2", "1 2")) +
      xdmfGrid("cells", kXdmfSamePoints + xdmfTopology("Hexahedron", "1 8", "7 6 5 4 3 2 1 0") +
                            xdmfValues("c", "1", "3")));
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("xdmf", text, 1000, options);
  EXPECT_EQ(labelsOfFaces(mesh),
            (LabelsOfFaces{{{0, 1, 2}, 1}, {{0, 2, 3}, 1}, {{4, 5, 6}, 2}, {{4, 6, 7}, 2}}));
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]),
            std::vector<int32_t>(static_cast<size_t>(mesh.schema.cell_count), 3));
}

// As dolfinx writes it: the mesh, its labels and then functions over time on the mesh.
TEST(XdmfBeside, FacesAreLabelledByNumbersThatAreWholeInFloat64) {
  for (const char* labels : {"16777217.4 2", "9007199254740995 2", "0.5 2"}) {
    const VtuMesh mesh =
        readAs("xdmf", besideTwoCells("walls", xdmfTopology("Triangle", "2 3", "0 1 2 1 2 3"),
                                      xdmfValues("w", "2", labels)));
    EXPECT_TRUE(mesh.face_labels.empty()) << labels;
    EXPECT_TRUE(hasNote(mesh, "is no label of faces: it has not one integer to each")) << labels;
  }
}

TEST(XdmfBeside, BesideAMeshOfSeveralGridsItIsLeftOut) {
  const std::string one = xdmfGrid("a", kXdmfTwoCells + kXdmfFivePoints);
  const VtuMesh mesh =
      readAs("xdmf",
             xdmfFile("<Grid Name=\"all\" GridType=\"Collection\" CollectionType=\"Spatial\">" +
                      one + one + "</Grid>" +
                      xdmfGrid("walls", kXdmfSamePoints + xdmfTopology("Triangle", "1 3", "0 1 2") +
                                            xdmfValues("w", "1", "7"))));
  EXPECT_TRUE(hasNote(mesh, "grid \"walls\" is left out: the mesh is made of several grids"));
}

TEST(XdmfBeside, LabelsStandBesideACollectionOverTime) {
  const std::string include =
      "<xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid[@GridType='Uniform'][1]/*[self::Topology "
      "or self::Geometry])\"/>";
  const auto step = [&](const char* time, const std::string& values) {
    return xdmfGrid(
        "u", include + "<Time Value=\"" + time + "\"/>" + xdmfValues("u", "5", values, "Node"));
  };
  const VtuMesh mesh = readAs(
      "xdmf",
      xdmfFile(kXdmfTwoCellGrid +
               xdmfGrid("cells", kXdmfSamePoints + kXdmfTwoCells + xdmfValues("c", "2", "3 4")) +
               xdmfGrid("walls", kXdmfSamePoints + xdmfTopology("Triangle", "1 3", "0 1 2") +
                                     xdmfValues("w", "1", "7")) +
               xdmfSteps("u", step("0", "1 2 3 4 5") + step("1", "2 3 4 5 6"))));
  EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{2, 3, 4, 5, 6}));
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{3, 4}));
  EXPECT_EQ(labelsOfFaces(mesh), (LabelsOfFaces{{{0, 1, 2}, 7}}));
}

TEST(XdmfBeside, SaysWhichGridIsWrong) {
  const auto failure = [](const std::string& topology, const std::string& values) {
    return failureAs("xdmf", besideTwoCells("tags", topology, values));
  };
  const auto cells = [&](const std::string& sizes, const std::string& text,
                         const std::string& values = xdmfValues("t", "1", "7")) {
    return failure(xdmfTopology("Tetrahedron", sizes, text), values);
  };
  const auto faces = [&](const std::string& sizes, const std::string& text,
                         const std::string& values = xdmfValues("t", "1", "7")) {
    return failure(xdmfTopology("Triangle", sizes, text), values);
  };
  EXPECT_EQ(cells("1 4", "0 1 2 3"), "");
  EXPECT_EQ(faces("1 3", "0 1 2"), "");
  EXPECT_TRUE(has(cells("1 4", "0 1 2 5"), "the values: cell 0 uses point 5, there are 5"));
  EXPECT_TRUE(has(cells("1 4", "0 1 2 -1"), "the values: cell 0 uses point -1, there are 5"));
  EXPECT_TRUE(has(faces("1 3", "0 1 5"), "the values: cell 0 uses point 5, there are 5"));
  EXPECT_TRUE(has(faces("1 3", "0 1 -1"), "the values: cell 0 uses point -1, there are 5"));
  EXPECT_TRUE(has(cells("7", "0 1 2 3 0 1 2"), "are not 4 nodes to a cell"));
  EXPECT_TRUE(has(faces("4", "0 1 2 3"), "are not 3 nodes to a cell"));
  for (const char* many : {"2", "100000", "1000000000000000"}) {
    const std::string rows = many, value = xdmfValues("t", rows, "7");
    EXPECT_TRUE(cells(rows + " 4", "0 1 2 3", value).starts_with("TETSTREAM_BAD_DATA")) << many;
    EXPECT_TRUE(faces(rows + " 3", "0 1 2", value).starts_with("TETSTREAM_BAD_DATA")) << many;
  }
  EXPECT_TRUE(has(cells("1 4", "0 1 2 3", xdmfValues("t", "1", "7 8")), "BAD_DATA"));
  EXPECT_TRUE(has(cells("1 4", "0 1 2 3", xdmfValues("t", "1", "seven")), "BAD_DATA"));
  EXPECT_TRUE(has(faces("1 3", "0 1 2", xdmfValues("t", "1", "")), "BAD_DATA"));
  EXPECT_TRUE(has(faces("2 3", "0 1 2 1 2 3", xdmfValues("t", "3", "7 8 9")),
                  "array \"t\" has 3 values for 2 rows"));
  const std::string floats = "<Topology TopologyType=\"Triangle\">" +
                             xdmfItem("1 3", "0 1 2", "NumberType=\"Float\"") + "</Topology>";
  EXPECT_TRUE(has(failure(floats, xdmfValues("t", "1", "7")), "are no integers"));
}

// A mesh whose own list of cells is shorter than it says is found out by the walk along it, too.
TEST(XdmfBeside, TheMeshMayLie) {
  const std::string lie = xdmfTopology("Tetrahedron", "1000000000 4", "0 1 2 3 1 2 3 4");
  EXPECT_TRUE(failureAs("xdmf", xdmfFile(xdmfGrid("mesh", lie + kXdmfFivePoints) +
                                         xdmfGrid("tags", kXdmfSamePoints + kXdmfTwoCells +
                                                              xdmfValues("t", "2", "7 8"))))
                  .starts_with("TETSTREAM_BAD_DATA"));
}

TEST(XdmfBeside, SurvivesEveryCutAndEveryFlippedBit) {
  const std::string good =
      xdmfFile(kXdmfTwoCellGrid +
               xdmfGrid("some", kXdmfSamePoints + xdmfTopology("Tetrahedron", "1 4", "4 3 2 1") +
                                    xdmfValues("c", "1", "3")) +
               xdmfGrid("walls", kXdmfSamePoints + xdmfTopology("Triangle", "2 3", "0 1 2 1 2 3") +
                                     xdmfValues("w", "2", "7 8")));
  expectXdmfSurvives(good);
}

}  // namespace
}  // namespace tetstream
