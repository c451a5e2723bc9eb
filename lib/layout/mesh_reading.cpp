#include "mesh_reading.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

void refuseCell(const IndexedSource& source, uint64_t cell, const int64_t corners[4]) {
  const int64_t points = source.schema().vertex_count;
  const auto first = static_cast<int64_t>(source.firstNumber());
  const auto number = static_cast<unsigned long long>(cell + source.firstNumber());
  for (int j = 0; j < 4; ++j) {
    if (corners[j] < 0 || corners[j] >= points)
      fail(Status::kBadData, "cell %llu: point %lld is not one of the mesh's %lld", number,
           static_cast<long long>(corners[j] + first), static_cast<long long>(points));
    if (std::find(corners, corners + j, corners[j]) != corners + j)
      fail(Status::kBadData, "cell %llu: point %lld is there twice", number,
           static_cast<long long>(corners[j] + first));
  }
}

}  // namespace tetstream
