#include "xdmf_whole.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "rows_at_once.h"

namespace tetstream {

namespace {

constexpr double kMostExact = 9007199254740992;  // 2^53: up to here every integer is a float64

class WholeValues final : public Values {
 public:
  explicit WholeValues(std::unique_ptr<Values> values) : values_(std::move(values)) {}
  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    for (size_t n; count > 0; first += n, count -= n, to += n * sizeOf(type)) {
      n = std::min(count, kRowsAtOnce);
      double held[kRowsAtOnce];
      int64_t whole[kRowsAtOnce];
      values_->read(first, n, held, ScalarType::kFloat64);
      for (size_t i = 0; i < n; ++i) whole[i] = static_cast<int64_t>(held[i]);
      convertScalars(whole, ScalarType::kInt64, to, type, n);
    }
  }

 private:
  std::unique_ptr<Values> values_;
};

}  // namespace

std::optional<ValueType> wholeType(const MeshArray& array, uint64_t count) {
  if (!isFloat(array.type)) return array.type;
  ValueType type = ValueType::kInt32;
  if (count == 0) return type;
  const std::unique_ptr<Values> values = array.open(count);
  double held[kRowsAtOnce];
  for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
    values->read(at, n, held, ScalarType::kFloat64);
    for (size_t i = 0; i < n; ++i) {
      // note: so that what is no number is not whole.
      if (!(std::fabs(held[i]) <= kMostExact) || held[i] != std::trunc(held[i])) return {};
      if (held[i] < INT32_MIN || held[i] > INT32_MAX) type = ValueType::kInt64;
    }
  }
  return type;
}

MeshArray asWhole(MeshArray array, ValueType type) {
  if (!isFloat(array.type)) return array;
  array.type = type;
  array.open = [open = array.open](uint64_t count) {
    return std::make_unique<WholeValues>(open(count));
  };
  return array;
}

}  // namespace tetstream
