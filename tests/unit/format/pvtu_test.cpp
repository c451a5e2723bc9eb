// Meshes in pieces, each a .vtu file: which of their points are one.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "status.h"
#include "vtu_encode.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

class Pvtu : public ::testing::Test {
 protected:
  Pvtu() {
    std::string name = ::testing::TempDir() + "tetstream-pvtu.XXXXXX";
    if (!::mkdtemp(name.data())) std::abort();
    folder_ = name;
  }
  ~Pvtu() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }

  // One file per piece and the one that names them.
  void writePieces(const std::vector<VtuTestPiece>& pieces) const {
    std::string text = "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid GhostLevel='0'>";
    for (size_t i = 0; i < pieces.size(); ++i) {
      const std::string name = "part_" + std::to_string(i) + ".vtu";
      write(name, makeVtu({pieces[i]}, {VtuCoding::kAppendedRaw}));
      text += "<Piece Source='" + name + "'/>";
    }
    write("all.pvtu", text + "</PUnstructuredGrid></VTKFile>");
  }

  VtuMesh read(size_t step = 1000) const {
    return readMesh(openFile(path("all.pvtu")), *findFormat("pvtu"), step);
  }

  std::vector<int64_t> origins() const {
    const Input input = findFormat("pvtu")->open(openFile(path("all.pvtu")), {});
    std::vector<int64_t> origins(static_cast<size_t>(input.schema().vertex_count));
    input.indexed->readOrigins(0, origins.size(), origins.data());
    return input.indexed->hasOrigins() ? origins : std::vector<int64_t>{};
  }

  std::string failure() const {
    try {
      read();
    } catch (const Error& error) {
      return error.text();
    }
    return "";
  }

 private:
  std::string folder_;
};

// A tetrahedron at x with one corner further on, so that the next one, mirrored, shares three.
VtuTestPiece onePiece(double tip, int64_t first_id, bool ids) {
  VtuTestPiece piece = twoCellPiece();
  piece.points = 4;
  piece.cells = 1;
  piece.points_element[0].reals = {-0.0, 0, 0, 0, 1, 0, 0, 0, 1, tip, 0, 0};
  piece.point_data[0].reals = {1, 2, 3, 4};
  piece.cells_element[0].integers = {0, 1, 2, 3};
  piece.cells_element[1].integers = {4};
  piece.cells_element[2].integers = {10};
  piece.cell_data[0].integers = {first_id};
  if (ids) piece.point_data.push_back({"Int64", "GlobalPointIds", 1, {}, {10, 11, 12, first_id}});
  return piece;
}

TEST_F(Pvtu, JoinsPointsWithTheSameCoordinates) {
  VtuTestPiece second = onePiece(1, 5, false);
  second.points_element[0].reals[0] = 0;  // and not -0
  writePieces({onePiece(-1, 4, false), second});
  for (const size_t step : {1, 2, 1000}) {
    const VtuMesh mesh = read(step);
    EXPECT_EQ(mesh.schema.vertex_count, 5);
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 0, 1, 2, 4}));
    EXPECT_EQ(valuesAs<double>(mesh.positions),
              (std::vector<double>{0, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 1, 0, 0}));
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 4}));
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_NE(mesh.notes[0].find("3 points were joined"), std::string::npos) << mesh.notes[0];
    EXPECT_NE(mesh.notes[0].find("coordinates"), std::string::npos);
  }
}

// As whoever appends the points of one piece to those of the other would number them: of those that
// were joined by the first one.
TEST_F(Pvtu, PointsAreNamedAsThePiecesHaveThem) {
  VtuTestPiece third = onePiece(1, 6, false);
  third.points_element[0].reals[1] = 3;
  writePieces({onePiece(-1, 4, false), onePiece(1, 5, false), third});
  EXPECT_EQ(read().cells, (std::vector<int64_t>{0, 1, 2, 3, 0, 1, 2, 4, 5, 1, 2, 4}));
  EXPECT_EQ(origins(), (std::vector<int64_t>{0, 1, 2, 3, 7, 8}));
}

TEST_F(Pvtu, BelievesGlobalIdsMoreThanCoordinates) {
  VtuTestPiece second = onePiece(1, 5, true);
  second.points_element[0].reals[1] = 1e-9;  // not quite the same place
  second.point_data[1].integers[2] = 99;     // the same place, but another point
  writePieces({onePiece(-1, 4, true), second});
  const VtuMesh mesh = read();
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 0, 1, 4, 5}));
  EXPECT_NE(mesh.notes[0].find("2 points were joined"), std::string::npos) << mesh.notes[0];
}

TEST_F(Pvtu, LeavesSlitsOpen) {
  VtuTestPiece first = onePiece(-1, 4, false);
  first.points = 5;  // point 4 lies where point 0 lies
  first.points_element[0].reals.insert(first.points_element[0].reals.end(), {0, 0, 0});
  first.point_data[0].reals.push_back(5);
  writePieces({first, onePiece(1, 5, false)});
  const VtuMesh mesh = read();
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 5, 1, 2, 6}));
  ASSERT_EQ(mesh.notes.size(), 2u);
  EXPECT_NE(mesh.notes[1].find("at 1 places pieces are not joined"), std::string::npos);
}

// As Chaste writes halos: both pieces have the second cell, with its corners in another order, and
// nothing says so. Cells of one piece are as the file has them.
TEST_F(Pvtu, TakesCellsOfSeveralPiecesOnce) {
  VtuTestPiece second = twoCellPiece();
  second.points_element[0].reals = {0, 1, 0, 1, 0, 0, 0, 0, 1, 1, 1, 0.1, 2, 2, 2};
  second.cells_element[0].integers = {1, 2, 0, 3, 0, 1, 3, 4};
  second.cell_data[0].integers = {70, 71};
  for (const size_t copies : {1, 2}) {
    std::vector<VtuTestPiece> pieces = {twoCellPiece()};
    pieces.insert(pieces.end(), copies, second);
    writePieces(pieces);
    for (const size_t step : {1, 2, 1000}) {
      const VtuMesh mesh = read(step);
      EXPECT_EQ(mesh.schema.vertex_count, 6);
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4, 2, 1, 4, 5}));
      EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{7, -7, 71}));
      ASSERT_EQ(mesh.notes.size(), 2u);
      const std::string wanted =
          std::to_string(2 * copies - 1) + " cells that an earlier piece has";
      EXPECT_NE(mesh.notes[1].find(wanted), std::string::npos) << mesh.notes[1];
    }
  }
  VtuTestPiece first = twoCellPiece();
  first.cells_element[0].integers = {1, 2, 3, 4, 1, 2, 3, 4};
  second.cells_element[0].integers = {0, 1, 3, 4, 0, 2, 3, 4};
  writePieces({first, second});
  EXPECT_EQ(read().schema.cell_count, 4);
  EXPECT_EQ(read().notes.size(), 1u);
}

TEST_F(Pvtu, ReadsMorePiecesThanMayBeOpenAtOnce) {
  std::vector<VtuTestPiece> pieces;
  for (int i = 0; i < 70; ++i) pieces.push_back(onePiece(i + 1, 100 + i, true));
  writePieces(pieces);
  const VtuMesh mesh = read();
  EXPECT_EQ(mesh.schema.cell_count, 70);
  EXPECT_EQ(mesh.schema.vertex_count, 73);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0])[69], 169);
}

TEST_F(Pvtu, NamesThePieceThatIsMissingOrBroken) {
  writePieces({onePiece(-1, 4, false), onePiece(1, 5, false)});
  write("part_1.vtu", "<VTKFile type='PolyData'/>");
  EXPECT_NE(failure().find("part_1.vtu: byte 0: the file holds \"PolyData\""), std::string::npos)
      << failure();
  std::filesystem::remove(path("part_1.vtu"));
  EXPECT_NE(failure().find("part_1.vtu: cannot open: "), std::string::npos) << failure();
  write("all.pvtu", "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid/></VTKFile>");
  EXPECT_NE(failure().find("there is no <Piece>"), std::string::npos) << failure();
  write("all.pvtu", "<VTKFile type='UnstructuredGrid'/>");
  EXPECT_NE(failure().find("no PUnstructuredGrid"), std::string::npos) << failure();
  write("all.pvtu",
        "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece/></PUnstructuredGrid>");
  EXPECT_NE(failure().find("a piece has no Source"), std::string::npos) << failure();
}

}  // namespace
}  // namespace tetstream
