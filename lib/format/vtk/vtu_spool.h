// format/vtk: one array of a .vtu file on its way out: collected, compressed in blocks and kept in
// a temporary file until the sizes that stand before it are known. Depends on column_spool.h.
#pragma once

#include <zlib.h>

#include <vector>

#include "column_spool.h"

namespace tetstream {

// Zlib, set up once for all blocks of all arrays.
class BlockCompressor {
 public:
  BlockCompressor();
  ~BlockCompressor();
  BlockCompressor(const BlockCompressor&) = delete;
  BlockCompressor& operator=(const BlockCompressor&) = delete;
  // The compressed bytes, which live until the next call.
  const std::vector<unsigned char>& compress(const void* data, size_t size);

 private:
  z_stream stream_{};
  std::vector<unsigned char> out_;
};

// Deflate looks back 32 KiB, so larger blocks hardly compress better, and every array holds one.
constexpr size_t kVtuBlockBytes = 1 << 17;

class VtuSpool {
 public:
  // Without a compressor the bytes stay as they are.
  VtuSpool(const std::string& temp_dir, BlockCompressor* compressor);

  void append(const void* data, size_t size);
  // After the last append.
  void close();
  uint64_t encodedBytes() const;  // what write will write
  void write(BufferedSink& sink);

 private:
  void endBlock();
  void writeWord(BufferedSink& sink, uint64_t word) { sink.write(&word, sizeof word); }

  BlockCompressor* compressor_;
  ColumnSpool file_;  // compressed blocks, each after its size in 4 bytes; or the bytes as they are
  std::vector<unsigned char> block_;
  uint64_t plain_bytes_ = 0, block_count_ = 0, compressed_bytes_ = 0;
};

}  // namespace tetstream
