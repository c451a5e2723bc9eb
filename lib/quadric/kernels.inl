// quadric: the bodies of the kernels. Compiled once per instruction set by kernels_*.cpp, each in
// an anonymous namespace, so that no function of one build is ever linked into another. For the
// same reason nothing here calls the standard library. Sums run in a fixed order and nothing is
// contracted: all builds give the same numbers.
#include "cells.inl"
#include "edges.inl"

namespace tetstream {
namespace {

template <class S, int N>
constexpr QuadricKernels<S> kKernels = {
    addCellField<S, N>,    addCellFields<S, N>, addCellDistance<S, N>, addFacePlane<S, N>,
    addFaceDistance<S, N>, minimizeEdge<S, N>,  solveEdge<S, N>,       solveEdges<S, N>,
    edgeErrors<S, N>,      errorAt<S, N>};
template <class S>
const QuadricKernels<S>& kernelsFor(int n) {
  switch (n) {
    case 3:
      return kKernels<S, 3>;
    case 4:
      return kKernels<S, 4>;
    case 5:
      return kKernels<S, 5>;
    case 6:
      return kKernels<S, 6>;
    case 7:
      return kKernels<S, 7>;
    default:
      return kKernels<S, 0>;
  }
}

}  // namespace
}  // namespace tetstream
