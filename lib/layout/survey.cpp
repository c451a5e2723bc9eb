#include "survey.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mix.h"
#include "status.h"
#include "symmetric_eigen.h"

namespace tetstream {

// One cell in so many is looked at for the direction, within limits: some thirty directions are
// tried. Of fewer cells fronts became wider by up to a fifth.
constexpr uint64_t kCellsPerSampled = 4, kLeastSampled = 8192, kMostSampled = 65536;
constexpr size_t kSlices = 4096;        // of a direction
constexpr double kWorthTilting = 0.95;  // what a direction that is no axis must save

Survey::Survey(IndexedSource& source, Account& account, const Tell& tell)
    : source_(source), used_(account, static_cast<size_t>(source.schema().vertex_count / 64 + 1)) {
  std::fill_n(used_.data(), used_.size(), uint64_t{0});
  std::fill_n(low_, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high_, 3, -std::numeric_limits<double>::infinity());
  readCells([&](double share) { tell(0.7 * share); });
  readPoints([&](double share) { tell(0.7 + 0.3 * share); });
}

void Survey::readCells(const Tell& tell) {
  const auto cells = static_cast<uint64_t>(source_.schema().cell_count);
  const uint64_t sampled = std::clamp(cells / kCellsPerSampled, kLeastSampled, kMostSampled);
  const uint64_t one_in = std::max<uint64_t>(cells / sampled, 1);
  std::vector<uint64_t> corners_of;
  readAllCells(source_, tell, [&](uint64_t first, size_t count, const int64_t* corners) {
    for (size_t i = 0; i < 4 * count; ++i) {
      const auto point = static_cast<uint64_t>(corners[i]);
      used_[point / 64] |= uint64_t{1} << (point % 64);
    }
    for (size_t i = 0; i < count; ++i)
      if (mix(first + i + 1) % one_in == 0)
        corners_of.insert(corners_of.end(), corners + 4 * i, corners + 4 * i + 4);
  });
  sampled_ = corners_of;
  std::sort(sampled_.begin(), sampled_.end());
  sampled_.erase(std::unique(sampled_.begin(), sampled_.end()), sampled_.end());
  for (uint64_t point : corners_of)
    sampled_cells_.push_back(static_cast<uint32_t>(
        std::lower_bound(sampled_.begin(), sampled_.end(), point) - sampled_.begin()));
}

void Survey::readPoints(const Tell& tell) {
  const ScalarType type = source_.schema().position_type;
  std::vector<double> rows(3 * kRowsOfPiece);
  places_.resize(3 * sampled_.size());
  readInPieces(static_cast<uint64_t>(source_.schema().vertex_count), tell,
               [&](uint64_t first, size_t count) {
                 source_.readPositions(first, count, rows.data());
                 for (size_t i = 0; i < count; ++i) {
                   if (!isUsed(first + i)) continue;
                   double place[3];
                   placeAt(rows.data(), type, i, place);
                   takePoint(first + i, place);
                 }
               });
}

void checkPlace(uint64_t point, const double place[3]) {
  if (std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2])) return;
  fail(Status::kBadData, "point %llu: its position is not finite",
       static_cast<unsigned long long>(point));
}

void Survey::takePoint(uint64_t point, const double place[3]) {
  checkPlace(source_.firstNumber() + point, place);
  if (used_count_++ == 0) std::copy_n(place, 3, first_);
  double d[3];
  for (int k = 0; k < 3; ++k) {
    low_[k] = std::min(low_[k], place[k]);
    high_[k] = std::max(high_[k], place[k]);
    d[k] = place[k] - first_[k];
    sums_[k] += d[k];
  }
  for (int i = 0, at = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) products_[at++] += d[i] * d[j];
  if (next_sampled_ == sampled_.size() || sampled_[next_sampled_] != point) return;
  for (size_t k = 0; k < 3; ++k) places_[3 * next_sampled_ + k] = d[k];
  ++next_sampled_;
}

// The covariance's eigenvectors.
void Survey::findPrincipalDirections(double directions[3][3]) const {
  const auto n = static_cast<double>(std::max<uint64_t>(used_count_, 1));
  std::vector<double> covariance(9);
  for (size_t i = 0, at = 0; i < 3; ++i)
    for (size_t j = 0; j <= i; ++j, ++at) {
      const double c = products_[at] / n - sums_[i] / n * (sums_[j] / n);
      covariance[3 * i + j] = covariance[3 * j + i] = std::isfinite(c) ? c : 0;
    }
  const Eigen eigen = symmetricEigen(covariance, 3);
  for (size_t i = 0; i < 9; ++i) directions[i / 3][i % 3] = eigen.vectors[i];
}

// Of the sampled cells, the most that a plane across the direction cuts.
double Survey::cellsCut(const double along[3]) const {
  std::vector<double> at(sampled_.size());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t i = 0; i < at.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) at[i] += along[k] * places_[3 * i + k];
    low = std::min(low, at[i]);
    high = std::max(high, at[i]);
  }
  const double unit = static_cast<double>(kSlices) / (high - low);
  if (!(high > low) || !std::isfinite(high - low) || !std::isfinite(unit))
    return std::numeric_limits<double>::infinity();
  std::vector<double> change(kSlices + 2);
  for (size_t c = 0; c < sampled_cells_.size(); c += 4) {
    double first = high, last = low;
    for (size_t j = 0; j < 4; ++j) {
      first = std::min(first, at[sampled_cells_[c + j]]);
      last = std::max(last, at[sampled_cells_[c + j]]);
    }
    // In part where it ends: thin cells count by their extent.
    const double from = (first - low) * unit, to = (last - low) * unit;
    const auto a = static_cast<size_t>(from), b = static_cast<size_t>(to);
    change[a] += static_cast<double>(a) + 1 - from;
    change[a + 1] += from - static_cast<double>(a);
    change[b] -= static_cast<double>(b) + 1 - to;
    change[b + 1] -= to - static_cast<double>(b);
  }
  double cut = 0, most = 0;
  for (double c : change) most = std::max(most, cut += c);
  return most;
}

// The direction turned by an angle towards +-u or +-v, all at right angles.
static void turn(const double along[3], int k, double angle, double turned[3]) {
  const int least = std::fabs(along[0]) < std::fabs(along[1]) ? 0 : 1;
  const int axis = std::fabs(along[least]) < std::fabs(along[2]) ? least : 2;
  double u[3], v[3], length = 0;
  for (int i = 0; i < 3; ++i) {
    u[i] = (i == axis) - along[axis] * along[i];
    length += u[i] * u[i];
  }
  for (double& x : u) x /= std::sqrt(length);
  for (int i = 0; i < 3; ++i)
    v[i] = along[(i + 1) % 3] * u[(i + 2) % 3] - along[(i + 2) % 3] * u[(i + 1) % 3];
  const double c = std::cos(angle), s = k % 2 ? std::sin(angle) : -std::sin(angle);
  for (int i = 0; i < 3; ++i) turned[i] = c * along[i] + s * (k < 2 ? u[i] : v[i]);
}

// Downhill from a direction, in smaller and smaller turns.
double Survey::improve(double along[3], double cut) const {
  for (double angle : {0.4, 0.2, 0.1, 0.05})
    for (int k = 0, failed = 0; failed < 4; k = (k + 1) % 4) {
      double turned[3];
      turn(along, k, angle, turned);
      const double less = cellsCut(turned);
      ++failed;
      if (!(less < cut)) continue;
      cut = less;
      std::copy_n(turned, 3, along);
      failed = 0;
    }
  return cut;
}

Survey::Direction Survey::direction(const std::string& axis) const {
  constexpr double kAxes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr const char* kNames[] = {"x", "y", "z"};
  size_t best = 0;
  double cut[3];
  for (size_t k = 0; k < 3; ++k) {
    if (axis == kNames[k]) return {{kAxes[k][0], kAxes[k][1], kAxes[k][2]}, axis};
    cut[k] = cellsCut(kAxes[k]);
    if (cut[k] < cut[best]) best = k;
  }
  double tilted[3], least = cut[best], directions[3][3];
  std::copy_n(kAxes[best], 3, tilted);
  findPrincipalDirections(directions);
  for (const auto& along : directions) {
    const double less = cellsCut(along);
    if (!(less < least)) continue;
    least = less;
    std::copy_n(along, 3, tilted);
  }
  if (improve(tilted, least) < kWorthTilting * cut[best])
    return {{tilted[0], tilted[1], tilted[2]},
            textOf("(%.2f, %.2f, %.2f)", tilted[0], tilted[1], tilted[2])};
  return {{kAxes[best][0], kAxes[best][1], kAxes[best][2]}, kNames[best]};
}

}  // namespace tetstream
