// format/gmsh: the cells of a mesh in the order in which they are written. Depends on msh_labels.h,
// gather/rows, mesh_collector.h.
#pragma once

#include <memory>
#include <vector>

#include "grouped_rows.h"
#include "mesh_collector.h"
#include "msh_labels.h"
#include "ordered_rows.h"
#include "rows_at_once.h"

namespace tetstream {

// That of the stream, or volume by volume, so that each is one block: other programs take a block
// for a set of cells of its own.
class MshElements {
 public:
  // The arguments have to outlive this.
  MshElements(MeshSpool& mesh, MshLabels& labels, const WriteOptions& options);

  // Whether that takes cells out of the order of the stream.
  bool areReordered() const { return cells_ != nullptr; }

  // In the order of the stream: visit(number, volume, corners)
  template <class Visit>
  void forEachInStream(Visit visit) {
    std::vector<int64_t> corners(4 * kRowsAtOnce);
    labels_.forEachCell([&](uint64_t cell, const MshVolume& volume) {
      const size_t at = cell % kRowsAtOnce;
      if (at == 0) mesh_.readCells(cell, rowsFrom(cell), corners.data());
      visit(cell, volume, corners.data() + 4 * at);
    });
  }

  // In that of the file: visit(number in the stream, corners)
  template <class Visit>
  void forEachInFile(Visit visit) {
    if (!cells_)
      return forEachInStream([&](uint64_t number, const MshVolume&, const int64_t* corners) {
        visit(number, corners);
      });
    for (uint64_t at = 0; at < mesh_.cellCount(); ++at) {
      const auto* const cell = static_cast<const Cell*>(cells_->rows().row(at));
      visit(cell->number, cell->corners);
    }
  }

  // The same with an array's values: visit(number in the stream, values)
  template <class Visit>
  void forEachRow(size_t column, Visit visit) {
    const size_t bytes = mesh_.schema().cell_data[column].bytesPerRow();
    if (!cells_)
      return tetstream::forEachRow(
          mesh_.cellCount(), bytes,
          [&](uint64_t first, size_t n, void* out) { mesh_.readCellData(column, first, n, out); },
          visit);
    const std::unique_ptr<OrderedRows> rows = inOrder(column, bytes);
    uint64_t place = 0;
    forEachInFile([&](uint64_t number, const int64_t*) { visit(number, rows->row(place++)); });
  }

 private:
  struct Cell {
    int64_t corners[4];
    uint64_t number;
  };
  // How many are read at once.
  size_t rowsFrom(uint64_t cell) const {
    return static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, mesh_.cellCount() - cell));
  }
  std::unique_ptr<OrderedRows> inOrder(size_t column, size_t bytes);

  MeshSpool& mesh_;
  MshLabels& labels_;
  const WriteOptions& options_;
  std::unique_ptr<GroupedRows<Cell>> cells_;  // where those of a volume do not follow each other
};

}  // namespace tetstream
