// run: how much of each part of a stream is left, by bricks of a sample. Depends on nothing.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tetstream {

constexpr size_t kStreamParts = 64;

// Of a brick: its cells by when they came, its vertices that are on no cut, and how many are left.
struct BrickLeft {
  std::array<double, kStreamParts> cells = {};
  double inside = 0, left = 0;
};

// For each part of the stream, of as many cells each, the share of it that should be left, so that
// `ratio` of all is; or nothing where too few bricks tell of it. One part, the whole stream, where
// bricks do not tell what is left of others any better than all of them together: what they differ
// by then is within the parts, or chance, and to follow it is worse than to leave the same of all.
std::vector<double> sampledRates(const std::vector<BrickLeft>& bricks, double ratio);

}  // namespace tetstream
