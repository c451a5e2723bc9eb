// Files with cells that are not linear tetrahedra, or with ghosts.
#include <gtest/gtest.h>

#include "status.h"
#include "vtu_encode.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

// Five points; a triangle, a tetrahedron, a line, a vertex, another tetrahedron.
VtuTestPiece mixedPiece() {
  VtuTestPiece piece = twoCellPiece();
  piece.cells = 5;
  piece.cells_element[0].integers = {0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 4};
  piece.cells_element[1].integers = {3, 7, 9, 10, 14};
  piece.cells_element[2].integers = {5, 10, 3, 1, 10};
  piece.cell_data[0].integers = {100, 101, 102, 103, 104};
  return piece;
}

bool hasNote(const VtuMesh& mesh, const std::string& text) {
  for (const std::string& note : mesh.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

const std::vector<VtuStyle> kStyles = {{}, {VtuCoding::kAppendedRaw}, {VtuCoding::kInline, true}};

TEST(MixedCells, KeepTheTetrahedraWithTheirDataAndTellOfTheOthers) {
  for (const VtuStyle& style : kStyles)
    for (const size_t step : {1, 2, 1000}) {
      const VtuMesh mesh =
          readVtu(makeVtu({mixedPiece(), twoCellPiece(), mixedPiece()}, style), step);
      EXPECT_EQ(mesh.schema.cell_count, 6);
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1,  2,  3,  4,  5,  6,  7,  8,
                                                  6, 7, 8, 9, 10, 11, 12, 13, 11, 12, 13, 14}));
      const std::vector<int32_t> labels = valuesAs<int32_t>(mesh.cell_data[0]);
      EXPECT_EQ(labels[0], 101);
      EXPECT_EQ(labels[1], 104);
      EXPECT_EQ(labels[5], 104);
      EXPECT_TRUE(hasNote(mesh, "2 triangles are labelled faces"));
      EXPECT_TRUE(hasNote(mesh, "4 cells of lower dimension are left out"));
    }
}

TEST(MixedCells, TakeTheCornersOfCurvedTetrahedra) {
  VtuTestPiece piece = twoCellPiece();
  piece.cells = 1;
  piece.cells_element[0].integers = {3, 2, 1, 0, 4, 4, 4, 4, 4, 4};
  piece.cells_element[1].integers = {10};
  piece.cells_element[2].integers = {24};
  piece.cell_data[0].integers = {7};
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{3, 2, 1, 0}));
  EXPECT_TRUE(hasNote(mesh, "1 cells of higher order are read by their corners"));
}

TEST(MixedCells, NameTheFirstCellThatIsNoTetrahedronAndItsType) {
  VtuTestPiece piece = mixedPiece();
  piece.cells_element[2].integers[3] = 14;
  const std::string text = vtuFailure(makeVtu({piece}, {}));
  EXPECT_TRUE(
      text.starts_with("TETSTREAM_UNSUPPORTED: test.vtu: cell 3 has VTK's type 14, "
                       "a pyramid"))
      << text;
}

// A voxel, a wedge, a tetrahedron between them and a line; a square of the voxel is a face.
VtuTestPiece shapesPiece() {
  VtuTestPiece piece = twoCellPiece();
  piece.points = 12;
  piece.points_element[0].reals = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1,
                                   0, 1, 1, 1, 1, 1, 2, 0, 0, 2, 0, 1, 0, 2, 0, 3, 3, 3};
  piece.point_data[0].reals.assign(12, 0);
  piece.cells = 5;
  piece.cells_element[0].integers = {0,  1, 2, 3, 4, 5, 6, 7, 8, 11, 2, 3,
                                     10, 6, 1, 3, 8, 5, 7, 9, 0, 1,  2, 3};
  piece.cells_element[1].integers = {8, 10, 14, 20, 24};
  piece.cells_element[2].integers = {11, 3, 10, 13, 8};
  piece.cell_data[0].integers = {100, 101, 102, 103, 104};
  return piece;
}

TEST(MixedCells, AreSplitIfAskedForAndTheirPartsHaveTheirData) {
  ReadOptions options;
  options.split = true;
  for (const VtuStyle& style : kStyles)
    for (const size_t step : {1, 2, 4, 1000}) {
      const VtuMesh mesh =
          readVtu(makeVtu({shapesPiece(), twoCellPiece(), shapesPiece()}, style), step, options);
      ASSERT_EQ(mesh.schema.cell_count, 22);
      EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]),
                (std::vector<int32_t>{100, 100, 100, 100, 100, 100, 102, 103, 103, 103, 7,
                                      -7,  100, 100, 100, 100, 100, 100, 102, 103, 103, 103}));
      // The square from its lowest corner; its label goes to both triangles.
      EXPECT_EQ(std::vector<int64_t>(mesh.faces.begin(), mesh.faces.begin() + 6),
                (std::vector<int64_t>{0, 1, 3, 0, 3, 2}));
      EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{104, 104, 104, 104}));
      EXPECT_TRUE(hasNote(mesh, "4 cells that are no tetrahedra are split into them"));
      EXPECT_TRUE(hasNote(mesh, "2 cells of lower dimension are left out"));
    }
  EXPECT_NE(vtuFailure(makeVtu({shapesPiece()}, {}))
                .find("type 11, a voxel; only tetrahedra are "
                      "read, unless other cells are to be "
                      "split into them (option split"),
            std::string::npos);
}

// VTK's linear wedges, unlike hexahedra and pyramids, have their first face turned outwards.
TEST(MixedCells, OfAnyShapeBecomeTetrahedraOfPositiveVolume) {
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readVtu(makeVtu({shapesPiece()}, {}), 1000, options);
  const auto labels = valuesAs<int32_t>(mesh.cell_data[0]);
  const std::vector<double> places = shapesPiece().points_element[0].reals;
  double volumes[2] = {0, 0};  // of the voxel and the wedge
  for (size_t c = 0; c < labels.size(); ++c) {
    if (labels[c] != 100 && labels[c] != 103) continue;
    const double volume = signedVolume(places, &mesh.cells[4 * c]);
    EXPECT_GT(volume, 0) << labels[c];
    volumes[labels[c] == 103] += volume;
  }
  EXPECT_NEAR(volumes[0], 1, 1e-12);
  EXPECT_NEAR(volumes[1], 0.5, 1e-12);
}

TEST(MixedCells, OfHigherOrderAreSplitByTheirCorners) {
  ReadOptions options;
  options.split = true;
  const struct {
    int64_t type, points, tetrahedra;
  } cases[] = {{25, 20, 6}, {26, 15, 3}, {27, 13, 2}, {29, 27, 6}, {37, 19, 2}, {72, 30, 6}};
  for (const auto& c : cases) {
    VtuTestPiece piece = shapesPiece();
    piece.cells = 1;
    piece.cells_element[0].integers = {0, 1, 3, 2, 4, 5, 7, 6};
    piece.cells_element[0].integers.resize(static_cast<size_t>(c.points), 11);
    piece.cells_element[1].integers = {c.points};
    piece.cells_element[2].integers = {c.type};
    piece.cell_data[0].integers = {7};
    const VtuMesh mesh = readVtu(makeVtu({piece}, {}), 1000, options);
    EXPECT_EQ(mesh.schema.cell_count, c.tetrahedra) << c.type;
    EXPECT_TRUE(hasNote(mesh, "1 cells of higher order are read by their corners")) << c.type;
    if (c.type >= 68) continue;  // of any number of points
    piece.cells_element[0].integers.push_back(1);
    ++piece.cells_element[1].integers[0];
    try {
      readVtu(makeVtu({piece}, {}), 1000, options);
      ADD_FAILURE() << c.type;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.text()).find("with a wrong number of points"), std::string::npos);
    }
  }
}

TEST(MixedCells, LeaveGhostsOutWithTheirMarks) {
  VtuTestPiece piece = mixedPiece();
  piece.cell_data.push_back({"UInt8", "vtkGhostType", 1, {}, {0, 1, 0, 0, 4}});
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{1, 2, 3, 4}));
  ASSERT_EQ(mesh.schema.cell_data.size(), 1u);
  EXPECT_TRUE(hasNote(mesh, "1 ghost cells"));
}

TEST(MixedCells, RefuseWrongOffsetsAndPoints) {
  const struct {
    std::vector<int64_t> connectivity, offsets;
    const char* says;
  } cases[] = {
      {{0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 5}, {3, 7, 9, 10, 14}, "cell 4 uses point 5"},
      {{0, 1, 2, 0, -1, 2, 3, 0, 1, 4, 1, 2, 3, 4}, {3, 7, 9, 10, 14}, "cell 1 uses point -1"},
      {{0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 4}, {3, 2, 9, 10, 14}, "cell 1 has a wrong offset"},
      {{0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 4}, {3, 7, 19, 10, 14}, "cell 2 has a wrong"},
      {{0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 4}, {3, 6, 9, 10, 14}, "cell 1 is a tetrahedron w"},
      {{0, 1, 2, 0, 1, 2, 3, 0, 1, 4, 1, 2, 3, 4}, {3, 7, 9, 10, -4}, "cell 4 has a wrong offset"},
      {{0, 1, 2, 0, 1, 2, 3}, {3, 7, 9, 10, 14}, "test.vtu: array \"connectivity\""},
  };
  for (const auto& c : cases) {
    VtuTestPiece piece = mixedPiece();
    piece.cells_element[0].integers = c.connectivity;
    piece.cells_element[1].integers = c.offsets;
    for (const VtuStyle& style : kStyles) {
      const std::string text = vtuFailure(makeVtu({piece}, style));
      EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.vtu: ")) << text;
      EXPECT_NE(text.find(c.says), std::string::npos) << c.says << ": " << text;
    }
  }
}

}  // namespace
}  // namespace tetstream
