// measure/stream: the layout diagram of a stream: its cells across, its vertices down, for each
// vertex a line from its introduction to its finalization. Depends on stream, line_raster.h.
//
// After Vo et al. 2007, section 3.1, but drawn into a raster while the stream passes: memory is
// that of the raster and of the front, whatever the length. The front at some cell is what a
// vertical line there meets: its width is how many lines, its span how far down they reach.
#pragma once

#include <vector>

#include "front_meter.h"
#include "line_raster.h"

namespace tetstream {

// A vertex is active from the cell that introduces it through the one that finalizes it; means over
// cells and over vertices. The span is counted from the lowest active vertex to the newest one.
struct DiagramFigures {
  int64_t cells = 0, vertices = 0;
  FrontStatistics front;
  double mean_width = 0, mean_span = 0;
  int64_t widest_cell = -1, longest_cell = -1;  // the first of the greatest width, of such a span
  int64_t longest_life = 0;                     // of a vertex, in cells
  double mean_life = 0;
};

// The front while the cells of one column are read.
struct DiagramColumn {
  int64_t width = 0;                 // at most
  int64_t lowest = -1, newest = -1;  // of the active vertices, the lowest and the last introduced
};

class LayoutDiagram {
 public:
  // The raster has `columns` x `rows` places at most, and half as many at least, if there are as
  // many cells and vertices.
  LayoutDiagram(const Schema& schema, size_t columns, size_t rows);

  // As for FrontMeter: throws kBadData.
  void put(const BatchView& batch);
  void finish();

  // After finish:
  const DiagramFigures& figures() const { return figures_; }
  size_t columns() const { return raster_.columnsUsed(cells()); }
  size_t rows() const { return raster_.rowsUsed(vertices()); }
  int64_t cellsPerColumn() const { return static_cast<int64_t>(raster_.columnWidth()); }
  int64_t verticesPerRow() const { return static_cast<int64_t>(raster_.rowHeight()); }
  // [rows][columns]: how much of a place is covered by the lines of its vertices, 0 to 1.
  const std::vector<float>& coverage() const { return coverage_; }
  const std::vector<DiagramColumn>& front() const { return front_; }  // [columns]

 private:
  uint64_t cells() const { return meter_.cellsSeen(); }
  uint64_t vertices() const { return meter_.front().introduced(); }
  void makeRoom();
  void addCell(const int64_t corners[4], unsigned last_uses);
  void startLines(uint64_t first, uint64_t time);
  void finalize(int64_t vertex);
  void endLife(uint64_t since);
  void look();

  Account account_;
  FrontMeter meter_;
  LineRaster raster_;
  Array<uint64_t> since_;  // per row of an active vertex: the cells before it
  std::vector<DiagramColumn> front_;
  std::vector<float> coverage_;
  DiagramFigures figures_;
  double sum_of_widths_ = 0, sum_of_spans_ = 0;
};

}  // namespace tetstream
