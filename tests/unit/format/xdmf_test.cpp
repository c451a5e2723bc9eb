// XDMF files whose values stand in their text.
#include <gtest/gtest.h>

#include "status.h"
#include "vtu_mesh_testing.h"
#include "xdmf_testing.h"

namespace tetstream {
namespace {

using namespace test;

std::string file(const std::string& grids) {
  return "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"3.0\" "
         "xmlns:xi=\"http://www.w3.org/2001/XInclude\"><Domain>" +
         grids + "</Domain></Xdmf>";
}

const std::string kXdmfPoints =
    "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"5 3\" NumberType=\"Float\" "
    "Precision=\"8\" Format=\"XML\">0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataItem></Geometry>";
const std::string kXdmfCells =
    "<Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"2\"><DataItem Dimensions=\"2 4\" "
    "NumberType=\"Int\" Format=\"XML\">0 1 2 3 1 2 3 4</DataItem></Topology>";

std::string attribute(const std::string& name, const std::string& values,
                      const std::string& center = "Node", const std::string& sizes = "5") {
  return "<Attribute Name=\"" + name + "\" AttributeType=\"Scalar\" Center=\"" + center +
         "\"><DataItem Dimensions=\"" + sizes + "\" Format=\"XML\">" + values +
         "</DataItem></Attribute>";
}

std::string uniform(const std::string& name, const std::string& content) {
  return "<Grid Name=\"" + name + "\" GridType=\"Uniform\">" + content + "</Grid>";
}

std::string collection(const std::string& name, const char* type, const std::string& grids) {
  return "<Grid Name=\"" + name + "\" GridType=\"Collection\" CollectionType=\"" + type + "\">" +
         grids + "</Grid>";
}

TEST(Xdmf, OneGridIsReadWithItsValues) {
  const std::string text = file(uniform(
      "mesh", kXdmfCells + kXdmfPoints + attribute("p", "1 2 3 4 5") +
                  attribute("rho", "7 8", "Cell", "2 1") + attribute("g", "1", "Grid", "1") +
                  attribute("u", "0 1 2 3 1 2 3 4", "Other", "8 1")));
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", text, step);
    EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
    EXPECT_EQ(valuesAs<double>(mesh.positions),
              (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(mesh.cells, kTwoCells);
    EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
    EXPECT_EQ(valuesAs<float>(mesh.cell_data[0]), (std::vector<float>{7, 8}));
    EXPECT_TRUE(hasNote(mesh, "array \"g\" is left out: it is of Grid"));
    EXPECT_TRUE(hasNote(mesh, "array \"u\" is left out: it is of neither nodes nor cells"));
  }
}

// Text whose type the file does not tell is of integers where nodes are told.
TEST(Xdmf, CellsNeedNoTypeInText) {
  const auto cells = [](const std::string& text) {
    return file(uniform("m", "<Topology TopologyType=\"Tetrahedron\">" + xdmfItem("2 4", text) +
                                 "</Topology>" + kXdmfPoints));
  };
  EXPECT_EQ(readAs("xdmf", cells("0 1 2 3 1 2 3 4")).cells, kTwoCells);
  EXPECT_TRUE(has(failureAs("xdmf", cells("0 1 2 3 1 2 3 4.5")), "BAD_DATA"));
}

// As ParaView writes arrays: with empty words, which say that it is no function.
TEST(Xdmf, EmptyWordsMakeNoFunction) {
  const auto withWords = [](std::string text, const std::string& words) {
    return text.insert(text.find(" AttributeType"), words);
  };
  const std::string none = " ElementCell=\"\" ElementDegree=\"0\" ElementFamily=\"\" ItemType=\"\"";
  const std::string some =
      " ElementCell=\"tetrahedron\" ElementDegree=\"1\" ElementFamily=\"CG\" "
      "ItemType=\"FiniteElementFunction\"";
  const VtuMesh mesh = readAs(
      "xdmf",
      file(uniform("m", kXdmfCells + kXdmfPoints + withWords(attribute("p", "1 2 3 4 5"), none) +
                            withWords(attribute("rho", "7 8", "Cell", "2"), none) +
                            withWords(attribute("f", "1 2 3 4 5"), some))));
  ASSERT_EQ(mesh.schema.fields.size(), 1u);
  EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{1, 2, 3, 4, 5}));
  ASSERT_EQ(mesh.cell_data.size(), 1u);
  EXPECT_EQ(valuesAs<float>(mesh.cell_data[0]), (std::vector<float>{7, 8}));
  EXPECT_TRUE(hasNote(mesh, "array \"f\" is left out: it is no list of values, but a function"));
}

TEST(Xdmf, AGridMayTellItsTime) {
  const std::string grid = kXdmfCells + kXdmfPoints;
  EXPECT_EQ(readAs("xdmf", file(uniform("mesh", grid + "<Time Value=\"0.5\"/>"))).schema.time, 0.5);
  EXPECT_EQ(readAs("xdmf", file(uniform("mesh", grid + "<Time Value=\" 0.5 \"/>"))).schema.time,
            0.5);
  EXPECT_EQ(readAs("xdmf", file(uniform("mesh", grid + "<Time Value=\"+0.3D+01\"/>"))).schema.time,
            3);
  EXPECT_FALSE(readAs("xdmf", file(uniform("mesh", grid))).schema.time);
  const VtuMesh strange = readAs("xdmf", file(uniform("mesh", grid + "<Time Value=\"1.5 s\"/>")));
  EXPECT_FALSE(strange.schema.time);
  EXPECT_TRUE(hasNote(strange, "the time is left out"));
}

TEST(Xdmf, AStepHasTheTimeThatIsToldOfItAlone) {
  const std::string grid = kXdmfCells + kXdmfPoints, time = "<Time Value=\"5\"/>";
  const auto timeOf = [](const std::string& steps) {
    return readAs("xdmf", file(collection("all", "Temporal", steps))).schema.time;
  };
  EXPECT_EQ(timeOf(uniform("a", grid) + uniform("b", grid + time)), 5);
  EXPECT_FALSE(timeOf(uniform("a", grid + time) + uniform("b", grid)));
  EXPECT_EQ(timeOf(collection("in space", "Spatial", uniform("a", grid + time))), 5);
  EXPECT_EQ(
      timeOf("<Time TimeType=\"List\"><DataItem Dimensions=\"2\" Format=\"XML\">1 2</DataItem>"
             "</Time>" +
             uniform("a", grid) + uniform("b", grid)),
      2);
  EXPECT_EQ(timeOf("<Time TimeType=\"HyperSlab\"><DataItem Dimensions=\"3\" Format=\"XML\">"
                   "0.5 0.25 2</DataItem></Time>" +
                   uniform("a", grid) + uniform("b", grid)),
            0.75);
}

// What cannot be read of a time is no reason not to read the mesh.
TEST(Xdmf, ATimeThatIsNoNumberIsLeftOut) {
  const VtuMesh mesh =
      readAs("xdmf", file(collection("all", "Temporal",
                                     "<Time TimeType=\"List\"><DataItem Dimensions=\"1\" "
                                     "Format=\"XML\">soon</DataItem></Time>" +
                                         uniform("a", kXdmfCells + kXdmfPoints))));
  EXPECT_EQ(mesh.cells, kTwoCells);
  EXPECT_FALSE(mesh.schema.time);
  EXPECT_TRUE(hasNote(mesh, "the time is left out: test.xdmf: array \"times\": byte"));
}

// As FEniCS writes functions: the mesh once, then grids that include it.
TEST(Xdmf, StepsIncludeTheirMeshAndFunctionsOnItJoin) {
  const std::string include =
      "<xi:include xpointer=\"xpointer(//Grid[@Name=&quot;mesh&quot;]/*[self::Topology or "
      "self::Geometry])\"/>";
  const auto step = [&](const std::string& name, const char* time, const std::string& values) {
    return uniform(name, include + "<Time Value=\"" + time + "\"/>" + attribute(name, values));
  };
  const std::string text = file(
      uniform("mesh", kXdmfCells + kXdmfPoints) +
      collection("u", "Temporal", step("u", "0", "1 2 3 4 5") + step("u", "0.5", "6 7 8 9 10")) +
      collection("v", "Temporal", step("v", "0", "0 0 0 0 0") + step("v", "0.5", "1 1 1 1 1")) +
      collection("w", "Temporal", step("w", "0", "0 0 0 0 0")));
  const VtuMesh mesh = readAs("xdmf", text);
  EXPECT_EQ(mesh.cells, kTwoCells);
  ASSERT_EQ(mesh.schema.fields.size(), 2u);
  EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{6, 7, 8, 9, 10}));
  EXPECT_EQ(valuesAs<float>(mesh.fields[1]), (std::vector<float>{1, 1, 1, 1, 1}));
  EXPECT_TRUE(hasNote(mesh, "of 2 time steps, 0 to 1, step 1 is read, at time 0.5"));
  EXPECT_EQ(mesh.schema.time, 0.5);
  EXPECT_TRUE(hasNote(mesh, "grid \"w\" is left out: it has other time steps"));
  ReadOptions options;
  options.step = 0;
  EXPECT_EQ(valuesAs<float>(readAs("xdmf", text, 1, options).fields[0]),
            (std::vector<float>{1, 2, 3, 4, 5}));
  options.step = 2;
  EXPECT_THROW(readAs("xdmf", text, 1, options), Error);
}

// As FEniCS of 2019: the first step holds the mesh, the others include it from there.
TEST(Xdmf, StepsIncludeTheMeshOfTheFirst) {
  const std::string include =
      "<xi:include xpointer=\"xpointer(//Grid[@Name='all']/Grid[1]/*[self::Topology or "
      "self::Geometry])\"/>";
  const VtuMesh mesh = readAs(
      "xdmf",
      file(collection("all", "Temporal",
                      uniform("mesh", kXdmfCells + kXdmfPoints + attribute("u", "1 2 3 4 5")) +
                          uniform("mesh", include + attribute("u", "2 3 4 5 6")))));
  EXPECT_EQ(mesh.cells, kTwoCells);
  EXPECT_EQ(valuesAs<float>(mesh.fields[0]), (std::vector<float>{2, 3, 4, 5, 6}));
}

TEST(Xdmf, CellsOfSeveralTypesAreSplitAndFacesLabelled) {
  const std::string mixed =
      "<Topology TopologyType=\"Mixed\"><DataItem Dimensions=\"19\" NumberType=\"Int\" "
      "Format=\"XML\">6 0 1 2 3  4 0 1 2  7 0 1 2 3 4  2 2 0 1</DataItem></Topology>";
  const std::string bad =
      "<Topology TopologyType=\"Mixed\"><DataItem Dimensions=\"8\" NumberType=\"Int\" "
      "Format=\"XML\">6 0 1 2 3  6 1 2</DataItem></Topology>";
  const std::string label =
      "<Attribute Name=\"tag\" Center=\"Cell\"><DataItem Dimensions=\"4\" NumberType=\"Int\" "
      "Format=\"XML\">7 8 9 10</DataItem></Attribute>";
  const std::string text = file(uniform("m", mixed + kXdmfPoints + label));
  EXPECT_TRUE(has(failureAs("xdmf", text), "cell 2 has VTK's type 14, a pyramid; only tetra"));
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("xdmf", text, 1, options);
  EXPECT_EQ(mesh.schema.cell_count, 3);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{7, 9, 9}));
  EXPECT_EQ(mesh.face_labels, (std::vector<int64_t>{8}));
  EXPECT_TRUE(
      has(failureAs("xdmf", file(uniform("m", bad + kXdmfPoints))), "cell 1 is not there in full"));
}

// Cells that both have are there once.
TEST(Xdmf, GridsInSpaceAreJoined) {
  const auto both = [](const std::string& points) {
    return readAs("xdmf", file(collection("parts", "Spatial",
                                          uniform("a", kXdmfCells + kXdmfPoints) +
                                              uniform("b", kXdmfCells + points))));
  };
  const VtuMesh apart = both(replaced(kXdmfPoints, "0 0 0 1", "2 2 2 1"));
  EXPECT_EQ(apart.schema.vertex_count, 6);
  EXPECT_EQ(apart.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4, 5, 1, 2, 3}));
  EXPECT_TRUE(hasNote(apart, "1 cells that an earlier piece has"));
  const VtuMesh same = both(kXdmfPoints);
  EXPECT_EQ(same.schema.vertex_count, 5);
  EXPECT_EQ(same.cells, kTwoCells);
}

// As those of .pvtu.
TEST(Xdmf, GhostsOfGridsInSpaceAreLeftOut) {
  const auto piece = [](const std::string& marks) {
    return uniform("part", kXdmfCells + kXdmfPoints + attribute("p", "1 2 3 4 5") +
                               replaced(attribute("vtkGhostType", marks, "Cell", "2"), "Format",
                                        "NumberType=\"UChar\" Precision=\"1\" Format"));
  };
  const VtuMesh mesh =
      readAs("xdmf", file(collection("all", "Spatial", piece("0 1") + piece("1 0"))));
  EXPECT_EQ(mesh.cells, kTwoCells);
  EXPECT_TRUE(mesh.cell_data.empty());
  EXPECT_TRUE(hasNote(mesh, "2 ghost cells"));
}

TEST(Xdmf, TellsWhatItLeavesOut) {
  const std::string values = "<DataItem Dimensions=\"5\" Format=\"XML\">1 2 3 4 5</DataItem>";
  const VtuMesh mesh = readAs(
      "xdmf", file(uniform("mesh", kXdmfCells + kXdmfPoints + "<Attribute>" + values +
                                       "</Attribute>" + "<Attribute>" + values +
                                       "</Attribute><Set Name=\"s\" "
                                       "SetType=\"Node\">" +
                                       values +
                                       "</Set><xi:include xpointer=\""
                                       "xpointer(/Xdmf/Domain/Grid[2]/*[self::Attribute])\"/>") +
                   uniform("other", kXdmfCells + replaced(kXdmfPoints, "1 1 1", "1 1 2") +
                                        attribute("f", "1 2 3 4 5"))));
  ASSERT_EQ(mesh.fields.size(), 1u);
  EXPECT_TRUE(hasNote(mesh, "grid \"other\" is left out: it has another mesh"));
  EXPECT_EQ(mesh.schema.fields[0].name, "values");
  EXPECT_TRUE(hasNote(mesh, "array \"values\" is left out: there is another one of its name"));
  EXPECT_TRUE(hasNote(mesh, "sets of nodes, faces or cells are left out"));
  EXPECT_TRUE(hasNote(mesh, "attributes that a grid includes from another one are left out"));
}

TEST(Xdmf, RefusesCellsWithOtherPointsThanThoseOfTheirNumbers) {
  const auto with = [](const std::string& words) {
    return file(
        uniform("m", replaced(kXdmfCells, "<Topology", "<Topology " + words) + kXdmfPoints));
  };
  for (const char* plain : {"BaseOffset=\"0\"", "Order=\"0 1 2 3\"", "Order=\"\" BaseOffset=\" \""})
    EXPECT_EQ(readAs("xdmf", with(plain)).cells, kTwoCells);
  EXPECT_TRUE(has(failureAs("xdmf", with("BaseOffset=\"1\"")),
                  "the BaseOffset of a Topology is not followed"));
  EXPECT_TRUE(
      has(failureAs("xdmf", with("Order=\"0 2 1 3\"")), "the Order of a Topology is not followed"));
}

// As Chaste writes them: each part a whole file.
TEST(Xdmf, NamesTheFileThatAGridTakesPartsFrom) {
  const std::string cells = "<xi:include href=\"cells_0.xml\"/>";
  for (const std::string& parts : {cells, kXdmfPoints + cells, cells + kXdmfPoints}) {
    const std::string problem = failureAs("xdmf", file(uniform("m", parts)));
    EXPECT_TRUE(has(problem, "grid \"m\" includes \"cells_0.xml\"")) << problem;
    EXPECT_TRUE(has(problem, "UNSUPPORTED")) << problem;
  }
  const VtuMesh mesh = readAs("xdmf", file(uniform("m", kXdmfCells + kXdmfPoints + cells)));
  EXPECT_EQ(mesh.cells, kTwoCells);
  EXPECT_TRUE(hasNote(mesh, "what a grid includes from other XML files is left out"));
}

TEST(Xdmf, SaysWhatIsWrong) {
  const auto failure = [](const std::string& content) {
    return failureAs("xdmf", file(uniform("m", content)));
  };
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
  };
  EXPECT_TRUE(has(failureAs("xdmf", "<VTKFile/>"), "this is no XDMF file"));
  EXPECT_TRUE(has(failureAs("xdmf", file("")), "there is no grid with cells"));
  EXPECT_TRUE(has(failure(kXdmfPoints), "there is no grid with cells"));
  EXPECT_TRUE(has(failure(kXdmfCells), "has no topology or no geometry"));
  EXPECT_TRUE(has(failure(replaced(kXdmfCells, "Tetrahedron", "Triangle") + kXdmfPoints),
                  "there are grids, but none with cells of three dimensions"));
  EXPECT_TRUE(has(failure(kXdmfCells + replaced(kXdmfPoints, "XYZ", "XY")),
                  "\"XY\" has no third coordinate"));
  EXPECT_TRUE(has(failure(kXdmfCells + replaced(kXdmfPoints, "5 3", "5 4")), "three coordinates"));
  EXPECT_TRUE(has(failure(kXdmfCells + replaced(kXdmfPoints, "5 3", "5 -3")), "are none"));
  EXPECT_TRUE(
      has(failure(kXdmfCells + replaced(kXdmfPoints, "5 3", "1152921504606846976 3")), "are none"));
  EXPECT_TRUE(
      has(failure(kXdmfCells + replaced(kXdmfPoints, "5 3", "72057594037927936 3")), "BAD_DATA"));
  EXPECT_TRUE(
      has(failure(kXdmfCells + replaced(kXdmfPoints, "XML", "XLS")), "\"XLS\" are not read"));
  EXPECT_TRUE(
      has(failure(replaced(kXdmfCells, "2 4", "7") + kXdmfPoints), "are not 4 nodes to a cell"));
  EXPECT_TRUE(
      has(failure(replaced(kXdmfCells, "3 4<", "3 5<") + kXdmfPoints), "cell 1 uses point 5"));
  EXPECT_TRUE(has(failure(kXdmfCells + kXdmfPoints + attribute("p", "1 2", "Node", "2")),
                  "2 values for 5"));
  const std::string good = file(uniform("m", kXdmfCells + kXdmfPoints));
  for (size_t size = 0; size < good.size(); ++size)
    EXPECT_TRUE(failureAs("xdmf", good.substr(0, size)).starts_with("TETSTREAM_BAD_DATA")) << size;
}

}  // namespace
}  // namespace tetstream
