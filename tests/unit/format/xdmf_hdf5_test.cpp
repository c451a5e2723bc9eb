// XDMF files whose values stand in HDF5.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

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
    }
    file.close();
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~XdmfHdf5() override { std::remove(path_.c_str()); }

  std::string text(const std::string& topology, const std::string& rows) const {
    return "<Xdmf><Domain><Grid><Topology TopologyType=\"Tetrahedron\"><DataItem Dimensions=\"" +
           rows + " 4\" Format=\"HDF\">\n  " + path_ + ":/Mesh/" + topology +
           "\n</DataItem></Topology><Geometry><DataItem Dimensions=\"5 3\" Format=\"HDF\">" +
           path_ + ":/Mesh/geometry</DataItem></Geometry></Grid></Domain></Xdmf>";
  }

  const std::string path_ = testing::TempDir() + "tetstream_xdmf_hdf5_test.h5";
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
