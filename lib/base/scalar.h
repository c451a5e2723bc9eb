// base: the number types that cross the library's boundary. Depends on nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

// Numbers equal TETSTREAM_TYPE_* of the public header and the type codes of `.tets`.
enum class ScalarType : int32_t { kFloat32 = 1, kFloat64 = 2, kInt32 = 3, kInt64 = 4 };

inline bool isKnown(ScalarType t) {
  return t >= ScalarType::kFloat32 && t <= ScalarType::kInt64;
}
inline bool isFloat(ScalarType t) {
  return t == ScalarType::kFloat32 || t == ScalarType::kFloat64;
}
inline size_t sizeOf(ScalarType t) {
  return t == ScalarType::kFloat32 || t == ScalarType::kInt32 ? 4 : 8;
}

// out[i] = in[i], both plain arrays of `count` values of the given types. Float to integer is
// never asked for; float64 to float32 rounds to nearest; int64 to int32 is the caller's check.
void convertScalars(const void* in, ScalarType in_type, void* out, ScalarType out_type,
                    size_t count);

// Whether a float64 holds the value, as it does all but large int64.
bool isExactAsDouble(const void* value, ScalarType type);

double valueAt(const void* values, ScalarType type, size_t index);

// Row `row` of positions, which are floats.
inline void placeAt(const void* positions, ScalarType type, size_t row, double place[3]) {
  for (size_t k = 0; k < 3; ++k) place[k] = valueAt(positions, type, 3 * row + k);
}

}  // namespace tetstream
