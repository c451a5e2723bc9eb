#include "field_weights.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "vector3.h"

namespace tetstream {
namespace {

constexpr uint32_t kSampledVertices = 512;
// What has more cells is left out: each of them is held against all vertices round it.
constexpr size_t kLargestStar = 200;
constexpr double kCostPower = 3.0 / 7;
// Of its range; what is less is rounding.
constexpr double kLeastErrorOfField = 1e-6;

template <class S>
class FieldErrors {
 public:
  FieldErrors(const Core<S>& core, const std::vector<double>& range)
      : core_(core), fields_(core.plan.schema.fields.size()), inverse_range_(range) {
    for (double& r : inverse_range_) r = r > 0 && std::isfinite(1 / r) ? 1 / r : 0;
  }

  // Of a vertex: its corners, each 4 * cell + j. It goes to one of its neighbours, for each field
  // to another.
  void add(const std::vector<uint32_t>& corners) {
    listOthers(corners);
    const size_t others = others_.size();
    costs_.assign(fields_.size() * others, 0);
    for (uint32_t corner : corners) addCell(corner);
    for (size_t f = 0; f < fields_.size(); ++f) {
      const double cost = usualCost(&costs_[f * others], others);
      fields_[f].sum += cost;
      fields_[f].root += std::pow(cost, kCostPower);
    }
  }

  // The squared error of the field alone, in a unit common to all; 0 where it cannot be told.
  double squareOf(size_t field) const {
    const bool is_noise = fields_[field].sum <= kLeastErrorOfField * kLeastErrorOfField * volume_;
    return is_noise ? 0 : std::pow(fields_[field].root, 1 / kCostPower);
  }

 private:
  struct Sums {
    double sum = 0, root = 0;  // of the costs, and of their powers
  };

  const uint32_t* cornersOf(uint32_t corner) const { return core_.window.mesh.corners(corner / 4); }

  void listOthers(const std::vector<uint32_t>& corners) {
    others_.clear();
    for (uint32_t corner : corners)
      for (uint32_t k = 1; k < 4; ++k) others_.push_back(cornersOf(corner)[(corner + k) % 4]);
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
  }

  // From the first vertex to the second, in the fields' ranges and the mesh's extent.
  double difference(uint32_t from, uint32_t to, size_t i) const {
    const double x = static_cast<double>(core_.window.values(from)[i]);
    return (static_cast<double>(core_.window.values(to)[i]) - x) * inverse_range_[i];
  }

  // What is linear in this cell, at the vertices round it all.
  void addCell(uint32_t corner) {
    const uint32_t* const v = cornersOf(corner);
    const uint32_t center = v[corner % 4];
    double e[3][3], normal[3][3];
    for (uint32_t k = 0; k < 3; ++k)
      for (size_t i = 0; i < 3; ++i) e[k][i] = difference(center, v[(corner + k + 1) % 4], i);
    for (size_t k = 0; k < 3; ++k) cross(e[(k + 1) % 3], e[(k + 2) % 3], normal[k]);
    const double six_volume = dot(e[0], normal[0]), volume = std::fabs(six_volume) / 24;
    if (!(volume > 0)) return;
    volume_ += volume;
    for (size_t i = 3; i < inverse_range_.size(); ++i) {
      double gradient[3] = {0, 0, 0};
      for (uint32_t k = 0; k < 3; ++k) {
        const double rise = difference(center, v[(corner + k + 1) % 4], i) / six_volume;
        for (size_t j = 0; j < 3; ++j) gradient[j] += rise * normal[k][j];
      }
      addErrors(center, gradient, i, volume);
    }
  }

  void addErrors(uint32_t center, const double gradient[3], size_t i, double volume) {
    const auto field = static_cast<size_t>(core_.plan.measured_column[i - 3]);
    double* const costs = &costs_[field * others_.size()];
    for (size_t k = 0; k < others_.size(); ++k) {
      double off = -difference(center, others_[k], i);
      for (size_t j = 0; j < 3; ++j) off += gradient[j] * difference(center, others_[k], j);
      costs[k] += volume * off * off;
    }
  }

  const Core<S>& core_;
  std::vector<Sums> fields_;
  std::vector<double> inverse_range_;
  std::vector<uint32_t> others_;  // round the vertex
  std::vector<double> costs_;     // of each field, to go to each of these
  double volume_ = 0;             // a quarter of that of the cells of each vertex
};

// Behind the last vertex of the cells: others may be there, as they came.
template <class S>
uint32_t vertexEndOf(const Core<S>& core, uint32_t end) {
  uint32_t last = 0;
  for (uint32_t c = 0; c < end; ++c)
    last = std::max(
        last, *std::max_element(core.window.mesh.corners(c), core.window.mesh.corners(c) + 4));
  return last + 1;
}

// The corners of some of the vertices, evenly spread; of those with too many cells one too many.
template <class S>
std::vector<std::vector<uint32_t>> someStars(const Core<S>& core, uint32_t end, uint32_t vertices) {
  const Topology& mesh = core.window.mesh;
  const uint32_t step = std::bit_ceil(vertices / kSampledVertices + 1);
  std::vector<std::vector<uint32_t>> stars(vertices / step + 1);
  for (uint32_t c = 0; c < end; ++c)
    for (uint32_t j = 0; j < 4; ++j)
      if (const uint32_t v = mesh.corners(c)[j]; (v & (step - 1)) == step / 2)
        if (stars[v / step].size() <= kLargestStar) stars[v / step].push_back(4 * c + j);
  return stars;
}

}  // namespace

template <class S>
std::vector<double> weightsOfFields(const Core<S>& core, uint32_t end,
                                    const std::vector<double>& range) {
  std::vector<double> weights(core.plan.schema.fields.size(), 1.0);
  const uint32_t vertices = vertexEndOf(core, end);
  if (vertices < kLeastVertices) return weights;
  FieldErrors<S> errors(core, range);
  for (const std::vector<uint32_t>& star : someStars(core, end, vertices))
    if (!star.empty() && star.size() <= kLargestStar) errors.add(star);
  double largest = 0;
  for (size_t f = 0; f < weights.size(); ++f) largest = std::max(largest, errors.squareOf(f));
  for (size_t f = 0; f < weights.size(); ++f) {
    const double square = errors.squareOf(f);
    if (!(square > 0) || !std::isfinite(largest)) continue;
    const double ratio = std::sqrt(largest / square);
    weights[f] = std::exp2(std::round(std::log2(std::min(ratio, kLargestFieldWeight))));
  }
  return weights;
}

template std::vector<double> weightsOfFields(const Core<float>&, uint32_t,
                                             const std::vector<double>&);
template std::vector<double> weightsOfFields(const Core<double>&, uint32_t,
                                             const std::vector<double>&);

}  // namespace tetstream
