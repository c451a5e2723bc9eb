// simplify/state: the quadrics of sheets and of the curves in them. Depends on core.h.
#pragma once

#include "core.h"

namespace tetstream {

// A face of a sheet: on the boundary, between regions, or labelled inside one.
enum class SheetFace : uint8_t { kOuter, kInterface, kInner };

// A face of a sheet adds its quadric to the rows of its three vertices.
template <class S>
void addFaceQuadric(const Core<S>& core, const S* const x[3], SheetFace kind, S* const q[3]);
// The same without what it has for the field beyond it.
template <class S>
void addFaceShape(const Core<S>& core, const S* const x[3], SheetFace kind, S* const q[3]);
// An edge of a curve adds one to those of its two ends; `inner`: one of a sheet inside a region.
template <class S>
void addCurveQuadric(const Core<S>& core, const S* const x[2], bool inner, S* const q[2]);

}  // namespace tetstream
