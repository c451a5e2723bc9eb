#include "crossing_faces.h"

#include <algorithm>
#include <cmath>

#include "vector3.h"

namespace tetstream {

constexpr double kOnPlane = 1e-4;  // of the longest edge

void PlacedFace::setNormal() {
  double a[3], b[3], c[3];
  subtract(at[1], at[0], a);
  subtract(at[2], at[0], b);
  subtract(at[2], at[1], c);
  cross(a, b, normal);
  longest = std::sqrt(std::max({dot(a, a), dot(b, b), dot(c, c)}));
}

void PlacedFace::setPlane() {
  setNormal();
  offset = dot(normal, at[0]);
  near = kOnPlane * longest * std::sqrt(dot(normal, normal));
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min({at[0][i], at[1][i], at[2][i]});
    high[i] = std::max({at[0][i], at[1][i], at[2][i]});
  }
}

static bool areApart(const PlacedFace& a, const PlacedFace& b) {
  bool apart = false;
  for (int i = 0; i < 3; ++i) apart |= (a.high[i] < b.low[i]) | (b.high[i] < a.low[i]);
  return apart;
}

// Whether the corners of `face` lie on both sides of the other's plane. If so, `side` tells of each
// on which: -1, 0 (on the plane) or 1.
static bool isCut(const PlacedFace& face, const PlacedFace& by, int side[3]) {
  double height[3];
  for (int k = 0; k < 3; ++k) height[k] = dot(by.normal, face.at[k]) - by.offset;
  const double most = std::max({height[0], height[1], height[2]});
  const double least = std::min({height[0], height[1], height[2]});
  if (!(most > by.near && least < -by.near)) return false;
  for (int k = 0; k < 3; ++k) side[k] = height[k] > by.near ? 1 : height[k] < -by.near ? -1 : 0;
  return true;
}

// Whether the line from a to b, which ends on different sides of its plane, goes through a face.
static bool passes(const double a[3], const double b[3], const PlacedFace& face) {
  bool left = true, right = true;
  for (int k = 0; k < 3; ++k) {
    const double volume = sixVolume(a, b, face.at[k], face.at[(k + 1) % 3]);
    left &= volume > 0;
    right &= volume < 0;
  }
  return left || right;
}

bool cross(const PlacedFace& a, const PlacedFace& b) {
  int of_a[3], of_b[3];
  if (areApart(a, b)) return false;
  if (!isCut(b, a, of_b) || !isCut(a, b, of_a)) return false;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (of_a[k] * of_a[next] < 0 && passes(a.at[k], a.at[next], b)) return true;
    if (of_b[k] * of_b[next] < 0 && passes(b.at[k], b.at[next], a)) return true;
  }
  return false;
}

}  // namespace tetstream
