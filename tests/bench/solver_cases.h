// What solvers are compared on: edges of meshes with the quadrics of their ends, as a run has them
// and exactly. Depends on quadric.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels.h"

namespace tetstream::bench {

// A type with about 34 digits, or the longest there is.
#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Wide;
#else
typedef long double Wide;
#endif

constexpr int kN = 4;                       // position and one field
constexpr int kPacked = kN * (kN + 1) / 2;  // in either layout
using WideVector = std::array<Wide, kN>;

struct Mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<double> field;
  std::vector<std::array<uint32_t, 4>> cells;
  double field_range = 0;  // 0: that of the values
};

// smooth: a field with curvature; homogeneous: constant here, not elsewhere; linear;
// one-dimensional: curved in one direction; thin: smooth on cells flat at 1:1000. Throws where
// there is no such one.
Mesh syntheticMesh(const std::string& name);

// Where a mesh lies, in extents from the origin, and in which unit. Normalised: in units of a mean
// edge, as the library has it; otherwise in those of the mesh, the field brought to its extent.
struct Place {
  std::string name;
  double offset = 0, unit = 1;
  bool normalised = true;
};

// Q(m + z) = at_middle - 2 r z + z^T A z, exactly, for the coordinates rounded to S; m is the
// middle of the two ends. z is normalised.
struct ExactQuadric {
  std::array<Wide, kPacked> a;
  WideVector r;
  Wide at_middle;
  WideVector half;  // of the edge
  WideVector
      nearest;  // the minimizer nearest to m: curvatures below 1e-12 of the largest count as 0
  Wide least;   // Q there

  Wide at(const WideVector& z) const;
  Wide betterEnd() const;
};

template <class S>
struct EdgeCase {
  // (A, p, e): A and e as the kernels have them, p the ends, in the mesh's units.
  S q1[kPacked + 1], q2[kPacked + 1], x1[kN], x2[kN];
  // (A, b, c) of the two together, about the origin, normalised; and their middle there.
  S a[kPacked], b[kN], c, middle[kN];
  ExactQuadric exact;
};

template <class S>
struct CaseSet {
  S scale[kN];
  std::vector<EdgeCase<S>> edges;
  size_t left_out =
      0;  // some cell round them is flat in these coordinates, or one end is the other
};

// `count` edges at random, whose ends stand for `merged` vertices each.
template <class S>
CaseSet<S> casesOf(const Mesh& mesh, const Place& place, size_t count, size_t merged);

}  // namespace tetstream::bench
