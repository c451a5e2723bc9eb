// measure/search: for many places the nearest point of a surface and the values there. Depends on
// row_chunk.h, in_pieces.h.
//
// The places wait in a temporary file; as much of the surface as the memory holds is searched at a
// time, each place with the distance that was found before as its bound.
#pragma once

#include <functional>
#include <vector>

#include "in_pieces.h"
#include "row_chunk.h"

namespace tetstream {

class NearestPoints {
 public:
  // Each place comes with `carried` numbers; the surface's corners have `values`.
  NearestPoints(size_t carried, size_t values, const std::string& temp_dir);
  void add(const double place[3], const double* carried);
  uint64_t count() const { return places_->rows(); }

  struct Found {
    const double* place;
    const double* carried;
    double distance;       // infinite if the surface has no triangle
    const double* values;  // at the nearest point
  };
  using Take = std::function<void(const Found&)>;
  struct Budget {
    Account& account;
    size_t bytes;
    const Tasks* tasks;
  };
  // Once: `take` gets them in the order in which they were added. `share` is told as it goes.
  void search(SimplexRows& surface, const Budget& budget, const Take& take,
              const std::function<void(double)>& share);

 private:
  void improve(const RowChunk& chunk, double* row) const;
  size_t improveFrom(const RowChunk& chunk, uint64_t first, const Tasks* tasks);
  Found foundIn(const double* row) const;
  std::unique_ptr<RowSpool> spool() const;

  size_t carried_, values_, doubles_;
  std::string temp_dir_;
  std::unique_ptr<RowSpool> places_;
  std::vector<double> row_, rows_;  // one, and some at once
};

}  // namespace tetstream
