// layout: what one reading of a mesh's cells and one of its points tell: which points are used,
// where they lie, and along which direction a sweep cuts the fewest cells. Depends on
// mesh_reading.h.
#pragma once

#include <string>

#include "memory.h"
#include "mesh_reading.h"

namespace tetstream {

// Throws kBadData where it is not finite.
void checkPlace(uint64_t point, const double place[3]);

class Survey {
 public:
  Survey(IndexedSource& source, Account& account, const Tell& tell);

  bool isUsed(uint64_t point) const { return used_[point / 64] >> (point % 64) & 1; }
  uint64_t usedCount() const { return used_count_; }
  const double* low() const { return low_; }  // of the points that are used
  const double* high() const { return high_; }

  // Along `axis` ("x", "y", "z"); otherwise the best of these, or one that is clearly better:
  // sought downhill from the best of them and of the mesh's principal directions. What tetrahedra
  // of a grid are cut from has its own directions: across their long diagonals fewer are met.
  struct Direction {
    double along[3];
    std::string name;  // "x", "(0.60, 0.00, 0.80)"
  };
  Direction direction(const std::string& axis) const;

 private:
  void readCells(const Tell& tell);
  void readPoints(const Tell& tell);
  void takePoint(uint64_t point, const double place[3]);
  void findPrincipalDirections(double directions[3][3]) const;
  double cellsCut(const double along[3]) const;
  double improve(double along[3], double cut) const;

  IndexedSource& source_;
  Array<uint64_t> used_;
  uint64_t used_count_ = 0;
  double low_[3], high_[3];
  double sums_[3] = {}, products_[6] = {};  // of places relative to the first used point
  double first_[3] = {};
  std::vector<uint64_t> sampled_;        // points of some cells, each once, rising
  std::vector<uint32_t> sampled_cells_;  // [n][4], as places in sampled_
  std::vector<double> places_;           // of the sampled points, relative to the first
  size_t next_sampled_ = 0;
};

}  // namespace tetstream
