// tests: an Exodus II file in netCDF-4, which is HDF5.
#pragma once

#include "hdf5_testing.h"

namespace tetstream::test {

inline void addTexts(Hdf5File& file, const std::string& path,
                     const std::vector<std::string>& rows) {
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

// Two cells of ten nodes each, a field over two time steps.
inline std::string netcdf4File(int64_t last_node = 5) {
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

}  // namespace tetstream::test
