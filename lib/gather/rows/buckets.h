// gather/rows: rows that are worked on in memory a part at a time, each part in a temporary file
// until then. Depends on column_spool.h, memory.h, rows_at_once.h.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "column_spool.h"
#include "memory.h"
#include "rows_at_once.h"

namespace tetstream {

// How many buckets so many rows want: each is in memory once, and is a file with a buffer before.
constexpr size_t bucketsFor(uint64_t rows, size_t row_bytes) {
  constexpr uint64_t kBucketBytes = uint64_t{16} << 20, kMostBuckets = 256;
  return static_cast<size_t>(std::min(rows * row_bytes / kBucketBytes + 1, kMostBuckets));
}

// Rows in files, by bucket.
template <class Row>
class Buckets {
 public:
  Buckets(size_t count, const std::string& temp_dir) {
    for (size_t i = 0; i < count; ++i) files_.push_back(std::make_unique<ColumnSpool>(temp_dir));
  }
  size_t count() const { return files_.size(); }
  void add(size_t bucket, const Row& row) { files_[bucket]->append(&row, sizeof row); }
  // The rows of a bucket, sorted. Its file is gone afterwards.
  Array<Row> take(size_t bucket, Account& account) {
    ColumnSpool& file = *files_[bucket];
    file.close();
    Array<Row> rows(account, static_cast<size_t>(file.size() / sizeof(Row)));
    if (rows.size() > 0) file.readAt(0, rows.data(), static_cast<size_t>(file.size()));
    std::sort(rows.data(), rows.data() + rows.size());
    files_[bucket].reset();
    return rows;
  }
  // use(row) for the rows of a bucket in the order in which they came, of which there may be any
  // number. Its file is gone afterwards.
  template <class Use>
  void empty(size_t bucket, Use use) {
    ColumnSpool& file = *files_[bucket];
    file.close();
    const uint64_t count = file.size() / sizeof(Row);
    std::vector<Row> rows(kRowsAtOnce);
    for (uint64_t at = 0; at < count; at += kRowsAtOnce) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, count - at));
      file.readAt(at * sizeof(Row), rows.data(), n * sizeof(Row));
      for (size_t i = 0; i < n; ++i) use(rows[i]);
    }
    files_[bucket].reset();
  }

 private:
  std::vector<std::unique_ptr<ColumnSpool>> files_;
};

}  // namespace tetstream
