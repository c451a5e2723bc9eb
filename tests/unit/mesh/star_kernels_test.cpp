// starShape against exact integers and the angles of single cells, nearestCell against volumes, and
// the same from every build.
#include "star_kernels.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "exact_reference.h"
#include "random.h"
#include "star_kernels.inl"
#include "test_mesh.h"

namespace tetstream {

namespace test {
namespace {

constexpr size_t kStride = 4;  // a field behind each position

int rounds() {
  return slowRun() ? 20 : 400;
}

double random(Random& r, double size) {
  return size * (2.0 * static_cast<double>(r.next() >> 11) * 0x1p-53 - 1);
}

// A centre, and cells over triangles of vertices of their own.
template <class S>
struct Fan {
  std::array<double, 3> x;
  std::vector<S> values;
  std::vector<StarCell> cells;
  double scale = 1;

  void add(const std::array<std::array<double, 3>, 3>& triangle) {
    const auto cell = static_cast<uint32_t>(cells.size());
    cells.push_back({4 * cell, {3 * cell, 3 * cell + 1, 3 * cell + 2}});
    for (const auto& p : triangle) {
      for (double c : p) values.push_back(static_cast<S>(c));
      values.push_back(std::numeric_limits<S>::quiet_NaN());  // no field is looked at
    }
  }
  std::array<double, 3> corner(size_t cell, size_t k) const {
    std::array<double, 3> p;
    for (size_t i = 0; i < 3; ++i)
      p[i] = static_cast<double>(values[kStride * cells[cell].t[k] + i]);
    return p;
  }
  int signOf(size_t cell) const {
    return referenceOrientation(x.data(), corner(cell, 0).data(), corner(cell, 1).data(),
                                corner(cell, 2).data());
  }
  uint32_t addCentre() {
    for (double c : x) values.push_back(static_cast<S>(c));
    values.push_back(0);
    return static_cast<uint32_t>(values.size() / kStride - 1);
  }
  // The smallest barycentric coordinate of p in a cell.
  double leastCoordinate(size_t cell, const std::array<double, 3>& p) const {
    const std::array<double, 3> c[4] = {x, corner(cell, 0), corner(cell, 1), corner(cell, 2)};
    const auto volume = [](const std::array<double, 3> t[4]) {
      return dot(edge(t[0], t[1]), cross(edge(t[0], t[2]), edge(t[0], t[3])));
    };
    const long double whole = volume(c);
    long double least = 2;
    for (size_t k = 0; k < 4; ++k) {
      std::array<double, 3> with_p[4] = {c[0], c[1], c[2], c[3]};
      with_p[k] = p;
      least = std::min(least, volume(with_p) / whole);
    }
    return static_cast<double>(least);
  }
  // In degrees, from normals as long as the areas: by the sine and the cosine.
  double smallestAngle(size_t cell) const {
    const std::array<double, 3> p[4] = {x, corner(cell, 0), corner(cell, 1), corner(cell, 2)};
    Long normals[4];  // away from the fourth corner
    for (size_t k = 0; k < 4; ++k) {
      const Long a = edge(p[(k + 1) % 4], p[(k + 2) % 4]), b = edge(p[(k + 1) % 4], p[(k + 3) % 4]);
      normals[k] = cross(a, b);
      if (dot(normals[k], edge(p[(k + 1) % 4], p[k])) > 0)
        for (long double& c : normals[k]) c = -c;
    }
    long double smallest = 180;
    for (size_t k = 0; k < 4; ++k)
      for (size_t l = 0; l < k; ++l) {
        const Long sine = cross(normals[k], normals[l]);
        const long double angle =
            std::atan2(std::sqrt(dot(sine, sine)), -dot(normals[k], normals[l]));
        smallest = std::min(smallest, angle * 180 / std::acos(-1.0L));
      }
    return static_cast<double>(smallest);
  }
  // Turns the cells that are negative.
  void makePositive() {
    for (size_t c = 0; c < cells.size(); ++c)
      if (signOf(c) < 0) std::swap(cells[c].t[0], cells[c].t[1]);
  }
  StarShape shape(double degrees = 10) const {
    return starShape(x.data(), values.data(), static_cast<int>(kStride), scale, cells.data(),
                     cells.size(), ThinAngle(degrees));
  }
  StarShape barredShape(double degrees) const {
    ThinAngle angle(degrees);
    angle.barred = true;
    return starShape(x.data(), values.data(), static_cast<int>(kStride), scale, cells.data(),
                     cells.size(), angle);
  }
  // With one or two smaller angles; 90: none.
  StarShape shapeOf(double degrees, double middle, double inner) const {
    ThinAngle angle(degrees);
    if (middle < degrees) angle.middle_cos2 = ThinAngle(middle).cos2;
    angle.inner_cos2 = ThinAngle(inner).cos2;
    return starShape(x.data(), values.data(), static_cast<int>(kStride), scale, cells.data(),
                     cells.size(), angle);
  }
  StarShape plainShape(double degrees = 10) const {
    return starShapeOf(x.data(), values.data(), static_cast<int>(kStride), scale, cells.data(),
                       cells.size(), ThinAngle(degrees));
  }

 private:
  using Long = std::array<long double, 3>;
  static Long edge(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    Long e;
    for (size_t i = 0; i < 3; ++i) e[i] = static_cast<long double>(b[i]) - a[i];
    return e;
  }
  static Long cross(const Long& a, const Long& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static long double dot(const Long& a, const Long& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
};

// Where thin cells are barred the star is told to be as good as its worst cell, and which that is.
template <class S>
void expectTruthWhereBarred(const Fan<S>& fan, double degrees) {
  const StarShape plain = fan.shape(degrees), barred = fan.barredShape(degrees);
  EXPECT_EQ(barred.positive, plain.positive && plain.thin == 0) << degrees;
  EXPECT_EQ(barred.thin, 0u);
  if (barred.positive) return;
  Fan<S> alone = fan;
  alone.cells = {fan.cells[barred.turned]};
  EXPECT_TRUE(!alone.shape(degrees).positive || alone.shape(degrees).thin == 1) << degrees;
}

// Below smaller angles are as many as where each is the only one.
template <class S>
void expectTruthOfSmaller(const Fan<S>& fan, double degrees) {
  const StarShape one = fan.shape(degrees), inner = fan.shape(degrees / 3);
  EXPECT_EQ(one.middle, 0u);
  EXPECT_EQ(one.inner, 0u);
  const StarShape two = fan.shapeOf(degrees, 90, degrees / 3);
  EXPECT_EQ(two.thin, one.thin);
  EXPECT_EQ(two.middle, 0u);
  EXPECT_EQ(two.inner, inner.thin) << degrees;
  const StarShape three = fan.shapeOf(degrees, degrees / 2, degrees / 3);
  EXPECT_EQ(three.thin, one.thin);
  EXPECT_EQ(three.middle, fan.shape(degrees / 2).thin) << degrees;
  EXPECT_EQ(three.inner, inner.thin) << degrees;
}

// A cell within a hair of the angle may count or not.
template <class S>
void expectTruth(const Fan<S>& fan) {
  bool positive = true;
  for (size_t c = 0; c < fan.cells.size(); ++c) positive = positive && fan.signOf(c) > 0;
  for (const double degrees : {0.1, 1.0, 10.0, 40.0, 70.0}) {
    size_t thin = 0, hair = 0;
    for (size_t c = 0; c < fan.cells.size() && positive; ++c) {
      const double angle = fan.smallestAngle(c);
      thin += angle < degrees;
      hair += std::fabs(angle - degrees) < 1e-6 * degrees;
    }
    const StarShape got = fan.shape(degrees);
    EXPECT_EQ(got.positive, positive);
    EXPECT_LE(got.thin, thin + hair) << degrees;
    EXPECT_GE(got.thin + hair, thin) << degrees;
    expectTruthWhereBarred(fan, degrees);
    if (degrees == 40) expectTruthOfSmaller(fan, degrees);
  }
}

template <class S>
Fan<S> randomFan(Random& r, size_t count, double size, double offset) {
  Fan<S> fan;
  for (double& c : fan.x) c = static_cast<double>(static_cast<S>(offset + random(r, size)));
  for (size_t k = 0; k < count; ++k) {
    std::array<std::array<double, 3>, 3> t;
    for (auto& p : t)
      for (double& c : p) c = offset + random(r, size);
    fan.add(t);
  }
  return fan;
}

// Sometimes all right, sometimes one of up to 40 cells wrong at any place among the others.
template <class S>
void expectTruthOfRandomFans() {
  Random r(1);
  int wrong = 0;
  for (int k = 0; k < rounds(); ++k) {
    Fan<S> fan = randomFan<S>(r, 1 + r.below(40), 1, k % 3 ? 0 : 100);
    fan.makePositive();
    expectTruth(fan);
    if (k % 2) continue;
    StarCell& turned = fan.cells[r.below(static_cast<uint32_t>(fan.cells.size()))];
    std::swap(turned.t[1], turned.t[2]);
    EXPECT_FALSE(fan.shape().positive);
    ++wrong;
  }
  EXPECT_GT(wrong, 0);
}
TEST(StarShape, IsThatOfAllItsCells) {
  expectTruthOfRandomFans<float>();
  expectTruthOfRandomFans<double>();
}

// A lattice: volumes are integers, and every tenth is exactly 0, which is not positive.
TEST(StarShape, IsExactOnALattice) {
  Random r(2);
  int flat = 0, whole = 0;
  for (int k = 0; k < 10 * rounds(); ++k) {
    Fan<float> fan;
    for (double& c : fan.x) c = static_cast<int>(r.below(5)) - 2;
    const size_t count = 1 + r.below(6);
    for (size_t cell = 0; cell < count; ++cell) {
      std::array<std::array<double, 3>, 3> t;
      for (auto& p : t)
        for (double& c : p) c = static_cast<int>(r.below(5)) - 2;
      fan.add(t);
    }
    fan.makePositive();
    bool any_flat = false;
    for (size_t c = 0; c < count; ++c) any_flat = any_flat || fan.signOf(c) == 0;
    ++(any_flat ? flat : whole);
    expectTruth(fan);
  }
  EXPECT_GT(flat, rounds());
  EXPECT_GT(whole, rounds());
}

// The centre in the plane of a triangle but for rounding: what the filter cannot decide.
TEST(StarShape, IsExactForNearlyFlatCells) {
  Random r(3);
  int positive = 0, other = 0;
  for (int k = 0; k < 4 * rounds(); ++k) {
    Fan<double> fan = randomFan<double>(r, 5, 1, k % 2 ? 1e5 : 0);
    fan.makePositive();
    const auto a = fan.corner(2, 0), b = fan.corner(2, 1), c = fan.corner(2, 2);
    const double s = random(r, 0.5), t = random(r, 0.5);
    for (size_t i = 0; i < 3; ++i) fan.x[i] = a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i]);
    for (size_t cell = 0; cell < 5; ++cell)  // the others stand right
      if (cell != 2 && fan.signOf(cell) < 0) std::swap(fan.cells[cell].t[0], fan.cells[cell].t[1]);
    ++(fan.signOf(2) > 0 ? positive : other);
    EXPECT_EQ(fan.shape().positive, fan.signOf(2) > 0);
  }
  EXPECT_GT(positive, rounds() / 2);
  EXPECT_GT(other, rounds() / 2);
}

// Powers of two change nothing, up to where a float64 ends; in the careful path, too.
TEST(StarShape, DoesNotDependOnTheUnit) {
  Random r(4);
  for (int k = 0; k < rounds() / 4; ++k) {
    Fan<double> fan = randomFan<double>(r, 7, 1, 0);
    for (double& v : fan.values) v = std::isnan(v) ? v : std::round(1000 * v);
    for (double& c : fan.x) c = std::round(1000 * c);
    fan.makePositive();
    const StarShape shape = fan.shape();
    for (int exponent : {-1060, -500, -160, -150, -140, -20, 20, 140, 160, 170, 500, 1000}) {
      Fan<double> scaled = fan;
      for (double& v : scaled.values) v = std::ldexp(v, exponent);
      for (double& c : scaled.x) c = std::ldexp(c, exponent);
      const StarShape other = scaled.shape();
      EXPECT_EQ(other.positive, shape.positive) << "times 2^" << exponent;
      EXPECT_EQ(other.thin, shape.thin) << "times 2^" << exponent;
    }
  }
}

// The angles of the regular cell are acos(1/3), 70.53 degrees; of the corner of a cube 54.74 along
// its far face; of a sixth of a cube 45 along its diagonal.
TEST(StarShape, IsKnownForSimpleCells) {
  const std::array<std::array<double, 3>, 3> triangles[3] = {
      {{{1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}},  // seen from (1, 1, 1)
      {{{2, 1, 1}, {1, 2, 1}, {1, 1, 2}}},
      {{{2, 1, 1}, {2, 2, 1}, {2, 2, 2}}}};
  const double angles[3] = {70.528779, 54.735610, 45};
  for (size_t k = 0; k < 3; ++k) {
    Fan<float> fan;
    fan.x = {1, 1, 1};
    fan.add(triangles[k]);
    fan.makePositive();
    EXPECT_NEAR(fan.smallestAngle(0), angles[k], 1e-6);
    if (k > 0) {  // no cell has only larger angles than the regular one
      EXPECT_EQ(fan.shape(angles[k] + 1e-5).thin, 1u);
    }
    EXPECT_EQ(fan.shape(angles[k] - 1e-5).thin, 0u);
    EXPECT_TRUE(fan.shape().positive);
  }
}

TEST(StarShape, OfNoCellsIsPositive) {
  const Fan<float> none = {{0, 0, 0}, {0, 0, 0, 0}, {}};
  EXPECT_TRUE(none.shape().positive);
  EXPECT_EQ(none.shape().thin, 0u);
}

// A needle beside which its triangle is huge: thin, however far its numbers are apart.
TEST(StarShape, IsThinForNeedlesOfAnyLength) {
  for (double length : {1e3, 1e30, 1e55, 1e70, 1e80, 1e100, 1e120, 1e150}) {
    Fan<double> fan;
    fan.x = {0, 0, 0};
    fan.add({{{1, 0, 0}, {0, length, 0}, {0, 0, length}}});
    EXPECT_TRUE(fan.shape().positive) << length;
    EXPECT_EQ(fan.shape().thin, 1u) << length;
  }
}

// Slivers, wedges, caps, needles of all degrees, many of them thin.
TEST(StarShape, FindsThinCellsOfEveryKind) {
  Random r(8);
  for (int k = 0; k < rounds(); ++k) {
    Fan<double> fan;
    fan.x = {0, 0, 0};
    for (int cell = 0; cell < 9; ++cell) {
      const double h = std::exp2(-static_cast<double>(r.below(12)));
      const double a = random(r, 1), b = random(r, 1), c = random(r, 1), d = random(r, 1);
      switch (r.below(4)) {
        case 0:  // flat: all four near a plane
          fan.add({{{1, 0, h * a}, {0, 1, h * b}, {c, d, h}}});
          break;
        case 1:  // a short edge
          fan.add({{{h * a, h * b, h * c}, {1, 0.2, d}, {0.1, 1, 0.3}}});
          break;
        case 2:  // two short edges, far from each other
          fan.add({{{h * a, h, h * b}, {1, h * c, h * d}, {1, -h, 2 * h}}});
          break;
        default:  // a vertex near the middle of a face
          fan.add({{{1 + a, h, 0}, {-1, 1 + b, h}, {-1, -1 + c, -h}}});
      }
    }
    fan.makePositive();
    expectTruth(fan);
  }
}

// starShape takes the build for this processor; starShapeOf is the plain one, built here.
template <class S>
void expectSameBits(const Fan<S>& fan) {
  const StarShape a = fan.shape(), b = fan.plainShape();
  EXPECT_EQ(a.positive, b.positive);
  EXPECT_EQ(a.thin, b.thin);
}
TEST(StarShape, IsTheSameFromEveryBuild) {
  Random r(5);
  for (int k = 0; k < rounds(); ++k)
    for (double size : {1.0, 1e-3, 0x1p100}) {
      Fan<float> single = randomFan<float>(r, 1 + r.below(30), size, k % 2 ? 0 : 10 * size);
      if (k % 3) single.makePositive();
      expectSameBits(single);
      Fan<double> fan = randomFan<double>(r, 1 + r.below(30), size * size, 0);
      if (k % 3) fan.makePositive();
      expectSameBits(fan);
    }
}

// The cells of a random fan and a place: the one with the largest of the smallest coordinates.
template <class S>
void expectNearestCell() {
  Random r(9);
  int inside = 0;
  for (int k = 0; k < rounds(); ++k) {
    Fan<S> fan = randomFan<S>(r, r.below(30), 1, k % 3 ? 0 : 10);
    fan.makePositive();
    const uint32_t centre = fan.addCentre();
    std::array<double, 3> x = fan.x;
    for (double& c : x) c = static_cast<double>(static_cast<S>(c + random(r, 0.1)));
    const auto found = nearestCell(x.data(), fan.values.data(), static_cast<int>(kStride),
                                   fan.scale, centre, fan.cells.data(), fan.cells.size());
    const auto plain = nearestCellOf(x.data(), fan.values.data(), static_cast<int>(kStride),
                                     fan.scale, centre, fan.cells.data(), fan.cells.size());
    EXPECT_EQ(found.place, plain.place);
    EXPECT_EQ(found.least, plain.least);
    double best = -1e301;
    for (size_t c = 0; c < fan.cells.size(); ++c) best = std::max(best, fan.leastCoordinate(c, x));
    const double tolerance = 1e-3 * (1 + std::fabs(best));  // of S, in thin cells
    EXPECT_NEAR(found.least, best, tolerance);
    inside += best > 0;
    if (fan.cells.empty()) continue;
    ASSERT_LT(found.place, fan.cells.size());
    EXPECT_NEAR(fan.leastCoordinate(found.place, x), best, tolerance);
  }
  EXPECT_GT(inside, 0);
}
TEST(NearestCell, HasTheLargestLeastCoordinate) {
  expectNearestCell<float>();
  expectNearestCell<double>();
}

}  // namespace
}  // namespace test
}  // namespace tetstream
