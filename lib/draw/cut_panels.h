// draw: the images of a cut through two meshes. Depends on canvas.h, comparison.h.
#pragma once

#include "canvas.h"
#include "comparison.h"

namespace tetstream {

// What the colours of a panel stand for.
struct Scale {
  double low, high;
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

constexpr Colour kLeftOut{0.74, 0.76, 0.79};  // the original where the simplified mesh is not
constexpr Colour kAdded{0.72, 0.80, 0.92};    // the other way round

// Of the values on the cut, of both meshes; of several components, of their norm.
Scale fieldScale(const CutComparison& cut);
// From 0 to what all but one in two hundred of the places on the cut keep below, in percent of the
// range, rounded up to one digit.
Scale errorScale(const CutComparison& cut, double range);

// The field with thin edges of cells; empty places are white.
Image fieldPanel(const CutComparison& cut, const CutImage& mesh, const Scale& scale);
Image errorPanel(const CutComparison& cut, double range, const Scale& scale);

}  // namespace tetstream
