#include "mesh_reading.h"

#include "status.h"

namespace tetstream {

void failPoint(uint64_t cell, int64_t point, int64_t points) {
  fail(Status::kBadData, "cell %llu: point %lld is not one of the mesh's %lld",
       static_cast<unsigned long long>(cell), static_cast<long long>(point),
       static_cast<long long>(points));
}

double valueAt(const void* rows, ScalarType type, size_t index) {
  switch (type) {
    case ScalarType::kFloat32:
      return static_cast<double>(static_cast<const float*>(rows)[index]);
    case ScalarType::kFloat64:
      return static_cast<const double*>(rows)[index];
    case ScalarType::kInt32:
      return static_cast<const int32_t*>(rows)[index];
    case ScalarType::kInt64:
      return static_cast<double>(static_cast<const int64_t*>(rows)[index]);
  }
  return 0;
}

}  // namespace tetstream
