// file: how many rows are copied, checked or converted in one go. Depends on nothing.
#pragma once

#include <cstddef>

namespace tetstream {

constexpr size_t kRowsAtOnce = 1024;

}  // namespace tetstream
