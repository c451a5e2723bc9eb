#include "scalar.h"

#include <cstring>

namespace tetstream {

template <class In, class Out>
static void convert(const void* in, void* out, size_t count) {
  const In* from = static_cast<const In*>(in);
  Out* to = static_cast<Out*>(out);
  for (size_t i = 0; i < count; ++i) to[i] = static_cast<Out>(from[i]);
}

template <class In>
static void convertFrom(const void* in, void* out, ScalarType out_type, size_t count) {
  switch (out_type) {
    case ScalarType::kFloat32:
      return convert<In, float>(in, out, count);
    case ScalarType::kFloat64:
      return convert<In, double>(in, out, count);
    case ScalarType::kInt32:
      return convert<In, int32_t>(in, out, count);
    case ScalarType::kInt64:
      return convert<In, int64_t>(in, out, count);
  }
}

bool isExactAsDouble(const void* value, ScalarType type) {
  constexpr int64_t kMost = int64_t{1} << 53;
  int64_t number = 0;
  if (type == ScalarType::kInt64) std::memcpy(&number, value, sizeof number);
  return number >= -kMost && number <= kMost;
}

void convertScalars(const void* in, ScalarType in_type, void* out, ScalarType out_type,
                    size_t count) {
  if (count == 0) return;
  if (in_type == out_type) {
    std::memcpy(out, in, count * sizeOf(in_type));
    return;
  }
  switch (in_type) {
    case ScalarType::kFloat32:
      return convertFrom<float>(in, out, out_type, count);
    case ScalarType::kFloat64:
      return convertFrom<double>(in, out, out_type, count);
    case ScalarType::kInt32:
      return convertFrom<int32_t>(in, out, out_type, count);
    case ScalarType::kInt64:
      return convertFrom<int64_t>(in, out, out_type, count);
  }
}

double valueAt(const void* values, ScalarType type, size_t index) {
  switch (type) {
    case ScalarType::kFloat32:
      return static_cast<double>(static_cast<const float*>(values)[index]);
    case ScalarType::kFloat64:
      return static_cast<const double*>(values)[index];
    case ScalarType::kInt32:
      return static_cast<const int32_t*>(values)[index];
    case ScalarType::kInt64:
      return static_cast<double>(static_cast<const int64_t*>(values)[index]);
  }
  return 0;
}

}  // namespace tetstream
