#include "point_means.h"

#include <cmath>

namespace tetstream {

// note: by steps that cannot overflow, and of equal values exactly that.
double PointMeans::meanOf(const Value* values, size_t count) {
  double mean = values[0].value, finite = 0;
  for (size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i].value)) continue;
    ++finite;
    mean = finite == 1 ? values[i].value : mean + (values[i].value / finite - mean / finite);
  }
  return mean;
}

void PointMeans::addComponent(Buckets<Value>& sorted, const std::string& temp_dir) {
  Account account;
  auto means = std::make_unique<RowSpool>(sizeof(double), temp_dir, kSpooledInSequence);
  const auto fillUpTo = [&](uint64_t point) {
    constexpr double nothing = 0;
    while (means->rows() < point) means->append(&nothing, 1);
  };
  for (size_t bucket = 0; bucket < sorted.count(); ++bucket) {
    const Array<Value> values = sorted.take(bucket, account);
    for (size_t first = 0, end; first < values.size(); first = end) {
      for (end = first + 1; end < values.size() && values[end].point == values[first].point;) ++end;
      fillUpTo(values[first].point);
      const double mean = meanOf(values.data() + first, end - first);
      means->append(&mean, 1);
    }
  }
  fillUpTo(points_);
  means->finish();
  components_.push_back(std::move(means));
}

void PointMeans::read(uint64_t first, size_t count, void* out) {
  auto* to = static_cast<unsigned char*>(out);
  for (uint64_t row = first; row < first + count; ++row)
    for (const std::unique_ptr<RowSpool>& component : components_) {
      convertScalars(component->row(row), ScalarType::kFloat64, to, column_.type, 1);
      to += sizeOf(column_.type);
    }
}

}  // namespace tetstream
