// gather/rows: means of values at points, for meshes of any size. Depends on buckets.h,
// row_spool.h, schema.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckets.h"
#include "row_spool.h"
#include "schema.h"

namespace tetstream {

// A column at points, of which each row is the mean of values that come in any order: of those that
// are finite; where none is, the first of them, and where there is none, 0. Memory is bounded.
class PointMeans {
 public:
  // visit(component, add) calls add(point, value) for each value of that component.
  template <class Visit>
  PointMeans(const Column& column, uint64_t points, const std::string& temp_dir, Visit visit)
      : column_(column) {
    for (size_t k = 0; k < static_cast<size_t>(column.components); ++k) {
      Gathered gathered(points, temp_dir);
      visit(k, [&](uint64_t point, double value) { gathered.add(point, value); });
      components_.push_back(gathered.spooled());
    }
  }

  // Rows of the column.
  void read(uint64_t first, size_t count, void* out);

 private:
  // Of the values so far. note: by steps that cannot overflow, and of equal values exactly that.
  struct Mean {
    double value;
    int64_t finite;  // how many there were; kNone: not even others
    static constexpr int64_t kNone = -1;
    void add(double next);
  };

  // Those of one component. Values are added up as they come at the first points, as many as are in
  // memory at once; those at others wait in files until their part of the points has its turn.
  class Gathered {
   public:
    Gathered(uint64_t points, const std::string& temp_dir);
    void add(uint64_t point, double value) {
      if (point < part_)
        means_[static_cast<size_t>(point)].add(value);
      else
        later_.add(static_cast<size_t>(point / part_) - 1, {point, value});
    }
    std::unique_ptr<RowSpool> spooled();

   private:
    struct Value {
      uint64_t point;
      double value;
    };
    void clear();

    uint64_t points_, part_;  // all, and of a part
    std::string temp_dir_;
    Account account_;
    Array<Mean> means_;     // of the part that has its turn
    Buckets<Value> later_;  // of the parts from the second on
  };

  Column column_;
  std::vector<std::unique_ptr<RowSpool>> components_;  // of float64
};

}  // namespace tetstream
