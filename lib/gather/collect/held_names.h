// gather/collect: names of arrays as a format can hold them. Depends on stream.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "schema.h"

namespace tetstream {

using HoldName = std::function<std::string(const std::string&)>;
using Tell = std::function<void(const std::string&)>;

// Of each column what `hold` makes of its name, and no two alike: those that stay as they are come
// first, others get '_' behind them. Each that becomes another is told.
std::vector<std::string> heldNames(const std::vector<Column>& columns, const HoldName& hold,
                                   const Tell& tell);
void tellOfName(const std::string& name, const std::string& held, const Tell& tell);

}  // namespace tetstream
