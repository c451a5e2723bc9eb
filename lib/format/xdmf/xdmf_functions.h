// format/xdmf: functions of finite element spaces, as checkpoints of FEniCS have them: one list of
// all values, and for each cell the numbers of its own in it. Depends on xdmf_subset.h.
#pragma once

#include <string>

#include "mesh_pieces.h"
#include "xdmf_subset.h"

namespace tetstream {

// The arrays that a function is in, and what its space has: for each cell `numbers_each`,
// component after component, those at the corners first.
struct XdmfFunction {
  MeshArray numbers, values, begins;  // begins: where the row of each cell begins and the last ends
  uint64_t value_count = 0;
  uint64_t numbers_each = 0;
  int components = 1;
  bool is_of_points = true;   // otherwise it has one value in each cell
  bool is_symmetric = false;  // its components are those of a matrix: xx, xy, xz, yy, yz and zz
  std::string place;          // of the numbers, for messages
};

// Of the function the values at points, 0 at those of no cell, or those of cells; row k of its
// numbers is of cell k. Symmetric matrices have xx, yy, zz, xy, yz and xz, as elsewhere. Nothing is
// read before the array is opened. What is wrong is an error then: numbers of no value, rows of
// another size, and cells near each other that have different values at one point.
// Source: the files of dolfin 2019.2 (XDMFFile::write_checkpoint).
MeshArray valuesOfFunction(XdmfFunction function, MeshArray corners, XdmfCellList cells,
                           const std::string& temp_dir);

}  // namespace tetstream
