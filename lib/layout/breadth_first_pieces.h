// layout: the breadth-first order of a mesh that does not fit the memory, piece by piece. Depends
// on traversal.h, external_sort.h, mesh_reading.h.
#pragma once

#include "external_sort.h"
#include "id_hash.h"
#include "mesh_reading.h"
#include "traversal.h"

namespace tetstream {

// The mesh comes as a stream that sweeps it. Of each piece the vertices that are final are ranked,
// breadth first from those that the last piece has ranked; cells with vertices that are not stay
// for the next. So within a piece the order is that of orderBreadthFirst, and the front never
// reaches beyond two pieces.
class PiecewiseBreadthFirst {
 public:
  PiecewiseBreadthFirst(size_t memory_bytes, Account& account, const std::string& temp_dir);

  // The events of the whole stream, with the finalizations that cells carry; then finish.
  void put(const BatchView& batch);
  void finish();
  // The rank of the stream's vertices 0, 1, 2, ...
  uint64_t next();

  uint64_t diskBytes() const { return ranks_.diskBytes(); }

 private:
  static constexpr uint64_t kNoRank = ~uint64_t{0};

  uint32_t localOf(int64_t vertex);
  void rankPiece();
  void takeRanked(Traversal& traversal);
  void keepOpenCells();

  Account& account_;
  size_t piece_cells_;
  Array<uint32_t> corners_;  // of the piece's cells, [cells][4], as places in what follows
  Array<int64_t> vertex_;    // in the stream
  Array<uint64_t> rank_of_;  // kNoRank: not yet
  Array<uint8_t> final_;
  uint32_t cells_ = 0, vertices_ = 0;
  IdHash local_of_;
  uint64_t ranked_ = 0;
  ExternalSort ranks_;  // by vertex
};

}  // namespace tetstream
