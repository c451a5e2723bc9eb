// simplify/intake: where a boundary folds back upon itself. Depends on core.h.
//
// Round a crack, a slit or a baffle without thickness, and at a thin edge of the body, the surface
// runs back beside itself: both sides lie nearly in one plane, their quadrics do not tell where it
// ends, and the rim would recede. So the edges of such rims are curves (sheets.h), held by their
// quadrics alone: a rough surface has folds that end and branch, and locks nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "core.h"

namespace tetstream {

// The cosine of the angle between the directions from the edge va into the faces vab and vac: -1 in
// a plane; NaN where a face has no area.
template <class S>
double bendAt(const Window<S>& window, uint32_t v, uint32_t a, uint32_t b, uint32_t c);

// Of the boundary's faces, by that cosine.
constexpr bool isFold(double bend) {
  return bend > 0.866;  // by 150 degrees and more
}
// Whether any two of the boundary's faces at v do, of which these are the edges opposite v as
// (a << 32 | b).
template <class S>
bool hasFold(const Window<S>& window, uint32_t v, const std::vector<uint64_t>& faces);

}  // namespace tetstream
