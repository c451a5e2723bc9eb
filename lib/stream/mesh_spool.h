// stream: an indexed mesh in temporary files, for those who get it row by row, or, as far as that
// is told, where its rows lie. Depends on source.h, column_rows.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "column_rows.h"
#include "memory.h"
#include "source.h"

namespace tetstream {

// Columns may be added until their first row comes; rows of different columns come in any order
// among each other. What is small stays in memory.
class MeshSpool : public IndexedSource {
 public:
  // `tasks`, which may be null, help to write up to finish and finishFaces.
  MeshSpool(ScalarType position_type, const std::string& temp_dir, const Tasks* tasks = nullptr);
  // With the columns of the schema and what else it knows; counts are those of what comes.
  MeshSpool(const Schema& schema, const std::string& temp_dir);

  size_t addField(const Column& column);
  size_t addCellData(const Column& column);
  // Settled, of what columns there are. Those of a column that is removed go with it.
  void nameLabels(std::vector<LabelName> names) { schema_.label_names = std::move(names); }
  void setTime(double time) { schema_.time = time; }
  // With their rows.
  void removeField(size_t column);
  void removeCellData(size_t column);
  void appendPositions(const void* rows, size_t count) { positions_.append(rows, count); }
  void appendCells(const int64_t* rows, size_t count);
  void appendField(size_t column, const void* rows, size_t count) {
    fields_[column]->append(rows, count);
  }
  void appendCellData(size_t column, const void* rows, size_t count) {
    cell_data_[column]->append(rows, count);
  }
  // Rows that are read where they lie, instead of as many that are appended. Cells come as int64.
  bool mayPlacePositions() const { return positions_.mayPlace(); }
  void placePositions(uint64_t count, std::shared_ptr<RowReader> rows) {
    positions_.place(count, std::move(rows));
  }
  bool mayPlaceCells() const { return !placed_cells_.isFull(); }
  void placeCells(uint64_t count, std::shared_ptr<RowReader> rows) {
    placed_cells_.add(cellCount(), count, std::move(rows));
  }
  void placeField(size_t column, uint64_t count, std::shared_ptr<RowReader> rows) {
    fields_[column]->place(count, std::move(rows));
  }
  void placeCellData(size_t column, uint64_t count, std::shared_ptr<RowReader> rows) {
    cell_data_[column]->place(count, std::move(rows));
  }
  void appendFace(const int64_t corners[3], int64_t label);
  // The vertices, cells and labelled faces of a batch; nothing of locks, origins, finalizations.
  void append(const BatchView& batch);
  void forgetFaces() { faces_ = openFaces(); }  // that came
  void lock(uint64_t point);                    // of those that came
  uint64_t pointCount() const { return positions_.rows(); }
  uint64_t cellCount() const { return cells_.rows() + wide_cells_.rows() + placed_cells_.rows(); }
  uint64_t faceCount() const { return faces_->rows(); }
  // Before anything is read. Every column has its rows then; faces may follow, up to their own end.
  void finish();
  void finishFaces();
  // Of the finished faces, those of which keep(three points) is true. Returns how many are gone.
  uint64_t keepFaces(const std::function<bool(const int64_t*)>& keep);
  uint64_t diskBytes() const;  // of its temporary files

  const Schema& schema() const override { return schema_; }
  const uint8_t* locked() const override { return locked_.size() > 0 ? locked_.data() : nullptr; }
  void readPositions(uint64_t first, size_t count, void* out) override;
  void readField(size_t column, uint64_t first, size_t count, void* out) override;
  void readCells(uint64_t first, size_t count, int64_t* out) override;
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override;
  void readFaces(uint64_t first, size_t count, int64_t* corners, int64_t* labels) override;

 private:
  using Columns = std::vector<std::unique_ptr<ColumnRows>>;
  void checkRows(const std::vector<Column>& columns, const Columns& rows, uint64_t count) const;
  std::unique_ptr<RowSpool> openFaces() const;
  void readCopiedCells(uint64_t first, size_t count, int64_t* out);
  void growLocks();

  Schema schema_;
  std::string temp_dir_;
  const Tasks* tasks_;
  ColumnRows positions_;
  // Cells that were appended as int32 up to the first point that needs more. A face: three points
  // and its label.
  RowSpool cells_, wide_cells_;
  std::unique_ptr<RowSpool> faces_;
  PlacedParts placed_cells_;
  Columns fields_, cell_data_;
  Account account_;
  Array<uint8_t> locked_;  // per point, if any is: in memory
};

}  // namespace tetstream
