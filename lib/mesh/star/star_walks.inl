// mesh: the bodies of the kernels that walk round a vertex, compiled once per instruction set:
// which cells and vertices are there, and sums over its link.
#include "star_kernels.h"
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace tetstream {
namespace {

// ---------------------------------------------------------------------------------- gathering

#ifdef __AVX2__
// Of two cells of 8 bytes the places of t0, t1, t2, from byte 2 of each on, seen from a corner of
// each: one of four bits each, none for a cell that is dead.
struct LookTable {
  alignas(16) uint8_t places[0x89][16];
};
constexpr LookTable makeLookTable() {
  LookTable table{};
  for (unsigned bits = 0; bits < 0x89; ++bits)
    for (unsigned k = 0; k < 2; ++k) {
      uint8_t* const out = table.places[bits] + 8 * k;
      for (unsigned byte = 0; byte < 8; ++byte) out[byte] = 0x80;  // gives 0
      for (unsigned j = 0; j < 4; ++j)
        for (unsigned i = 0; (bits >> (4 * k + j) & 1) && i < 6; ++i)
          out[2 + i] = static_cast<uint8_t>(8 * k + 2u * kOpposite[j][i / 2] + i % 2);
    }
  return table;
}
constexpr LookTable kLook = makeLookTable();

// The places of the bits that are set, as pairs of 32-bit numbers of a vector and as pairs of
// bytes.
struct PickTable {
  alignas(32) uint32_t pairs[16][8];
  uint8_t bytes[16][8];
};
constexpr PickTable makePickTable() {
  PickTable table{};
  for (unsigned bits = 0; bits < 16; ++bits)
    for (unsigned k = 0, picked = 0; k < 4; ++k)
      for (unsigned i = 0; (bits >> k & 1) && i < 2; ++i, ++picked) {
        table.pairs[bits][picked] = 2 * k + i;
        table.bytes[bits][picked] = static_cast<uint8_t>(2 * k + i);
      }
  return table;
}
constexpr PickTable kPick = makePickTable();

inline uint64_t eightBytesAt(const uint16_t* p) {
  uint64_t bytes;
  __builtin_memcpy(&bytes, p, sizeof bytes);
  return bytes;
}
inline __m128i loadTwoCells(const uint16_t* corners, uint64_t two) {
  return _mm_set_epi64x(static_cast<int64_t>(eightBytesAt(corners + 4 * (two >> 16 & 0xffff))),
                        static_cast<int64_t>(eightBytesAt(corners + 4 * (two & 0xffff))));
}
inline __m128i eightBytes(const uint8_t* p) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
}

// Of four cells, a number and three corners of 16 bits each, those whose bits are set.
inline void putCells(__m256i cells, unsigned bits, StarCell* out) {
  static_assert(sizeof(StarCell) == 16 && offsetof(StarCell, t) == 4);
  const __m256i places = _mm256_load_si256(reinterpret_cast<const __m256i*>(kPick.pairs[bits]));
  const __m256i picked = _mm256_permutevar8x32_epi32(cells, places);
  __m256i* const to = reinterpret_cast<__m256i*>(out);
  _mm256_storeu_si256(to, _mm256_cvtepu16_epi32(_mm256_castsi256_si128(picked)));
  _mm256_storeu_si256(to + 1, _mm256_cvtepu16_epi32(_mm256_extracti128_si256(picked, 1)));
}

inline unsigned zerosOf(__m256i masks) {
  const __m256i zeros = _mm256_cmpeq_epi64(masks, _mm256_setzero_si256());
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(zeros)));
}

// Four at a time, without branches, since there is no pattern in which of them are dead or have the
// other vertex: all are written, and what does not belong is overwritten by the next.
struct RoundLook {
  const uint16_t* corners;
  __m256i v, other;
  StarCell *star, *ring;

  // Of those whose bits are set in `there`. Returns the bits of those that live.
  unsigned lookAt(uint64_t four, unsigned there) {
    const __m256i corner =
        _mm256_set_m128i(loadTwoCells(corners, four >> 32), loadTwoCells(corners, four));
    const __m256i is_v = _mm256_cmpeq_epi16(corner, v),
                  is_other = _mm256_cmpeq_epi16(corner, other);
    const auto at = static_cast<unsigned>(  // four bits of a cell, two cells, each twice
        _mm256_movemask_epi8(_mm256_packs_epi16(is_v, is_v)));
    const __m256i look =
        _mm256_set_m128i(_mm_load_si128(reinterpret_cast<const __m128i*>(kLook.places[at >> 24])),
                         _mm_load_si128(reinterpret_cast<const __m128i*>(kLook.places[at & 0xff])));
    const __m128i numbers = _mm_cvtsi64_si128(static_cast<int64_t>(four));
    const __m256i seen =
        _mm256_or_si256(_mm256_shuffle_epi8(corner, look), _mm256_cvtepu16_epi64(numbers));
    const unsigned live = ~zerosOf(is_v) & there, alone = live & zerosOf(is_other);
    putCells(seen, alone, star);
    putCells(seen, live ^ alone, ring);
    star += __builtin_popcount(alone);
    ring += __builtin_popcount(live ^ alone);
    return live;
  }
};

inline StarCounts lookRoundOf(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                              uint16_t other, StarCell* star, StarCell* ring) {
  RoundLook look = {corners, _mm256_set1_epi16(static_cast<short>(v)),
                    _mm256_set1_epi16(static_cast<short>(other)), star, ring};
  uint16_t* kept = cells;
  const uint16_t* const end = cells + count;
  for (; end - cells >= 4; cells += 4) {
    const uint64_t four = eightBytesAt(cells);
    const unsigned live = look.lookAt(four, 15);
    const __m128i numbers = _mm_cvtsi64_si128(static_cast<int64_t>(four));
    const __m128i first = _mm_shuffle_epi8(numbers, eightBytes(kPick.bytes[live]));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(kept), first);
    kept += __builtin_popcount(live);
  }
  if (const auto left = static_cast<unsigned>(end - cells)) {
    uint64_t four = 0;
    for (unsigned k = 0; k < left; ++k) four |= uint64_t{cells[k]} << 16 * k;
    for (unsigned k = 0, live = look.lookAt(four, (1u << left) - 1); k < left; ++k) {
      *kept = cells[k];
      kept += live >> k & 1;
    }
  }
  return {static_cast<uint32_t>(look.star - star), static_cast<uint32_t>(look.ring - ring)};
}
#else
inline StarCounts lookRoundOf(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                              uint16_t other, StarCell* star, StarCell* ring) {
  uint32_t kept = 0, in_ring = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint16_t cell = cells[i];
    const uint16_t* corner = corners + 4 * size_t{cell};
    if (corner[0] == kGoneCorner) continue;
    const uint32_t j =
        uint32_t{corner[1] == v} + 2 * uint32_t{corner[2] == v} + 3 * uint32_t{corner[3] == v};
    const bool both =
        (corner[0] == other) | (corner[1] == other) | (corner[2] == other) | (corner[3] == other);
    cells[kept + in_ring] = cell;
    StarCell& out = both ? ring[in_ring++] : star[kept++];
    out.cell = cell;
    for (int k = 0; k < 3; ++k) out.t[k] = corner[kOpposite[j][k]];
  }
  return {kept, in_ring};
}
#endif

// ---------------------------------------------------------------------------------- links

typedef uint32_t Numbers __attribute__((vector_size(32)));  // of four corners two each

// One to one, looks random (each of the two numbers with factors of its own).
inline Numbers mixed(Numbers n) {
  constexpr Numbers kFirst = {0x7feb352d, 0x21f0aaad, 0x7feb352d, 0x21f0aaad,
                              0x7feb352d, 0x21f0aaad, 0x7feb352d, 0x21f0aaad};
  constexpr Numbers kSecond = {0x846ca68b, 0xd35a2d97, 0x846ca68b, 0xd35a2d97,
                               0x846ca68b, 0xd35a2d97, 0x846ca68b, 0xd35a2d97};
  n = (n ^ (n >> 16)) * kFirst;
  n = (n ^ (n >> 15)) * kSecond;
  return n ^ (n >> 16);
}
typedef uint32_t NumberPair __attribute__((vector_size(8)));
inline void addPair(NumberPair pair, uint64_t* sums) {
  NumberPair before;
  __builtin_memcpy(&before, sums, sizeof before);
  before += pair;
  __builtin_memcpy(sums, &before, sizeof before);
}
// Of corners a, b, c of each face: j's is that of kOpposite[j].
inline Numbers cornersA(Numbers n) {
  return __builtin_shufflevector(n, n, 2, 3, 0, 1, 0, 1, 0, 1);
}
inline Numbers cornersB(Numbers n) {
  return __builtin_shufflevector(n, n, 4, 5, 6, 7, 2, 3, 4, 5);
}
inline Numbers cornersC(Numbers n) {
  return __builtin_shufflevector(n, n, 6, 7, 4, 5, 6, 7, 2, 3);
}

inline void addToLinkSumsOf(const uint32_t v[4], bool negative, const uint32_t taken[4],
                            uint64_t* sums) {
  static_assert(kOpposite[0][0] == 1 && kOpposite[1][0] == 0 && kOpposite[1][1] == 3 &&
                kOpposite[2][1] == 1 && kOpposite[3][1] == 2);
  const Numbers x = mixed(Numbers{v[0], v[0], v[1], v[1], v[2], v[2], v[3], v[3]} + 0x9e3779b9u);
  const Numbers y = (x ^ (x >> 13)) * 0xde82ef95u;
  const Numbers xa = cornersA(x), ya = cornersA(y);
  const Numbers bx = cornersB(x) - xa, by = cornersB(y) - ya;
  const Numbers cx = cornersC(x) - xa, cy = cornersC(y) - ya;
  const Numbers sign = Numbers{} - uint32_t{negative};
  const Numbers all = {taken[0], taken[0], taken[1], taken[1],
                       taken[2], taken[2], taken[3], taken[3]};
  const Numbers added = (((bx * cy - cx * by) ^ sign) - sign) & all;
  addPair(__builtin_shufflevector(added, added, 0, 1), sums + v[0]);
  addPair(__builtin_shufflevector(added, added, 2, 3), sums + v[1]);
  addPair(__builtin_shufflevector(added, added, 4, 5), sums + v[2]);
  addPair(__builtin_shufflevector(added, added, 6, 7), sums + v[3]);
}

// Without branches, since there is no pattern in what was seen before.
inline void listVertex(uint32_t v, uint32_t* seen, uint32_t mark, uint32_t* out, size_t* listed) {
  out[*listed] = v;
  *listed += seen[v] < mark;
  seen[v] = seen[v] < mark ? mark : seen[v];
}
inline size_t listVerticesOf(const uint16_t* corners, const uint16_t* cells, uint32_t count,
                             uint32_t* seen, uint32_t mark, uint32_t* out) {
  size_t listed = 0;
  for (uint32_t i = 0; i < count; ++i)
    for (size_t k = 0; k < 4; ++k)
      listVertex(corners[4 * size_t{cells[i]} + k], seen, mark, out, &listed);
  return listed;
}
inline size_t listVerticesOf(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                             uint32_t* out) {
  size_t listed = 0;
  for (size_t i = 0; i < count; ++i)
    for (uint32_t t : cells[i].t) listVertex(t, seen, mark, out, &listed);
  return listed;
}

}  // namespace
}  // namespace tetstream
