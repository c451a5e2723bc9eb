// layout: the cells of a mesh in the order of their last vertices. Depends on ranked_vertices.h,
// counted_order.h, cell_front.h.
#pragma once

#include "cell_front.h"
#include "counted_order.h"
#include "ranked_vertices.h"

namespace tetstream {

// A cell of the stream that is to come.
struct OrderedCell {
  uint32_t corners[4];        // ranks of vertices
  unsigned last_uses;         // bit j: no later cell uses corner j
  const unsigned char* data;  // its cell data, or its number where the source gives single rows
};

class OrderedCells {
 public:
  // `sorts`: cells by their highest rank, ties as in the mesh; else they stay in the mesh's order.
  // `front`: takes them from the last to the first; may be null.
  OrderedCells(IndexedSource& source, RankedVertices& vertices, bool sorts,
               RankedVertices::Budget budget, CellFront* front, const Tell& tell);

  uint64_t count() const { return rows_.rows(); }
  OrderedCell cell(uint64_t place);  // its data live until the next call
  void copyData(const OrderedCell& cell, Batch& batch, size_t row);

  uint64_t mostDiskBytes() const { return disk_; }  // while they were sorted, and now

 private:
  // A row: four corners, then the data.
  static constexpr size_t kCorners = 4 * sizeof(uint32_t);
  class Translation;
  class Passage;

  bool fits(const RankedVertices& vertices, size_t memory_bytes) const;
  void sortCells(RankedVertices& vertices, bool sorts, const RankedVertices::Budget& budget,
                 const Tell& tell);
  void countCells(const Array<uint32_t>& ranks, CountedOrder& order, const Tell& tell);
  void countRows(const Array<uint32_t>& ranks, CountedOrder& order, Account& account,
                 const Tell& tell);
  void passCells(RankedVertices& vertices, bool sorts, const RankedVertices::Budget& budget,
                 const Tell& tell);
  template <class UsesOf>
  void listLastUses(UsesOf usesOf, const Tell& tell);
  void findLastUses(uint64_t vertices, Account& account, const Tell& tell);

  IndexedSource& source_;
  size_t data_bytes_;
  RowSpool rows_, last_uses_;  // these from the last cell to the first
  uint64_t disk_ = 0;
};

}  // namespace tetstream
