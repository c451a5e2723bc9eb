// measure: what a comparison is asked for. Depends on nothing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

namespace tetstream {

struct CompareOptions {
  int64_t samples = 0;           // 0: exact integrals
  int64_t boundary_samples = 0;  // 0: as below
  std::string cut = "none";      // of the picture
  std::string box;               // the part that is compared (part_box.h)

  // Points by which each boundary's distance is measured; its vertices are looked at besides.
  int64_t surfaceSamples() const {
    constexpr int64_t kMost = 200000;
    if (boundary_samples > 0) return boundary_samples;
    return samples > 0 ? std::min(samples, kMost) : kMost;
  }
};

}  // namespace tetstream
