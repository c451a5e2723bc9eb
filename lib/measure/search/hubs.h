// measure/search: places at which very many cells or triangles meet. Depends on simplex_rows.h.
#pragma once

#include <vector>

#include "simplex_rows.h"

namespace tetstream {

// Rows in core.
struct RowView {
  RowShape shape;
  const double* rows;
  size_t count;
  const double* row(size_t i) const { return rows + i * shape.doubles(); }
};

class Hubs {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;
  // A corner of so many rows; of so many of a sample where there are more rows than that has: what
  // hubs cost grows with the square of theirs, to be small beside all others'.
  static constexpr uint32_t kManyRows = 256;
  static constexpr size_t kSample = 65536;

  // On the way it takes 8 bytes for each corner and 8 for each row, at most.
  Hubs(const RowView& rows, Account& account);
  size_t count() const { return hubs_.size(); }
  const double* place(uint32_t hub) const { return hubs_[hub].place; }
  uint32_t find(const double place[3]) const;  // its number, or kNone

 private:
  struct Hub {
    uint64_t number;  // of its place
    double place[3];
  };
  uint32_t findNumber(uint64_t number) const;

  std::vector<Hub> hubs_;  // by number
};

}  // namespace tetstream
