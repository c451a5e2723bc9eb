// base: rows of fixed width, written in one order and read in another. Depends on bytes.h,
// tasks.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bytes.h"
#include "tasks.h"

namespace tetstream {

// How much of a spool is held in memory: blocks of about so many bytes. Orders that are near the
// written one cost few system calls; a single block serves reading in sequence.
struct SpoolShape {
  size_t blocks = 64;
  size_t block_bytes = 32 << 10;
};

// Of rows that are written and read in sequence.
constexpr SpoolShape kSpooledInSequence = {2, 256 << 10};

// Rows go to an unnamed temporary file, each block with a check sum that is looked at when it comes
// back: a file that was damaged is no mesh that is wrong. What fits the memory stays there.
class RowSpool {
 public:
  // With `tasks`, which may be null and are borrowed up to finish, another thread writes some
  // blocks while rows are appended; they take their memory once more. A failure to write comes
  // later then.
  RowSpool(size_t row_bytes, const std::string& temp_dir, SpoolShape shape = {},
           const Tasks* tasks = nullptr);
  ~RowSpool();
  void append(const void* rows, size_t count);
  void finish();                    // before the first read
  const void* row(uint64_t index);  // lives until the next call
  void read(uint64_t first, size_t count, void* out);

  uint64_t rows() const { return rows_; }
  uint64_t diskBytes() const { return file_ ? file_->size() : 0; }

 private:
  class Behind;
  size_t blockBytes() const { return row_bytes_ << shift_; }
  size_t bytesOf(uint64_t block) const;
  void writeBlocks(bool all);
  void readBlock(uint64_t block, size_t place);

  size_t row_bytes_, blocks_;
  unsigned shift_;  // rows in a block: 1 << shift_
  std::string temp_dir_;
  std::optional<SpoolFile> file_;
  const Tasks* tasks_;
  std::optional<Kept<Behind>> behind_;  // once there is a file
  std::vector<unsigned char> held_;     // to be written; then the blocks that are held
  std::vector<uint64_t> block_at_;      // per place: the block it holds, plus one
  uint64_t rows_ = 0;
};

}  // namespace tetstream
