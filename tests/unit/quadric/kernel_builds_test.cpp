// The kernels give the same bits from every build of them.
#include <gtest/gtest.h>
#include <cstring>

#include "edge_testing.h"
#include "kernel_builds.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

template <class S>
void expectSameBits(const QuadricKernels<S>& a, const QuadricKernels<S>& b, QuadricLayout layout,
                    int n, Random& r) {
  const auto bytes = [](const std::vector<S>& v) { return v.size() * sizeof(S); };
  Corners<S> cell(r, layout, 4, n, false), other = cell, face(r, layout, 3, n, false),
                                           other_face = face;
  const auto addAll = [n](const QuadricKernels<S>& k, Corners<S>& c, Corners<S>& f) {
    c.template addWith<4>(
        [&](const S* const* x, S* const* q) { k.addCell(x, c.scale.data(), n, kShapeWeight, q); });
    f.template addWith<3>(
        [&](const S* const* x, S* const* q) { k.addFace(x, f.scale.data(), n, 300, 0.5, q); });
  };
  addAll(a, cell, face);
  addAll(b, other, other_face);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_EQ(
        0, std::memcmp(cell.quadrics[i].data(), other.quadrics[i].data(), bytes(cell.quadrics[i])));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(0, std::memcmp(face.quadrics[i].data(), other_face.quadrics[i].data(),
                             bytes(face.quadrics[i])));
  Edge<S> e(r, layout, static_cast<size_t>(n), 0.01, static_cast<size_t>(n));
  std::vector<S> z1(static_cast<size_t>(n)), z2(static_cast<size_t>(n));
  const auto minimum = [&](const QuadricKernels<S>& k, std::vector<S>& z) {
    return k.minimizeEdge(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                          z.data());
  };
  EXPECT_EQ(minimum(a, z1), minimum(b, z2));
  EXPECT_EQ(0, std::memcmp(z1.data(), z2.data(), bytes(z1)));
  const auto errorOf = [&](const QuadricKernels<S>& k) {
    return k.errorAt(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                     e.q1.data());
  };
  EXPECT_EQ(errorOf(a), errorOf(b));
  const auto solved = [&](const QuadricKernels<S>& k, std::vector<S>& z) {
    return k.solveEdge(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                       z.data());
  };
  EXPECT_EQ(solved(a, z1), solved(b, z2));
  EXPECT_EQ(0, std::memcmp(z1.data(), z2.data(), bytes(z1)));
  a.followStep(e.q1.data(), e.q2.data(), n, e.x1.data(), z1.data());
  b.followStep(e.q1.data(), e.q2.data(), n, e.x1.data(), z2.data());
  EXPECT_EQ(0, std::memcmp(z1.data(), z2.data(), bytes(z1)));
  std::vector<S> form(6), other_form(6);
  a.spaceForm(e.q1.data(), e.q2.data(), n, form.data());
  b.spaceForm(e.q1.data(), e.q2.data(), n, other_form.data());
  EXPECT_EQ(0, std::memcmp(form.data(), other_form.data(), bytes(form)));
  if (n > 20) return;
  const Table<S> table(r, layout, n, 12);
  const uint32_t others[11] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<S> errors(16), other_errors(16);
  a.edgeErrors(table.view(), 0, others, 11, table.scale.data(), n, errors.data());
  b.edgeErrors(table.view(), 0, others, 11, table.scale.data(), n, other_errors.data());
  EXPECT_EQ(0, std::memcmp(errors.data(), other_errors.data(), bytes(errors)));
}

// quadricKernels gives the build for this processor.
TEST(QuadricKernels, GiveTheSameBitsFromEveryBuild) {
  Random r(14);
  for (QuadricLayout layout : kLayouts)
    for (int n : kDimensions)
      for (int round = 0; round < (slowRun() ? 1 : 50); ++round) {
        expectSameBits(plainKernelsFloat(layout, n), quadricKernels<float>(layout, n), layout, n,
                       r);
        expectSameBits(plainKernelsDouble(layout, n), quadricKernels<double>(layout, n), layout, n,
                       r);
      }
  RecordProperty("build", kernelBuild());
}

}  // namespace
}  // namespace tetstream::test
