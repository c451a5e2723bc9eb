// quadric: the bodies of the kernels. Compiled once per instruction set by kernels_*.cpp, each in
// an anonymous namespace, so that no function of one build is ever linked into another. For the
// same reason nothing here calls the standard library. Sums run in a fixed order and nothing is
// contracted: all builds give the same numbers.
#include "batches.inl"
#include "distances.inl"
#include "minimum.inl"

namespace tetstream {
namespace {

template <class S, int N>
constexpr QuadricKernels<S> kFieldKernels = {
    addCellField<S, N>,       addCellFields<S, N>,        addFacePlane<S, N>,
    rescaleFields<S, N>,      minimizeEdge<Fields, S, N>, solveEdge<Fields, S, N>,
    solveEdges<Fields, S, N>, edgeErrors<Fields, S, N>,   errorAt<Fields, S, N>,
    followFields<S, N>,       spaceOfFields<S, N>};
template <class S, int N>
constexpr QuadricKernels<S> kFullKernels = {
    addCellDistance<S, N>,    addNoCells<S>,         addFaceDistance<S, N>,  rescaleFull<S, N>,
    minimizeEdge<Full, S, N>, solveEdge<Full, S, N>, solveEdges<Full, S, N>, edgeErrors<Full, S, N>,
    errorAt<Full, S, N>,      followNothing<S>,      spaceOfFull<S>};

template <class S>
const QuadricKernels<S>& fieldKernelsFor(int n) {
  switch (n) {
    case 3:
      return kFieldKernels<S, 3>;
    case 4:
      return kFieldKernels<S, 4>;
    case 5:
      return kFieldKernels<S, 5>;
    case 6:
      return kFieldKernels<S, 6>;
    case 7:
      return kFieldKernels<S, 7>;
    case 9:
      return kFieldKernels<S, 9>;
    case 10:
      return kFieldKernels<S, 10>;
    case 12:
      return kFieldKernels<S, 12>;
    default:
      return kFieldKernels<S, 0>;
  }
}

// The general ones, but for one field: full quadrics are for comparisons with others' work.
template <class S>
const QuadricKernels<S>& fullKernelsFor(int n) {
  return n == 4 ? kFullKernels<S, 4> : kFullKernels<S, 0>;
}

template <class S>
const QuadricKernels<S>& kernelsFor(QuadricLayout layout, int n) {
  return layout == QuadricLayout::kFull ? fullKernelsFor<S>(n) : fieldKernelsFor<S>(n);
}

}  // namespace
}  // namespace tetstream
