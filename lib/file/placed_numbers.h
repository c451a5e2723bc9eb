// file: numbers that every row of a part of a file has, as a column of a mesh, read where they lie.
// Depends on column_rows.h, file_window.h, scalar.h, tasks.h.
#pragma once

#include <memory>

#include "column_rows.h"
#include "file_window.h"
#include "scalar.h"
#include "tasks.h"

namespace tetstream {

struct NumbersOfRow {
  size_t at_byte = 0;  // of the row
  size_t count = 1;
  size_t width = 4;  // bytes of each, 4 or 8
  bool real = false;
  bool finite = false;  // reals that are to be: a position
};

// As numbers of `type`: reals as floats, integers as those of the same width or a larger one.
std::shared_ptr<RowReader> placeNumbers(std::shared_ptr<FileWindow> window, const RowsPlace& place,
                                        const NumbersOfRow& numbers, ScalarType type);

// Whether any of the integers, one of each row, is not 0. Looks up to the first such, at long parts
// with all who help.
bool anyNonZero(const RowsPlace& place, const NumbersOfRow& integer, const Tasks* tasks);

// The same integer in every row, of int32 or int64.
std::shared_ptr<RowReader> placeConstant(int64_t value, ScalarType type);

}  // namespace tetstream
