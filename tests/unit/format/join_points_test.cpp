// Points at the same place that become one: where each cell has points of its own, by itself, and
// anywhere else if that is asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "gmsh_format.h"
#include "indexed_testing.h"
#include "medit_format.h"
#include "meshes.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream::test {
namespace {

ReadOptions joining(PointJoining join) {
  ReadOptions options;
  options.join = join;
  return options;
}

// Each cell with points of its own, moved by `noise`; "f" is x + 2y + 3z there, plus 1 or minus 1
// for cells in turn, of which a mean says nothing; "id" is the number of the grid's vertex.
VtuTestPiece apart(const SmallMesh& mesh, const std::string& type, double noise = 0) {
  VtuTestPiece piece;
  std::vector<double> places, f, velocity;
  std::vector<int64_t> names, ends, types, ids;
  for (size_t i = 0; i < mesh.cells.size(); ++i) {
    const auto v = static_cast<size_t>(mesh.cells[i]);
    for (size_t k = 0; k < 3; ++k) {
      const double away = noise * (static_cast<double>((i * 7 + k * 3) % 5) - 2);
      places.push_back(mesh.positions[3 * v + k] / 3 + away);
      velocity.push_back(mesh.positions[3 * v + k]);
    }
    f.push_back(mesh.field[v] + (i % 2 == 0 ? 1 : -1));
    ids.push_back(mesh.cells[i]);
    names.push_back(static_cast<int64_t>(i));
    if (i % 4 == 3) ends.push_back(static_cast<int64_t>(i + 1)), types.push_back(10);
  }
  piece.points = mesh.cells.size();
  piece.cells = mesh.cellCount();
  piece.points_element = {{type, "Points", 3, places, {}}};
  piece.point_data = {{"Float64", "f", 1, f, {}},
                      {"Float32", "velocity", 3, velocity, {}},
                      {"Int32", "id", 1, {}, ids}};
  piece.cells_element = {{"Int64", "connectivity", 1, {}, names},
                         {"Int64", "offsets", 1, {}, ends},
                         {"UInt8", "types", 1, {}, types}};
  return piece;
}

// Whether the mesh is the grid: every cell names the grid's vertices, one point to each.
void expectGrid(const VtuMesh& read, const SmallMesh& grid) {
  ASSERT_EQ(read.schema.vertex_count, static_cast<int64_t>(grid.vertexCount()));
  ASSERT_EQ(read.cells.size(), grid.cells.size());
  const std::vector<int32_t> ids = valuesAs<int32_t>(read.fields[2]);
  for (size_t i = 0; i < grid.cells.size(); ++i)
    ASSERT_EQ(ids[static_cast<size_t>(read.cells[i])], grid.cells[i]);
  const std::vector<float> velocity = valuesAs<float>(read.fields[1]);
  for (size_t p = 0; p < ids.size(); ++p)
    for (size_t k = 0; k < 3; ++k)
      ASSERT_FLOAT_EQ(velocity[3 * p + k],
                      static_cast<float>(grid.positions[3 * static_cast<size_t>(ids[p]) + k]));
}

TEST(JoinPoints, CellsThatAreApartAreJoinedByThemselves) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  for (const char* type : {"Float32", "Float64"})
    for (const size_t step : {1, 7, 1000}) {
      const VtuMesh mesh = readVtu(makeVtu({apart(grid, type)}, {}), step);
      expectGrid(mesh, grid);
      EXPECT_TRUE(hasNote(mesh, "516 of 576 points were joined with others at the same place"));
    }
  const VtuMesh kept =
      readVtu(makeVtu({apart(grid, "Float64")}, {}), 1000, joining(PointJoining::kNo));
  EXPECT_EQ(kept.schema.vertex_count, 576);
  EXPECT_TRUE(kept.notes.empty());
}

TEST(JoinPoints, FieldsAreMeans) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece piece = apart(grid, "Float64");
  piece.point_data[0].reals[0] = std::nan("");
  const VtuMesh mesh = readVtu(makeVtu({piece}, {VtuCoding::kAppendedRaw}));
  std::vector<double> sums(grid.vertexCount()), counts(grid.vertexCount());
  for (size_t i = 1; i < grid.cells.size(); ++i) {  // what is no number does not count
    sums[static_cast<size_t>(grid.cells[i])] += piece.point_data[0].reals[i];
    ++counts[static_cast<size_t>(grid.cells[i])];
  }
  const std::vector<double> f = valuesAs<double>(mesh.fields[0]);
  const std::vector<int32_t> ids = valuesAs<int32_t>(mesh.fields[2]);
  for (size_t p = 0; p < f.size(); ++p) {
    const auto v = static_cast<size_t>(ids[p]);
    EXPECT_NEAR(f[p], sums[v] / counts[v], 1e-12) << v;
  }
}

// As a program has them that computes each cell's corners by themselves.
TEST(JoinPoints, PlacesMayDifferByRounding) {
  const SmallMesh grid = gridMesh(9, 9, 9);
  for (const double noise : {1e-16, 2e-15})
    for (const double first : {0.0, 0x1p-40})  // across a line of the grid, all with some
      for (const double all : {0.0, 1e-16}) {
        VtuTestPiece piece = apart(grid, "Float64", noise);
        for (size_t i = 0; i < piece.points_element[0].reals.size(); ++i)
          piece.points_element[0].reals[i] += first + all * static_cast<double>(i % 7);
        expectGrid(readVtu(makeVtu({piece}, {VtuCoding::kAppendedRaw})), grid);
      }
  const VtuMesh far = readVtu(makeVtu({apart(grid, "Float64", 1e-6)}, {VtuCoding::kAppendedRaw}));
  EXPECT_GT(far.schema.vertex_count, static_cast<int64_t>(2 * grid.vertexCount()));
}

TEST(JoinPoints, OfPiecesEachWithCellsApart) {
  SmallMesh grid = gridMesh(3, 4, 2);
  const VtuTestPiece whole = apart(grid, "Float64");
  const VtuMesh mesh = readVtu(makeVtu({whole, whole}, {}));
  EXPECT_EQ(mesh.schema.vertex_count, static_cast<int64_t>(grid.vertexCount()));
  EXPECT_EQ(mesh.schema.cell_count, static_cast<int64_t>(2 * grid.cellCount()));
}

// The legacy format has the number of its points before each cell.
TEST(JoinPoints, OfLegacyFiles) {
  const SmallMesh grid = gridMesh(2, 2, 2);
  std::string file =
      "# vtk DataFile Version 3.0\napart\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
      std::to_string(grid.cells.size()) + " double\n";
  std::string cells, types;
  for (size_t i = 0; i < grid.cells.size(); ++i) {
    const double* at = &grid.positions[3 * static_cast<size_t>(grid.cells[i])];
    file += textOf("%g %g %g\n", at[0], at[1], at[2]);
    cells += (i % 4 == 0 ? "\n4 " : " ") + std::to_string(i);
    if (i % 4 == 0) types += "10\n";
  }
  file += textOf("CELLS %zu %zu", grid.cellCount(), 5 * grid.cellCount()) + cells +
          "\nCELL_TYPES " + std::to_string(grid.cellCount()) + "\n" + types;
  const VtuMesh mesh = readAs("vtk", file);
  EXPECT_EQ(mesh.schema.vertex_count, static_cast<int64_t>(grid.vertexCount()));
  EXPECT_EQ(mesh.schema.cell_count, static_cast<int64_t>(grid.cellCount()));
}

// Before they are split, so that the tetrahedra of neighbours agree on the face between them.
TEST(JoinPoints, CellsThatAreSplitAgree) {
  constexpr int kSide = 3;
  VtuTestPiece piece;
  std::vector<double> places;
  std::vector<int64_t> names, ends, types;
  for (int cell = 0; cell < kSide * kSide * kSide; ++cell) {
    for (int corner = 0; corner < 8; ++corner) {
      const int x = cell % kSide + (corner % 4 == 1 || corner % 4 == 2);
      const int y = cell / kSide % kSide + (corner % 4 >= 2), z = cell / kSide / kSide + corner / 4;
      for (const int at : {x, y, z}) places.push_back(at);
      names.push_back(static_cast<int64_t>(names.size()));
    }
    ends.push_back(static_cast<int64_t>(names.size()));
    types.push_back(12);
  }
  piece.points = names.size();
  piece.cells = types.size();
  piece.points_element = {{"Float64", "Points", 3, places, {}}};
  piece.cells_element = {{"Int64", "connectivity", 1, {}, names},
                         {"Int64", "offsets", 1, {}, ends},
                         {"UInt8", "types", 1, {}, types}};
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}), 1000, options);
  EXPECT_EQ(mesh.schema.vertex_count, 64);
  std::map<std::set<int64_t>, int> faces;
  for (size_t c = 0; c < mesh.cells.size(); c += 4)
    for (size_t j = 0; j < 4; ++j) {
      std::set<int64_t> face(&mesh.cells[c], &mesh.cells[c] + 4);
      face.erase(mesh.cells[c + j]);
      ++faces[face];
    }
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](const auto& f) { return f.second == 1; }),
            6 * kSide * kSide * 2);
}

// Two cells on both sides of a crack share no point either; nobody asked to close it.
TEST(JoinPoints, FewCellsStayApart) {
  const SmallMesh grid = gridMesh(1, 2, 1);
  EXPECT_EQ(readVtu(makeVtu({apart(grid, "Float64")}, {})).schema.vertex_count, 48);
  const VtuMesh joined =
      readVtu(makeVtu({apart(grid, "Float64")}, {}), 1000, joining(PointJoining::kYes));
  expectGrid(joined, grid);
}

// A grid with its middle layer of vertices twice.
SmallMesh slitMesh() {
  SmallMesh grid = gridMesh(2, 2, 2);
  const size_t vertices = grid.vertexCount();
  std::vector<int64_t> other(vertices, -1);
  for (size_t v = 0; v < vertices; ++v) {
    if (grid.positions[3 * v + 2] != 1) continue;
    other[v] = static_cast<int64_t>(grid.vertexCount());
    for (size_t k = 0; k < 3; ++k) grid.positions.push_back(grid.positions[3 * v + k]);
    grid.field.push_back(grid.field[v]);
  }
  for (size_t c = 0; c < grid.cellCount(); ++c) {
    double height = 0;
    for (size_t j = 0; j < 4; ++j)
      height += grid.positions[3 * static_cast<size_t>(grid.cells[4 * c + j]) + 2];
    for (size_t j = 0; height > 4 && j < 4; ++j) {
      int64_t& corner = grid.cells[4 * c + j];
      if (other[static_cast<size_t>(corner)] >= 0) corner = other[static_cast<size_t>(corner)];
    }
  }
  return grid;
}

// Text of Gmsh's format, with tags from 1.
std::string mshOf(const SmallMesh& mesh) {
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(mesh.vertexCount()) + "\n";
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    text += textOf("%zu %g %g %g\n", v + 1, mesh.positions[3 * v], mesh.positions[3 * v + 1],
                   mesh.positions[3 * v + 2]);
  text += "$EndNodes\n$Elements\n" + std::to_string(mesh.cellCount()) + "\n";
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    text += std::to_string(c + 1) + " 4 2 0 1";
    for (size_t j = 0; j < 4; ++j) text += " " + std::to_string(mesh.cells[4 * c + j] + 1);
    text += "\n";
  }
  return text + "$EndElements\n";
}

TEST(JoinPoints, OfAnyIndexedFormatIfAskedFor) {
  const std::string file = mshOf(slitMesh());
  EXPECT_EQ(openText(openMsh, file).schema().vertex_count, 36);
  EXPECT_EQ(openText(openMsh, file, joining(PointJoining::kNo)).schema().vertex_count, 36);
  const Input joined = openText(openMsh, file, joining(PointJoining::kYes));
  EXPECT_EQ(joined.schema().vertex_count, 27);
  // A point is named by the first one that it was.
  EXPECT_TRUE(joined.indexed->hasOrigins());
  std::vector<int64_t> origins(27);
  joined.indexed->readOrigins(0, 27, origins.data());
  for (int64_t i = 0; i < 27; ++i) EXPECT_EQ(origins[static_cast<size_t>(i)], i);
  const std::string plain = mshOf(gridMesh(2, 2, 2));
  EXPECT_EQ(openText(openMsh, plain, joining(PointJoining::kYes)).schema().vertex_count, 27);
}

// A point is locked if one of those that it was is.
TEST(JoinPoints, LocksAreKept) {
  const std::string file =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\nRequiredVertices\n1\n6\n"
      "Tetrahedra\n2\n1 2 3 4 0\n5 6 7 8 0\nEnd\n";
  const Input joined = openText(openMedit, file, joining(PointJoining::kYes));
  ASSERT_EQ(joined.schema().vertex_count, 5);
  const std::vector<uint8_t> locked(joined.indexed->locked(), joined.indexed->locked() + 5);
  EXPECT_EQ(locked, (std::vector<uint8_t>{0, 0, 1, 0, 0}));
}

// By themselves nothing is joined then, and if it is asked for, that is an error.
TEST(JoinPoints, NoCellLosesACorner) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece piece = apart(grid, "Float64");
  for (size_t k = 0; k < 3; ++k)  // the first two corners of cell 20
    piece.points_element[0].reals[3 * 81 + k] = piece.points_element[0].reals[3 * 80 + k];
  const std::string file = makeVtu({piece}, {});
  const VtuMesh mesh = readVtu(file);
  EXPECT_EQ(mesh.schema.vertex_count, 576);
  EXPECT_TRUE(hasNote(mesh, "points at the same place are not joined: cell 20 has two points"));
  try {
    readVtu(file, 1000, joining(PointJoining::kYes));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadData);
    EXPECT_TRUE(has(error.text(), "points cannot be joined: cell 20 has two points"));
  }
}

// A mesh so small, for where it is, that places nearer than the grid are different ones.
TEST(JoinPoints, PlacesThatAreNotTheSameStayApart) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece small = apart(grid, "Float64"), gap = small;
  for (double& x : small.points_element[0].reals) x = 1 + x * 0x1p-44;
  EXPECT_EQ(readVtu(makeVtu({small}, {VtuCoding::kAppendedRaw})).schema.vertex_count, 60);
  // Two halves, 1e-11 of the largest coordinate from each other.
  std::vector<double>& places = gap.points_element[0].reals;
  for (size_t cell = 0; cell < grid.cellCount(); ++cell) {
    double height = 0;
    for (size_t j = 0; j < 4; ++j) height += places[12 * cell + 3 * j + 2];
    for (size_t j = 0; j < 4 && height * 3 > 4; ++j) places[12 * cell + 3 * j + 2] += 2e-11;
  }
  EXPECT_EQ(readVtu(makeVtu({gap}, {VtuCoding::kAppendedRaw})).schema.vertex_count, 80);
}

// Of three blocks in turn, or with points in any order.
TEST(JoinPoints, PointsMayComeInAnyOrder) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece piece = apart(grid, "Float32");
  std::vector<int64_t>& names = piece.cells_element[0].integers;
  VtuTestPiece shuffled = piece;
  for (size_t i = 0; i < names.size(); ++i) {
    const auto to = static_cast<int64_t>(i * 25 % names.size());
    shuffled.cells_element[0].integers[i] = to;
    for (size_t k = 0; k < 3; ++k)
      shuffled.points_element[0].reals[3 * static_cast<size_t>(to) + k] =
          piece.points_element[0].reals[3 * i + k];
    shuffled.point_data[2].integers[static_cast<size_t>(to)] = piece.point_data[2].integers[i];
    for (size_t k = 0; k < 3; ++k)
      shuffled.point_data[1].reals[3 * static_cast<size_t>(to) + k] =
          piece.point_data[1].reals[3 * i + k];
  }
  expectGrid(readVtu(makeVtu({shuffled}, {})), grid);
}

// Triangles use the cells' points, and a long line some twice.
TEST(JoinPoints, CellsOfOtherDimensionsDoNotMatter) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece piece = apart(grid, "Float64");
  std::vector<int64_t>&names = piece.cells_element[0].integers,
  &ends = piece.cells_element[1].integers, &types = piece.cells_element[2].integers;
  const std::vector<int64_t> cells = names;
  names = {0, 1, 2};
  for (int64_t i = 0; i < 70; ++i) names.push_back(i % 69);
  names.insert(names.end(), cells.begin(), cells.end());
  for (int64_t& end : ends) end += 73;
  ends.insert(ends.begin(), {3, 73});
  types.insert(types.begin(), {5, 4});
  piece.cells += 2;
  piece.cell_data = {{"Int32", "wall", 1, {}, std::vector<int64_t>(piece.cells, 7)}};
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  expectGrid(mesh, grid);
  EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{7}));
}

// A wedge as a hexahedron names points twice; that is no joining's doing.
TEST(JoinPoints, CellsThatNameAPointTwiceMayStay) {
  VtuTestPiece piece;
  piece.points = 6;
  piece.cells = 1;
  piece.points_element = {
      {"Float64", "Points", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}, {}}};
  piece.cells_element = {{"Int64", "connectivity", 1, {}, {0, 1, 2, 2, 3, 4, 5, 5}},
                         {"Int64", "offsets", 1, {}, {8}},
                         {"UInt8", "types", 1, {}, {12}}};
  ReadOptions options;
  options.split = true;
  const VtuMesh before = readVtu(makeVtu({piece}, {}), 1000, options);
  options.join = PointJoining::kYes;
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}), 1000, options);
  EXPECT_EQ(mesh.cells, before.cells);
  EXPECT_TRUE(hasNote(mesh, "no two points lie at the same place"));
}

TEST(JoinPoints, LabelledFacesWithPointsOfTheirOwnAreKept) {
  const std::string file =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n7\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "1 0 0 0\n0 1 0 0\n0 0 1 0\nTriangles\n1\n5 6 7 9\nTetrahedra\n1\n1 2 3 4 0\nEnd\n";
  Input joined = openText(openMedit, file, joining(PointJoining::kYes));
  EXPECT_EQ(facesOf(joined), (std::vector<TestFace>{{1, 2, 3, 9}}));
}

// A face that both of its cells have labelled is there once.
TEST(JoinPoints, FacesThatBecomeOneAreThereOnce) {
  const std::string file =
      "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
      "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\nTriangles\n3\n2 3 4 9\n7 6 5 8\n1 2 3 7\n"
      "Tetrahedra\n2\n1 2 3 4 0\n5 6 7 8 0\nEnd\n";
  std::vector<std::string> notes;
  Input joined = openText(openMedit, file, joining(PointJoining::kYes), &notes);
  const std::vector<TestFace> faces = facesOf(joined);
  ASSERT_EQ(faces.size(), 2u);
  for (const TestFace& face : faces) EXPECT_EQ(face.label, face.a + face.b + face.c == 6 ? 9 : 7);
  EXPECT_TRUE(anyNote(notes, "1 labelled faces have become one with others"));
}

// What a ghost says of a point is somebody else's.
TEST(JoinPoints, PointsOfGhostsDoNotCount) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  VtuTestPiece piece = apart(grid, "Float64");
  std::vector<int64_t> ghosts(piece.cells, 0);
  ghosts[0] = 1;
  piece.cell_data = {{"UInt8", "vtkGhostType", 1, {}, ghosts}};
  for (size_t i = 0; i < 4; ++i) piece.point_data[0].reals[i] = 1e6;
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  EXPECT_EQ(mesh.schema.cell_count, 143);
  EXPECT_EQ(mesh.schema.vertex_count, 60);
  for (const double f : valuesAs<double>(mesh.fields[0])) EXPECT_LT(f, 100);
}

// Claims that lie are found as ever, by the reader's own words.
TEST(JoinPoints, WhatIsWrongIsFoundAsEver) {
  const SmallMesh grid = gridMesh(3, 4, 2);
  for (const size_t array : {0, 1}) {
    VtuTestPiece piece = apart(grid, "Float64");
    piece.cells_element[array].integers.back() = 1 << 20;
    EXPECT_NE(vtuFailure(makeVtu({piece}, {})), "");
    piece.cells_element[array].integers.back() = -1;
    EXPECT_NE(vtuFailure(makeVtu({piece}, {})), "");
  }
}

}  // namespace
}  // namespace tetstream::test
