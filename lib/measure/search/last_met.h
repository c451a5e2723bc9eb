// measure/search: whether a vertex was met a short while ago. Depends on base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "memory.h"

namespace tetstream {

// Of vertices that many faces or cells share, which come one soon after the other: one that is
// forgotten is rare, and is only taken once more. A set of all of them would grow with the mesh.
class LastMet {
 public:
  // `bytes` that the work beside it may take: a small part is enough.
  LastMet(Account& account, size_t bytes)
      : numbers_(account,
                 std::bit_floor(std::clamp(bytes / kPart, kLeast, kMost)) / sizeof(uint64_t)) {
    std::fill_n(numbers_.data(), numbers_.size(), uint64_t{0});
  }
  // By its number, which is as good as random. Whether it was known; it is now.
  bool meet(uint64_t number) {
    uint64_t& last = numbers_[number & (numbers_.size() - 1)];
    const bool was_known = last == number;
    last = number;
    return was_known;
  }

 private:
  static constexpr size_t kPart = 16, kLeast = size_t{1} << 13, kMost = size_t{1} << 22;

  Array<uint64_t> numbers_;
};

}  // namespace tetstream
