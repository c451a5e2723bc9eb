// XDMF files whose values stand in HDF5.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "folder.h"
#include "hdf5_testing.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

class XdmfHdf5 : public testing::Test {
 protected:
  XdmfHdf5() {
    std::string bytes;
    Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
    {
      const Hdf5Turn turn;
      file.createGroup("Mesh");
      addColumn<double>(file, "Mesh/geometry", ValueType::kFloat64, 3,
                        {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
      addColumn<uint32_t>(file, "Mesh/topology", ValueType::kUInt32, 4, {0, 1, 2, 3, 1, 2, 3, 4});
      file.createGroup("Tags");
      addColumn<int64_t>(file, "Tags/cells", ValueType::kInt64, 4, {4, 3, 2, 1});
      addColumn<int64_t>(file, "Tags/part", ValueType::kInt64, 1, {5000000000});
      addColumn<int64_t>(file, "Tags/faces", ValueType::kInt64, 3, {0, 1, 2, 1, 2, 3});
      addColumn<double>(file, "Tags/side", ValueType::kFloat64, 1, {7, 8});
      addSteps(file);
    }
    file.close();
    std::ofstream(path_, std::ios::binary) << bytes;
  }

  std::string text(const std::string& topology, const std::string& rows) const {
    return "<Xdmf><Domain><Grid><Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"" +
           rows + " 4\" Format=\"HDF\">\n  " + path_ + ":/Mesh/" + topology +
           "\n</DataItem></Topology><Geometry><DataItem Dimensions=\"5 3\" Format=\"HDF\">" +
           path_ + ":/Mesh/geometry</DataItem></Geometry></Grid></Domain></Xdmf>";
  }

  // Numbers from 0 on: two steps of five vectors.
  static void addSteps(Hdf5File& file) {
    constexpr hsize_t sizes[3] = {2, 5, 3};
    float numbers[30];
    for (int i = 0; i < 30; ++i) numbers[i] = static_cast<float>(i);
    const Hdf5Id space(hdf5().Screate_simple(3, sizes, nullptr), hdf5().Sclose);
    const Hdf5Id set = file.create("Tags/steps", hdf5().T_NATIVE_FLOAT, space, H5P_DEFAULT);
    hdf5().Dwrite(set, hdf5().T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers);
  }

  const Folder folder_;
  const std::string path_ = folder_.file("mesh.h5");
};

TEST_F(XdmfHdf5, IsReadWhereItLies) {
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", text("topology", "2"), step);
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(valuesAs<double>(mesh.positions)[3], 1);
  }
}

// As ParaView and FEniCS's checkpoints name datasets: from the root, but without its slash.
TEST_F(XdmfHdf5, PathsWithoutASlashLeadFromTheRoot) {
  std::string bare = text("topology", "2");
  for (size_t at; (at = bare.find(":/Mesh")) != std::string::npos;) bare.replace(at, 6, ":Mesh");
  const VtuMesh mesh = readAs("xdmf", bare);
  EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(valuesAs<double>(mesh.positions)[3], 1);
}

// The middle rows of a larger dataset.
TEST_F(XdmfHdf5, SlabsAreCutOutOfIt) {
  std::string slab = text("topology", "1");
  const std::string whole =
      slab.substr(slab.find("<DataItem"), slab.find("</Topology>") - slab.find("<DataItem"));
  std::string source = whole;
  source.replace(source.find("\"1 4\""), 5, "\"2 4\"");
  slab.replace(slab.find(whole), whole.size(),
               "<DataItem ItemType=\"HyperSlab\" Dimensions=\"1 4\"><DataItem Dimensions=\"3 2\">"
               "1 0 1 1 1 4</DataItem>" +
                   source + "</DataItem>");
  EXPECT_EQ(readAs("xdmf", slab).cells, (std::vector<int64_t>{1, 2, 3, 4}));
}

// Untyped labels of dolfinx: HDF5 tells their type.
TEST_F(XdmfHdf5, LabelsBesideTheMeshHaveTheirTypes) {
  const auto named = [this](const std::string& sizes, const std::string& name) {
    return "<DataItem Dimensions=\"" + sizes + "\" Format=\"HDF\">" + path_ + ":/Tags/" + name +
           "</DataItem>";
  };
  const std::string same = "<xi:include xpointer=\"xpointer(/Xdmf/Domain/Grid/Geometry)\"/>";
  const auto grid = [&](const std::string& name, const std::string& type, const std::string& cells,
                        const std::string& values) {
    return "<Grid Name=\"" + name + "\">" + same + "<Topology TopologyType=\"" + type + "\">" +
           cells + "</Topology><Attribute Name=\"" + name + "\" Center=\"Cell\">" + values +
           "</Attribute></Grid>";
  };
  std::string file = text("topology", "2");
  file.replace(file.find("</Domain>"), 0,
               grid("part", "Tetrahedron", named("1 4", "cells"), named("1 1", "part")) +
                   grid("side", "Triangle", named("2 3", "faces"), named("2 1", "side")));
  const VtuMesh mesh = readAs("xdmf", file);
  EXPECT_EQ(valuesAs<int64_t>(mesh.cell_data.at(0)), (std::vector<int64_t>{0, 5000000000}));
  EXPECT_EQ(mesh.face_labels.size(), 2u);
  const std::string lie = ":/Tags/side", wrong = ":/Tags/none";
  file.replace(file.find(lie), lie.size(), wrong);
  EXPECT_NE(failureAs("xdmf", file).find("there is no dataset"), std::string::npos);
}

// One of several steps of a vector, as PETSc writes it.
TEST_F(XdmfHdf5, SlabsAreCutOutOfDatasetsOfThreeDirections) {
  std::string file = text("topology", "2");
  file.replace(file.find("</Grid>"), 0,
               "<Attribute Name=\"w\" Center=\"Node\"><DataItem ItemType=\"HyperSlab\" "
               "Dimensions=\"1 5 3\"><DataItem Dimensions=\"3 3\">1 0 0 1 1 1 1 5 3</DataItem>"
               "<DataItem Dimensions=\"2 5 3\" Format=\"HDF\">" +
                   path_ + ":/Tags/steps</DataItem></DataItem></Attribute>");
  for (const size_t step : {1, 1000}) {
    const VtuMesh mesh = readAs("xdmf", file, step);
    EXPECT_EQ(mesh.schema.fields.at(0).components, 3);
    EXPECT_EQ(valuesAs<float>(mesh.fields.at(0)),
              (std::vector<float>{15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29}));
  }
}

TEST_F(XdmfHdf5, SaysWhatIsNotThere) {
  EXPECT_NE(failureAs("xdmf", text("none", "2")).find("there is no dataset"), std::string::npos);
  EXPECT_NE(failureAs("xdmf", text("topology", "3")).find("has not the 12 numbers"),
            std::string::npos);
  for (const std::string& name :
       {path_, path_ + ":", path_ + ":/", std::string(":Mesh/topology")}) {
    std::string wrong = text("topology", "2");
    const std::string right = path_ + ":/Mesh/topology";
    wrong.replace(wrong.find(right), right.size(), name);
    EXPECT_NE(failureAs("xdmf", wrong).find("names no dataset"), std::string::npos) << name;
  }
  std::remove(path_.c_str());
  EXPECT_TRUE(failureAs("xdmf", text("topology", "2")).starts_with("TETSTREAM_IO"));
}

}  // namespace
}  // namespace tetstream
