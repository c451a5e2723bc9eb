#include "vtu_blocks.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

constexpr size_t kInputBytes = 1 << 15;
constexpr size_t kMaxParts = 4096;  // the table of a huge array is read again, in this many parts
constexpr size_t kTableWords = 3;

static constexpr VtuCompressor kCompressors[] = {
    {"vtkZLibDataCompressor", openZlibBlocks},
#ifdef TETSTREAM_WITH_LZ4
    {"vtkLZ4DataCompressor", openLz4Blocks},
#endif
#ifdef TETSTREAM_WITH_LZMA
    {"vtkLZMADataCompressor", openLzmaBlocks},
#endif
};

const VtuCompressor* findVtuCompressor(const std::string& name) {
  for (const VtuCompressor& row : kCompressors)
    if (name == row.name) return &row;
  return nullptr;
}

std::string vtuCompressorNames() {
  std::string names;
  for (const VtuCompressor& row : kCompressors)
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

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

// ------------------------------------------------------------------------------------- the table

BlockTable::BlockTable(const EncodedRun& run, const VtuFile& file, uint64_t size,
                       uint64_t max_ratio)
    : run_(run), file_(file) {
  readHeader(size);
  const uint64_t header_bytes = (kTableWords + count_) * file.word_bytes;
  if (header_bytes > run_.capacity()) fail("the file ends inside the block table");
  walk(size, run_.after(header_bytes).capacity(), max_ratio);
}

EncodedRun BlockTable::blocks() const {
  return run_.after((kTableWords + count_) * file_.word_bytes);
}

void BlockTable::locate(uint64_t block, uint64_t* begin, uint64_t* size) {
  const uint64_t part = block / stride_;
  if (part != part_) loadPart(part);
  const size_t at = static_cast<size_t>(block - part * stride_);
  *begin = starts_[at];
  *size = starts_[at + 1] - starts_[at];
}

void BlockTable::fail(const char* text) const {
  tetstream::fail(Status::kBadData, "%s: %s", run_.what().c_str(), text);
}

void BlockTable::readHeader(uint64_t size) {
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
void BlockTable::walk(uint64_t size, uint64_t available, uint64_t max_ratio) {
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
      if (plain / max_ratio > sizes[i]) fail("a block claims to hold more than it can");
      sum += sizes[i];
    }
  }
}

void BlockTable::readSizes(uint64_t first, uint64_t* out, size_t n) {
  readVtuWords(run_, (kTableWords + first) * file_.word_bytes, file_, out, n);
}

void BlockTable::loadPart(uint64_t part) {
  const uint64_t first = part * stride_;
  const size_t n = static_cast<size_t>(std::min<uint64_t>(stride_, count_ - first));
  part_ = UINT64_MAX;
  starts_.resize(n + 1);
  readSizes(first, starts_.data() + 1, n);
  starts_[0] = marks_[part];
  for (size_t i = 0; i < n; ++i) starts_[i + 1] += starts_[i];
  part_ = part;
}

// ---------------------------------------------------------------------------- blocks as they come

namespace {

class StreamedBlocks final : public ValueBytes {
 public:
  StreamedBlocks(BlockTable table, const EncodedRun& run, uint64_t size,
                 std::unique_ptr<BlockDecoder> decoder)
      : table_(std::move(table)),
        blocks_(table_.blocks()),
        size_(size),
        decoder_(std::move(decoder)),
        input_(static_cast<size_t>(std::min<uint64_t>(kInputBytes, blocks_.capacity()))),
        what_(run.what()) {}

  void readAt(uint64_t offset, void* out, size_t size) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      const uint64_t block = offset / table_.blockBytes();
      const uint64_t within = offset - block * table_.blockBytes();
      if (block != block_ || within < at_) startBlock(block);
      skipTo(within);
      const size_t n = static_cast<size_t>(std::min<uint64_t>(size, block_size_ - within));
      decodeTo(to, n);
      to += n;
      offset += n;
      size -= n;
    }
  }

 private:
  [[noreturn]] void fail(const char* text) const {
    tetstream::fail(Status::kBadData, "%s: compressed block %llu (byte %llu of the values): %s",
                    what_.c_str(), static_cast<unsigned long long>(block_),
                    static_cast<unsigned long long>(block_ * table_.blockBytes() + at_), text);
  }

  // True at the block's end.
  bool take(BlockDecoder::Result result) const {
    if (result == BlockDecoder::Result::kNoMemory)
      tetstream::fail(Status::kNoMemory, "%s: no memory to decompress it", what_.c_str());
    if (result == BlockDecoder::Result::kDamaged) fail(decoder_->problem());
    return result == BlockDecoder::Result::kEnd;
  }

  void startBlock(uint64_t block) {
    block_ = UINT64_MAX;  // until it is started
    uint64_t compressed;
    table_.locate(block, &input_at_, &compressed);
    input_end_ = input_at_ + compressed;
    take(decoder_->start());
    buffers_.in_size = 0;
    at_ = 0;
    block_size_ = std::min(table_.blockBytes(), size_ - block * table_.blockBytes());
    block_ = block;
  }

  void skipTo(uint64_t within) {
    unsigned char scratch[4096];
    while (at_ < within)
      decodeTo(scratch, static_cast<size_t>(std::min<uint64_t>(sizeof scratch, within - at_)));
  }

  void refill() {
    const size_t n = static_cast<size_t>(std::min<uint64_t>(input_.size(), input_end_ - input_at_));
    if (n == 0) fail("it ends too early");
    blocks_.readAt(input_at_, input_.data(), n);
    input_at_ += n;
    buffers_.in = input_.data();
    buffers_.in_size = n;
  }

  bool step(unsigned char* out, size_t size) {
    if (buffers_.in_size == 0) refill();
    buffers_.out = out;
    buffers_.out_size = size;
    return take(decoder_->step(buffers_));
  }

  void decodeTo(unsigned char* out, size_t size) {
    constexpr size_t kMostAtOnce = 1 << 30;  // zlib counts in 32 bits
    while (size > 0) {
      const size_t n = std::min(size, kMostAtOnce);
      const bool ended = step(out, n);
      const size_t made = n - buffers_.out_size;
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
      const bool ended = step(&extra, 1);
      if (buffers_.out_size == 0) fail("it holds more bytes than it should");
      if (ended) return;
    }
  }

  BlockTable table_;
  EncodedRun blocks_;
  uint64_t size_;
  std::unique_ptr<BlockDecoder> decoder_;
  std::vector<unsigned char> input_;
  std::string what_;
  BlockDecoder::Buffers buffers_;
  uint64_t block_ = UINT64_MAX, at_ = 0, block_size_ = 0;  // the open block, bytes made of it
  uint64_t input_at_ = 0, input_end_ = 0;                  // of the blocks' bytes
};

}  // namespace

std::unique_ptr<ValueBytes> openStreamedBlocks(BlockTable table, const EncodedRun& run,
                                               uint64_t size,
                                               std::unique_ptr<BlockDecoder> decoder) {
  return std::make_unique<StreamedBlocks>(std::move(table), run, size, std::move(decoder));
}

}  // namespace tetstream
