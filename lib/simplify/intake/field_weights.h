// simplify/intake: how much each of several fields should count beside the others. Depends on
// core.h.
//
// What is added up are squared errors in units of the fields' ranges. A field that is smooth adds
// little: beside a rough one nobody looks after it, and it loses many times the error that it would
// have alone. With weights of 1 / error^2, of the error that each has alone, all would lose alike,
// and the product of their errors would be least; but the rough one is the one with the largest
// error, and gives most of what it has. Weights are 1 / error, half way between the two.
//   What taking a vertex out adds to a field's squared error, c, is measured at a sample of
// vertices. With the law of balance.h, all that is left alone costs the same, and the squared error
// of a given number of vertices is in proportion to the 7/3rd power of the mean of c^(3/7).
#pragma once

#include <vector>

#include "core.h"

namespace tetstream {

// Times the weight of each field of the schema: powers of two from 1, for the field with the
// largest error, to kLargestFieldWeight; 1 where it is not measured, and where its error is too
// small to be told, or where the mesh is. From the first cells of the window, those before `end`,
// and the ranges: of each component with the extent in front, as many as the metric's dimensions.
constexpr double kLargestFieldWeight = 256;
template <class S>
std::vector<double> weightsOfFields(const Core<S>& core, uint32_t end,
                                    const std::vector<double>& range);

}  // namespace tetstream
