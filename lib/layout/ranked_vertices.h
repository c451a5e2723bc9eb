// layout: the used points of a mesh in the order of their keys, with their values. Depends on
// survey.h, external_sort.h.
#pragma once

#include <functional>

#include "external_sort.h"
#include "survey.h"

namespace tetstream {

using VertexKey = std::function<uint64_t(uint64_t point, const double place[3])>;

class RankedVertices {
 public:
  struct Budget {
    size_t memory_bytes;
    Account& account;
    std::string temp_dir;
  };
  // Reads the points once. Fills the box of `schema`, which is the source's, over the used points,
  // or widens the one that it has; values of `measured` fields (empty: of none) that are not finite
  // are kBadData. Equal keys rank as the points do.
  RankedVertices(IndexedSource& source, const Survey& survey, const VertexKey& key, Budget budget,
                 const std::vector<bool>& measured, Schema& schema, const Tell& tell);

  uint64_t count() const { return rows_.rows(); }
  static constexpr uint32_t kNoRank = 0xffffffffu;
  // ranks[i] becomes the rank of point first + i, or kNoRank where no cell used it.
  void tellRanks(uint64_t first, Array<uint32_t>& ranks);
  uint64_t pointAt(uint64_t rank);
  // The values of a vertex into a row of a batch; returns its origin.
  int64_t copyTo(uint64_t rank, Batch& batch, size_t row);

  uint64_t diskBytes() const { return rows_.diskBytes(); }
  uint64_t mostDiskBytes() const { return disk_; }  // while they were sorted

 private:
  // A row: the point, whether it is locked, its values where the source gives no single rows, and
  // its origin where that is not the point itself.
  static constexpr size_t kHead = sizeof(uint64_t);
  static constexpr uint64_t kLockedBit = uint64_t{1} << 63;
  static size_t valueBytes(const IndexedSource& source);
  static size_t rowBytes(const IndexedSource& source) {
    return kHead + valueBytes(source) + (source.hasOrigins() ? sizeof(int64_t) : 0);
  }

  void sortPoints(const Survey& survey, const VertexKey& key, ExternalSort& sort,
                  const std::vector<bool>& measured, Schema& schema, const Tell& tell);

  IndexedSource& source_;
  bool holds_values_;
  RowSpool rows_;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
