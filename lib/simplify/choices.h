// simplify: the best edges of each vertex of a patch. Depends on base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "memory.h"

namespace tetstream {

// An edge is kept with both its ends, as its error and the other end. Of a vertex the eight best
// are known, and the best of those that were refused since its surroundings last changed; of all
// others only the least error. Once the eight are worse than that, the vertex must look at its
// edges again: with four it had to twice as often.
class Choices {
 public:
  static constexpr uint32_t kMostVertices = 1 << 12;  // what keys have room for

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
  void reconsider(uint32_t v) {
    Choice& c = of_[v];
    woken_[v] = 0;
    c.tried = 0;
    c.passed_over = std::min(c.passed_over, c.also_refused);
    c.also_refused = kNothing;
    const float key = c.refused;
    c.refused = kNothing;
    offer(c, key);
    update(v);
  }
  // Whether the vertex must look at its edges, all of them, for its best.
  bool mustLookAgain(uint32_t v) const { return of_[v].passed_over < bestOf(of_[v]); }
  uint32_t target(uint32_t v) const { return otherOf(bestOf(of_[v])); }

  // The edges of v, all of them, in place of what was known.
  template <class S>
  void relist(uint32_t v, const S* errors, const uint32_t* others, size_t count) {
    Choice c = of_[v];
    c.passed_over = kNothing;
    float first[kBest];
    for (size_t i = 0; i < kBest; ++i)
      first[i] = i < count ? keyOf(errors[i], others[i]) : kNothing;
    for (float& key : first) key = key < c.tried ? kNothing : key;
    std::memcpy(c.best, first, sizeof first);
    for (int k = 0; k < 2; ++k) c.best[k] = c.best[k] < kNothing ? c.best[k] : none(k);
    for (size_t i = kBest; i < count; ++i) offer(c, keyOf(errors[i], others[i]));
    of_[v] = c;
    update(v);
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
  void add(uint32_t v, const S* errors, const uint32_t* others, size_t count) {
    Choice c = of_[v];
    for (size_t i = 0; i < count; ++i) {
      const uint32_t w = others[i];
      offer(c, keyOf(errors[i], w));
      const float key = keyOf(errors[i], v);
      least_[w] = std::min(least_[w], leastIn(key < of_[w].tried ? kNothing : key));
      offer(of_[w], key);
    }
    of_[v] = c;
    update(v);
  }
  // v was merged into u: what x knew of either is void, and its other edges may be legal again.
  void replace(uint32_t x, uint32_t u, uint32_t v, float error) {
    Choice& c = of_[x];
    const Ends gone_u = Ends{} + u, gone_v = Ends{} + v;
    for (int k = 0; k < 2; ++k) {
      const Ends end = std::bit_cast<Ends>(c.best[k]) & kEndMask;
      c.best[k] = ((end == gone_u) | (end == gone_v)) ? none(k) : c.best[k];
    }
    const uint32_t refused_end = otherOf(c.refused);
    c.refused = refused_end == u || refused_end == v ? kNothing : c.refused;
    woken_[x] = 1;
    c.tried = std::min(c.tried, keyOf(error, u));  // this one was not
    offer(c, keyOf(error, u));
    update(x);
  }
  // v is gone, or another vertex now.
  void forget(uint32_t v) {
    of_[v] = Choice{{none(0), none(1)}};
    least_[v] = kInfinite;
    woken_[v] = 0;
  }
  // v's best edge, to w, is not legal.
  void refuse(uint32_t v, uint32_t w) {
    const float key = bestOf(of_[v]), back = keyOf(key, v);
    refuse(of_[v], key);
    update(v);
    const auto known = (of_[w].best[0] == back) | (of_[w].best[1] == back);
    if (!(known[0] | known[1] | known[2] | known[3])) return;
    refuse(of_[w], back);
    update(w);
  }

 private:
  // Edges by keys: the error, rounded down, with the other end in its last bits. They order by the
  // error, then by the end. Keys that are none are larger, and different in each place.
  static constexpr uint32_t kEndMask = kMostVertices - 1, kNothingBits = 0x7f7ff000;
  static constexpr float kNothing = std::bit_cast<float>(kNothingBits + 8);
  static constexpr float kRounding = 1 - 1e-3f;  // of keys, and of errors seen from the other end
  static constexpr float kInfinite = std::numeric_limits<float>::infinity();
  static constexpr size_t kBest = 8;
  typedef float Keys __attribute__((vector_size(16)));
  typedef uint32_t Ends __attribute__((vector_size(16)));
  static constexpr Ends kNoneBits[2] = {
      {kNothingBits, kNothingBits + 1, kNothingBits + 2, kNothingBits + 3},
      {kNothingBits + 4, kNothingBits + 5, kNothingBits + 6, kNothingBits + 7}};
  static Keys none(int k) { return std::bit_cast<Keys>(kNoneBits[k]); }
  struct Choice {
    Keys best[2];  // in no order
    float refused = kNothing;
    float tried = 0;  // edges below were refused or are listed
    float passed_over = kNothing, also_refused = kNothing;
  };

  static uint32_t otherOf(float key) { return std::bit_cast<uint32_t>(key) & kEndMask; }
  static float keyOf(double error, uint32_t other) {
    return keyOf(static_cast<float>(error), other);
  }
  static float keyOf(float error, uint32_t other) {
    const uint32_t bits = std::bit_cast<uint32_t>(error) & ~kEndMask;
    const uint32_t key = std::min(bits, kNothingBits - kMostVertices) | other;
    return error < kInfinite ? std::bit_cast<float>(key) : kNothing;
  }
  static Keys smaller(Keys a, Keys b) { return a < b ? a : b; }
  static Keys larger(Keys a, Keys b) { return a > b ? a : b; }
  static float leastOf(Keys m) {
    m = smaller(m, __builtin_shufflevector(m, m, 2, 3, 0, 1));
    m = smaller(m, __builtin_shufflevector(m, m, 1, 0, 3, 2));
    return m[0];
  }
  static float bestOf(const Choice& c) { return leastOf(smaller(c.best[0], c.best[1])); }
  // In place of the worst, which may be none.
  static void offer(Choice& c, float key) {
    const Keys offered = Keys{} + (key < c.tried ? kNothing : key);
    Keys worst = larger(c.best[0], c.best[1]);
    worst = larger(worst, __builtin_shufflevector(worst, worst, 2, 3, 0, 1));
    worst = larger(worst, __builtin_shufflevector(worst, worst, 1, 0, 3, 2));
    const Keys taken = smaller(offered, worst);
    for (Keys& best : c.best) best = best == worst ? taken : best;
    c.passed_over = std::min(c.passed_over, larger(offered, worst)[0]);
  }
  static void refuse(Choice& c, float key) {
    if (key == bestOf(c)) c.tried = std::bit_cast<float>(std::bit_cast<uint32_t>(key) + 1);
    for (int k = 0; k < 2; ++k) c.best[k] = c.best[k] == key ? none(k) : c.best[k];
    c.also_refused = std::min(c.also_refused, std::max(key, c.refused));
    c.refused = std::min(key, c.refused);
  }
  // The error in a key.
  static float leastIn(float key) {
    const uint32_t least = std::bit_cast<uint32_t>(key) & ~kEndMask;
    return std::bit_cast<float>(least + (least == kNothingBits ? kMostVertices : 0));  // infinity
  }
  void update(uint32_t v) { least_[v] = leastIn(std::min(bestOf(of_[v]), of_[v].passed_over)); }

  size_t count_ = 0;
  Array<Choice> of_;
  Array<float> least_;
  Array<uint8_t> woken_;
};

}  // namespace tetstream
