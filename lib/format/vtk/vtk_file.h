// format/vtk: what a legacy VTK file says of its arrays and where their values lie. Depends on
// mesh_pieces.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bytes.h"
#include "mesh_pieces.h"

namespace tetstream {

struct VtkArray {
  std::string name;
  ValueType type = ValueType::kFloat32;
  bool bits = false;  // binary: eight values in a byte, the first in the highest bit
  int components = 1;
  uint64_t rows = 0;
  uint64_t begin = 0, end = 0;  // bytes of the file
};

struct VtkFile {
  bool binary = false;   // big-endian
  bool offsets = false;  // version 5 and later: cells as offsets and connectivity
  uint64_t cell_count = 0;
  std::optional<VtkArray> points, cells, cell_ends, types;  // cell_ends: one row more than cells
  std::optional<VtkArray> time;                             // one number
  std::vector<VtkArray> point_data, cell_data;
  std::vector<std::string> notes;
};

// Reads what stands between the arrays of a seekable source. Of text the words are counted, of
// binary values it is checked that the file is long enough.
VtkFile parseVtk(ByteSource& bytes);

}  // namespace tetstream
