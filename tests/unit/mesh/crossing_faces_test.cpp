#include "crossing_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tetstream::test {
namespace {

PlacedFace faceOf(uint32_t a, uint32_t b, uint32_t c, const double (&at)[3][3]) {
  PlacedFace face(a, b, c);
  std::copy_n(&at[0][0], 9, &face.at[0][0]);
  face.setPlane();
  return face;
}

PlacedFace inOrder(const PlacedFace& face, const int (&order)[3]) {
  PlacedFace other = face;
  for (int k = 0; k < 3; ++k) {
    other.corner[k] = face.corner[order[k]];
    std::copy_n(face.at[order[k]], 3, other.at[k]);
  }
  other.setPlane();
  return other;
}

// In any order of their corners, and of the two.
void expectCross(const PlacedFace& a, const PlacedFace& b, bool expected) {
  constexpr int kOrders[4][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}};
  for (const auto& of_a : kOrders)
    for (const auto& of_b : kOrders) {
      EXPECT_EQ(cross(inOrder(a, of_a), inOrder(b, of_b)), expected);
      EXPECT_EQ(cross(inOrder(b, of_b), inOrder(a, of_a)), expected);
    }
}

constexpr double kFlat[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

TEST(CrossingFaces, AreThoseWithAnEdgeThroughTheOther) {
  const PlacedFace flat = faceOf(0, 1, 2, kFlat);
  expectCross(flat, faceOf(3, 4, 5, {{1, 1, -1}, {1, 1, 1}, {9, 9, 0}}), true);
  expectCross(flat, faceOf(3, 4, 5, {{-1, -1, -1}, {-1, -1, 1}, {9, 9, 0}}), true);  // cut across
  expectCross(flat, faceOf(3, 4, 5, {{1, 1, 1}, {1, 2, 3}, {2, 1, 3}}), false);      // above
  expectCross(flat, faceOf(3, 4, 5, {{3, 3, -1}, {3, 3, 1}, {9, 9, 0}}), false);     // beside
}

TEST(CrossingFaces, MayMeetAtTheirCorners) {
  const PlacedFace flat = faceOf(0, 1, 2, kFlat);
  expectCross(flat, faceOf(0, 3, 4, {{0, 0, 0}, {1, 1, -1}, {1, 1, 1}}), true);
  expectCross(flat, faceOf(0, 3, 4, {{0, 0, 0}, {-1, -1, -1}, {-1, -1, 1}}), false);
  expectCross(flat, faceOf(0, 1, 3, {{0, 0, 0}, {4, 0, 0}, {1, 1, 1}}), false);  // at an edge
}

TEST(CrossingFaces, MayLieInOnePlane) {
  const PlacedFace flat = faceOf(0, 1, 2, kFlat);
  expectCross(flat, faceOf(1, 2, 3, {{4, 0, 0}, {0, 4, 0}, {4, 4, 0}}), false);
  expectCross(flat, faceOf(3, 4, 5, {{1, 1, 0}, {2, 1, 0}, {1, 2, 1}}), false);  // one rests on it
}

// Corners of an inclined plane are off it by rounding: a plane mesh has no crossings.
TEST(CrossingFaces, MayLieInAnInclinedPlane) {
  const auto placed = [](uint32_t first, const int(&at)[3][2]) {
    double inclined[3][3];
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        inclined[k][i] = static_cast<float>(1e3 + at[k][0] / (1.7 + i) + at[k][1] / (2.9 - i));
    return faceOf(first, first + 1, first + 2, inclined);
  };
  const PlacedFace face = placed(0, {{0, 0}, {4, 0}, {0, 4}});
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      expectCross(face, placed(3, {{x, y}, {x + 4, y + 1}, {x + 1, y + 4}}), false);
}

}  // namespace
}  // namespace tetstream::test
