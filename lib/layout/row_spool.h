// layout: rows of fixed width, written in one order and read in another. Depends on base.
#pragma once

#include <vector>

#include "bytes.h"

namespace tetstream {

// Rows go to an unnamed temporary file; reading keeps a few blocks in memory, so that orders that
// are near the written one cost few system calls.
class RowSpool {
 public:
  RowSpool(size_t row_bytes, const std::string& temp_dir);
  void append(const void* rows, size_t count);
  void finish();                    // before the first read
  const void* row(uint64_t index);  // lives until the next call

 private:
  static constexpr size_t kBlocks = 64;
  static constexpr size_t kBlockBytes = 32 << 10;

  size_t row_bytes_, rows_per_block_;
  SpoolFile file_;
  std::vector<unsigned char> pending_, cache_;
  std::vector<uint64_t> held_;  // per place of the cache: the block it holds, plus one
};

}  // namespace tetstream
