// simplify/select: the bodies of the loops over the edges round a vertex, compiled once per
// instruction set. Nothing here calls the standard library: no function of one build is linked into
// another.
#include "choice_kernels.h"
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace tetstream {
namespace {

typedef float Keys __attribute__((vector_size(32)));
typedef uint32_t Ends __attribute__((vector_size(32)));
static_assert(sizeof(Keys) == kBestEdges * sizeof(float));

inline float least(float a, float b) {
  return b < a ? b : a;
}
inline float largest(float a, float b) {
  return a < b ? b : a;
}
[[gnu::always_inline]] inline Keys smaller(Keys a, Keys b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Keys larger(Keys a, Keys b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Keys keysAt(const float* keys) {
  Keys k;
  __builtin_memcpy(&k, keys, sizeof k);
  return k;
}
[[gnu::always_inline]] inline void putKeys(Keys k, float* keys) {
  __builtin_memcpy(keys, &k, sizeof k);
}
[[gnu::always_inline]] inline float leastOf(Keys m) {
  m = smaller(m, __builtin_shufflevector(m, m, 4, 5, 6, 7, 0, 1, 2, 3));
  m = smaller(m, __builtin_shufflevector(m, m, 2, 3, 0, 1, 6, 7, 4, 5));
  m = smaller(m, __builtin_shufflevector(m, m, 1, 0, 3, 2, 5, 4, 7, 6));
  return m[0];
}

// ------------------------------------------------------------------------------------- sorting

// One step of a network: lane k is compared with lane other[k], and the one further back gets the
// larger.
template <int... other>
[[gnu::always_inline]] inline Keys exchanged(Keys k) {
  constexpr int at[] = {other...};
  const Keys o = __builtin_shufflevector(k, k, other...), low = smaller(k, o), high = larger(k, o);
  return __builtin_shufflevector(low, high, at[0] < 0 ? 8 : 0, at[1] < 1 ? 9 : 1,
                                 at[2] < 2 ? 10 : 2, at[3] < 3 ? 11 : 3, at[4] < 4 ? 12 : 4,
                                 at[5] < 5 ? 13 : 5, at[6] < 6 ? 14 : 6, at[7] < 7 ? 15 : 7);
}
// Batcher's network for eight.
[[gnu::always_inline]] inline Keys sorted(Keys k) {
  k = exchanged<1, 0, 3, 2, 5, 4, 7, 6>(k);
  k = exchanged<2, 3, 0, 1, 6, 7, 4, 5>(k);
  k = exchanged<0, 2, 1, 3, 4, 6, 5, 7>(k);
  k = exchanged<4, 5, 6, 7, 0, 1, 2, 3>(k);
  k = exchanged<0, 1, 4, 5, 2, 3, 6, 7>(k);
  return exchanged<0, 2, 1, 4, 3, 6, 5, 7>(k);
}
// Of two that are sorted the eight smallest, sorted; `others` becomes the others, in no order.
[[gnu::always_inline]] inline Keys merged(Keys a, Keys* others) {
  const Keys back = __builtin_shufflevector(*others, *others, 7, 6, 5, 4, 3, 2, 1, 0);
  *others = larger(a, back);
  a = exchanged<4, 5, 6, 7, 0, 1, 2, 3>(smaller(a, back));  // rises, then falls
  a = exchanged<2, 3, 0, 1, 6, 7, 4, 5>(a);
  return exchanged<1, 0, 3, 2, 5, 4, 7, 6>(a);
}

// Without those that are true in `gone`, in the same order.
#ifdef __AVX2__
struct LeftTable {
  uint8_t lanes[256][8];
};
constexpr LeftTable makeLeftTable() {
  LeftTable table{};
  for (unsigned gone = 0; gone < 256; ++gone) {
    unsigned k = 0;
    for (unsigned want = 0; want < 2; ++want)
      for (unsigned i = 0; i < 8; ++i)
        if ((gone >> i & 1) == want) table.lanes[gone][k++] = static_cast<uint8_t>(i);
  }
  return table;
}
constexpr LeftTable kLeft = makeLeftTable();
[[gnu::always_inline]] inline Keys without(Keys k, Ends gone) {
  k = gone ? Keys{} + kNothing : k;
  const auto bits = static_cast<unsigned>(_mm256_movemask_ps(__builtin_bit_cast(__m256, gone)));
  const __m128i lanes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kLeft.lanes[bits]));
  return __builtin_bit_cast(
      Keys, _mm256_permutevar8x32_ps(__builtin_bit_cast(__m256, k), _mm256_cvtepu8_epi32(lanes)));
}
#else
inline Keys without(Keys k, Ends gone) {
  Keys left = Keys{} + kNothing;
  for (unsigned i = 0, kept = 0; i < kBestEdges; ++i)
    if (!gone[i]) left[kept++] = k[i];
  return left;
}
#endif

// --------------------------------------------------------------------------------------- edges

// Eight errors from `first` on.
[[gnu::always_inline]] inline Keys errorsFrom(const EdgeList<float>& edges, size_t first) {
  return keysAt(edges.errors + first) * edges.unit;
}
[[gnu::always_inline]] inline Keys errorsFrom(const EdgeList<double>& edges, size_t first) {
  typedef double Doubles __attribute__((vector_size(64)));
  Doubles errors;
  __builtin_memcpy(&errors, edges.errors + first, sizeof errors);
  return __builtin_convertvector(errors * edges.unit, Keys);
}
[[gnu::always_inline]] inline Ends endsAt(const uint32_t* ends) {
  Ends e;
  __builtin_memcpy(&e, ends, sizeof e);
  return e;
}
[[gnu::always_inline]] inline Keys keysOf(Keys errors, Ends ends) {
  const Ends bits = __builtin_bit_cast(Ends, errors) & ~kEndMask, most = Ends{} + kMostKey;
  const Keys keys = __builtin_bit_cast(Keys, (bits < most ? bits : most) | ends);
  return errors < kInfiniteError ? keys : Keys{} + kNothing;
}

// What is known of a vertex, while it is worked on.
struct Chooser {
  Choice& row;
  Keys best;
  float tried, passed_over;

  [[gnu::always_inline]] explicit Chooser(Choice& c)
      : row(c), best(keysAt(c.best)), tried(c.tried), passed_over(c.passed_over) {}
  // In its place, where it is one of the best.
  [[gnu::always_inline]] void offer(float key) {
    constexpr Keys kFirst = {-1};
    key = key < tried ? kNothing : key;
    const Keys offered = Keys{} + key;
    const Keys before = __builtin_shufflevector(best, best, 7, 0, 1, 2, 3, 4, 5, 6);
    passed_over = least(passed_over, largest(key, before[0]));
    const Keys from_before = __builtin_shufflevector(before, kFirst, 8, 1, 2, 3, 4, 5, 6, 7);
    best = smaller(best, larger(offered, from_before));
  }
  // Many, eight at a time: one after the other each would wait for the one before.
  template <class S>
  [[gnu::always_inline]] void offerAll(const EdgeList<S>& edges) {
    constexpr Ends kPlaces = {0, 1, 2, 3, 4, 5, 6, 7};
    const Keys nothing = Keys{} + kNothing;
    Keys dropped = Keys{} + passed_over;
    for (size_t first = 0; first < edges.count; first += kBestEdges) {
      Keys keys = keysOf(errorsFrom(edges, first), endsAt(edges.others + first));
      keys = kPlaces < static_cast<uint32_t>(edges.count - first) ? keys : nothing;
      keys = sorted(keys < tried ? nothing : keys);
      best = merged(best, &keys);
      dropped = smaller(dropped, keys);
    }
    passed_over = leastOf(dropped);
  }
  [[gnu::always_inline]] void refuse(float key) {
    if (key == best[0])
      row.tried = __builtin_bit_cast(float, __builtin_bit_cast(uint32_t, key) + 1);
    best = without(best, __builtin_bit_cast(Ends, best == key));
    row.also_refused = least(row.also_refused, largest(key, row.refused));
    row.refused = least(key, row.refused);
  }
  [[gnu::always_inline]] void put(const ChoiceTable& table, uint32_t v) const {
    putKeys(best, row.best);
    row.passed_over = passed_over;
    table.least[v] = errorIn(least(best[0], passed_over));
  }
};

// Calls visit(other, key) for each edge, its key as the other end has it: with the end v.
template <class S, class Visit>
[[gnu::always_inline]] inline void forOthers(const EdgeList<S>& edges, uint32_t v, Visit visit) {
  alignas(32) float keys[kBestEdges];
  for (size_t first = 0; first < edges.count; first += kBestEdges) {
    putKeys(keysOf(errorsFrom(edges, first), Ends{} + v), keys);
    const size_t left = edges.count - first, here = left < kBestEdges ? left : kBestEdges;
    for (size_t k = 0; k < here; ++k) visit(edges.others[first + k], keys[k]);
  }
}

template <class S>
inline void relistEdgesOf(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges) {
  Chooser c(table.of[v]);
  c.passed_over = kNothing;
  c.best = Keys{} + kNothing;
  c.offerAll(edges);
  c.put(table, v);
}

template <class S>
inline void addEdgesOf(const ChoiceTable& table, uint32_t v, const EdgeList<S>& edges) {
  forOthers(
      edges, v, [&](uint32_t w, float key) __attribute__((always_inline)) {
        Chooser other(table.of[w]);
        other.offer(key);
        other.put(table, w);
      });
  Chooser c(table.of[v]);
  c.offerAll(edges);
  c.put(table, v);
}

template <class S>
inline void replaceEdgesOf(const ChoiceTable& table, uint32_t u, uint32_t v,
                           const EdgeList<S>& edges) {
  forOthers(
      edges, u, [&](uint32_t x, float key) __attribute__((always_inline)) {
        Chooser c(table.of[x]);
        const Ends end = __builtin_bit_cast(Ends, c.best) & kEndMask;
        c.best = without(c.best, __builtin_bit_cast(Ends, (end == u) | (end == v)));
        const uint32_t refused_end = otherOf(c.row.refused);
        const bool is_void = (refused_end == u) | (refused_end == v);
        c.row.refused = is_void ? kNothing : c.row.refused;
        table.woken[x] = 1;
        c.row.tried = c.tried = least(c.tried, key);  // this one was not
        c.offer(key);
        c.put(table, x);
      });
}

inline void refuseEdgeOf(const ChoiceTable& table, uint32_t v, uint32_t w) {
  Chooser c(table.of[v]);
  const float key = c.best[0], back = keyOf(key, v);
  c.refuse(key);
  c.put(table, v);
  bool known = false;
  for (float best : table.of[w].best) known |= best == back;
  if (!known) return;
  Chooser other(table.of[w]);
  other.refuse(back);
  other.put(table, w);
}

inline void reconsiderEdgesOf(const ChoiceTable& table, uint32_t v) {
  Chooser c(table.of[v]);
  table.woken[v] = 0;
  c.row.tried = c.tried = 0;
  c.passed_over = least(c.passed_over, c.row.also_refused);
  c.row.also_refused = kNothing;
  const float key = c.row.refused;
  c.row.refused = kNothing;
  c.offer(key);
  c.put(table, v);
}

}  // namespace
}  // namespace tetstream
