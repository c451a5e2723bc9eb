#include "placement.h"

#include <algorithm>
#include <cmath>

#include "arithmetic.h"

namespace tetstream {

namespace {

constexpr double kBoxJitter = 0.15;
constexpr double kBallJitter = 0.12;
static_assert(6 * kBoxJitter < 0.95, "cells of the box could be flat");

bool isInside(int64_t index, int64_t last) {
  return index > 0 && index < last;
}

struct Point {
  double x, y, z;
};

// |t| <= 1: about tan(pi t / 4), so that a face's lines meet the sphere at nearly equal angles.
double spread(double t) {
  return t * (0.75 + 0.25 * t * t);
}

// The sphere of radius r = max(|x|, |y|, |z|) takes the boundary of the cube of half side r.
Point cubeToBall(const Point& p) {
  const double r = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  if (r == 0) return {0, 0, 0};
  const double x = spread(p.x / r), y = spread(p.y / r), z = spread(p.z / r);
  const double scale = r / std::sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

}  // namespace

void placeInBox(const Lattice& lattice, uint64_t seed, const VertexRun& run, Positions* out) {
  const double side = static_cast<double>(lattice.side);
  const double free_y = isInside(run.b, lattice.side) ? kBoxJitter : 0;
  const double free_z = isInside(run.c, lattice.depth) ? kBoxJitter : 0;
  for (int i = 0; i < run.count; ++i) {
    const int64_t a = run.first + i;
    const uint64_t bits = randomBits(seed, lattice.vertexNumber(a, run.b, run.c));
    const double free_x = isInside(a, lattice.side) ? kBoxJitter : 0;
    const double x = static_cast<double>(a) + free_x * signedFraction(bits);
    const double y = static_cast<double>(run.b) + free_y * signedFraction(bits >> 21);
    const double z = static_cast<double>(run.c) + free_z * signedFraction(bits >> 42);
    out->x[i] = static_cast<float>(x / side);
    out->y[i] = static_cast<float>(y / side);
    out->z[i] = static_cast<float>(z / side);
  }
}

void placeInBall(const Lattice& lattice, uint64_t seed, const VertexRun& run, Positions* out) {
  const int64_t n = lattice.side;
  const double side = static_cast<double>(n);
  const bool inside = isInside(run.b, n) && isInside(run.c, n);
  for (int i = 0; i < run.count; ++i) {
    const int64_t a = run.first + i;
    const uint64_t bits = randomBits(seed, lattice.vertexNumber(a, run.b, run.c));
    // In half spacings, counted from the centre.
    const double jitter = inside && isInside(a, n) ? 2 * kBallJitter : 0;
    const double x = static_cast<double>(2 * a - n) + jitter * signedFraction(bits);
    const double y = static_cast<double>(2 * run.b - n) + jitter * signedFraction(bits >> 21);
    const double z = static_cast<double>(2 * run.c - n) + jitter * signedFraction(bits >> 42);
    const Point p = cubeToBall({x / side, y / side, z / side});
    out->x[i] = static_cast<float>(p.x);
    out->y[i] = static_cast<float>(p.y);
    out->z[i] = static_cast<float>(p.z);
  }
}

}  // namespace tetstream
