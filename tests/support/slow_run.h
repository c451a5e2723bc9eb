// tests/support: what is left out where a run is many times slower than usual, under memcheck for
// one: TETSTREAM_SLOW is set.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace tetstream::test {

inline bool slowRun() {
  return std::getenv("TETSTREAM_SLOW") != nullptr;
}

// Of many alike cases a slow run takes one in so many, any other each: `i += oneIn(7)`.
inline size_t oneIn(size_t so_many) {
  return slowRun() ? so_many : 1;
}

}  // namespace tetstream::test
