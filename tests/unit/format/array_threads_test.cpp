// Arrays of text, of VTK's files and of XDMF, that several threads read.
#include <gtest/gtest.h>

#include "slow_run.h"
#include "text_threads_testing.h"
#include "vtk_format.h"
#include "xdmf_format.h"

namespace tetstream {
namespace {

using namespace test;

std::string lines(int count, const std::function<std::string()>& line) {
  std::string text;
  for (int i = 0; i < count; ++i) text += line() + "\n";
  return text;
}

struct Arrays {
  Words w;
  std::string points = lines(kPoints, [&] { return w.reals(3); });
  std::string values = lines(kPoints, [&] { return w.real(); });
  std::string vectors = lines(kPoints, [&] { return w.reals(3); });
  std::string corners = lines(kCells, [&] { return w.corners(0, 4); });
  std::string labels = lines(kCells, [&] { return w.label(); });
  std::string types = lines(kCells, [] { return "10"; });
  std::string ends(int first) const {
    return lines(kCells + (first == 0),
                 [at = first - 4]() mutable { return std::to_string(at += 4); });
  }
};

std::string vtkHead(const char* version) {
  return textOf("# vtk DataFile Version %s\na title\nASCII\nDATASET UNSTRUCTURED_GRID\n", version);
}

std::string vtkData(const Arrays& a) {
  return textOf("CELL_TYPES %d\n", kCells) + a.types +
         textOf("POINT_DATA %d\nSCALARS p float\nLOOKUP_TABLE default\n", kPoints) + a.values +
         "VECTORS v double\n" + a.vectors +
         textOf("CELL_DATA %d\nSCALARS region unsigned_char\nLOOKUP_TABLE default\n", kCells) +
         a.labels;
}

std::string oldVtkText() {
  const Arrays a;
  std::string rows;
  for (const std::string& line : linesOf(a.corners)) rows += "4 " + line + "\n";
  return vtkHead("3.0") + textOf("POINTS %d double\n", kPoints) + a.points +
         textOf("CELLS %d %d\n", kCells, 5 * kCells) + rows + vtkData(a);
}

std::string newVtkText() {
  const Arrays a;
  return vtkHead("5.1") + textOf("POINTS %d float\n", kPoints) + a.points +
         textOf("CELLS %d %d\nOFFSETS vtktypeint64\n", kCells + 1, 4 * kCells) + a.ends(0) +
         "CONNECTIVITY vtktypeint64\n" + a.corners + vtkData(a);
}

std::string vtuArray(const char* type, const char* name, int components,
                     const std::string& values) {
  return textOf("<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n",
                type, name, components) +
         values + "</DataArray>\n";
}

std::string vtuText() {
  const Arrays a;
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\n" +
         textOf("<Piece NumberOfPoints=\"%d\" NumberOfCells=\"%d\">\n<PointData>\n", kPoints,
                kCells) +
         vtuArray("Float32", "p", 1, a.values) + vtuArray("Float64", "v", 3, a.vectors) +
         "</PointData>\n<CellData>\n" + vtuArray("UInt64", "region", 1, a.labels) +
         "</CellData>\n<Points>\n" + vtuArray("Float32", "Points", 3, a.points) +
         "</Points>\n<Cells>\n" + vtuArray("Int64", "connectivity", 1, a.corners) +
         vtuArray("Int32", "offsets", 1, a.ends(4)) + vtuArray("UInt8", "types", 1, a.types) +
         "</Cells>\n</Piece></UnstructuredGrid></VTKFile>\n";
}

std::string xdmfItem(const char* kind, int rows, int columns, const std::string& values) {
  return textOf(
             "<DataItem Format=\"XML\" NumberType=\"%s\" Precision=\"8\" Dimensions=\"%d %d\">\n",
             kind, rows, columns) +
         values + "</DataItem>\n";
}

std::string xdmfText() {
  const Arrays a;
  return "<Xdmf Version=\"3.0\"><Domain><Grid Name=\"g\">\n" +
         textOf("<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"%d\">\n", kCells) +
         xdmfItem("Int", kCells, 4, a.corners) + "</Topology>\n<Geometry GeometryType=\"XYZ\">\n" +
         xdmfItem("Float", kPoints, 3, a.points) +
         "</Geometry>\n<Attribute Name=\"p\" AttributeType=\"Scalar\" Center=\"Node\">\n" +
         xdmfItem("Float", kPoints, 1, a.values) + "</Attribute>\n</Grid></Domain></Xdmf>\n";
}

const TextFormat kArrayFormats[] = {{"vtk 3.0", openVtk, oldVtkText()},
                                    {"vtk 5.1", openVtk, newVtkText()},
                                    {"vtu", openVtu, vtuText()},
                                    {"xdmf", openXdmf, xdmfText()}};

TEST(ArrayThreads, GiveTheMeshOfOneThreadWhereverTheTextIsCut) {
  for (const TextFormat& format : kArrayFormats) {
    SCOPED_TRACE(format.name);
    const OpenIt open = format.opening();
    const std::string mesh = expectSame(open, {40, 1000, 100000});
    EXPECT_NE(mesh.substr(0, 6), "error:") << mesh.substr(0, 200);
    for (size_t bytes = 8; bytes < 200; bytes += 5)
      EXPECT_TRUE(outcomeOf(open, {someTasks()[bytes % someTasks().size()].get(), bytes}) == mesh)
          << bytes;
  }
}

TEST(ArrayThreads, KnowEveryBlank) {
  for (const TextFormat& format : kArrayFormats) {
    SCOPED_TRACE(format.name);
    const std::vector<std::string> all = linesOf(format.text);
    const std::string mesh = outcomeOf(format.opening());
    for (const char* end : {"\r\n", " \t\n", "\n\n"}) {
      if (std::string_view(format.name).starts_with("vtk") && end[1] == '\n') continue;
      EXPECT_TRUE(expectSame(opening(format.open, joined(all, end)), {30, 300}) == mesh);
    }
  }
}

TEST(ArrayThreads, FindTheFirstBadValueOfOneThread) {
  for (const TextFormat& format : kArrayFormats) {
    SCOPED_TRACE(format.name);
    const std::vector<std::string> all = linesOf(format.text);
    size_t errors = 0, tried = 0;
    for (size_t i = 4; i < all.size(); i += 5 * oneIn(3), ++tried) {
      std::vector<std::string> damaged = all;
      damaged[i] = kDamages[tried % std::size(kDamages)](all[i]);
      SCOPED_TRACE(damaged[i].substr(0, 60));
      errors += expectSame(opening(format.open, joined(damaged, "\n")), {50, 200})
                    .starts_with("error: mesh");
    }
    EXPECT_GT(errors, tried / 2);
  }
}

TEST(ArrayThreads, StopWhereATextIsCutOff) {
  expectSameWhereverCutOff(kArrayFormats);
}

TEST(ArrayThreads, NeedNobodyWhoComes) {
  expectSameWhoeverComes(kArrayFormats);
}

}  // namespace
}  // namespace tetstream
