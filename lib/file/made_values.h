// file: values of an array that no file has in one place: parts after each other, numbers that
// follow a rule, columns side by side. Depends on values.h.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "values.h"

namespace tetstream {

using OpenValues = std::function<std::unique_ptr<Values>()>;
using OpenArray = std::function<std::unique_ptr<Values>(uint64_t count)>;  // as MeshArray has it

struct ValuesPart {
  uint64_t count = 0;
  OpenValues open;  // its values from 0 on
};

// One part after the other. Only the one that was read last is open.
std::unique_ptr<Values> openParts(std::vector<ValuesPart> parts);
// `values` plus `shift`; integers only.
std::unique_ptr<Values> openShifted(std::unique_ptr<Values> values, int64_t shift);
// first, first + step, ...
std::unique_ptr<Values> openSequence(int64_t first, int64_t step);
// Value i of each, for each i. Read in whole rows.
std::unique_ptr<Values> openColumns(std::vector<std::unique_ptr<Values>> columns);

}  // namespace tetstream
