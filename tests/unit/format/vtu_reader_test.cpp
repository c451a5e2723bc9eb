// Every encoding of .vtu, made by the encoders of tests/support.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "meshes.h"
#include "pipes.h"
#include "slow_run.h"
#include "status.h"
#include "vtk_format.h"
#include "vtu_encode.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

// A slow run takes one in seven.
std::vector<VtuStyle> allStyles(size_t block_bytes) {
  std::vector<VtuStyle> styles, taken;
  for (VtuCoding coding :
       {VtuCoding::kAscii, VtuCoding::kInline, VtuCoding::kAppendedBase64, VtuCoding::kAppendedRaw})
    for (bool zlib : {false, true})
      for (bool big_endian : {false, true})
        for (int bits : {32, 64})
          for (bool apart : {false, true})
            styles.push_back({coding, zlib, big_endian, bits, block_bytes, apart});
  for (size_t i = 0; i < styles.size(); i += oneIn(7)) taken.push_back(styles[i]);
  return taken;
}

std::string nameOf(const VtuStyle& s) {
  return "coding " + std::to_string(static_cast<int>(s.coding)) + " zlib " +
         std::to_string(s.zlib) + " big " + std::to_string(s.big_endian) + " header " +
         std::to_string(s.header_bits) + " apart " + std::to_string(s.header_apart);
}

// 64 numbers of all magnitudes, subnormal and special ones among them.
VtuTestArray hardNumbers(const char* type, const char* name) {
  VtuTestArray a{type, name, 1, {}, {}};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  const bool is_float = type[5] == '3';
  const int most = is_float ? 126 : 1021;
  for (int i = 0; i < 60; ++i) {
    const int exponent = static_cast<int>(random() % (2 * most)) - most;
    const double number = std::ldexp(mantissa(random), exponent);
    a.reals.push_back(is_float ? static_cast<float>(number) : number);
  }
  a.reals.insert(a.reals.end(),
                 {-0.0, std::numeric_limits<double>::infinity(), is_float ? 1e-45 : 5e-324, 0.1});
  return a;
}

VtuTestPiece hardPiece() {
  VtuTestPiece piece;
  piece.points = 64;
  piece.cells = 1;
  piece.point_data = {hardNumbers("Float32", "f"), hardNumbers("Float64", "d")};
  VtuTestArray points = hardNumbers("Float64", "Points");
  points.components = 3;
  points.reals.insert(points.reals.end(), points.reals.begin(), points.reals.end());
  points.reals.insert(points.reals.end(), points.reals.begin(), points.reals.begin() + 64);
  piece.points_element = {points};
  piece.cells_element = {{"Int32", "connectivity", 1, {}, {0, 21, 42, 63}},
                         {"Int32", "offsets", 1, {}, {4}},
                         {"UInt8", "types", 1, {}, {10}}};
  return piece;
}

TEST(VtuReader, ReadsTheSameMeshFromEveryEncoding) {
  for (const char* ids : {"Int32", "Int64", "UInt32", "UInt64", "Int16", "UInt8"}) {
    for (const VtuStyle& style : allStyles(16)) {
      SCOPED_TRACE(nameOf(style) + " " + ids);
      const VtuMesh mesh = readVtu(makeVtu({twoCellPiece("Float32", ids)}, style));
      EXPECT_EQ(mesh.schema.vertex_count, 5);
      EXPECT_EQ(mesh.schema.cell_count, 2);
      EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat32);
      EXPECT_EQ(valuesAs<float>(mesh.positions),
                (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.1f}));
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
      ASSERT_EQ(mesh.fields.size(), 1u);
      EXPECT_EQ(mesh.schema.fields[0].name, "p");
      EXPECT_EQ(valuesAs<float>(mesh.fields[0]),
                (std::vector<float>{0.5f, -1.25f, 1e-7f, 3, 1e30f}));
      ASSERT_EQ(mesh.cell_data.size(), 1u);
      EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{7, -7}));
      EXPECT_TRUE(mesh.notes.empty());
    }
  }
}

TEST(VtuReader, KeepsFloatsToTheLastBit) {
  const VtuTestPiece piece = hardPiece();
  std::vector<float> floats(piece.point_data[0].reals.begin(), piece.point_data[0].reals.end());
  for (const VtuStyle& style : allStyles(40)) {
    SCOPED_TRACE(nameOf(style));
    const VtuMesh mesh = readVtu(makeVtu({piece}, style), 7);
    ASSERT_EQ(mesh.fields.size(), 2u);
    EXPECT_EQ(std::memcmp(mesh.fields[0].data(), floats.data(), 64 * 4), 0);
    EXPECT_EQ(std::memcmp(mesh.fields[1].data(), piece.point_data[1].reals.data(), 64 * 8), 0);
    EXPECT_EQ(std::memcmp(mesh.positions.data(), piece.points_element[0].reals.data(), 192 * 8), 0);
  }
}

TEST(VtuReader, WidensEveryIntegerType) {
  const struct {
    const char* type;
    ScalarType as;
    std::vector<int64_t> values;
  } cases[] = {{"Int8", ScalarType::kInt32, {-128, 127}},
               {"UInt8", ScalarType::kInt32, {0, 255}},
               {"Int16", ScalarType::kInt32, {-32768, 32767}},
               {"UInt16", ScalarType::kInt32, {0, 65535}},
               {"Int32", ScalarType::kInt32, {INT32_MIN, INT32_MAX}},
               {"UInt32", ScalarType::kInt64, {0, UINT32_MAX}},
               {"Int64", ScalarType::kInt64, {INT64_MIN, INT64_MAX}},
               {"UInt64", ScalarType::kInt64, {0, INT64_MAX}}};
  for (const auto& c : cases) {
    VtuTestPiece piece = twoCellPiece();
    piece.cell_data = {{c.type, "n", 1, {}, c.values}};
    for (const VtuStyle& style : allStyles(32768)) {
      SCOPED_TRACE(nameOf(style) + " " + c.type);
      const VtuMesh mesh = readVtu(makeVtu({piece}, style));
      ASSERT_EQ(mesh.cell_data.size(), 1u);
      EXPECT_EQ(mesh.schema.cell_data[0].type, c.as);
      std::vector<int64_t> got = valuesAs<int64_t>(mesh.cell_data[0]);
      if (c.as == ScalarType::kInt32) {
        const std::vector<int32_t> narrow = valuesAs<int32_t>(mesh.cell_data[0]);
        got.assign(narrow.begin(), narrow.end());
      }
      EXPECT_EQ(got, c.values);
    }
  }
}

TEST(VtuReader, JumpsToAnyRange) {
  SmallMesh grid = gridMesh(9, 8, 7);
  VtuTestPiece piece;
  piece.points = grid.vertexCount();
  piece.cells = grid.cellCount();
  piece.point_data = {{"Float64", "f", 1, grid.field, {}}};
  piece.points_element = {{"Float64", "Points", 3, grid.positions, {}}};
  VtuTestArray offsets{"Int64", "offsets", 1, {}, {}}, types{"UInt8", "types", 1, {}, {}};
  for (uint64_t i = 0; i < piece.cells; ++i) {
    offsets.integers.push_back(static_cast<int64_t>(4 * i + 4));
    types.integers.push_back(10);
  }
  piece.cells_element = {types, {"Int32", "connectivity", 1, {}, grid.cells}, offsets};
  for (const VtuStyle& style : allStyles(1000)) {
    SCOPED_TRACE(nameOf(style));
    const std::string file = makeVtu({piece}, style);
    const Input input = openVtu(openMemory(file.data(), file.size(), "test.vtu"), {});
    std::mt19937 random(3);
    std::vector<int64_t> cells(4 * piece.cells);
    std::vector<double> field(piece.points), positions(3 * piece.points);
    for (int i = 0; i < 30; ++i) {
      const size_t cell = random() % piece.cells, point = random() % piece.points;
      const size_t n = random() % (piece.cells - cell), m = random() % (piece.points - point);
      input.indexed->readCells(cell, n, cells.data());
      EXPECT_TRUE(std::equal(cells.begin(), cells.begin() + static_cast<ptrdiff_t>(4 * n),
                             grid.cells.begin() + static_cast<ptrdiff_t>(4 * cell)));
      input.indexed->readField(0, point, m, field.data());
      EXPECT_EQ(std::memcmp(field.data(), &grid.field[point], 8 * m), 0);
      input.indexed->readPositions(point, m, positions.data());
      EXPECT_EQ(std::memcmp(positions.data(), &grid.positions[3 * point], 24 * m), 0);
    }
  }
}

TEST(VtuReader, FindsItsWayBackInLongText) {
  // More values than there are marks, so that marks are thinned out.
  const size_t count = 1'200'000;
  std::string file =
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>"
      "<Piece NumberOfPoints='1200000' NumberOfCells='0'><PointData>"
      "<DataArray Name='n' type='Int32'>";
  for (size_t i = 0; i < count; ++i) {
    file += i % 16 ? ' ' : '\n';
    file += static_cast<char>('0' + i % 10);
  }
  file += "</DataArray></PointData><Points><DataArray type='UInt8'>";
  for (size_t i = 0; i < 3 * count; ++i) file += "0 ";
  file += "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
  const Input input = openVtu(openMemory(file.data(), file.size(), "test.vtu"), {});
  int32_t values[10];
  for (size_t place : {count - 10, size_t{0}, count / 2 + 1, size_t{123457}, count - 11}) {
    input.indexed->readField(0, place, 10, values);
    for (size_t i = 0; i < 10; ++i) EXPECT_EQ(values[i], static_cast<int32_t>((place + i) % 10));
  }
}

TEST(VtuReader, JoinsPiecesEndToEnd) {
  VtuTestPiece second = twoCellPiece("Float32", "Int32"), empty;
  second.point_data[0].type = "Float64";
  second.cell_data[0].type = "Int64";
  second.cell_data[0].integers = {1, int64_t{1} << 40};
  second.point_data.push_back({"Float32", "only here", 1, {1, 2, 3, 4, 5}, {}});
  for (const VtuStyle& style : allStyles(16)) {
    SCOPED_TRACE(nameOf(style));
    const std::string file = makeVtu({empty, twoCellPiece(), empty, second, empty}, style);
    for (size_t step : {1, 3, 100}) {
      const VtuMesh mesh = readVtu(file, step);
      EXPECT_EQ(mesh.schema.vertex_count, 10);
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4, 5, 6, 7, 8, 6, 7, 8, 9}));
      EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
      ASSERT_EQ(mesh.schema.fields.size(), 1u);
      EXPECT_EQ(mesh.schema.fields[0].type, ScalarType::kFloat64);
      EXPECT_EQ(valuesAs<double>(mesh.fields[0])[6], -1.25);
      EXPECT_EQ(valuesAs<int64_t>(mesh.cell_data[0]),
                (std::vector<int64_t>{7, -7, 1, int64_t{1} << 40}));
      ASSERT_EQ(mesh.notes.size(), 1u);
      EXPECT_NE(mesh.notes[0].find("only here"), std::string::npos);
    }
  }
}

TEST(VtuReader, LeavesOutWithANoteWhatAStreamCannotHold) {
  VtuTestPiece piece = twoCellPiece();
  piece.point_data = {{"Float32", "wide", 10, std::vector<double>(50), {}},
                      {"String", "words", 1, {}, {}},
                      {"Float32", "", 1, {1, 2, 3, 4, 5}, {}},
                      {"Float32", "tensor", 9, std::vector<double>(45, 2), {}}};
  const VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  ASSERT_EQ(mesh.schema.fields.size(), 2u);
  EXPECT_EQ(mesh.schema.fields[0].name, "field_1");
  EXPECT_EQ(valuesAs<float>(mesh.fields[0])[4], 5);
  EXPECT_EQ(mesh.schema.fields[1].components, 9);
  ASSERT_EQ(mesh.notes.size(), 3u);
  EXPECT_NE(mesh.notes[0].find("test.vtu: array \"wide\""), std::string::npos);
  EXPECT_NE(mesh.notes[1].find("words"), std::string::npos);
  EXPECT_NE(mesh.notes[2].find("field_1"), std::string::npos);
}

TEST(VtuReader, ReadsFilesWithoutCellsOrPoints) {
  for (const VtuStyle& style : allStyles(16)) {
    SCOPED_TRACE(nameOf(style));
    VtuTestPiece piece = twoCellPiece();
    piece.cells = 0;
    piece.cells_element.clear();
    piece.cell_data[0].integers.clear();
    const VtuMesh mesh = readVtu(makeVtu({piece}, style));
    EXPECT_EQ(mesh.schema.vertex_count, 5);
    EXPECT_EQ(mesh.schema.cell_count, 0);
    EXPECT_EQ(mesh.schema.cell_data.size(), 1u);
    EXPECT_EQ(readVtu(makeVtu({VtuTestPiece()}, style)).schema.vertex_count, 0);
  }
}

TEST(VtuReader, SpoolsAPipe) {
  const std::string file = makeVtu({twoCellPiece()}, {VtuCoding::kAppendedRaw, true});
  const Bytes bytes(file.begin(), file.end());
  const Input input = openVtu(std::make_unique<PipeSource>(bytes, 3), {});
  int64_t cells[8];
  input.indexed->readCells(0, 2, cells);
  EXPECT_EQ(cells[7], 4);
}

}  // namespace
}  // namespace tetstream
