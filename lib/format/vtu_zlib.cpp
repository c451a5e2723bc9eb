#include "vtu_zlib.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "status.h"

namespace tetstream {

static uint64_t wordAt(const unsigned char* bytes, size_t size, bool big_endian) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value = value << 8 | bytes[big_endian ? i : size - 1 - i];
  return value;
}

void readVtuWords(EncodedRun& run, uint64_t offset, const VtuFile& file, uint64_t* out,
                  size_t count) {
  unsigned char bytes[4096];
  const size_t size = file.word_bytes;
  while (count > 0) {
    const size_t n = std::min(count, sizeof bytes / size);
    run.readAt(offset, bytes, n * size);
    for (size_t i = 0; i < n; ++i) *out++ = wordAt(bytes + i * size, size, file.big_endian);
    offset += n * size;
    count -= n;
  }
}

uint64_t readVtuWord(EncodedRun& run, uint64_t offset, const VtuFile& file) {
  uint64_t word;
  readVtuWords(run, offset, file, &word, 1);
  return word;
}

namespace {

constexpr size_t kInputBytes = 1 << 15;
constexpr size_t kMaxParts = 4096;  // the table of a huge array is read again, in this many parts
constexpr size_t kHeaderWords = 3;
// Deflate makes at most 1032 bytes of one. A block that claims more is a lie.
constexpr uint64_t kMaxRatio = 1040;

// Where each block begins, in bounded memory: the table stays in the file, except for a mark every
// `stride` blocks and the part of it that was used last.
class BlockTable {
 public:
  BlockTable(const EncodedRun& run, const VtuFile& file, uint64_t size)
      : run_(run), file_(file), block_bytes_(0) {
    readHeader(size);
    const uint64_t header_bytes = (kHeaderWords + count_) * file.word_bytes;
    if (header_bytes > run_.capacity()) fail("the file ends inside the block table");
    walk(size, run_.after(header_bytes).capacity());
  }

  uint64_t blockBytes() const { return block_bytes_; }
  EncodedRun blocks() const { return run_.after((kHeaderWords + count_) * file_.word_bytes); }

  void locate(uint64_t block, uint64_t* begin, uint64_t* size) {
    const uint64_t part = block / stride_;
    if (part != part_) loadPart(part);
    const size_t at = static_cast<size_t>(block - part * stride_);
    *begin = starts_[at];
    *size = starts_[at + 1] - starts_[at];
  }

 private:
  [[noreturn]] void fail(const char* text) const {
    tetstream::fail(Status::kBadData, "%s: %s", run_.what().c_str(), text);
  }

  void readHeader(uint64_t size) {
    count_ = readVtuWord(run_, 0, file_);
    if (count_ == 0) fail("there are no values where the counts need some");
    uint64_t words[2];
    readVtuWords(run_, file_.word_bytes, file_, words, 2);
    block_bytes_ = words[0];
    const uint64_t last = words[1] ? words[1] : block_bytes_;
    // note: count - 1 blocks fit into size once it was compared, so nothing here can overflow.
    if (block_bytes_ == 0 || last > block_bytes_ || count_ - 1 > size / block_bytes_ ||
        last != size - (count_ - 1) * block_bytes_)
      tetstream::fail(Status::kBadData,
                      "%s: %llu blocks of %llu bytes, the last of %llu, are not the %llu bytes "
                      "that the counts need",
                      run_.what().c_str(), static_cast<unsigned long long>(count_),
                      static_cast<unsigned long long>(block_bytes_),
                      static_cast<unsigned long long>(last), static_cast<unsigned long long>(size));
    if (count_ > UINT64_MAX / 16) fail("the block table is longer than any file");
  }

  // Checks every entry once and places the marks.
  void walk(uint64_t size, uint64_t available) {
    stride_ = (count_ - 1) / kMaxParts + 1;
    uint64_t sizes[512], sum = 0;
    for (uint64_t first = 0; first < count_; first += std::size(sizes)) {
      const size_t n = static_cast<size_t>(std::min<uint64_t>(std::size(sizes), count_ - first));
      readSizes(first, sizes, n);
      for (size_t i = 0; i < n; ++i) {
        const uint64_t block = first + i;
        const uint64_t plain = std::min(block_bytes_, size - block * block_bytes_);
        if (block % stride_ == 0) marks_.push_back(sum);
        if (sizes[i] > available - sum) fail("the file ends before the compressed blocks do");
        if (plain / kMaxRatio > sizes[i]) fail("a block claims to hold more than it can");
        sum += sizes[i];
      }
    }
  }

  void readSizes(uint64_t first, uint64_t* out, size_t n) {
    readVtuWords(run_, (kHeaderWords + first) * file_.word_bytes, file_, out, n);
  }

  void loadPart(uint64_t part) {
    const uint64_t first = part * stride_;
    const size_t n = static_cast<size_t>(std::min<uint64_t>(stride_, count_ - first));
    part_ = UINT64_MAX;
    starts_.resize(n + 1);
    readSizes(first, starts_.data() + 1, n);
    starts_[0] = marks_[part];
    for (size_t i = 0; i < n; ++i) starts_[i + 1] += starts_[i];
    part_ = part;
  }

  EncodedRun run_;
  const VtuFile& file_;
  uint64_t count_ = 0, block_bytes_, stride_ = 1, part_ = UINT64_MAX;
  std::vector<uint64_t> marks_, starts_;
};

// Inflates as it is read, never a whole block at once: a block may be as large as the array.
class ZlibBlocks final : public VtuBytes {
 public:
  ZlibBlocks(const EncodedRun& run, const VtuFile& file, uint64_t size)
      : table_(run, file, size), blocks_(table_.blocks()), size_(size) {
    input_.resize(std::min<uint64_t>(kInputBytes, blocks_.capacity()));
    if (inflateInit(&stream_) != Z_OK)
      tetstream::fail(Status::kNoMemory, "%s: no memory for zlib", run.what().c_str());
  }
  ~ZlibBlocks() override { inflateEnd(&stream_); }
  ZlibBlocks(const ZlibBlocks&) = delete;
  ZlibBlocks& operator=(const ZlibBlocks&) = delete;

  void readAt(uint64_t offset, void* out, size_t size) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      const uint64_t block = offset / table_.blockBytes();
      const uint64_t within = offset - block * table_.blockBytes();
      if (block != block_ || within < at_) startBlock(block);
      skipTo(within);
      const size_t n = static_cast<size_t>(std::min<uint64_t>(size, block_size_ - within));
      inflateTo(to, n);
      to += n;
      offset += n;
      size -= n;
    }
  }

 private:
  [[noreturn]] void fail(const char* text) const {
    tetstream::fail(Status::kBadData, "%s: compressed block %llu (byte %llu of the values): %s",
                    blocks_.what().c_str(), static_cast<unsigned long long>(block_),
                    static_cast<unsigned long long>(block_ * table_.blockBytes() + at_), text);
  }

  void startBlock(uint64_t block) {
    block_ = UINT64_MAX;  // until it is started
    uint64_t compressed;
    table_.locate(block, &input_at_, &compressed);
    input_end_ = input_at_ + compressed;
    inflateReset(&stream_);
    stream_.avail_in = 0;
    at_ = 0;
    block_size_ = std::min(table_.blockBytes(), size_ - block * table_.blockBytes());
    block_ = block;
  }

  void skipTo(uint64_t within) {
    unsigned char scratch[4096];
    while (at_ < within)
      inflateTo(scratch, static_cast<size_t>(std::min<uint64_t>(sizeof scratch, within - at_)));
  }

  void refill() {
    const size_t n = static_cast<size_t>(std::min<uint64_t>(input_.size(), input_end_ - input_at_));
    if (n == 0) fail("it ends too early");
    blocks_.readAt(input_at_, input_.data(), n);
    input_at_ += n;
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(n);
  }

  int step() {
    if (stream_.avail_in == 0) refill();
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_MEM_ERROR)
      tetstream::fail(Status::kNoMemory, "%s: no memory for zlib", blocks_.what().c_str());
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
      fail(stream_.msg ? stream_.msg : "it is damaged");
    return result;
  }

  void inflateTo(unsigned char* out, size_t size) {
    constexpr size_t kMostAtOnce = 1 << 30;  // zlib counts in 32 bits
    while (size > 0) {
      const size_t n = std::min(size, kMostAtOnce);
      stream_.next_out = out;
      stream_.avail_out = static_cast<uInt>(n);
      const bool ended = step() == Z_STREAM_END;
      const size_t made = n - stream_.avail_out;
      out += made;
      size -= made;
      at_ += made;
      if (ended && at_ < block_size_) fail("it holds fewer bytes than it should");
      if (ended) return;
    }
    if (at_ == block_size_) finishBlock();
  }

  // To the end of the stream, so that its checksum is compared.
  void finishBlock() {
    unsigned char extra;
    for (;;) {
      stream_.next_out = &extra;
      stream_.avail_out = 1;
      const int result = step();
      if (stream_.avail_out == 0) fail("it holds more bytes than it should");
      if (result == Z_STREAM_END) return;
    }
  }

  BlockTable table_;
  EncodedRun blocks_;
  uint64_t size_;
  std::vector<unsigned char> input_;
  z_stream stream_{};
  uint64_t block_ = UINT64_MAX, at_ = 0, block_size_ = 0;  // the open block, bytes inflated of it
  uint64_t input_at_ = 0, input_end_ = 0;                  // of the blocks' bytes
};

}  // namespace

std::unique_ptr<VtuBytes> openZlibBlocks(const EncodedRun& run, const VtuFile& file,
                                         uint64_t size) {
  return std::make_unique<ZlibBlocks>(run, file, size);
}

}  // namespace tetstream
