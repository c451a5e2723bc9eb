#include "float_labels.h"

#include <cmath>

#include "status.h"

namespace tetstream {

constexpr double kMostLabel = 1LL << 53;

void readFloatLabels(const Column& column, const void* rows, size_t row, size_t count,
                     uint64_t first_cell, int64_t* out) {
  const auto components = static_cast<size_t>(column.components);
  for (size_t i = row * components; i < (row + count) * components; ++i) {
    const double value = valueAt(rows, column.type, i);
    if (!(std::fabs(value) < kMostLabel) || value != std::trunc(value))
      fail(Status::kBadData,
           "cell %llu has %.9g in \"%s\", which is to label regions: labels are integers",
           static_cast<unsigned long long>(first_cell + i / components), value,
           column.name.c_str());
    *out++ = static_cast<int64_t>(value);
  }
}

}  // namespace tetstream
