// simplify/tiling: a list of ids cut in two, again and again. Depends on nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tetstream {

// Which side is cut. Where most ids are in a thin layer, as what a stream has just brought, the
// layer is cut across, though the box be longer the other way; else both are the same.
enum class CutSide : uint8_t {
  kLongest,   // of the box
  kSparsest,  // along which those nearest to the cut lie farthest apart: few are beside it
};

// `share` of a piece, below 1, lies before its cut: 0.5 cuts at the median. A piece of `most` ids
// or fewer is a leaf. With `fills` there are as few leaves as can be, all of about one size, and
// the share is that of the leaves.
struct CutRule {
  double share;
  size_t most;
  bool fills = false;
  CutSide side = CutSide::kLongest;

  bool isLeaf(size_t count) const { return count <= most; }
  size_t before(size_t count) const {
    if (!fills) return static_cast<size_t>(share * static_cast<double>(count));
    const size_t leaves = (count - 1) / most + 1;
    const auto first = static_cast<size_t>(std::lround(share * static_cast<double>(leaves)));
    return count * std::clamp<size_t>(first, 1, leaves - 1) / leaves;
  }
  // How many leaves come of a piece of `count` ids.
  size_t leavesOf(size_t count) const {
    return isLeaf(count) ? 1 : leavesOf(before(count)) + leavesOf(count - before(count));
  }
};

// at(id, axis): a coordinate, in the type in which sides are compared. The ids stay ascending in
// every piece, so that nothing is sorted: the place of a cut is found by counting. Pieces that do
// not overlap may be cut by several threads at once.
template <class At>
class MedianCut {
 public:
  MedianCut(uint32_t* ids, size_t count, const CutRule& rule, const At& at)
      : ids_(ids), rule_(rule), at_(at), bins_(count), aside_(count) {}

  // Reorders ids[begin, end), ascending, so that each leaf is a piece of it, its ids ascending, and
  // calls leaf(begin, end) for one after the other.
  template <class Leaf>
  void cut(size_t begin, size_t end, const Leaf& leaf) {
    if (rule_.isLeaf(end - begin)) {
      leaf(begin, end);
      return;
    }
    const size_t middle = cutOnce(begin, end);
    cut(begin, middle, leaf);
    cut(middle, end, leaf);
  }

  // The first of these cuts alone, of what is no leaf; returns where it is.
  size_t cutOnce(size_t begin, size_t end) {
    const size_t middle = begin + rule_.before(end - begin);
    partition(begin, middle, end,
              rule_.side == CutSide::kSparsest ? sparsestSide(begin, middle, end)
                                               : longestSide(begin, end));
    return middle;
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
      partition(begin, middle, end, side);
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

  Side sparsestSide(size_t begin, size_t middle, size_t end) const {
    Number widest = 0;
    int axis = -1;
    for (int a = 0; a < 3; ++a) {
      const Number width = widthAtCut(begin, middle, end, a);
      if (!(width > widest)) continue;
      widest = width;
      axis = a;
    }
    if (axis < 0) return longestSide(begin, end);  // most places are equal
    Side side{axis, at_(ids_[begin], axis), at_(ids_[begin], axis)};
    for (size_t i = begin; i < end; ++i) {
      const Number x = at_(ids_[i], axis);
      side.low = std::min(side.low, x);
      side.high = std::max(side.high, x);
    }
    return side;
  }

  // Half of what the fifth of all that is nearest to the cut takes up, since the difference of
  // finite numbers may be none. As a sample tells, in an order that has nothing to do with how a
  // lattice's points are numbered.
  Number widthAtCut(size_t begin, size_t middle, size_t end, int axis) const {
    constexpr size_t kSample = 256;
    constexpr double kNear = 0.1, kGolden = 0.6180339887498949;
    std::array<Number, kSample> sample;
    const size_t taken = std::min(kSample, end - begin);
    const auto count = static_cast<double>(end - begin), last = static_cast<double>(taken - 1);
    for (size_t k = 0; k < taken; ++k) {
      const double turns = kGolden * static_cast<double>(k);
      const double place = (turns - std::floor(turns)) * count;
      sample[k] = at_(ids_[begin + (taken < kSample ? k : static_cast<size_t>(place))], axis);
    }
    const double share = static_cast<double>(middle - begin) / count;
    const auto first = sample.begin();
    const auto low = first + static_cast<std::ptrdiff_t>(std::max(share - kNear, 0.0) * last);
    const auto high =
        first + static_cast<std::ptrdiff_t>(std::ceil(std::min(share + kNear, 1.0) * last));
    const auto sample_end = first + static_cast<std::ptrdiff_t>(taken);
    std::nth_element(first, low, sample_end);
    std::nth_element(low, high, sample_end);
    return *high / 2 - *low / 2;
  }

  // The first behind the cut, and the bin that it is in.
  struct Pivot {
    Place place;
    uint8_t bin;
  };

  // What comes at `middle` when all are in order. In bins_: of each its bin, which rises with the
  // coordinate.
  Pivot pivotAt(size_t begin, size_t middle, size_t end, const Side& side) {
    // Halves, since the difference of finite numbers may be none.
    const Number width = side.high / 2 - side.low / 2;
    const Number bins_per_unit =
        width > 0 ? std::min(kBins / width, std::numeric_limits<Number>::max()) : 0;
    std::array<uint32_t, kBins> count{};
    for (size_t i = begin; i < end; ++i) {
      const Number x = at_(ids_[i], side.axis) / 2 - side.low / 2;
      const size_t bin = std::min(static_cast<size_t>(x * bins_per_unit), kBins - 1);
      bins_[i] = static_cast<uint8_t>(bin);
      ++count[bin];
    }
    size_t bin = 0, before = begin;
    for (; before + count[bin] <= middle; ++bin) before += count[bin];
    uint32_t* const in_bin = &aside_[begin];
    uint32_t* end_in_bin = in_bin;
    for (size_t i = begin; i < end; ++i)
      if (bins_[i] == bin) *end_in_bin++ = ids_[i];
    uint32_t* const id = in_bin + (middle - before);
    std::nth_element(in_bin, id, end_in_bin,
                     [&](uint32_t a, uint32_t b) { return placeOf(a, side) < placeOf(b, side); });
    return {placeOf(*id, side), static_cast<uint8_t>(bin)};
  }

  // [begin, middle) and [middle, end), each in the order that it has. Nearly all are told by their
  // bin.
  void partition(size_t begin, size_t middle, size_t end, const Side& side) {
    const Pivot pivot = pivotAt(begin, middle, end, side);
    uint32_t* const behind = &aside_[begin];
    size_t kept = begin, put_aside = 0;
    for (size_t i = begin; i < end; ++i) {
      const uint32_t id = ids_[i];
      const bool is_before =
          bins_[i] == pivot.bin ? placeOf(id, side) < pivot.place : bins_[i] < pivot.bin;
      ids_[kept] = behind[put_aside] = id;
      kept += is_before;
      put_aside += !is_before;
    }
    std::copy_n(behind, put_aside, ids_ + kept);
  }

  Place placeOf(uint32_t id, const Side& side) const { return {at_(id, side.axis), id}; }

  static constexpr size_t kBins = 256;
  uint32_t* ids_;
  CutRule rule_;
  const At& at_;
  std::vector<uint8_t> bins_;    // of ids_
  std::vector<uint32_t> aside_;  // as many
};

}  // namespace tetstream
