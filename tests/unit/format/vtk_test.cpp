// Legacy VTK files: of all versions, text and binary, whole and broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "slow_run.h"
#include "status.h"
#include "vtk_writer.h"
#include "vtu_encode.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

// As an old program might write it, with everything that may stand between.
const char* const kOldVtkText =
    "# vtk DataFile Version 2.0\n"
    "a title\n"
    "ASCII\n"
    "DATASET UNSTRUCTURED_GRID\n"
    "FIELD FieldData 3\n"
    "TIME 1 1 double\n"
    "0.5\n"
    "CYCLE 1 1 int\n"
    "3\n"
    "who 1 2 string\n"
    "some%20body\n"
    "else\n"
    "POINTS 5 double\n"
    "0 0 0 1 0 0 0 1 0\n"
    "0 0 1\n"
    "1 1 1.25e0\n"
    "\n"
    "CELLS 4 17\n"
    "3 0 1 2\n"
    "4 0 1 2 3 2 0 1\n"
    "4 1 2 3 4\n"
    "CELL_TYPES 4\n"
    "5 10 3 10\n"
    "POINT_DATA 5\n"
    "SCALARS p%20q float 1\n"
    "LOOKUP_TABLE mine\n"
    "1 2 3 4 5\n"
    "LOOKUP_TABLE mine 1\n"
    "0 0 0 1\n"
    "METADATA\n"
    "COMPONENT_NAMES\n"
    "X\n"
    "\n"
    "VECTORS v double\n"
    "0 0 1 0 0 2 0 0 3 0 0 4 0 0 5\n"
    "COLOR_SCALARS c 2\n"
    "0 0.5 0 0.5 0 0.5 0 0.5 0 0.5\n"
    "FIELD FieldData 3\n"
    "ids 1 5 vtkIdType\n"
    "5 4 3 2 1\n"
    "METADATA\n"
    "COMPONENT_NAMES\n"
    "\n"
    "INFORMATION 1\n"
    "NAME L2_NORM_RANGE LOCATION vtkDataArray\n"
    "DATA 2 1 5\n"
    "\n"
    "short 1 4 float\n"
    "1 2 3 4\n"
    "words 1 5 string\n"
    "a\nb\nc\nd\ne\n"
    "CELL_DATA 4\n"
    "SCALARS region unsigned_char\n"
    "LOOKUP_TABLE default\n"
    "7 8 9 250\n";

TEST(Vtk, ReadsWhatOldProgramsWrite) {
  for (const size_t step : {1, 2, 1000}) {
    const VtuMesh mesh = readAs("vtk", kOldVtkText, step);
    EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
    EXPECT_EQ(valuesAs<double>(mesh.positions)[14], 1.25);
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    ASSERT_EQ(mesh.schema.fields.size(), 4u);
    EXPECT_EQ(mesh.schema.fields[0].name, "p q");
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.schema.fields[1].components, 3);
    EXPECT_EQ(mesh.schema.fields[2].name, "c");
    EXPECT_EQ(valuesAs<int32_t>(mesh.fields[3]), (std::vector<int32_t>{5, 4, 3, 2, 1}));
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{8, 250}));
    EXPECT_TRUE(hasNote(mesh, "field data is left out"));
    EXPECT_EQ(mesh.schema.time, 0.5);
    EXPECT_TRUE(hasNote(mesh, "\"short\" is left out"));
    EXPECT_TRUE(hasNote(mesh, "\"words\" is left out"));
    EXPECT_TRUE(hasNote(mesh, "1 cells of lower dimension"));
    EXPECT_EQ(mesh.faces, (std::vector<int64_t>{0, 1, 2}));
    EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{7}));
  }
}

// Big-endian, whatever this machine is.
template <class T>
std::string big(const std::vector<T>& values) {
  std::string out;
  for (const T value : values) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (std::endian::native == std::endian::little) std::reverse(bytes, bytes + sizeof(T));
    out.append(bytes, sizeof(T));
  }
  return out;
}

std::string binaryFile(const std::string& version, const std::string& cells) {
  return "# vtk DataFile Version " + version + "\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\n" +
         "POINTS 5 float\n" + big<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}) + "\n" +
         cells + "CELL_TYPES 2\n" + big<int32_t>({10, 10}) + "\nPOINT_DATA 5\nSCALARS b bit 1\n" +
         "LOOKUP_TABLE default\n\xA8\nFIELD F 2\nstr 1 5 string\n" + std::string("\xC1") + "a" +
         std::string("\x80\x02") + "bc" + std::string("\x40\x00\x00\x01", 4) + "d" +
         std::string("\0\0\0\0\0\0\0\x01", 8) + "e" + "\xC0" + "\nd 2 5 double\n" +
         big<double>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) +
         "\nMETADATA\nCOMPONENT_NAMES\n\ny\nINFORMATION 0\n\nCELL_DATA 2\nTENSORS t float\n" +
         big<float>({1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9}) + "\n";
}

const std::string kCellRows = "CELLS 2 10\n" + big<int32_t>({4, 0, 1, 2, 3, 4, 1, 2, 3, 4}) + "\n";

template <class T>
std::string offsetsAs(const std::string& type) {
  return "CELLS 3 8\nOFFSETS " + type + "\n" + big<T>({0, 4, 8}) + "\nCONNECTIVITY " + type + "\n" +
         big<T>({0, 1, 2, 3, 1, 2, 3, 4}) + "\n";
}
const std::string kOffsets = offsetsAs<int64_t>("vtktypeint64");
const std::string kNarrow = offsetsAs<int32_t>("vtktypeint32");  // as meshio writes it

TEST(Vtk, ReadsBinaryOfBothFormsOfCells) {
  for (const std::string& file :
       {binaryFile("4.2", kCellRows), binaryFile("5.1", kOffsets), binaryFile("5.1", kNarrow)})
    for (const size_t step : {1, 1000}) {
      const VtuMesh mesh = readAs("vtk", file, step);
      EXPECT_EQ(valuesAs<float>(mesh.positions)[12], 1);
      EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
      EXPECT_EQ(valuesAs<int32_t>(mesh.fields[0]), (std::vector<int32_t>{1, 0, 1, 0, 1}));
      EXPECT_EQ(mesh.schema.fields[1].components, 2);
      EXPECT_EQ(valuesAs<double>(mesh.fields[1])[9], 10);
      EXPECT_EQ(mesh.schema.cell_data[0].components, 9);
      EXPECT_TRUE(hasNote(mesh, "\"str\" is left out"));
    }
}

TEST(Vtk, SaysWhereAFileIsWrong) {
  const struct {
    const char *from, *to, *says;
  } cases[] = {
      {"# vtk", "# xtk", "BAD_DATA: test.vtk: byte 0: this is no VTK file"},
      {"ASCII", "ASCIZ", "BAD_DATA: test.vtk: byte 35: here stands neither"},
      {"UNSTRUCTURED_GRID", "POLYDATA", "UNSUPPORTED: test.vtk: the file holds \"POLYDATA\""},
      {"POINTS 5 double", "POINTS 6 double", "BAD_DATA: test.vtk"},
      {"POINTS 5 double", "POINTS -5 double", "the number of points is missing or no number"},
      {"POINTS 5 double", "POINTS 5 triple", "\"triple\" is no type of values"},
      {"POINTS 5", "POINTS 99999999999", "the file ends before the 99999999999 x 3 values"},
      {"CELLS 4 17", "CELLS 4 18", "byte 260: \"4\" is no keyword"},
      {"CELLS 4 17", "CELLS 4 16", "BAD_DATA: test.vtk: byte"},
      {"CELLS 4 17", "CELLS 3 17", "CELLS and CELL_TYPES have different numbers of cells"},
      {"4 0 1 2 3", "5 0 1 2 3", "cell 1 is a tetrahedron with a wrong number of points"},
      {"4 1 2 3 4", "4 1 2 3 5", "cell 3 uses point 5, there are 5"},
      {"4 1 2 3 4", "4 1 2 x 4", "array \"CELLS\": byte"},
      {"5 10 3 10", "5 10 3 12", "UNSUPPORTED: test.vtk: cell 3 has VTK's type 12, a hexahedron"},
      {"CELL_TYPES 4\n5 10 3 10\n", "", "there are no CELL_TYPES"},
      {"POINT_DATA 5", "POINT_DATA 4", "there is data for 4 points, but there are 5"},
      {"SCALARS p", "SCALARZ p", "\"scalarz\" is no keyword"},
      {"p%20q float 1", "p%20q float x", "the number of components is no number"},
      {"1.25e0", "1.25f0", "\"1.25f0\" is no number"},
  };
  for (const auto& c : cases) {
    const std::string text = failureAs("vtk", replaced(kOldVtkText, c.from, c.to));
    EXPECT_TRUE(has(text, c.says)) << c.from << " -> " << c.to << ": " << text;
  }
  EXPECT_TRUE(has(failureAs("vtk", ""), "BAD_DATA: test.vtk: byte 0"));
}

TEST(Vtk, RefusesClaimsThatTheFileCannotHold) {
  const std::string good = binaryFile("4.2", kCellRows), late = binaryFile("5.1", kOffsets);
  for (const char* count : {"1152921504606846976", "72057594037927936", "4294967296", "2000"}) {
    for (const char* name : {"POINTS ", "CELL_TYPES ", "POINT_DATA ", "CELL_DATA "}) {
      const std::string bad = replaced(good, name, std::string(name) + count + " ");
      EXPECT_TRUE(has(failureAs("vtk", bad), "BAD_DATA: test.vtk: byte")) << name << count;
    }
    for (const std::string& from : {std::string("CELLS 2 10"), std::string("CELLS 2")})
      EXPECT_TRUE(has(failureAs("vtk", replaced(good, from, std::string("CELLS 2 ") + count)),
                      "BAD_DATA: test.vtk"));
    EXPECT_TRUE(has(failureAs("vtk", replaced(late, "CELLS 3", std::string("CELLS ") + count)),
                    "BAD_DATA: test.vtk: byte"));
  }
}

void damageVtkEverywhere(const std::string& good) {
  ASSERT_EQ(failureAs("vtk", good), "");
  const auto expectSafe = [](const std::string& file, const std::string& where) {
    const std::string text = failureAs("vtk", file);
    EXPECT_TRUE(text.empty() || text.starts_with("TETSTREAM_BAD_DATA: test.vtk: ") ||
                text.starts_with("TETSTREAM_UNSUPPORTED: test.vtk: "))
        << where << ": " << text;
  };
  for (size_t size = 0; size < good.size(); size += oneIn(5))
    expectSafe(good.substr(0, size), "cut to " + std::to_string(size));
  for (size_t bit = 0; bit < 8 * good.size(); bit += 3 * oneIn(5)) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    expectSafe(bad, "bit " + std::to_string(bit));
  }
}

TEST(Vtk, TakesATimeThatIsOneNumberByItsName) {
  const std::string file = binaryFile("4.2", kCellRows);
  const size_t at = file.find("POINTS");
  const auto timeOf = [&](const std::string& head, const std::string& values) {
    return readAs("vtk", file.substr(0, at) + "FIELD FieldData 1\n" + head + "\n" + values + "\n" +
                             file.substr(at))
        .schema.time;
  };
  EXPECT_EQ(timeOf("TimeValue 1 1 double", big<double>({0.1})), 0.1);
  EXPECT_EQ(timeOf("TIME 1 1 float", big<float>({0.5})), 0.5);
  EXPECT_EQ(timeOf("TimeValue 1 1 int", big<int32_t>({-3})), -3);
  EXPECT_FALSE(timeOf("Time 1 1 double", big<double>({0.1})));
  EXPECT_FALSE(timeOf("TimeValue 1 2 double", big<double>({0.1, 0.2})));
  EXPECT_FALSE(timeOf("TimeValue 2 1 double", big<double>({0.1, 0.2})));
  EXPECT_FALSE(timeOf("TimeValue 1 1 double", big<double>({NAN})));
  const VtuMesh mesh = readAs("vtk", replaced(kOldVtkText, "0.5\nCYCLE", "1e400\nCYCLE"));
  EXPECT_FALSE(mesh.schema.time);
  EXPECT_TRUE(hasNote(mesh, "the time is left out: test.vtk: array \"TIME\": byte"));
}

TEST(Vtk, SurvivesDamage) {
  damageVtkEverywhere(kOldVtkText);
  damageVtkEverywhere(binaryFile("4.2", kCellRows));
  damageVtkEverywhere(binaryFile("5.1", kOffsets));
}

TEST(Vtk, WrittenInEitherVersionGivesBackEveryArray) {
  VtuTestPiece piece = twoCellPiece();
  piece.point_data.push_back({"Float64", "a vector, 100 %", 3, {}, {}});
  piece.point_data.back().reals.assign(15, 0.1);
  piece.cell_data.push_back({"Int64", "long", 2, {}, {1, INT64_MIN, 3, INT64_MAX}});
  VtuMesh mesh = readVtu(makeVtu({piece}, {}));
  mesh.schema.time = 0.1;
  for (const uint64_t most : {kVtkMostInt32, uint64_t{9}}) {
    std::vector<unsigned char> out;
    const std::string file =
        writtenBy(*createVtkWith(createMemory(out), WriteOptions(), most), out, mesh);
    EXPECT_TRUE(has(file, most == 9 ? "Version 5.1" : "Version 4.2"));
    EXPECT_TRUE(has(file, "\nFIELD FieldData 1\nTimeValue 1 1 double\n"));
    EXPECT_LT(file.find("CELL_TYPES"), file.find("TimeValue"));  // Gmsh does not read it elsewhere
    EXPECT_TRUE(has(file, "VECTORS a%20vector,%20100%20%25 double"));
    EXPECT_TRUE(readAs("vtk", file) == mesh);
    EXPECT_TRUE(readAs("vtk", file).notes.empty());
  }
}

// Two of each kind are 18 numbers in a file of version 4.2.
TEST(Vtk, FacesAreWrittenAfterTheCellsAndComeBack) {
  VtuMesh mesh = readVtu(makeVtu({twoCellPiece()}, {}));
  mesh.faces = {0, 1, 2, 2, 4, 3};
  mesh.face_labels = {-5, int64_t{1} << 40};
  mesh.schema.face_count = 2;
  for (const uint64_t most : {kVtkMostInt32, uint64_t{18}, uint64_t{17}}) {
    std::vector<unsigned char> out;
    const std::string file =
        writtenBy(*createVtkWith(createMemory(out), WriteOptions(), most), out, mesh);
    EXPECT_TRUE(has(file, most == 17 ? "\nCELLS 5 14\nOFFSETS" : "\nCELLS 4 18\n"));
    EXPECT_TRUE(has(file, "\nCELL_TYPES 4\n" + big<int32_t>({10, 10, 5, 5})));
    EXPECT_TRUE(has(file, "\nface_label 1 4 long\n" + big<int64_t>({0, 0, -5, 1LL << 40})));
    const VtuMesh back = readAs("vtk", file);
    EXPECT_TRUE(back == mesh);
    ASSERT_EQ(back.notes.size(), 1u);
    EXPECT_TRUE(hasNote(back, "by the cell array \"face_label\""));
  }
}

}  // namespace
}  // namespace tetstream
