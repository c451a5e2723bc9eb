// simplify: a list of ids cut in two across the longest side of their box, again and again. Depends
// on nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tetstream {

// `share` of a piece, below 1, lies before its cut: 0.5 cuts at the median. A piece of `most` ids
// or fewer is a leaf.
struct CutRule {
  double share;
  size_t most;
};

// at(id, axis): a coordinate, in the type in which sides are compared. The ids stay ascending in
// every piece, so that nothing is sorted: the place of a cut is found by counting.
template <class At>
class MedianCut {
 public:
  MedianCut(uint32_t* ids, const CutRule& rule, const At& at) : ids_(ids), rule_(rule), at_(at) {}

  // Reorders ids[begin, end), ascending, so that each leaf is a piece of it, its ids ascending, and
  // calls leaf(begin, end) for one after the other.
  template <class Leaf>
  void cut(size_t begin, size_t end, const Leaf& leaf) {
    if (end - begin <= rule_.most) {
      leaf(begin, end);
      return;
    }
    const Side side = longestSide(begin, end);
    const size_t middle =
        begin + static_cast<size_t>(rule_.share * static_cast<double>(end - begin));
    partition(begin, end, side.axis, placeAt(begin, middle, end, side));
    cut(begin, middle, leaf);
    cut(middle, end, leaf);
  }

  // The same in slices across the longest side of the whole: `count` of one size, or by half of it
  // farther on, one more of which the first and the last have half.
  template <class Leaf>
  void slice(size_t begin, size_t end, size_t count, bool half_on, const Leaf& leaf) {
    const Side side = longestSide(begin, end);
    const double first = static_cast<double>(begin), size = static_cast<double>(end - begin);
    for (size_t i = 0; i < count; ++i) {
      const double share =
          (static_cast<double>(i) + (half_on ? 0.5 : 1)) / static_cast<double>(count);
      const auto middle = static_cast<size_t>(first + share * size);
      if (middle == begin) continue;
      if (middle == end) break;
      partition(begin, end, side.axis, placeAt(begin, middle, end, side));
      leaf(begin, middle);
      begin = middle;
    }
    leaf(begin, end);
  }

 private:
  using Number = decltype(std::declval<At>()(0u, 0));
  struct Side {
    int axis;
    Number low, high;
  };
  // A coordinate, then an id where coordinates are equal.
  using Place = std::pair<Number, uint32_t>;

  // Of equal sides the first: what is equal in float may not be in double.
  Side longestSide(size_t begin, size_t end) const {
    Number low[3], high[3];
    std::fill_n(low, 3, std::numeric_limits<Number>::infinity());
    std::fill_n(high, 3, -std::numeric_limits<Number>::infinity());
    for (size_t i = begin; i < end; ++i)
      for (int a = 0; a < 3; ++a) {
        const Number x = at_(ids_[i], a);
        low[a] = std::min(low[a], x);
        high[a] = std::max(high[a], x);
      }
    int longest = 0;
    for (int a = 1; a < 3; ++a)
      if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
    return {longest, low[longest], high[longest]};
  }

  // The place of the id that comes at `middle` when all are in order.
  Place placeAt(size_t begin, size_t middle, size_t end, const Side& side) {
    // Halves, since the difference of finite numbers may be none.
    const Number width = side.high / 2 - side.low / 2;
    const Number bins_per_unit =
        width > 0 ? std::min(kBins / width, std::numeric_limits<Number>::max()) : 0;
    const auto bin_of = [&](Number x) {  // rises with x
      return std::min(static_cast<size_t>((x / 2 - side.low / 2) * bins_per_unit), kBins - 1);
    };
    std::array<uint32_t, kBins> count{};
    for (size_t i = begin; i < end; ++i) ++count[bin_of(at_(ids_[i], side.axis))];
    size_t bin = 0, before = begin;
    for (; before + count[bin] <= middle; ++bin) before += count[bin];
    in_bin_.clear();
    for (size_t i = begin; i < end; ++i) {
      const Number x = at_(ids_[i], side.axis);
      if (bin_of(x) == bin) in_bin_.push_back({x, ids_[i]});
    }
    const auto place = in_bin_.begin() + static_cast<std::ptrdiff_t>(middle - before);
    std::nth_element(in_bin_.begin(), place, in_bin_.end());
    return *place;
  }

  void partition(size_t begin, size_t end, int axis, const Place& first_behind) {
    behind_.clear();
    size_t kept = begin;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t id = ids_[i];
      if (Place(at_(id, axis), id) < first_behind)
        ids_[kept++] = id;
      else
        behind_.push_back(id);
    }
    std::copy(behind_.begin(), behind_.end(), ids_ + kept);
  }

  static constexpr size_t kBins = 256;
  uint32_t* ids_;
  CutRule rule_;
  const At& at_;
  std::vector<Place> in_bin_;
  std::vector<uint32_t> behind_;
};

}  // namespace tetstream
