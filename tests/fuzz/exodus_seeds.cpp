// exodus_seeds FOLDER: Exodus II files in each layout of netCDF, which the command does not write.
#include <cstdio>
#include <fstream>
#include <string>

#include "netcdf_testing.h"
#ifdef TETSTREAM_WITH_HDF5
#include "netcdf4_testing.h"
#endif

using namespace tetstream::test;

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const std::string folder = argv[1];
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder + "/" + name, std::ios::binary) << bytes;
  };
  for (const int version : {1, 2, 5})
    write("classic" + std::to_string(version), twoBlocks(version).make());
  NetcdfMaker streaming = twoBlocks();
  streaming.streaming = true;
  write("streaming", streaming.make());
#ifdef TETSTREAM_WITH_HDF5
  write("netcdf4", netcdf4File());
#endif
  return 0;
}
