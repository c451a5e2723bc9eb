// gather/rows: means of values at points, for meshes of any size. Depends on buckets.h,
// row_spool.h, schema.h.
#pragma once

#include <algorithm>
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
  // visit(component, add) calls add(point, value) for each value of that component, of which there
  // are about `values`.
  template <class Visit>
  PointMeans(const Column& column, uint64_t points, uint64_t values, const std::string& temp_dir,
             Visit visit)
      : column_(column), points_(points) {
    for (size_t k = 0; k < static_cast<size_t>(column.components); ++k) {
      const size_t buckets = bucketsFor(values, sizeof(Value));
      Buckets<Value> sorted(buckets, temp_dir);
      const uint64_t part = points / buckets + 1;
      uint64_t rank = 0;
      visit(k, [&](uint64_t point, double value) {
        sorted.add(static_cast<size_t>(point / part), {point, rank++, value});
      });
      addComponent(sorted, temp_dir);
    }
  }

  // Rows of the column.
  void read(uint64_t first, size_t count, void* out);

 private:
  struct Value {
    uint64_t point, rank;
    double value;
    bool operator<(const Value& other) const {
      return point != other.point ? point < other.point : rank < other.rank;
    }
  };
  static double meanOf(const Value* values, size_t count);
  void addComponent(Buckets<Value>& sorted, const std::string& temp_dir);

  Column column_;
  uint64_t points_;
  std::vector<std::unique_ptr<RowSpool>> components_;  // of float64
};

}  // namespace tetstream
