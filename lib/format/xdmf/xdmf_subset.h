// format/xdmf: which cells of a mesh another list of cells names, and values of those for all of
// the mesh. Depends on mesh_pieces.h, row_spool.h.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "mesh_pieces.h"
#include "row_spool.h"

namespace tetstream {

constexpr size_t kCellsAtOnce = 256;  // of a list, read together

// Cells of one type, each with as many nodes, of which the corners come first.
struct XdmfCellList {
  const MeshArray* nodes = nullptr;  // lives as long as it is read
  uint64_t cells = 0, nodes_each = 0;
  size_t corners = 0;
  uint64_t points = 0;  // of the mesh
  std::string place;    // of the list, for messages
};

// Throws if a corner of the cell is no point.
void checkCorners(const XdmfCellList& list, uint64_t cell, const int64_t* nodes);

class XdmfSubset {
 public:
  explicit XdmfSubset(const std::string& temp_dir);

  // Looks for the cells of `part`, by their corners in any order, in `mesh`, which has them in the
  // same order with others between them. Both are read once, side by side. Returns the first cell
  // of the part that is not found; none: all are. Throws if a corner is no point.
  std::optional<uint64_t> find(const XdmfCellList& part, const XdmfCellList& mesh);

  uint64_t named() const { return named_; }  // cells
  // Row i of the values is that of the part's cell i; 0 at cells that it does not name.
  static MeshArray spread(const std::shared_ptr<XdmfSubset>& subset, MeshArray values);

  // Cells of the mesh that follow each other, named by rows of the part that do.
  struct Run {
    uint64_t cell = 0, row = 0, count = 0;
    uint64_t end() const { return cell + count; }
  };
  Run run(uint64_t index);  // without cells: there is none
  // The first one that ends behind the cell, or how many there are; found fast near `hint`.
  uint64_t runBehind(uint64_t cell, uint64_t hint);

 private:
  void add(uint64_t cell);

  RowSpool runs_;
  Run last_;
  uint64_t named_ = 0;
};

}  // namespace tetstream
