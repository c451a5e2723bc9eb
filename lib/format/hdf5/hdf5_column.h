// format/hdf5: a dataset that grows as its rows come. Depends on hdf5_file.h.
#pragma once

#ifdef TETSTREAM_WITH_HDF5
#include "hdf5_file.h"

namespace tetstream {

class Hdf5Column {
 public:
  Hdf5Column(Hdf5File& file, const std::string& path, ValueType type, int components,
             bool compress);

  // All of these in a turn.
  void append(const void* rows, size_t count);
  void finish();  // after the last row

 private:
  void create(size_t chunk_rows);
  void writeHeld();
  int dimensions() const { return components_ == 1 ? 1 : 2; }

  Hdf5File& file_;
  std::string path_;
  ValueType type_;
  size_t components_, row_bytes_, chunk_rows_;
  bool compress_;
  Hdf5Id dataset_;
  std::vector<unsigned char> held_;  // less than a chunk
  uint64_t written_ = 0;             // rows
};

}  // namespace tetstream
#endif
