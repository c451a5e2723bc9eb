// measure/search: cells or triangles, each with the places and the values of its corners, so that
// any of them can be looked at alone. In core up to a limit, then in a temporary file. Depends on
// base.
#pragma once

#include <memory>
#include <string>

#include "memory.h"
#include "row_spool.h"

namespace tetstream {

struct Box {
  double low[3], high[3];
  Box();  // of nothing
  void add(const double place[3]);
  void add(const Box& other);
  bool meets(const Box& other) const {
    return low[0] <= other.high[0] && high[0] >= other.low[0] && low[1] <= other.high[1] &&
           high[1] >= other.low[1] && low[2] <= other.high[2] && high[2] >= other.low[2];
  }
};

// What a row is: `corners` places, then the values of each corner.
struct RowShape {
  size_t corners, values;
  size_t doubles() const { return corners * (3 + values); }
  const double* place(const double* row, size_t corner) const { return row + 3 * corner; }
  const double* value(const double* row, size_t corner) const {
    return row + 3 * corners + values * corner;
  }
  Box boxOf(const double* row) const;
  void centreOf(const double* row, double out[3]) const;
};

// Where rows go and what they may take.
struct RowBudget {
  Account& account;
  std::string temp_dir;
  size_t in_core_bytes;
};

class SimplexRows {
 public:
  SimplexRows(RowShape shape, const RowBudget& budget);
  void add(const double* row);
  void finish();  // before the first row is read

  const RowShape& shape() const { return shape_; }
  uint64_t count() const { return count_; }
  uint64_t bytes() const { return count_ * shape_.doubles() * sizeof(double); }
  const Box& box() const { return box_; }          // of all corners
  const Box& centres() const { return centres_; }  // of the rows' centres
  // All rows, or null if they are in a file.
  const double* inCore() const { return spool_ ? nullptr : rows_.data(); }
  const double* row(uint64_t index);  // lives until the next call

 private:
  void spill();

  RowShape shape_;
  RowBudget budget_;
  Array<double> rows_;
  uint64_t count_ = 0;
  Box box_, centres_;
  std::unique_ptr<RowSpool> spool_;
};

}  // namespace tetstream
