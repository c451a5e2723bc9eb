// simplify/state: why a target was missed. Depends on core.h.
#pragma once

#include <string>

#include "core.h"

namespace tetstream {

// Once the report's counts are those of the whole run.
template <class S>
std::string missInWords(const Core<S>& core);

}  // namespace tetstream
