// Exodus II files in netCDF-4, which is HDF5.
#include <gtest/gtest.h>

#include "hdf5_testing.h"
#include "vtu_read.h"

namespace tetstream {
namespace {

using namespace test;

void addTexts(Hdf5File& file, const std::string& path, const std::vector<std::string>& rows) {
  constexpr hsize_t kWidth = 16;
  const Hdf5Functions& h = hdf5();
  const hsize_t sizes[2] = {rows.size(), kWidth};
  std::string all;
  for (std::string row : rows) {
    row.resize(kWidth);
    all += row;
  }
  const Hdf5Id space(h.Screate_simple(2, sizes, nullptr), h.Sclose);
  const Hdf5Id made = file.create(path, h.T_C_S1, space, H5P_DEFAULT);
  file.check(h.Dwrite(made, h.T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), path);
}

std::string makeFile(int64_t last_node = 5) {
  std::string bytes;
  Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
  {
    const Hdf5Turn turn;
    addColumn<double>(file, "coordx", ValueType::kFloat64, 1, {0, 1, 0, 0, 1});
    addColumn<double>(file, "coordy", ValueType::kFloat64, 1, {0, 0, 1, 0, 1});
    addColumn<double>(file, "coordz", ValueType::kFloat64, 1, {0, 0, 0, 1, 1});
    addColumn<int64_t>(file, "eb_prop1", ValueType::kInt64, 1, {30});
    addColumn<int64_t>(file, "connect1", ValueType::kInt64, 10,
                       {1, 2, 3, 4, 1, 1, 1, 1, 1, 1, 2, 3, 4, last_node, 1, 1, 1, 1, 1, 1});
    const Hdf5Id connect = file.openDataset("connect1");
    file.addAttribute(connect, "elem_type", std::string("TETRA10"));
    addColumn<double>(file, "time_whole", ValueType::kFloat64, 1, {0, 1});
    addTexts(file, "name_nod_var", {"p"});
    addTexts(file, "eb_names", {"rock"});
    addColumn<double>(file, "vals_nod_var1", ValueType::kFloat64, 5,
                      {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  }
  file.close();
  return bytes;
}

TEST(Netcdf4, IsReadAsTheOthersAre) {
  for (const size_t step : {1, 3, 1000}) {
    const VtuMesh mesh = readAs("exodus", makeFile(), step);
    EXPECT_EQ(valuesAs<double>(mesh.positions),
              (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(mesh.cells, (std::vector<int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(valuesAs<double>(mesh.fields[0]), (std::vector<double>{5, 6, 7, 8, 9}));
    EXPECT_EQ(mesh.schema.fields[0].name, "p");
    EXPECT_EQ(valuesAs<int32_t>(mesh.cell_data[0]), (std::vector<int32_t>{30, 30}));
  }
}

TEST(Netcdf4, WrongNodesAndCutFilesAreRefused) {
  EXPECT_NE(failureAs("exodus", makeFile(6)).find("cell 1 uses point 5"), std::string::npos);
  const std::string good = makeFile();
  for (size_t size = 4; size < good.size(); size += 97) {
    const std::string text = failureAs("exodus", good.substr(0, size));
    EXPECT_TRUE(text.starts_with("TETSTREAM_BAD_DATA: test.exodus: ")) << size << ": " << text;
  }
}

}  // namespace
}  // namespace tetstream
