// measure: a field on a plane through a mesh, as a raster. Depends on simplex_rows.h.
#pragma once

#include "simplex_rows.h"

namespace tetstream {

class CellMap;

// The plane where coordinate `axis` is `at`, seen against that axis' direction: `across` grows to
// the right, `up` upwards.
struct CutPlane {
  int axis, across, up;
  double at;
  double low[2], high[2];  // what is seen, along across and up
};

// The plane of a word: "auto" is the middle of the box across its shortest axis; "x=0.3" is told by
// the coordinate, "x" is the middle. Throws kBadArgument for others.
CutPlane cutPlaneOf(const std::string& word, const Box& box);
// The box of what the plane cuts.
Box cutBoxOf(SimplexRows& cells, const CutPlane& plane);
// What is seen becomes that box; an empty one changes nothing. Tall views are turned.
void showBox(const Box& box, CutPlane& plane);
void checkCut(const std::string& word);

class CutImage {
 public:
  struct Shown {
    size_t first, components;  // of the values of a corner
    const double* zero;        // taken off each, so that a float holds what differs
  };
  CutImage(Account& account, const CutPlane& plane, size_t width, size_t height,
           const Shown& shown);
  // All cells that the plane cuts.
  void add(SimplexRows& cells);

  size_t width() const { return width_; }
  size_t height() const { return height_; }
  // The number of the cell, from 1, or 0 where there is none. Row 0 is the uppermost.
  uint32_t cell(size_t x, size_t y) const { return cells_[y * width_ + x]; }
  const float* values(size_t x, size_t y) const {
    return values_.data() + (y * width_ + x) * shown_.components;
  }
  uint64_t cellsCut() const { return cut_; }

 private:
  void addCell(const RowShape& shape, const double* row);
  void addRow(const RowShape& shape, const double* row, const CellMap& map, size_t y, size_t left,
              size_t right);

  CutPlane plane_;
  size_t width_, height_;
  Shown shown_;
  double pixel_[2];
  Array<uint32_t> cells_;
  Array<float> values_;
  uint64_t cut_ = 0;
};

}  // namespace tetstream
