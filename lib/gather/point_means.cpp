#include "point_means.h"

#include <algorithm>
#include <cmath>

#include "buckets.h"
#include "rows_at_once.h"

namespace tetstream {

namespace {

constexpr uint64_t kBucketBytes = uint64_t{16} << 20;  // wanted in memory at once
constexpr uint64_t kMaxBuckets = 256;
constexpr SpoolShape kInSequence = {2, 256 << 10};

struct Value {
  uint64_t point, old;  // now, and before
  double value;
  bool operator<(const Value& other) const {
    return point != other.point ? point < other.point : old < other.old;
  }
};

double meanOf(const Value* values, size_t count) {
  double sum = 0;
  size_t finite = 0;
  for (size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i].value)) continue;
    sum += values[i].value;
    ++finite;
  }
  return finite > 0 ? sum / static_cast<double>(finite) : values[0].value;
}

}  // namespace

PointMeans::PointMeans(IndexedSource& mesh, PointJoin& points, size_t column)
    : column_(mesh.schema().fields[column]) {
  for (size_t k = 0; k < static_cast<size_t>(column_.components); ++k)
    addComponent(mesh, points, column, k);
}

void PointMeans::addComponent(IndexedSource& mesh, PointJoin& points, size_t column,
                              size_t component) {
  const std::string& temp_dir = points.plan().temp_dir;
  const auto old_points = static_cast<uint64_t>(mesh.schema().vertex_count);
  const auto buckets = static_cast<size_t>(
      std::clamp<uint64_t>(old_points * sizeof(Value) / kBucketBytes + 1, 1, kMaxBuckets));
  const uint64_t part = (points.count() - 1) / buckets + 1;
  Buckets<Value> values(buckets, temp_dir);
  const auto width = static_cast<size_t>(column_.components);
  std::vector<unsigned char> rows(kRowsAtOnce * column_.bytesPerRow());
  for (uint64_t at = 0; at < old_points; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, old_points - at));
    mesh.readField(column, at, n, rows.data());
    for (size_t i = 0; i < n; ++i) {
      Value row = {static_cast<uint64_t>(points.newOf(at + i)), at + i, 0};
      convertScalars(rows.data() + (i * width + component) * sizeOf(column_.type), column_.type,
                     &row.value, ScalarType::kFloat64, 1);
      values.add(static_cast<size_t>(row.point / part), row);
    }
  }
  Account account;
  components_.push_back(std::make_unique<RowSpool>(sizeof(double), temp_dir, kInSequence));
  for (size_t bucket = 0; bucket < buckets; ++bucket) {
    const Array<Value> sorted = values.take(bucket, account);
    for (size_t first = 0, end; first < sorted.size(); first = end) {
      for (end = first + 1; end < sorted.size() && sorted[end].point == sorted[first].point;) ++end;
      const double mean = meanOf(sorted.data() + first, end - first);
      components_.back()->append(&mean, 1);
    }
  }
  components_.back()->finish();
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
