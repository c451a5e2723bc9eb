#include "balance_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "mix.h"
#include "vector3.h"

namespace tetstream {

template <class S>
BalanceSample<S>::BalanceSample(Core<S>& core)
    : core_(core),
      sheet_(static_cast<size_t>(quadricSize(core.plan.layout, core.plan.dimension))),
      nowhere_(sheet_.size()),
      difference_(static_cast<size_t>(core.plan.dimension)),
      nothing_(sheet_.size()) {}

// Of the range of the fields: smaller errors are alike.
constexpr double kLeastFieldError = 1e-5;

template <class S>
void BalanceSample<S>::start(const Group groups[3], bool is_whole) {
  costs_.is_whole = is_whole;
  costs_.outer.vertices = static_cast<double>(groups[0].of);
  costs_.interfaces.vertices = static_cast<double>(groups[1].of);
  costs_.inside.vertices = static_cast<double>(groups[2].of);
  const double least = kLeastFieldError * core_.extent;
  for (size_t i = 0; i < 3; ++i) costs_.least_field += least * least * groups[i].volume;
}

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
void BalanceSample<S>::keepUnique() {
  std::sort(others_.begin(), others_.end());
  others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
}

// From v to the other two of a face, in normalised units.
template <class S>
void BalanceSample<S>::edgesOf(uint32_t v, const Face& face, double edges[2][3]) const {
  const auto scale = static_cast<double>(core_.scale[0]);
  double x[3];
  positionOf(core_.window, v, x);
  positionOf(core_.window, face.a, edges[0]);
  positionOf(core_.window, face.b, edges[1]);
  for (size_t i = 0; i < 3; ++i) {
    edges[0][i] = (edges[0][i] - x[i]) * scale;
    edges[1][i] = (edges[1][i] - x[i]) * scale;
  }
}

template <class S>
void BalanceSample<S>::addInside(uint32_t v, const Star& star) {
  others_.clear();
  for (const StarCell& cell : star) others_.insert(others_.end(), cell.t, cell.t + 3);
  keepUnique();
  field_costs_.clear();
  for (uint32_t other : others_) field_costs_.push_back(fieldErrorTowards(v, other));
  const double usual = usualCost(field_costs_.data(), field_costs_.size());
  costs_.inside.sample.push_back({{usual, 0}});
}

// Cosine between the normals on both sides of a crease; of all ways' errors, what the two along a
// straight one have.
constexpr double kCrease = 0.766, kStraight = 1e-3;

// The other ends of the edges at v along which the sheet is creased.
template <class S>
const std::vector<uint32_t>& BalanceSample<S>::creaseAt(uint32_t v,
                                                        const std::vector<Face>& faces) {
  normals_.clear();
  double edges[2][3];
  for (const Face& face : faces) {
    edgesOf(v, face, edges);
    cross(edges[0], edges[1], normals_.emplace_back().data());
  }
  const auto isCrease = [this](size_t i, size_t k) {
    const double *m = normals_[i].data(), *n = normals_[k].data();
    return dot(m, n) < kCrease * std::sqrt(dot(m, m) * dot(n, n));
  };
  others_.clear();
  for (size_t i = 0; i < faces.size(); ++i)
    for (size_t k = 0; k < faces.size(); ++k)
      if (faces[i].b == faces[k].a && isCrease(i, k)) others_.push_back(faces[i].b);
  return others_;
}

// All vertices of the boundary are looked at from each of these: from every fourth.
constexpr size_t kPerSight = 4;

// What is no number counts as nothing, and so does what rounding leaves below it.
static double knownCost(double cost) {
  return std::isfinite(cost) && cost > 0 ? cost : 0;
}

template <class S>
void BalanceSample<S>::addOnSheet(uint32_t v, const std::vector<Face>& faces, const Star& star,
                                  SheetFace kind) {
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
  const auto wayTo = [&](uint32_t other) -> Removal {
    return {knownCost(fieldErrorTowards(v, other)),
            knownCost(errorTowards(sheet_.data(), v, other))};
  };
  Ways ways, along;
  double all = 0, straight = 0;
  for (uint32_t other : others_) {
    ways.push_back(wayTo(other));
    all += ways.back().sheet;
  }
  for (uint32_t other : creaseAt(v, faces)) {
    along.push_back(wayTo(other));
    straight += along.back().sheet;
  }
  if (along.size() != 2 || straight > kStraight * all) along = ways;
  RemovalCosts::Group& group = kind == SheetFace::kOuter ? costs_.outer : costs_.interfaces;
  group.sample.push_back(std::move(ways));
  group.along_creases.push_back(std::move(along));
  if (kind == SheetFace::kOuter && group.sample.size() % kPerSight == 1) addSight(v, faces, star);
}

template <class S>
typename BalanceSample<S>::Bend BalanceSample<S>::bendAt(uint32_t v,
                                                         const std::vector<Face>& faces) {
  Bend bend;
  double sum[3] = {0, 0, 0}, around[3] = {0, 0, 0};
  others_.clear();
  for (const Face& face : faces) {
    double edges[2][3], normal[3];
    edgesOf(v, face, edges);
    const double *a = edges[0], *b = edges[1];
    cross(a, b, normal);
    for (size_t i = 0; i < 3; ++i) {
      sum[i] += normal[i];
      around[i] += (a[i] + b[i]) / 2;
    }
    bend.edges += (dot(a, a) + dot(b, b)) / 2;
    others_.insert(others_.end(), {face.a, face.b});
  }
  keepUnique();
  const auto count = static_cast<double>(faces.size());
  const double length = std::sqrt(dot(sum, sum));
  bend.is_closed = others_.size() == faces.size() && length > 0;
  if (!bend.is_closed) return bend;
  for (size_t i = 0; i < 3; ++i) bend.normal[i] = sum[i] / length;
  bend.height = dot(around, bend.normal) / count;
  bend.edges /= count;
  return bend;
}

// Of a vertex whose sheet is closed: others have no one normal.
template <class S>
void BalanceSample<S>::addSight(uint32_t v, const std::vector<Face>& faces, const Star& star) {
  const Bend bend = bendAt(v, faces);
  if (!bend.is_closed) return;
  Sight sight = {v, v, {}, {}, std::numeric_limits<double>::infinity(), sheet_};
  positionOf(core_.window, v, sight.place);
  double inwards = 0;
  for (const StarCell& cell : star)
    for (const uint32_t other : cell.t) {
      double y[3];
      positionOf(core_.window, other, y);
      for (size_t i = 0; i < 3; ++i) inwards += (y[i] - sight.place[i]) * bend.normal[i];
    }
  const double away = inwards < 0 ? 1 : -1;
  for (size_t i = 0; i < 3; ++i) sight.along[i] = away * bend.normal[i];
  sights_.push_back(std::move(sight));
}

// What is seen lies within 45 degrees of the normal.
template <class S>
void BalanceSample<S>::addGaps(const uint32_t* all, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    double y[3];
    positionOf(core_.window, all[i], y);
    for (Sight& sight : sights_) {
      const double d[3] = {y[0] - sight.place[0], y[1] - sight.place[1], y[2] - sight.place[2]};
      const double square = dot(d, d), ahead = dot(d, sight.along);
      if (!(square < sight.square && ahead > 0 && 2 * ahead * ahead > square)) continue;
      sight.square = square;
      sight.nearest = all[i];
    }
  }
  for (const Sight& sight : sights_)
    costs_.gaps.push_back(
        sight.nearest == sight.from
            ? std::numeric_limits<double>::infinity()
            : knownCost(errorTowards(sight.sheet.data(), sight.from, sight.nearest)));
}

template <class S>
void BalanceSample<S>::addBend(uint32_t v, const std::vector<Face>& faces) {
  const Bend bend = bendAt(v, faces);
  if (bend.is_closed) pairs_.push_back({{others_.rbegin(), others_.rend()}, v, bend});
}

template <class S>
std::vector<uint32_t> BalanceSample<S>::partners() {
  others_.clear();
  if (costs_.jitter.pairs >= kLeastPairs) return others_;
  for (Pair& pair : pairs_) {
    if (pair.is_met || pair.others.empty()) continue;
    pair.partner = pair.others.back();
    pair.others.pop_back();
    others_.push_back(pair.partner);
  }
  keepUnique();
  return others_;
}

// Of the edges: what rounding leaves of a plane is less.
constexpr double kLeastJitter = 0.01;
// Cosine between the normals: across a rim nobody knows which side is the same.
constexpr double kLeastAlong = 0.5;

// Faces are turned to the same side as at the others.
template <class S>
void BalanceSample<S>::addPartner(uint32_t v, const std::vector<Face>& faces) {
  const Bend bend = bendAt(v, faces);
  if (!bend.is_closed) return;
  for (Pair& pair : pairs_) {
    if (pair.partner != v || pair.is_met) continue;
    const double turn = dot(bend.normal, pair.bend.normal);
    if (std::fabs(turn) < kLeastAlong) continue;
    RemovalCosts::Jitter& jitter = costs_.jitter;
    const double square = (bend.height * bend.height + pair.bend.height * pair.bend.height) / 2;
    pair.is_met = true;
    ++jitter.pairs;
    jitter.off += square > kLeastJitter * kLeastJitter * (bend.edges + pair.bend.edges) / 2;
    jitter.square += square;
    jitter.product += (turn < 0 ? -1 : 1) * bend.height * pair.bend.height;
  }
}

// The same for vertices at the same place; hardly for others.
template <class S>
uint64_t BalanceSample<S>::placeKey(uint32_t v) const {
  uint64_t key = 0;
  for (int i = 0; i < 3; ++i) {
    const double x = static_cast<double>(core_.window.values(v)[i]) + 0.0;  // of -0, too
    key = mix(key + std::bit_cast<uint64_t>(x) + 1);
  }
  return key;
}

template <class S>
void BalanceSample<S>::addTouching(const std::vector<uint32_t>& sampled, const uint32_t* all,
                                   size_t count) {
  std::unordered_map<uint64_t, int> met;
  for (uint32_t v : sampled) met.emplace(placeKey(v), 0);
  for (size_t i = 0; i < count; ++i)
    if (const auto place = met.find(placeKey(all[i])); place != met.end()) ++place->second;
  const auto touches = [&](uint32_t v) { return met.at(placeKey(v)) > 1; };
  const auto touching = std::count_if(sampled.begin(), sampled.end(), touches);
  costs_.touching =
      static_cast<double>(touching) / static_cast<double>(std::max<size_t>(sampled.size(), 1));
}

template class BalanceSample<float>;
template class BalanceSample<double>;

}  // namespace tetstream
