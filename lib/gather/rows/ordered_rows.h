// gather/rows: rows of any width that come in any order, each once, and are then read in that of
// their places, in bounded memory and without a look at the disk for each. Depends on buckets.h,
// row_spool.h.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "buckets.h"
#include "row_spool.h"

namespace tetstream {

// Rows are taken apart into words, which are sorted by where they go.
class OrderedRows {
 public:
  OrderedRows(uint64_t rows, size_t row_bytes, const std::string& temp_dir)
      : row_bytes_(row_bytes),
        words_(std::max<size_t>((row_bytes + sizeof(uint64_t) - 1) / sizeof(uint64_t), 1)),
        buckets_(bucketsFor(rows * words_, sizeof(Word)), temp_dir),
        part_(rows * words_ / buckets_.count() + 1),
        row_(words_),
        rows_(words_ * sizeof(uint64_t), temp_dir, kSpooledInSequence) {}

  void put(uint64_t place, const void* row) {
    std::memcpy(row_.data(), row, row_bytes_);
    for (size_t w = 0; w < words_; ++w) {
      const uint64_t index = place * words_ + w;
      buckets_.add(static_cast<size_t>(index / part_), {index, row_[w]});
    }
  }

  // After the last, which is one of every place; before rows are read.
  void finish() {
    Account account;
    size_t w = 0;
    for (size_t bucket = 0; bucket < buckets_.count(); ++bucket) {
      const Array<Word> words = buckets_.take(bucket, account);
      for (size_t i = 0; i < words.size(); ++i) {
        row_[w++] = words[i].value;
        if (w == words_) rows_.append(row_.data(), 1);
        w %= words_;
      }
    }
    rows_.finish();
  }

  // Lives until the next call.
  const unsigned char* row(uint64_t place) {
    return static_cast<const unsigned char*>(rows_.row(place));
  }

 private:
  struct Word {
    uint64_t index, value;
    bool operator<(const Word& other) const { return index < other.index; }
  };

  size_t row_bytes_, words_;  // of a row
  Buckets<Word> buckets_;
  uint64_t part_;  // words to a bucket
  std::vector<uint64_t> row_;
  RowSpool rows_;
};

}  // namespace tetstream
