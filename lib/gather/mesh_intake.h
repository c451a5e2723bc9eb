// gather: what the readers of indexed files share: points, cells of any shape, labelled faces and
// data come in the file's order, and an indexed mesh comes out. Depends on cell_kinds.h,
// file_scan.h, mesh_spool.h, format_rows.h, scattered_rows.h.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "cell_kinds.h"
#include "file_scan.h"
#include "format_rows.h"
#include "mesh_spool.h"
#include "scattered_rows.h"

namespace tetstream {

class MeshIntake {
 public:
  MeshIntake(const FileScan& file, const ReadOptions& options, ScalarType position_type);

  MeshSpool& mesh() { return *mesh_; }
  uint64_t cellCount() const { return mesh_->cellCount() + held_; }
  // Integer cell data, int32 unless `wide`; before the first cell. Not there if all are 0, unless
  // they are `sure` to have been.
  void addLabels(const char* name, bool wide = false, bool sure = false);

  // The same of points, all of one column; before the first point.
  void addPointLabels(const char* name, bool wide = false);
  void labelPoint(int64_t label);  // of the last one

  // Throws kBadData unless the position is finite.
  void addPoint(const double position[3]);
  // A cell of three dimensions, by its corners' ranks, with a value per column of labels; returns
  // how many tetrahedra it has become. Throws kUnsupported, naming the cell, if it is none and is
  // not to be split. `number` is its number in the file, for messages.
  size_t addCell(CellKind kind, const int64_t* corners, const int64_t* labels, int64_t number);
  void addFace(CellKind kind, const int64_t* corners, int64_t label);

  // Told once each, at the end, with how many there were.
  void leaveOut(const std::string& things, uint64_t count = 1) { left_out_[things] += count; }
  void note(const std::string& text);

  // Rows of fields, or of cell data, in any order.
  size_t addData(const Column& column, bool of_cells);
  // Of float64: becomes int32 if all values are such integers.
  size_t addCellNumbers(const std::string& name);
  void putData(size_t data, uint64_t row, const double* values);

  // After the last: checks that every corner is a point, writes the data, tells what was left out.
  std::unique_ptr<IndexedSource> finish();

 private:
  // Those of a column that nobody has yet are only counted.
  struct Labels {
    size_t column;
    bool of_points, wide, any;  // any: not all are 0, or it is sure to be there
    uint64_t zeros = 0;         // that came while there was none
    std::vector<int64_t> held = {};
  };
  struct Data {
    Data(const Column& c, bool cells, const std::string& temp_dir)
        : column(c), of_cells(cells), rows(c.bytesPerRow(), temp_dir) {}
    Column column;
    bool of_cells, maybe_integers = false;
    ScatteredRows rows;
  };
  void takeLabel(Labels& labels, int64_t label, size_t count, int64_t number);
  void appendLabels(Labels& labels, const int64_t* rows, size_t count);
  void writeLabels(Labels& labels);
  void countZeros(Labels& labels);
  void holdCell(const int64_t* corners) {
    std::copy(corners, corners + 4, held_cells_.begin() + static_cast<std::ptrdiff_t>(4 * held_));
    ++held_;
  }
  void writeHeld();
  void checkCorners();
  void takeFaces();
  void copyData();

  const FileScan& file_;
  ReadOptions options_;
  std::string name_;
  std::unique_ptr<MeshSpool> mesh_;
  std::vector<Labels> labels_, point_labels_;
  std::vector<int64_t> held_cells_;  // some, which are written together
  size_t held_ = 0;                  // of them
  RowSpool faces_;  // three points and a label; only those of cells go into the mesh
  std::vector<std::unique_ptr<Data>> data_;
  std::map<std::string, uint64_t> left_out_;
  int64_t largest_corner_ = -1;
  uint64_t split_ = 0, quadratic_ = 0;
};

}  // namespace tetstream
