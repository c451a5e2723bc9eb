// format/xdmf: the cells of an XDMF topology. Depends on xdmf_arrays.h, mesh_pieces.h.
#pragma once

#include "xdmf_arrays.h"

namespace tetstream {

// VTK's type of the cells of a topology; 0: cells of several types; -1: none that is known.
int vtkTypeOfXdmf(const std::string& topology);

// Gives the piece its connectivity, and offsets and types as CellForm::kOffsets wants them.
void addXdmfCells(const XdmfTopology& topology, XdmfArrays& arrays, const std::string& temp_dir,
                  MeshPiece& piece);
// Whether those that it was given are four points each, all of them.
bool areTetrahedra(const MeshPiece& piece);

}  // namespace tetstream
