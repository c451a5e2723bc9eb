// Exodus II files in netCDF-4, which is HDF5.
#include <gtest/gtest.h>

#include "netcdf4_testing.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

TEST(Netcdf4, IsReadAsTheOthersAre) {
  for (const size_t step : {1, 3, 1000}) {
    const VtuMesh mesh = readAs("exodus", netcdf4File(), step);
    EXPECT_EQ(valuesAs<double>(mesh.positions),
              (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{5, 6, 7, 8, 9}));
    EXPECT_EQ(mesh.schema.fields[0].name, "p");
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{30, 30}));
  }
}

TEST(Netcdf4, WrongNodesAndCutFilesAreRefused) {
  EXPECT_NE(failureAs("exodus", netcdf4File(6)).find("cell 1 uses point 5"), std::string::npos);
  const std::string good = netcdf4File();
  for (size_t size = 4; size < good.size(); size += 97) {
    const std::string text = failureAs("exodus", good.substr(0, size));
    EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.exodus: ")) << size << ": " << text;
  }
}

}  // namespace
}  // namespace tetstream
