// format/xdmf: grids beside the mesh that have its points and a topology of their own, as dolfinx
// writes labels of cells and of faces. Depends on xdmf_fields.h, xdmf_subset.h.
#pragma once

#include <string>

#include "file_format.h"
#include "xdmf_fields.h"
#include "xdmf_subset.h"

namespace tetstream {

class XdmfBeside {
 public:
  // The piece is the only one of the mesh; `topology` is where its cells come from.
  XdmfBeside(XdmfArrays& arrays, const ReadOptions& options, MeshPieces& mesh, MeshPiece& piece,
             const XdmfTopology& topology)
      : arrays_(arrays),
        options_(options),
        mesh_(mesh),
        piece_(piece),
        topology_(topology),
        fields_(arrays, mesh, piece, options.temp_dir) {}

  // Cells of the mesh get the grid's arrays, faces its labels. What is left out is noted.
  void add(const XdmfGrid& grid, const XdmfTopology& topology);
  void finish();  // after the last

 private:
  void addCells(const XdmfGrid& grid, const XdmfTopology& topology);
  void addFaces(const XdmfGrid& grid, const XdmfTopology& topology);
  void labelFaces(const XdmfCellList& faces, const MeshArray& labels);
  XdmfCellList listOf(const XdmfTopology& topology, MeshPiece& part);
  void leaveOut(const XdmfGrid& grid, const std::string& why);

  XdmfArrays& arrays_;
  const ReadOptions& options_;
  MeshPieces& mesh_;
  MeshPiece& piece_;
  const XdmfTopology& topology_;
  XdmfFields fields_;
};

}  // namespace tetstream
