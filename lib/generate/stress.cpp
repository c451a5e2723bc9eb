#include "stress.h"

#include <algorithm>
#include <cmath>

namespace tetstream {

namespace {

constexpr int kAxes[kStressValues][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
constexpr float kGravity = 0.05f, kSoftness = 0.12f;
constexpr double kRounding = 1e-5;  // far above what float leaves

float pressureAt(float w) {
  return kGravity * (6.0f - 2.0f * w - std::sqrt(w * w + kSoftness * kSoftness));
}

// The largest density |velocity_i velocity_j|.
double largestFlux(const MixingLayer& layer, int value) {
  double flux = layer.maximum(0);
  for (int axis : kAxes[value]) flux *= std::max(-layer.minimum(1 + axis), layer.maximum(1 + axis));
  return flux;
}

bool isNormal(int value) {
  return kAxes[value][0] == kAxes[value][1];
}

}  // namespace

void stressAt(float w, float density, const float velocity[3], float stress[kStressValues]) {
  const float pressure = pressureAt(w);
  for (int value = 0; value < kStressValues; ++value) {
    const float flux = density * (velocity[kAxes[value][0]] * velocity[kAxes[value][1]]);
    stress[value] = -(isNormal(value) ? pressure + flux : flux);
  }
}

double leastStress(const MixingLayer& layer, int value) {
  const double flux = largestFlux(layer, value) + kRounding;
  return isNormal(value) ? -(static_cast<double>(pressureAt(-2)) + flux) : -flux;
}

double largestStress(const MixingLayer& layer, int value) {
  if (isNormal(value)) return -static_cast<double>(pressureAt(2)) + kRounding;
  return largestFlux(layer, value) + kRounding;
}

}  // namespace tetstream
