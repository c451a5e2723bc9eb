#include "mixing_layer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "arithmetic.h"

namespace tetstream {

namespace {

constexpr double kPi = 3.14159265358979324;

// p_m and q_m, half waves across the domain, and relative heights before the seed changes them.
constexpr int kHalfWaves[][2] = {{2, 1}, {1, 3}, {4, 2}, {3, 5}, {5, 4}};
constexpr double kPlumeHeights[] = {0.30, 0.25, 0.20, 0.15, 0.10};
constexpr int kMostHalfWaves = 5;

// Of the small waves, in turns per unit of length, and their heights.
constexpr double kTurns[][3] = {{2.1, -1.4, 1.7}, {-2.7, 2.2, 1.3},  {3.3, 1.9, -3.0},
                                {1.4, -4.0, 2.5}, {-4.5, -2.4, 3.5}, {4.9, 3.8, -4.3}};
constexpr double kWaveHeights[] = {0.25, 0.22, 0.18, 0.15, 0.11, 0.09};

constexpr float kInterfaceHeight = 0.8f;  // of the tallest plumes
constexpr float kInterfaceThickness = 0.12f;
constexpr float kWidening = 0.18f;  // of a plume's head, at |w| = kHeadHeight
constexpr float kHeadHeight = 0.4f;
constexpr float kZoneHeight = 0.8f;  // where the small waves have half their height
constexpr float kRoughness = 0.8f;   // by the small waves, in thicknesses
constexpr float kContrast = 0.87f, kStratification = 0.05f, kRipple = 0.08f;
constexpr float kWaveSpeed = 0.2f;

// cos(k pi x) and sin(k pi x) for k = 0 ... kMostHalfWaves, by the addition theorem from k = 1.
template <class F>
struct Multiples {
  F cosine[kMostHalfWaves + 1], sine[kMostHalfWaves + 1];

  explicit Multiples(F x) {
    cosine[0] = F{} + 1.0f;
    sine[0] = F{};
    cosine[1] = sineOfTurns(0.5f * x + 0.25f);
    sine[1] = sineOfTurns(0.5f * x);
    for (int k = 2; k <= kMostHalfWaves; ++k) {
      cosine[k] = 2.0f * cosine[1] * cosine[k - 1] - cosine[k - 2];
      sine[k] = 2.0f * cosine[1] * sine[k - 1] - sine[k - 2];
    }
  }
};

double magnitude(double x) {
  return x < 0 ? -x : x;
}

}  // namespace

MixingLayer::MixingLayer(uint64_t seed) {
  setPlumes(randomBits(seed, 0));
  setWaves(randomBits(seed, 1));
  setBounds();
}

void MixingLayer::setPlumes(uint64_t seed) {
  double heights[kPlumes], sum = 0;
  for (int m = 0; m < kPlumes; ++m) {
    const uint64_t bits = randomBits(seed, static_cast<uint64_t>(m));
    heights[m] = kPlumeHeights[m] * (1 + 0.25 * signedFraction(bits));
    sum += heights[m];
    if (bits >> 63) heights[m] = -heights[m];
  }
  for (int m = 0; m < kPlumes; ++m) {
    const double height = heights[m] / sum, p = kHalfWaves[m][0], q = kHalfWaves[m][1];
    height_[m] = static_cast<float>(height);
    slope_x_[m] = static_cast<float>(height * kPi * p);
    slope_y_[m] = static_cast<float>(height * kPi * q);
    drift_x_[m] = static_cast<float>(height * p / (kPi * (p * p + q * q)));
    drift_y_[m] = static_cast<float>(height * q / (kPi * (p * p + q * q)));
  }
}

void MixingLayer::setWaves(uint64_t seed) {
  for (int m = 0; m < kWaves; ++m) {
    Wave& wave = waves_[m];
    const double* k = kTurns[m];
    // (k y, -k x, 0) with a share of k's own direction across it: k x (k y, -k x, 0).
    const double share = m % 2 ? 0.4 : -0.3;
    const double across[3] = {k[1] + share * k[0] * k[2], -k[0] + share * k[1] * k[2],
                              -share * (k[0] * k[0] + k[1] * k[1])};
    const double length =
        std::sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
    wave.height = static_cast<float>(kWaveHeights[m]);
    wave.phase = static_cast<float>(signedFraction(randomBits(seed, static_cast<uint64_t>(m))));
    for (int i = 0; i < 3; ++i) {
      wave.turns[i] = static_cast<float>(k[i]);
      wave.along[i] = static_cast<float>(kWaveHeights[m] * across[i] / length);
    }
  }
}

template <class F>
MixingLayer::Plumes<F> MixingLayer::plumesAt(F x, F y) const {
  const Multiples<F> at_x(x), at_y(y);
  Plumes<F> plumes = {};
  for (int m = 0; m < kPlumes; ++m) {
    const int p = kHalfWaves[m][0], q = kHalfWaves[m][1];
    const F sine_x = at_x.sine[p] * at_y.cosine[q], sine_y = at_x.cosine[p] * at_y.sine[q];
    plumes.sum += height_[m] * (at_x.cosine[p] * at_y.cosine[q]);
    plumes.slope_x -= slope_x_[m] * sine_x;
    plumes.slope_y -= slope_y_[m] * sine_y;
    plumes.drift_x -= drift_x_[m] * sine_x;
    plumes.drift_y -= drift_y_[m] * sine_y;
  }
  return plumes;
}

template <class F>
F MixingLayer::plumeSumAt(F x, F y) const {
  const Multiples<F> at_x(x), at_y(y);
  F sum = {};
  for (int m = 0; m < kPlumes; ++m)
    sum += height_[m] * (at_x.cosine[kHalfWaves[m][0]] * at_y.cosine[kHalfWaves[m][1]]);
  return sum;
}

template <class F>
void MixingLayer::evaluateAt(const F at[3], F* density, F velocity[3]) const {
  const F x = at[0], y = at[1], z = at[2];
  F ripple = {}, along[3] = {};
  for (const Wave& wave : waves_) {
    const F sine =
        sineOfTurns(wave.turns[0] * x + wave.turns[1] * y + wave.turns[2] * z + wave.phase);
    ripple += wave.height * sine;
    for (int i = 0; i < 3; ++i) along[i] += wave.along[i] * sine;
  }
  const F far = z * z * (1.0f / (kZoneHeight * kZoneHeight));
  const F zone = 1.0f / (1.0f + far * far);

  const Plumes<F> plumes = plumesAt(x, y);
  const F head = z * (1.0f / kHeadHeight);
  const F widening = kWidening * kHeadHeight * head / (1.0f + head * head);
  const F warped = plumeSumAt(x + widening * plumes.slope_x, y + widening * plumes.slope_y);
  const F distance = (z - kInterfaceHeight * warped) * (1.0f / kInterfaceThickness);
  const F value = 2.0f + kContrast * hyperbolicTangent(distance + kRoughness * zone * ripple) -
                  kStratification * 0.5f * z + kRipple * zone * ripple;
  *density = between(1.0f, value, 3.0f);

  const F depth = 1.0f - 0.25f * z * z;
  const F speed = depth * depth, shear = -z * depth, share = kWaveSpeed * zone;
  velocity[0] = shear * plumes.drift_x + share * along[0];
  velocity[1] = shear * plumes.drift_y + share * along[1];
  velocity[2] = speed * plumes.sum + share * along[2];
}

// Four points side by side.
void MixingLayer::evaluate(const float* x, const float* y, const float* z, int count,
                           float* density, float* const velocity[3]) const {
  typedef float Four __attribute__((vector_size(16)));
  constexpr int kLanes = sizeof(Four) / sizeof(float);
  const float* const places[3] = {x, y, z};
  for (int i = 0; i < count; i += kLanes) {
    const size_t bytes = static_cast<size_t>(std::min(count - i, kLanes)) * sizeof(float);
    Four at[3] = {}, value, moving[3];
    for (int axis = 0; axis < 3; ++axis) std::memcpy(&at[axis], places[axis] + i, bytes);
    evaluateAt(at, &value, moving);
    std::memcpy(density + i, &value, bytes);
    for (int axis = 0; axis < 3; ++axis) std::memcpy(velocity[axis] + i, &moving[axis], bytes);
  }
}

// The plumes' largest values lie where the slope is zero, at most half a step along x and y from a
// point of the grid, so that a value there is short by at most (step / 2)^2 / 2 times the sum of
// the second derivatives' largest magnitudes, which is pi^2 (p + q)^2 for each plume.
void MixingLayer::setBounds() {
  constexpr int kSteps = 64;
  constexpr double kShort = 0.125 / (kSteps * kSteps);
  constexpr double kSteepest = 0.76981;  // of g: |w| (1 - w^2 / 4) at w^2 = 4 / 3
  constexpr double kRounding = 1e-4;     // far above what sineOfTurns and float leave
  double low = 0, high = 0, drift[2] = {0, 0};
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const Plumes<float> at =
          plumesAt(static_cast<float>(i) / kSteps, static_cast<float>(j) / kSteps);
      low = std::min(low, static_cast<double>(at.sum));
      high = std::max(high, static_cast<double>(at.sum));
      drift[0] = std::max(drift[0], magnitude(at.drift_x));
      drift[1] = std::max(drift[1], magnitude(at.drift_y));
    }
  }
  double waves[3] = {0, 0, 0};
  for (const Wave& wave : waves_)
    for (int i = 0; i < 3; ++i) waves[i] += kWaveSpeed * magnitude(wave.along[i]);
  for (int m = 0; m < kPlumes; ++m) {
    const double both = kPi * (kHalfWaves[m][0] + kHalfWaves[m][1]), missed = kShort * both * both;
    low -= missed * magnitude(height_[m]);
    high += missed * magnitude(height_[m]);
    drift[0] += missed * magnitude(drift_x_[m]);
    drift[1] += missed * magnitude(drift_y_[m]);
  }
  minimum_[0] = 1;
  maximum_[0] = 3;
  for (int i = 0; i < 2; ++i) {
    maximum_[1 + i] = kSteepest * drift[i] + waves[i] + kRounding;
    minimum_[1 + i] = -maximum_[1 + i];
  }
  minimum_[3] = low - waves[2] - kRounding;
  maximum_[3] = high + waves[2] + kRounding;
}

}  // namespace tetstream
