// simplify: a list of ids cut in two across the longest side of their box, again and again. Depends
// on nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetstream {

// `share` of a piece, below 1, lies before its cut: 0.5 cuts at the median. A piece of `most` ids
// or fewer is a leaf.
struct CutRule {
  double share;
  size_t most;
};

// at(id, axis): a coordinate, in the type in which sides are compared. Of equal sides the first:
// what is equal in float may not be in double.
template <class At>
int longestSide(const uint32_t* ids, size_t count, const At& at) {
  using Number = decltype(at(0u, 0));
  Number low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<Number>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<Number>::infinity());
  for (size_t i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a) {
      const Number x = at(ids[i], a);
      low[a] = std::min(low[a], x);
      high[a] = std::max(high[a], x);
    }
  int longest = 0;
  for (int a = 1; a < 3; ++a)
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  return longest;
}

// Reorders ids[begin, end) so that each leaf is a piece of it, its ids ascending, and calls
// leaf(begin, end) for one after the other. The order of the ids before makes no difference.
template <class At, class Leaf>
void medianCut(uint32_t* ids, size_t begin, size_t end, const CutRule& rule, const At& at,
               const Leaf& leaf) {
  if (end - begin <= rule.most) {
    std::sort(ids + begin, ids + end);
    leaf(begin, end);
    return;
  }
  const int axis = longestSide(ids + begin, end - begin, at);
  const size_t middle = begin + static_cast<size_t>(rule.share * static_cast<double>(end - begin));
  std::nth_element(ids + begin, ids + middle, ids + end, [&at, axis](uint32_t a, uint32_t b) {
    const auto x = at(a, axis), y = at(b, axis);
    return x != y ? x < y : a < b;
  });
  medianCut(ids, begin, middle, rule, at, leaf);
  medianCut(ids, middle, end, rule, at, leaf);
}

}  // namespace tetstream
