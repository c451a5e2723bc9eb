// What the two parts of `structures` share: a stream kept in memory, and times of several rounds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <functional>
#include <utility>
#include <vector>

#include "schema.h"

namespace tetstream::bench {

// The events of a stream. Vertices are introduced where a cell first needs them.
struct Recording {
  Schema schema;
  uint64_t vertices = 0;
  std::vector<float> positions;
  std::vector<uint32_t> cells;                         // [][4] ranks
  std::vector<uint8_t> last_uses;                      // as in BatchView
  std::vector<std::pair<size_t, uint32_t>> finalized;  // after so many cells: that rank
  size_t cellCount() const { return last_uses.size(); }
};

inline double processorNs() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

template <class Action>
double nsOf(Action action) {
  const double start = processorNs();
  action();
  return processorNs() - start;
}

inline double median(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return (of[(of.size() - 1) / 2] + of[of.size() / 2]) / 2;
}

void compareMaps(const Recording& stream, int rounds);
void compareStars(const Recording& stream, size_t window, int rounds);

}  // namespace tetstream::bench
