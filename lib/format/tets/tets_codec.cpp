#include "tets_codec.h"

#include <algorithm>

#include "status.h"
#include "zstd_result.h"

namespace tetstream::tets {

#ifdef TETSTREAM_WITH_ZSTD

// Level 1: higher ones are several times slower and store as much, since the transposed bytes have
// no long matches.
static constexpr int kLevel = 1;

struct Codec::State {
  ZSTD_CCtx* to = nullptr;
  ZSTD_DCtx* from = nullptr;
  std::vector<unsigned char> filtered;
  void makeDecompressor() {
    if (!from && !(from = ZSTD_createDCtx()))
      fail(Status::kNoMemory, "no memory for zstd's decompression");
  }
  ~State() {
    ZSTD_freeCCtx(to);
    ZSTD_freeDCtx(from);
  }
};

// out[b * count + i] = byte b of number i, of n numbers of a column that has `count`.
template <size_t kWidth>
static void transpose(const unsigned char* in, unsigned char* out, size_t n, size_t count) {
  for (size_t i = 0; i < n; ++i)
    for (size_t b = 0; b < kWidth; ++b) out[b * count + i] = in[i * kWidth + b];
}

template <size_t kWidth>
static void transposeBack(const unsigned char* in, unsigned char* out, size_t count) {
  for (size_t i = 0; i < count; ++i)
    for (size_t b = 0; b < kWidth; ++b) out[i * kWidth + b] = in[b * count + i];
}

// Of the numbers from `first` on. Unsigned arithmetic wraps, so every value comes back, whatever it
// is.
template <class U>
static void toDifferences(const unsigned char* in, unsigned char* out, size_t first, size_t n,
                          size_t step) {
  const auto at = [in](size_t i) {
    U u;
    std::memcpy(&u, in + i * sizeof(U), sizeof u);
    return u;
  };
  for (size_t i = first; i < first + n; ++i) {
    const U d = at(i) - (i < step ? U{0} : at(i - step));
    const U sign = static_cast<U>(U{0} - (d >> (8 * sizeof(U) - 1)));
    const U u = static_cast<U>(d << 1) ^ sign;
    std::memcpy(out + (i - first) * sizeof(U), &u, sizeof u);
  }
}

// By blocks, whose differences stay in the cache.
template <class U>
static void filterIds(const ColumnPlace& c, const unsigned char* in, unsigned char* out) {
  static constexpr size_t kBlock = 1024;
  const size_t count = c.rows * c.components;
  unsigned char differences[kBlock * sizeof(U)];
  for (size_t first = 0; first < count; first += kBlock) {
    const size_t n = std::min(kBlock, count - first);
    toDifferences<U>(in, differences, first, n, c.components);
    transpose<sizeof(U)>(differences, out + first, n, count);
  }
}

template <class U>
static void fromDifferences(unsigned char* data, size_t count, size_t step) {
  for (size_t i = 0; i < count; ++i) {
    U u, above = 0;
    std::memcpy(&u, data + i * sizeof(U), sizeof u);
    if (i >= step) std::memcpy(&above, data + (i - step) * sizeof(U), sizeof above);
    const U value = ((u >> 1) ^ static_cast<U>(U{0} - (u & 1))) + above;
    std::memcpy(data + i * sizeof(U), &value, sizeof value);
  }
}

static void filter(const ColumnPlace& c, const unsigned char* in, unsigned char* out) {
  const size_t count = c.rows * c.components;
  if (c.ids)
    c.width == 4 ? filterIds<uint32_t>(c, in, out) : filterIds<uint64_t>(c, in, out);
  else if (c.width == 1)
    std::memcpy(out, in, c.bytes);
  else if (c.width == 4)
    transpose<4>(in, out, count, count);
  else
    transpose<8>(in, out, count, count);
}

static void filterBack(const ColumnPlace& c, const unsigned char* in, unsigned char* out) {
  const size_t count = c.rows * c.components;
  if (c.width == 1)
    std::memcpy(out, in, c.bytes);
  else if (c.width == 4)
    transposeBack<4>(in, out, count);
  else
    transposeBack<8>(in, out, count);
  if (!c.ids) return;
  if (c.width == 4)
    fromDifferences<uint32_t>(out, count, c.components);
  else
    fromDifferences<uint64_t>(out, count, c.components);
}

static size_t filteredBytes(const ChunkShape& shape) {
  size_t sum = 0;
  for (const ColumnPlace& c : shape.columns()) sum += c.bytes;
  return sum;
}

Codec::Codec() : state_(std::make_unique<State>()) {}
Codec::~Codec() = default;
bool Codec::builtIn() {
  return true;
}

static void unfilter(const ChunkShape& shape, const unsigned char* filtered,
                     unsigned char* payload) {
  for (const ColumnPlace& c : shape.columns())
    if (c.bytes) {
      filterBack(c, filtered, payload + c.offset);
      filtered += c.bytes;
    }
}

size_t Codec::compress(const ChunkShape& shape, size_t payload_at,
                       std::vector<unsigned char>& section) {
  State& s = *state_;
  if (!s.to && !(s.to = ZSTD_createCCtx()))
    fail(Status::kNoMemory, "no memory for zstd's compression");
  makeZeros(s.filtered, filteredBytes(shape));
  size_t at = 0;
  for (const ColumnPlace& c : shape.columns())
    if (c.bytes) {
      filter(c, section.data() + payload_at + c.offset, s.filtered.data() + at);
      at += c.bytes;
    }
  unsigned char* const payload = section.data() + payload_at;
  const size_t got =
      ZSTD_compressCCtx(s.to, payload, shape.payloadBytes(), s.filtered.data(), at, kLevel);
  const bool fits = !zstdFailed(got);
  if (!fits && ZSTD_getErrorCode(got) != ZSTD_error_dstSize_tooSmall)
    fail(Status::kInternal, "zstd: %s", ZSTD_getErrorName(got));
  // Where less than an eighth is saved, columns that can be used in place are worth more.
  const bool pays = fits && alignUp(got) <= shape.payloadBytes() - shape.payloadBytes() / 8;
  if (pays) {
    section.resize(payload_at + got);
    return got;
  }
  std::memset(payload, 0, shape.payloadBytes());
  unfilter(shape, s.filtered.data(), payload);
  return 0;
}

bool Codec::decompress(const ChunkShape& shape, const unsigned char* stored, size_t stored_bytes,
                       unsigned char* payload) {
  State& s = *state_;
  s.makeDecompressor();
  const size_t bytes = filteredBytes(shape);
  if (ZSTD_getFrameContentSize(stored, stored_bytes) != bytes) return false;
  makeZeros(s.filtered, bytes);
  const size_t got = ZSTD_decompressDCtx(s.from, s.filtered.data(), bytes, stored, stored_bytes);
  if (zstdFailed(got) || got != bytes) return false;
  unfilter(shape, s.filtered.data(), payload);
  return true;
}

bool Codec::decompressFirst(const ChunkShape& shape, const unsigned char* stored,
                            size_t stored_bytes, unsigned char* column) {
  State& s = *state_;
  s.makeDecompressor();
  if (ZSTD_getFrameContentSize(stored, stored_bytes) != filteredBytes(shape)) return false;
  makeZeros(s.filtered, shape[0].bytes);
  ZSTD_DCtx_reset(s.from, ZSTD_reset_session_only);
  ZSTD_inBuffer in{stored, stored_bytes, 0};
  ZSTD_outBuffer out{s.filtered.data(), shape[0].bytes, 0};
  while (out.pos < out.size) {
    const size_t before = in.pos + out.pos;
    const size_t more = ZSTD_decompressStream(s.from, &out, &in);
    if (zstdFailed(more) || in.pos + out.pos == before) return false;
  }
  filterBack(shape[0], s.filtered.data(), column);
  return true;
}

#else

struct Codec::State {};
Codec::Codec() = default;
Codec::~Codec() = default;
bool Codec::builtIn() {
  return false;
}
size_t Codec::compress(const ChunkShape&, size_t, std::vector<unsigned char>&) {
  return 0;
}
bool Codec::decompress(const ChunkShape&, const unsigned char*, size_t, unsigned char*) {
  return false;
}
bool Codec::decompressFirst(const ChunkShape&, const unsigned char*, size_t, unsigned char*) {
  return false;
}

#endif

}  // namespace tetstream::tets
