// layout: records sorted by a 64-bit key, in bounded memory. Depends on row_spool.h.
//
// Runs as large as the memory allows are sorted by the digits of their keys and go to temporary
// files; a tree of losers merges them (Knuth, The Art of Computer Programming 3, section 5.4.1).
// What fits the memory never leaves it.
#pragma once

#include <memory>

#include "memory.h"
#include "row_spool.h"

namespace tetstream {

class ExternalSort {
 public:
  // Records are a key and `payload_bytes` more. The memory is charged to the account.
  ExternalSort(size_t payload_bytes, size_t memory_bytes, Account& account,
               const std::string& temp_dir);
  ~ExternalSort();

  // Room for the payload of one more record, to be filled before the next call.
  unsigned char* add(uint64_t key);
  bool empty() const { return count_ == 0 && runs_.empty(); }  // before finish
  // Then the records in the order of their keys, equal ones as they came; null at the end. A
  // payload lives until the next call.
  void finish();
  const unsigned char* next(uint64_t* key);

  uint64_t diskBytes() const { return most_on_disk_; }  // of temporary files at once, at most

 private:
  struct Entry {
    uint64_t key;
    uint32_t row;
  };
  class Merge;

  void sortRun();
  void flushRun();
  std::unique_ptr<RowSpool> mergeRuns(size_t first, size_t count);
  void mergeFullLevels();
  void mergeLast(size_t first, unsigned level);
  void mergeUntilFew();
  void countDisk(uint64_t more);
  SpoolShape shapeOfRun() const;

  size_t payload_bytes_, memory_bytes_, rows_at_once_;
  std::string temp_dir_;
  Array<Entry> entries_, scratch_;
  Array<unsigned char> payloads_;
  std::vector<unsigned char> record_;
  size_t count_ = 0, at_ = 0;  // of the run in memory
  std::vector<std::unique_ptr<RowSpool>> runs_;
  std::vector<unsigned> levels_;  // of each run: how often its records were merged
  std::unique_ptr<Merge> merge_;
  uint64_t on_disk_ = 0, most_on_disk_ = 0;
};

}  // namespace tetstream
