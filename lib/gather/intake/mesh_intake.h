// gather/intake: what the readers of indexed files share: points, cells of any shape, labelled
// faces and data come in the file's order, and an indexed mesh comes out. Depends on cell_kinds.h,
// file_scan.h, mesh_spool.h, file_format.h, placed_cells.h, placed_numbers.h, scattered_rows.h.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cell_kinds.h"
#include "file_format.h"
#include "file_scan.h"
#include "joined_points.h"
#include "mesh_spool.h"
#include "placed_cells.h"
#include "placed_numbers.h"
#include "scattered_rows.h"

namespace tetstream {

class MeshIntake {
 public:
  MeshIntake(const FileScan& file, const ReadOptions& options, ScalarType position_type);

  MeshSpool& mesh() { return *mesh_; }
  uint64_t cellCount() const { return mesh_->cellCount() + held_; }
  // Integer cell data, int32 unless `wide`; before the first cell. At the end the column is removed
  // if all its values are 0, unless it is `sure`.
  void addLabels(const char* name, bool wide = false, bool sure = false);

  // The same of points, all of one column; before the first point.
  void addPointLabels(const char* name, bool wide = false);
  void labelPoint(int64_t label);  // of the last one

  // Throws kBadData unless the position is finite.
  void addPoint(const double position[3]);
  // A cell of three dimensions, by its corners' ranks, with a value per column of labels; returns
  // how many tetrahedra it has become. Throws kUnsupported, naming the cell, if it is none and is
  // not to be split. `number` is its number in the file, for messages.
  size_t addCell(CellKind kind, const int64_t* corners, const int64_t* labels, int64_t number) {
    if (kind.shape != CellShape::kTetra || kind.nodes != 4)
      return addOtherCell(kind, corners, labels, number);
    for (int c = 0; c < 4; ++c) largest_corner_ = std::max(largest_corner_, corners[c]);
    holdCell(corners);
    takeLabels(labels, 1, number);
    return 1;
  }
  void addFace(CellKind kind, const int64_t* corners, int64_t label);

  // Of labels of the columns above, by their names, and of faces; those of labels that nobody has
  // in the file may be among them. Once, before the end.
  void nameLabels(std::vector<LabelName> names);

  // Of those that came, each of which is told of as one of these things.
  void leaveOutFaces(const std::string& things);

  // Told once each, at the end, with how many there were.
  void leaveOut(const std::string& things, uint64_t count = 1) { left_out_[things] += count; }
  void note(const std::string& text);

  // Rows of fields, or of cell data, in any order.
  size_t addData(const Column& column, bool of_cells);
  // Of float64: becomes int32 if all values are such integers.
  size_t addCellNumbers(const std::string& name);
  void putData(size_t data, uint64_t row, const double* values);

  // Rows that are read where they lie in the file, in place of as many calls of the above. Whether
  // points, or cells, may be so: else they are to be added.
  bool mayPlacePoints() const { return mesh_->mayPlacePositions(); }
  bool mayPlaceCells() const { return mesh_->mayPlaceCells(); }
  // Positions are `reals` of the rows.
  void placePoints(const RowsPlace& rows, const NumbersOfRow& reals);
  // An integer of each row, of the last points that came.
  void placePointLabels(const RowsPlace& rows, const NumbersOfRow& label);
  // Tetrahedra, of which the caller tells the labels then, of every column.
  void placeCells(CellKind kind, PlacedCellsPlan plan);
  void placeCellLabels(size_t labels, const RowsPlace& rows, const NumbersOfRow& label);
  void placeCellLabels(size_t labels, uint64_t count, int64_t label);  // of at most 32 bits
  size_t labelColumns() const { return labels_.size(); }
  // All rows of new data of floats, from the first on.
  bool mayPlaceData(size_t data) const { return data_[data]->isNew(); }
  void placeData(size_t data, const RowsPlace& rows, const NumbersOfRow& reals,
                 std::shared_ptr<FileWindow> window);

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
    Data(const Column& c, bool cells) : column(c), of_cells(cells) {}
    bool isNew() const { return !rows && !placed && isFloat(column.type) && !maybe_integers; }
    Column column;
    bool of_cells, maybe_integers = false;
    // Rows that were put, or those that lie in the file.
    std::optional<ScatteredRows> rows;
    std::shared_ptr<RowReader> placed;
    uint64_t placed_rows = 0;
  };
  size_t addOtherCell(CellKind kind, const int64_t* corners, const int64_t* labels, int64_t number);
  void takeLabel(Labels& labels, int64_t label, size_t count, int64_t number);
  // Of a cell that has become so many, of every column.
  void takeLabels(const int64_t* labels, size_t count, int64_t number) {
    for (size_t k = 0; k < labels_.size(); ++k)
      if (labels[k] == 0 && !labels_[k].any)
        labels_[k].zeros += count;
      else
        takeLabel(labels_[k], labels[k], count, number);
  }
  bool takeZeros(Labels& labels, uint64_t count, bool any);
  void placeLabels(Labels& labels, uint64_t count, std::shared_ptr<RowReader> rows);
  void placeLabels(Labels& labels, const RowsPlace& rows, const NumbersOfRow& label);
  ScalarType typeOf(const Labels& labels) const {
    return labels.wide ? ScalarType::kInt64 : ScalarType::kInt32;
  }
  ScatteredRows& scattered(Data& data);
  void appendLabels(Labels& labels, const int64_t* rows, size_t count);
  void writeLabels(Labels& labels);
  void countZeros(Labels& labels);
  void holdCell(const int64_t* corners) {
    std::copy(corners, corners + 4, held_cells_.begin() + static_cast<std::ptrdiff_t>(4 * held_));
    if (++held_ == held_cells_.size() / 4) writeHeld();
  }
  void writeHeld();
  void checkCorners();
  std::shared_ptr<PointJoin> joinPoints();
  template <class Visit>
  void forFaces(Visit visit);
  void dropStrayFaces(PointJoin* joined);
  void copyData();
  void copyRows(Data& data, size_t column, uint64_t count);
  void appendData(const Data& data, size_t column, const void* rows, size_t count);

  const FileScan& file_;
  ReadOptions options_;
  std::string name_;
  std::unique_ptr<MeshSpool> mesh_;
  std::vector<Labels> labels_, point_labels_;
  std::vector<int64_t> held_cells_;  // some, which are written together
  size_t held_ = 0;                  // of them
  std::vector<std::unique_ptr<Data>> data_;
  std::shared_ptr<FileWindow> points_window_, cells_window_;  // of the points' and the cells' rows
  std::map<std::string, uint64_t> left_out_;
  int64_t largest_corner_ = -1;
  uint64_t split_ = 0, quadratic_ = 0;
};

}  // namespace tetstream
