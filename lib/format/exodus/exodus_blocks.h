// format/exodus: the element blocks of an Exodus file. Depends on cell_kinds.h, netcdf_file.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cell_kinds.h"
#include "netcdf_file.h"

namespace tetstream {

constexpr const char* kBlockId = "block_id";  // the cell array of their ids

struct ExodusBlock {
  int64_t id = 0;
  std::string name, element;                    // "TETRA"; the name may be empty
  std::string connectivity;                     // the variable
  uint64_t first = 0, elements = 0, nodes = 0;  // first: the elements of the blocks before
  int vtk_type = 0;

  CellKind kind() const;
};

// All blocks in the order of the file; throws kUnsupported for one whose elements are not read.
// `faces`: those of triangles and quadrilaterals count, too.
std::vector<ExodusBlock> readExodusBlocks(NetcdfFile& file, bool split, bool faces);

// "element block 3 ("rock")".
std::string nameOf(const ExodusBlock& block);

// The corners, by their places in the element, of a side, from 1; how many there are, 3 or 4. 0:
// the shape has no such side.
size_t exodusSide(CellShape shape, int64_t side, int* corners);

}  // namespace tetstream
