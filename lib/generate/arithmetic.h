// generate: sine, hyperbolic tangent and random numbers made of + - * / alone, so that the same
// arguments give the same bits on every processor and with every C library. Depends on nothing.
//
// F is float, or several of them side by side.
#pragma once

#include <cstdint>

namespace tetstream {

// sin(2 pi t) for |t| < 2^21, within 1e-6 of the exact value of the rounded t.
//
// t is brought to r in [-1/2, 1/2] by subtracting the nearest integer, which adding and
// subtracting 1.5 * 2^23 leaves over, then folded to |f| <= 1/4 with the same sine. With
// u = 2 pi f, |u| <= pi / 2, Taylor's series up to u^11 / 11! is off by less than 6e-8.
template <class F>
inline F sineOfTurns(F t) {
  constexpr float kRounder = 12582912.0f;
  constexpr float kTwoPi = 6.28318530717958648f;
  const F nearest = (t + kRounder) - kRounder;
  const F r = t - nearest;
  const F folded = r > 0.25f ? 0.5f - r : (r < -0.25f ? -0.5f - r : r);
  const F u = kTwoPi * folded;
  const F q = u * u;
  F sum = -1.0f / 39916800.0f * q + 1.0f / 362880.0f;
  sum = sum * q - 1.0f / 5040.0f;
  sum = sum * q + 1.0f / 120.0f;
  sum = sum * q - 1.0f / 6.0f;
  return u + u * q * sum;
}

template <class F>
inline F between(float low, F x, float high) {
  const F lowest = F{} + low, highest = F{} + high;
  return x > highest ? highest : (x < lowest ? lowest : x);
}

// tanh(x) within 2e-4, monotone, exactly -1 and 1 from about |x| = 5 on: the seventh convergent of
// Lambert's continued fraction tanh x = x / (1 + x^2 / (3 + x^2 / (5 + ...))).
template <class F>
inline F hyperbolicTangent(F x) {
  const F q = x * x;
  const F up = x * (135135.0f + q * (17325.0f + q * (378.0f + q)));
  const F down = 135135.0f + q * (62370.0f + q * (3150.0f + q * 28.0f));
  return between(-1.0f, up / down, 1.0f);
}

// 64 bits that depend on every bit of the seed and of the counter: the mixing steps of SplitMix64
// (Steele, Lea, Flood, OOPSLA 2014) on a counter in place of a state.
inline uint64_t randomBits(uint64_t seed, uint64_t counter) {
  uint64_t h = seed + 0x9e3779b97f4a7c15u * (counter + 1);
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

// The lowest 21 bits as a number in (-1, 1), symmetric, never 0.
inline double signedFraction(uint64_t bits) {
  return (static_cast<double>(bits & 0x1fffff) - 1048575.5) * (1.0 / 1048576.0);
}

}  // namespace tetstream
