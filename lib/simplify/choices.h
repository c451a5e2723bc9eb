// simplify: the best edges of each vertex of a patch. Depends on base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "memory.h"

namespace tetstream {

// An edge is kept with both its ends, as its error and the other end. Of a vertex the four best are
// known, and the best of those that were refused since its surroundings last changed; of all others
// only the least error. Once the four are worse than that, the vertex must look at its edges again:
// with two it had to three times for every two collapses of meshes that refuse many.
class Choices {
 public:
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
  float least(uint32_t v) const { return std::bit_cast<float>(least_[v]); }
  // The same of kBlock vertices from v on, and of the rows beyond the last.
  static constexpr uint32_t kBlock = 16;
  float leastOfBlock(uint32_t v) const {
    uint32_t least = least_[v];
    for (uint32_t k = 1; k < kBlock; ++k) least = std::min(least, least_[v + k]);
    return std::bit_cast<float>(least);
  }
  // Offers again what was refused before its surroundings changed.
  void reconsider() {
    for (uint32_t v = 0; v < count_; ++v)
      if (woken_[v]) reconsider(v);
  }
  // Whether the vertex must look at its edges, all of them, for its best.
  bool mustLookAgain(uint32_t v) const { return of_[v].passed_over < of_[v].best[0]; }
  uint32_t target(uint32_t v) const { return otherOf(of_[v].best[0]); }

  // The edges of v, all of them, in place of what was known.
  template <class S>
  void relist(uint32_t v, const S* errors, const uint32_t* others, size_t count) {
    Choice c = of_[v];
    std::fill_n(c.best, kBest, kNothing);
    c.passed_over = kNothing;
    for (size_t i = 0; i < count; ++i) offer(c, keyOf(static_cast<float>(errors[i]), others[i]));
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
  // One edge more, at both its ends.
  void add(uint32_t v, uint32_t w, float error) {
    offer(of_[v], keyOf(error, w));
    offer(of_[w], keyOf(error, v));
    update(v);
    update(w);
  }
  // v was merged into u: what x knew of either is void, and its other edges may be legal again.
  void replace(uint32_t x, uint32_t u, uint32_t v, float error) {
    Choice& c = of_[x];
    const auto unless_void = [u, v](double key) {
      const uint64_t is_void = uint64_t{otherOf(key) == u} | uint64_t{otherOf(key) == v};
      const uint64_t bits = std::bit_cast<uint64_t>(key), none = std::bit_cast<uint64_t>(kNothing);
      return std::bit_cast<double>(bits ^ ((bits ^ none) & (0 - is_void)));  // without a branch
    };
    for (double& key : c.best) key = unless_void(key);
    sort(c);
    c.refused = unless_void(c.refused);
    woken_[x] = 1;
    c.tried = std::min(c.tried, keyOf(error, u));  // this one was not
    offer(c, keyOf(error, u));
    update(x);
  }
  // v is gone, or another vertex now.
  void forget(uint32_t v) {
    of_[v] = Choice{};
    least_[v] = std::bit_cast<uint32_t>(kInfinite);
    woken_[v] = 0;
  }
  // v's best edge, to w, is not legal.
  void refuse(uint32_t v, uint32_t w) {
    const double key = of_[v].best[0], back = keyOf(errorOf(key), v);
    refuse(of_[v], key);
    update(v);
    bool known = false;
    for (double other : of_[w].best) known |= other == back;
    if (!known) return;
    refuse(of_[w], back);
    update(w);
  }

 private:
  static constexpr float kRounding = 1 - 1e-5f;  // errors seen from the other end
  static constexpr float kInfinite = std::numeric_limits<float>::infinity();
  static constexpr double kNothing = std::numeric_limits<double>::infinity();
  static constexpr int kBest = 4;
  // Edges by keys: the error, with the other end in the bits that float32 leaves free. They order
  // by the error, then by the end, and the processor has minima of them.
  struct Choice {
    double best[kBest] = {kNothing, kNothing, kNothing, kNothing};  // rising
    double refused = kNothing;
    double tried = 0;  // edges below were refused or are listed
    double passed_over = kNothing, also_refused = kNothing;
  };

  static float errorOf(double key) { return static_cast<float>(key); }
  static uint32_t otherOf(double key) {
    return static_cast<uint32_t>(std::bit_cast<uint64_t>(key) & 0xffff);
  }
  static double keyOf(float error, uint32_t other) {
    const auto bits = std::bit_cast<uint64_t>(static_cast<double>(error));
    return error < kInfinite ? std::bit_cast<double>(bits | other) : kNothing;
  }
  static void offer(Choice& c, double key) {
    if (key < c.tried) key = kNothing;
    for (double& best : c.best) exchange(best, key);
    c.passed_over = std::min(c.passed_over, key);
  }
  static void exchange(double& a, double& b) {
    const double worse = std::max(a, b);
    a = std::min(a, b);
    b = worse;
  }
  static void sort(Choice& c) {
    exchange(c.best[0], c.best[1]);
    exchange(c.best[2], c.best[3]);
    exchange(c.best[0], c.best[2]);
    exchange(c.best[1], c.best[3]);
    exchange(c.best[1], c.best[2]);
  }
  static void refuse(Choice& c, double key) {
    if (key == c.best[0]) c.tried = std::bit_cast<double>(std::bit_cast<uint64_t>(key) + 1);
    for (double& best : c.best) best = best == key ? kNothing : best;
    sort(c);
    c.also_refused = std::min(c.also_refused, std::max(key, c.refused));
    c.refused = std::min(key, c.refused);
  }
  void update(uint32_t v) {
    const Choice& c = of_[v];
    least_[v] = std::bit_cast<uint32_t>(errorOf(std::min(c.best[0], c.passed_over)));
  }
  void reconsider(uint32_t v) {
    Choice& c = of_[v];
    woken_[v] = 0;
    c.tried = 0;
    c.passed_over = std::min(c.passed_over, c.also_refused);
    c.also_refused = kNothing;
    const double key = c.refused;
    c.refused = kNothing;
    offer(c, key);
    update(v);
  }

  size_t count_ = 0;
  Array<Choice> of_;
  Array<uint32_t> least_;  // bits of the errors: they order as these do
  Array<uint8_t> woken_;
};

}  // namespace tetstream
