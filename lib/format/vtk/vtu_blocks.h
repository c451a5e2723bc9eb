// format/vtk: the compressed blocks of one array of a .vtu file. Depends on vtu_run.h.
//
// Layout: words n, block size, size of the last block if it is shorter (else 0), n compressed
// sizes; then the n blocks, each compressed on its own. In base64, words and blocks are two texts.
#pragma once

#include <memory>
#include <vector>

#include "vtu_run.h"

namespace tetstream {

// Where each block begins, in bounded memory: the table stays in the file, except for a mark every
// so-many blocks and the part of it that was used last.
class BlockTable {
 public:
  // Blocks that claim to hold more than max_ratio times their bytes are refused.
  BlockTable(const EncodedRun& run, const VtuFile& file, uint64_t size, uint64_t max_ratio);

  uint64_t blockBytes() const { return block_bytes_; }
  EncodedRun blocks() const;
  void locate(uint64_t block, uint64_t* begin, uint64_t* size);

 private:
  [[noreturn]] void fail(const char* text) const;
  void readHeader(uint64_t size);
  void walk(uint64_t size, uint64_t available, uint64_t max_ratio);
  void readSizes(uint64_t first, uint64_t* out, size_t n);
  void loadPart(uint64_t part);

  EncodedRun run_;
  const VtuFile& file_;
  uint64_t count_ = 0, block_bytes_ = 0, stride_ = 1, part_ = UINT64_MAX;
  std::vector<uint64_t> marks_, starts_;
};

// Undoes one block after the other, some bytes at a time.
class BlockDecoder {
 public:
  struct Buffers {  // step moves them on
    const unsigned char* in = nullptr;
    size_t in_size = 0;
    unsigned char* out = nullptr;
    size_t out_size = 0;
  };
  enum class Result { kMore, kEnd, kDamaged, kNoMemory };

  virtual ~BlockDecoder() = default;
  virtual Result start() = 0;  // of the next block
  virtual Result step(Buffers& buffers) = 0;
  virtual const char* problem() const = 0;  // of what is damaged
};

// Blocks of a compressor whose decoder takes any part: a block may be as large as the array.
std::unique_ptr<ValueBytes> openStreamedBlocks(BlockTable table, const EncodedRun& run,
                                               uint64_t size,
                                               std::unique_ptr<BlockDecoder> decoder);

// The rows of the table of compressors, each in its own file; null where it is not built in.
std::unique_ptr<ValueBytes> openZlibBlocks(const EncodedRun& run, const VtuFile& file,
                                           uint64_t size);
std::unique_ptr<ValueBytes> openLz4Blocks(const EncodedRun& run, const VtuFile& file,
                                          uint64_t size);
std::unique_ptr<ValueBytes> openLzmaBlocks(const EncodedRun& run, const VtuFile& file,
                                           uint64_t size);

struct VtuCompressor {
  const char* name;  // as the header has it
  std::unique_ptr<ValueBytes> (*open)(const EncodedRun& run, const VtuFile& file, uint64_t size);
};
const VtuCompressor* findVtuCompressor(const std::string& name);  // null: there is none such
std::string vtuCompressorNames();

// The length words of an array: 4 or 8 bytes, in the file's byte order.
uint64_t readVtuWord(EncodedRun& run, uint64_t offset, const VtuFile& file);
void readVtuWords(EncodedRun& run, uint64_t offset, const VtuFile& file, uint64_t* out,
                  size_t count);

}  // namespace tetstream
