// simplify/select: the best edges of a vertex as numbers in vectors, and the loops over the edges
// round a vertex, built for several instruction sets; all builds give the same. Depends on nothing.
//
// Edges are known by keys: the error, rounded down, with the other end in its last bits. They order
// by the error, then by the end. kNothing, larger than any, is none.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

constexpr uint32_t kMostChoosers = 1 << 12;  // vertices that keys have room for
constexpr uint32_t kEndMask = kMostChoosers - 1, kNothingBits = 0x7f7ff000;
constexpr uint32_t kMostKey = kNothingBits - kMostChoosers;  // of an error, without its end
constexpr float kNothing = __builtin_bit_cast(float, kNothingBits);
constexpr float kInfiniteError = __builtin_inff();
constexpr size_t kBestEdges = 8;

struct Choice {
  float best[kBestEdges];  // rising
  float refused;
  float tried;  // edges below were refused or are listed
  float passed_over, also_refused;
};

// Of all vertices: what is known of their edges; the least error of one; whether what was refused
// is to be offered again.
struct ChoiceTable {
  Choice* of;
  float* least;
  uint8_t* woken;
};

// Edges of a vertex: their errors, which are to be multiplied by `unit`, and their other ends; as
// many of both as make up a multiple of kBestEdges can be read.
template <class S>
struct EdgeList {
  const S* errors;
  const uint32_t* others;
  size_t count;
  S unit;
};

// The edges of v, all of them, in place of what was known.
template <class S>
void relistEdges(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges);
// More edges of v, at both their ends.
template <class S>
void addEdges(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges);
// v was merged into u, whose edges now are these: what the other ends knew of either is void, and
// their other edges may be legal again.
template <class S>
void replaceEdges(const ChoiceTable& table, uint32_t u, uint32_t v, const EdgeList<S>& edges);
// v's best edge, to w, is not legal.
void refuseEdge(const ChoiceTable& table, uint32_t v, uint32_t w);
// Offers again what was refused of v.
void reconsiderEdges(const ChoiceTable& table, uint32_t v);

// Of keys, for those who look at one edge.
static inline float keyOf(float error, uint32_t other) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, error) & ~kEndMask;
  const uint32_t key = (bits < kMostKey ? bits : kMostKey) | other;
  return error < kInfiniteError ? __builtin_bit_cast(float, key) : kNothing;
}
static inline uint32_t otherOf(float key) {
  return __builtin_bit_cast(uint32_t, key) & kEndMask;
}
// The error in a key.
static inline float errorIn(float key) {
  const uint32_t bits = __builtin_bit_cast(uint32_t, key) & ~kEndMask;
  return __builtin_bit_cast(float, bits + (bits == kNothingBits ? kMostChoosers : 0));  // infinity
}

}  // namespace tetstream
