#include "point_means.h"

#include <cmath>

namespace tetstream {

void PointMeans::Mean::add(double next) {
  if (finite == kNone) *this = {next, 0};
  if (!std::isfinite(next)) return;
  ++finite;
  const auto count = static_cast<double>(finite);
  value = finite == 1 ? next : value + (next / count - value / count);
}

PointMeans::Gathered::Gathered(uint64_t points, const std::string& temp_dir)
    : points_(points),
      part_(points / bucketsFor(points, sizeof(Mean)) + 1),
      temp_dir_(temp_dir),
      means_(account_, static_cast<size_t>(std::min(points, part_))),
      later_(static_cast<size_t>(points / part_), temp_dir) {
  clear();
}

void PointMeans::Gathered::clear() {
  std::fill_n(means_.data(), means_.size(), Mean{0, Mean::kNone});
}

std::unique_ptr<RowSpool> PointMeans::Gathered::spooled() {
  auto rows = std::make_unique<RowSpool>(sizeof(double), temp_dir_, kSpooledInSequence);
  for (uint64_t first = 0; first < points_; first += part_) {
    if (first > 0) {
      clear();
      later_.empty(static_cast<size_t>(first / part_) - 1, [&](const Value& row) {
        means_[static_cast<size_t>(row.point - first)].add(row.value);
      });
    }
    const auto count = static_cast<size_t>(std::min(part_, points_ - first));
    for (size_t i = 0; i < count; ++i) rows->append(&means_[i].value, 1);
  }
  rows->finish();
  return rows;
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
