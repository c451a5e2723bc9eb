// Exodus II files in netCDF's classic layouts.
#include <gtest/gtest.h>

#include "netcdf_testing.h"
#include "slow_run.h"
#include "status.h"
#include "vtu_mesh_testing.h"

namespace tetstream {
namespace {

using namespace test;

TestVariable& variable(NetcdfMaker& m, const std::string& name) {
  for (TestVariable& v : m.variables)
    if (v.name == name) return v;
  throw std::runtime_error(name);
}

TEST(Exodus, IsReadInEachLayout) {
  for (const int version : {1, 2, 5})
    for (const bool streaming : {false, true})
      for (const size_t step : {1, 1000}) {
        NetcdfMaker m = twoBlocks(version);
        m.streaming = streaming;
        const VtuMesh mesh = readAs("exodus", m.make(), step);
        EXPECT_EQ(mesh.schema.position_type, ScalarType::kFloat64);
        EXPECT_EQ(valuesAs<double>(mesh.positions),
                  (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
        EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
        ASSERT_EQ(mesh.schema.fields.size(), 1u);
        EXPECT_EQ(mesh.schema.fields[0].name, "p");
        EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{10, 11, 12, 13, 14}));
        ASSERT_EQ(mesh.schema.cell_data.size(), 2u);
        EXPECT_EQ(mesh.schema.cell_data[1].name, "rho");
        EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{30, 20}));
        EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), (std::vector<float>{0, 0.75}));
        EXPECT_TRUE(hasNote(mesh, "of 3 time steps, 0 to 2, step 2 is read, at time 1"));
        EXPECT_TRUE(hasNote(mesh, "\"rho\" has no value at 1 elements"));
        EXPECT_EQ(mesh.schema.label_names,
                  (std::vector<LabelName>{
                      {"", 7, "inlet"}, {"block_id", 20, "sand"}, {"block_id", 30, "rock"}}));
        EXPECT_TRUE(hasNote(mesh, "side set 7 labels faces"));
        EXPECT_TRUE(hasNote(mesh, "2 node sets are left out"));
      }
}

TEST(Exodus, SidesLabelFacesOnceEach) {
  const VtuMesh mesh = readAs("exodus", twoBlocks().make(), 1);
  EXPECT_EQ(mesh.face_labels.size(), 3u);
  EXPECT_EQ(labelsOfFaces(mesh), (LabelsOfFaces{{{0, 1, 2}, 7}, {{1, 2, 3}, 7}, {{2, 3, 4}, 9}}));
  EXPECT_TRUE(hasNote(mesh, "1 faces are in side sets more than once"));
}

TEST(Exodus, OfVariablesOfOneNameTheFirstIsRead) {
  NetcdfMaker m = twoBlocks();
  for (TestVariable& v : m.variables)
    if (v.name == "name_elem_var") v.text = "block_id";
  const VtuMesh mesh = readAs("exodus", m.make());
  EXPECT_TRUE(
      hasNote(mesh, "variable \"block_id\" is left out: there is another array of its name"));
  ASSERT_EQ(mesh.schema.cell_data.size(), 1u);
  EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{30, 20}));
}

TEST(Exodus, TheTimeStepIsChosen) {
  const std::string file = twoBlocks().make();
  ReadOptions options;
  options.step = 1;
  const VtuMesh mesh = readAs("exodus", file, 1000, options);
  EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{5, 6, 7, 8, 9}));
  EXPECT_TRUE(hasNote(mesh, "step 1 is read, at time 0.5"));
  EXPECT_EQ(mesh.schema.time, 0.5);
  options.step = 3;
  try {
    readAs("exodus", file, 1000, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadArgument);
    EXPECT_TRUE(has(error.text(), "there is no time step 3")) << error.text();
  }
}

TEST(Exodus, OldFilesHaveCoordinatesAndVariablesInOneEach) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["three"] = 3;
  m.variables[1] = {
      "coord", 6, {"three", "nodes"}, {0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1}, ""};
  m.variables.erase(m.variables.begin() + 2, m.variables.begin() + 4);
  TestVariable& names = variable(m, "name_nod_var");
  names.dimensions[0] = "two";
  names.text = std::string("p\0\0\0\0\0\0\0\0q", 10);
  TestVariable& values = variable(m, "vals_nod_var1");
  values.name = "vals_nod_var";
  values.dimensions = {"time", "two", "nodes"};
  values.values.resize(30);
  for (size_t i = 0; i < 30; ++i) values.values[i] = static_cast<double>(i);
  const VtuMesh mesh = readAs("exodus", m.make(), 2);
  EXPECT_EQ(valuesAs<double>(mesh.positions),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
  ASSERT_EQ(mesh.fields.size(), 2u);
  EXPECT_EQ(valuesAs<double>(mesh.fields[1]), (std::vector<double>{25, 26, 27, 28, 29}));
}

// As some writers have vectors, though the format has none.
TEST(Exodus, VariablesOfOneDimensionMoreAreVectors) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["three"] = 3;
  m.dimensions["ten"] = 10;
  TestVariable& of_nodes = variable(m, "vals_nod_var1");
  of_nodes.dimensions.push_back("three");
  of_nodes.values.resize(45);
  for (size_t i = 0; i < 45; ++i) of_nodes.values[i] = static_cast<double>(i);
  TestVariable& of_elements = variable(m, "vals_elem_var1eb2");
  of_elements.dimensions.push_back("three");
  of_elements.values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const VtuMesh mesh = readAs("exodus", m.make(), 2);
  ASSERT_EQ(mesh.schema.fields.size(), 1u);
  EXPECT_EQ(mesh.schema.fields[0].components, 3);
  const std::vector<double> nodal = valuesAs<double>(mesh.fields[0]);
  ASSERT_EQ(nodal.size(), 15u);
  for (size_t i = 0; i < 15; ++i) EXPECT_EQ(nodal[i], 30 + static_cast<double>(i));
  ASSERT_EQ(mesh.schema.cell_data.size(), 2u);
  EXPECT_EQ(valuesAs<float>(mesh.cell_data[1]), (std::vector<float>{0, 0, 0, 7, 8, 9}));
  of_nodes.dimensions.back() = "ten";
  of_nodes.values.resize(150);
  const VtuMesh wide = readAs("exodus", m.make(), 2);
  EXPECT_TRUE(hasNote(wide, "variable \"p\" is left out: it has more than 9 components"));
  EXPECT_TRUE(wide.schema.fields.empty());
}

TEST(Exodus, StepsThatAVariableLacksAreTold) {
  NetcdfMaker m = twoBlocks();
  TestVariable& values = variable(m, "vals_nod_var1");
  values.dimensions = {"two", "nodes"};
  values.values.resize(10);
  const VtuMesh mesh = readAs("exodus", m.make(), 2);
  EXPECT_TRUE(hasNote(mesh, "variable \"p\" is left out: it has no values of this time step"));
  EXPECT_TRUE(mesh.schema.fields.empty());
}

// Of six nodes and of more the first triangle is turned inwards, as in hexahedra the first square.
TEST(Exodus, PrismsBecomeTetrahedraOfPositiveVolume) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["six"] = 6;
  variable(m, "connect2") = {"connect2", 4, {"one", "six"}, {1, 2, 3, 4, 5, 6}, "", "WEDGE"};
  m.dimensions["nodes"] = 6;
  const char* const axes[] = {"coordx", "coordy", "coordz"};
  const std::vector<double> places[] = {{0, 1, 0, 0, 1, 0}, {0, 0, 1, 0, 0, 1}, {0, 0, 0, 2, 2, 2}};
  for (size_t k = 0; k < 3; ++k) variable(m, axes[k]).values = places[k];
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("exodus", m.make(), 1, options);
  EXPECT_FALSE(hasNote(mesh, "higher order"));
  const std::vector<double> x = valuesAs<double>(mesh.positions);
  double whole = 0;
  for (size_t c = 0; 4 * c < mesh.cells.size(); ++c) {
    if (valuesAs<int32_t>(mesh.cell_data[0])[c] != 20) continue;
    const double volume = signedVolume(x, &mesh.cells[4 * c]);
    EXPECT_GT(volume, 0) << c;
    whole += volume;
  }
  EXPECT_NEAR(whole, 1, 1e-12);
}

// A prism on a tetrahedron, and a block of triangles.
TEST(Exodus, OtherBlocksAreSplitIfAskedFor) {
  NetcdfMaker m = twoBlocks();
  m.dimensions["six"] = 6;
  m.dimensions["three"] = 3;
  variable(m, "connect2") = {"connect2", 4, {"one", "six"}, {2, 3, 4, 5, 1, 2}, "", "WEDGE"};
  variable(m, "connect1") = {"connect1", 4, {"one", "three"}, {1, 2, 3}, "", "TRI3"};
  for (const char* set : {"elem_ss1", "side_ss1"}) variable(m, set).values = {2, 2};
  const std::string refused = failureAs("exodus", m.make());
  EXPECT_TRUE(has(refused,
                  "UNSUPPORTED: test.exodus: element block 20 (\"sand\") has elements "
                  "\"WEDGE\" of 6 nodes; only tetrahedra are read, unless"))
      << refused;
  ReadOptions options;
  options.split = true;
  const VtuMesh mesh = readAs("exodus", m.make(), 1, options);
  EXPECT_TRUE(hasNote(mesh, "1 cells that are no tetrahedra are split"));
  EXPECT_TRUE(hasNote(mesh, "1 cells of lower dimension are left out"));
  for (const int32_t id : valuesAs<int32_t>(mesh.cell_data[0])) EXPECT_EQ(id, 20);
  // Sides are cut by the points as they are, and so are cells only if these stay.
  options.join = PointJoining::kYes;
  try {
    readAs("exodus", m.make(), 1000, options);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(has(error.text(), "points are not joined where labelled faces stand apart"));
  }
  options.join = PointJoining::kAuto;
  m.variables.erase(m.variables.begin() + 12, m.variables.begin() + 18);  // no side sets
  const VtuMesh labelled = readAs("exodus", m.make(), 1, options);
  EXPECT_EQ(labelled.face_labels, (std::vector<int64_t>{30}));
}

TEST(Exodus, SaysWhichVariableIsWrong) {
  const auto failure = [](auto change) {
    NetcdfMaker m = twoBlocks();
    change(m);
    return failureAs("exodus", m.make());
  };
  EXPECT_TRUE(has(failureAs("exodus", "no netCDF"), "BAD_DATA: test.exodus: this is no netCDF"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) {
                    variable(m, "connect2").values[0] = 6;
                    for (const char* list : {"side_ss1", "side_ss2"})
                      variable(m, list).values = {1, 2};
                    variable(m, "elem_ss2").values = {1, 1};
                  }),
                  "cell 1 uses point 5, there are 5"));
  EXPECT_TRUE(has(failureAs("exodus", ""), "BAD_DATA: test.exodus: this is no netCDF"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect2").values[3] = 6; }),
                  "element 2 uses node 6, there are 5"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect2").values[3] = 0; }),
                  "element 2 uses node 0, there are 5"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "elem_ss2").values[1] = 3; }),
                  "side set 2 names element 3, there are 2"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "side_ss2").values[1] = 5; }),
                  "side set 2 names side 5 of a tetrahedron"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "side_ss2").dimensions = {"one"}; }),
                  "\"elem_ss2\" and \"side_ss2\" do not match"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "coordy").dimensions = {"four"}; }),
                  "the coordinates are not as many"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "coordz").name = "other"; }),
                  "UNSUPPORTED: test.exodus: the mesh has not three dimensions"));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "connect1").attribute = "NFACED"; }),
                  "element block 30 (\"rock\") has elements \"NFACED\""));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { variable(m, "vals_nod_var1").name = "x"; }),
                  "there is no \"vals_nod_var\""));
  EXPECT_TRUE(has(failure([](NetcdfMaker& m) { m.version = 3; }), "netCDF of version 3"));
}

TEST(Exodus, RefusesClaimsAndFilesThatAreCut) {
  for (const int version : {1, 5}) {
    const std::string good = twoBlocks(version).make();
    for (size_t size = 0; size < good.size(); size += (version == 1 ? 1 : 7) * oneIn(5)) {
      const std::string text = failureAs("exodus", good.substr(0, size));
      EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.exodus: ")) << size << ": " << text;
    }
    // Any word of the header may be a lie: nothing worse than an error comes of it.
    for (size_t at = 4; at + 4 <= good.size() && at < 1600; at += 4 * oneIn(3))
      for (const char* lie : {"\x7F\xFF\xFF\xFF", "\xFF\xFF\xFF\xFF", "\x00\x00\x00\x00"}) {
        std::string bad = good;
        bad.replace(at, 4, lie, 4);
        failureAs("exodus", bad);
      }
  }
}

}  // namespace
}  // namespace tetstream
