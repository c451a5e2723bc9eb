#include "balance_sample.h"

#include <algorithm>
#include <cmath>

#include "vector3.h"

namespace tetstream {

// Of the faces' area, what they cover in the plane across their mean normal. Of interfaces that
// were meshed as such nearly all vertices are above it, edges and corners of them apart; of labels
// by the cells' centres nine of ten are below, of organs in a scanned brain three of ten.
constexpr double kCoherent = 0.9;

template <class S>
BalanceSample<S>::BalanceSample(Core<S>& core)
    : core_(core),
      sheet_(static_cast<size_t>(quadricSize(core.plan.layout, core.plan.dimension))),
      nowhere_(sheet_.size()),
      difference_(static_cast<size_t>(core.plan.dimension)),
      nothing_(sheet_.size()) {}

// Its own minimum is at v, where it is 0.
template <class S>
double BalanceSample<S>::errorTowards(const S* quadric, uint32_t v, uint32_t other) {
  const S *x = core_.window.values(v), *y = core_.window.values(other);
  for (size_t i = 0; i < difference_.size(); ++i) difference_[i] = core_.scale[i] * (y[i] - x[i]);
  return static_cast<double>(core_.kernels.errorAt(quadric, x, nothing_.data(), x,
                                                   core_.scale.data(), core_.plan.dimension,
                                                   difference_.data()));
}

// Without what the regulariser of shapes adds: of a linear field that is all.
template <class S>
double BalanceSample<S>::fieldErrorTowards(uint32_t v, uint32_t other) {
  const double error = errorTowards(core_.window.quadric(v), v, other);
  double square = 0;
  for (size_t i = 0; i < 3; ++i)
    square += static_cast<double>(difference_[i]) * static_cast<double>(difference_[i]);
  return error - core_.shape_weight * volumeAt(core_, v) * square;
}

template <class S>
double BalanceSample<S>::third(std::vector<double>& costs) {
  const auto place = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 3);
  for (double& cost : costs)
    if (!std::isfinite(cost)) cost = 0;
  std::nth_element(costs.begin(), place, costs.end());
  return *place > 0 ? *place : 0;
}

template <class S>
void BalanceSample<S>::keepUnique() {
  std::sort(others_.begin(), others_.end());
  others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
}

template <class S>
void BalanceSample<S>::addInside(uint32_t v, const Star& star) {
  others_.clear();
  for (const StarCell& cell : star) others_.insert(others_.end(), cell.t, cell.t + 3);
  keepUnique();
  field_costs_.clear();
  for (uint32_t other : others_) field_costs_.push_back(fieldErrorTowards(v, other));
  costs_.inside.sample.push_back({third(field_costs_), 0});
}

template <class S>
void BalanceSample<S>::addOnSheet(uint32_t v, const std::vector<Face>& faces, SheetFace kind) {
  others_.clear();
  std::fill(sheet_.begin(), sheet_.end(), S(0));
  for (const Face& face : faces) {
    others_.insert(others_.end(), {face.a, face.b});
    const S* x[3] = {core_.window.values(v), core_.window.values(face.a),
                     core_.window.values(face.b)};
    S* q[3] = {sheet_.data(), nowhere_.data(), nowhere_.data()};
    addFaceShape(core_, x, kind, q);
  }
  keepUnique();
  field_costs_.clear();
  sheet_costs_.clear();
  for (uint32_t other : others_) {
    field_costs_.push_back(fieldErrorTowards(v, other));
    sheet_costs_.push_back(errorTowards(sheet_.data(), v, other));
  }
  RemovalCosts::Group& group = kind == SheetFace::kOuter ? costs_.outer : costs_.interfaces;
  group.sample.push_back({third(field_costs_), third(sheet_costs_)});
}

template <class S>
void BalanceSample<S>::addRoughness(uint32_t v, const std::vector<Face>& faces) {
  double x[3], sum[3] = {0, 0, 0}, area = 0;
  positionOf(core_.window, v, x);
  for (const Face& face : faces) {
    double a[3], b[3], normal[3];
    positionOf(core_.window, face.a, a);
    positionOf(core_.window, face.b, b);
    for (size_t i = 0; i < 3; ++i) {
      a[i] = (a[i] - x[i]) * static_cast<double>(core_.scale[0]);
      b[i] = (b[i] - x[i]) * static_cast<double>(core_.scale[0]);
    }
    cross(a, b, normal);
    for (size_t i = 0; i < 3; ++i) sum[i] += normal[i];
    area += std::sqrt(dot(normal, normal));
  }
  ++costs_.plain_interfaces;
  costs_.rough_interfaces += std::sqrt(dot(sum, sum)) < kCoherent * area;
}

template class BalanceSample<float>;
template class BalanceSample<double>;

}  // namespace tetstream
