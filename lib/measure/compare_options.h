// measure: what a comparison is asked for. Depends on nothing.
#pragma once

#include <cstdint>
#include <string>

namespace tetstream {

struct CompareOptions {
  int64_t samples = 0;       // 0: exact integrals
  std::string cut = "none";  // of the picture
};

}  // namespace tetstream
