// layout: an indexed mesh as a stream, swept along an axis. Depends on stream, sweep_order.h.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "row_spool.h"
#include "source.h"
#include "sweep_order.h"

namespace tetstream {

struct OrderOptions {
  std::string axis = "auto";  // "x", "y", "z"; auto: the one with the narrowest front
  std::string temp_dir;
  std::function<void(double fraction)> tell;  // may throw to stop
};

// Reads the whole mesh once when made: connectivity into memory, values and cell data into
// temporary files unless the source gives single rows cheaply. Its schema is complete: counts of
// what is used, box, front. Vertices come just before the first cell that uses them, in that order;
// vertices that no cell uses are left out.
class OrderedSource : public Source {
 public:
  OrderedSource(IndexedSource& source, const OrderOptions& options);
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;
  std::unique_ptr<Source> again() override;
  int64_t unusedVertices() const { return unused_; }
  char axis() const { return static_cast<char>('x' + order_.axis); }

 private:
  class SecondReading;

  void readCells();
  void readPoints();
  void readValues();
  void spoolCellData();
  void addVertex(uint32_t vertex);
  void addCellData(uint32_t cell, size_t row);

  IndexedSource& source_;
  OrderOptions options_;
  Schema schema_;
  Account account_;
  Connectivity mesh_;
  Array<uint8_t> used_;  // per point, while the mesh is read: whether a cell uses it
  SweepOrder order_;
  std::unique_ptr<RowSpool> vertex_rows_, cell_rows_;  // empty with random access
  Batch batch_;
  uint32_t place_ = 0, introduced_ = 0;
  int64_t unused_ = 0;
};

}  // namespace tetstream
