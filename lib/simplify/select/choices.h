// simplify/select: the best edges of each vertex of a patch. Depends on choice_kernels.h, base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "choice_kernels.h"
#include "memory.h"

namespace tetstream {

// An edge is kept with both its ends, as its error and the other end. Of a vertex the eight best
// are known, and the best of those that were refused since its surroundings last changed; of all
// others only the least error. Once the eight are worse than that, the vertex must look at its
// edges again: with four it had to twice as often.
class Choices {
 public:
  static constexpr uint32_t kMostVertices = kMostChoosers;

  explicit Choices(Account& account) : of_(account), least_(account), woken_(account) {}

  void reset(size_t vertices) {
    const size_t rows = (vertices + kBlock - 1) / kBlock * kBlock;
    if (of_.size() < rows) {
      of_.resize(rows);
      least_.resize(rows);
      woken_.resize(rows);
    }
    count_ = vertices;
    for (uint32_t v = 0; v < rows; ++v) forget(v);
  }

  // The least error that an edge of v may have; infinity when there is none left.
  float least(uint32_t v) const { return least_[v]; }
  // The same of kBlock vertices from v on, and of the rows beyond the last.
  static constexpr uint32_t kBlock = 16;
  float leastOfBlock(uint32_t v) const {
    Keys four[kBlock / 4];
    std::memcpy(four, &least_[v], sizeof four);
    return leastOf(smaller(smaller(four[0], four[1]), smaller(four[2], four[3])));
  }
  // Vertices from v on whose least is up to `level`, by their blocks until there are `enough`;
  // `out` has room for kBlock more. Returns their number.
  uint32_t listUpTo(float level, uint32_t v, uint32_t enough, uint32_t* out) const {
    uint32_t listed = 0;
    for (uint32_t block = v / kBlock * kBlock; block < count_ && listed < enough; block += kBlock) {
      if (!(leastOfBlock(block) <= level)) continue;
      for (uint32_t x = block; x < block + kBlock; ++x) {  // no branch: there is no pattern
        out[listed] = x;
        listed += unsigned{x >= v} & unsigned{least_[x] <= level};
      }
    }
    return listed;
  }
  // Offers again what was refused before its surroundings changed.
  void reconsider() {
    for (uint32_t block = 0; block < count_; block += kBlock) {
      uint64_t woken[kBlock / 8];
      std::memcpy(woken, &woken_[block], sizeof woken);
      if ((woken[0] | woken[1]) == 0) continue;
      for (uint32_t v = block; v < block + kBlock; ++v)
        if (woken_[v]) reconsider(v);
    }
  }
  // Offers again what was refused of v.
  void reconsider(uint32_t v) { reconsiderEdges(table(), v); }
  // Whether the vertex must look at its edges, all of them, for its best.
  bool mustLookAgain(uint32_t v) const { return of_[v].passed_over < of_[v].best[0]; }
  uint32_t target(uint32_t v) const { return otherOf(of_[v].best[0]); }

  // The edges of v, all of them, in place of what was known.
  template <class S>
  void relist(uint32_t v, const EdgeList<S>& edges) {
    relistEdges(table(), v, edges);
  }
  // Of the edges of v only this is known; all of them are added where that is not enough.
  void know(uint32_t v, float least, bool refused) {
    of_[v].passed_over = keyOf(least, 0);
    of_[v].also_refused = refused ? 0 : kNothing;
    update(v);
  }
  // The edges of v are added; of those below `least`, all that are legal are known at their other
  // ends.
  void passOver(uint32_t v, float least, bool refused) {
    of_[v].tried = keyOf(kRounding * least, 0);
    of_[v].also_refused = refused ? 0 : kNothing;
  }
  // Whether edges of v were refused, and not offered again.
  bool hasRefused(uint32_t v) const {
    return std::min(of_[v].also_refused, of_[v].refused) < kNothing;
  }
  // More edges of v, at both their ends.
  template <class S>
  void add(uint32_t v, const EdgeList<S>& edges) {
    addEdges(table(), v, edges);
  }
  // v was merged into u, whose edges now are these: what the other ends knew of either is void, and
  // their other edges may be legal again.
  template <class S>
  void replace(uint32_t u, uint32_t v, const EdgeList<S>& edges) {
    replaceEdges(table(), u, v, edges);
  }
  // v is gone, or another vertex now.
  void forget(uint32_t v) {
    Choice& c = of_[v];
    std::fill_n(c.best, kBestEdges, kNothing);
    c.refused = c.passed_over = c.also_refused = kNothing;
    c.tried = 0;
    least_[v] = kInfiniteError;
    woken_[v] = 0;
  }
  // v's best edge, to w, is not legal.
  void refuse(uint32_t v, uint32_t w) { refuseEdge(table(), v, w); }

 private:
  static constexpr float kRounding = 1 - 1e-3f;  // of keys, and of errors seen from the other end
  typedef float Keys __attribute__((vector_size(16)));

  ChoiceTable table() { return {of_.data(), least_.data(), woken_.data()}; }
  static Keys smaller(Keys a, Keys b) { return a < b ? a : b; }
  static float leastOf(Keys m) {
    m = smaller(m, __builtin_shufflevector(m, m, 2, 3, 0, 1));
    m = smaller(m, __builtin_shufflevector(m, m, 1, 0, 3, 2));
    return m[0];
  }
  void update(uint32_t v) { least_[v] = errorIn(std::min(of_[v].best[0], of_[v].passed_over)); }

  size_t count_ = 0;
  Array<Choice> of_;
  Array<float> least_;
  Array<uint8_t> woken_;
};

}  // namespace tetstream
