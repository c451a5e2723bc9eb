// gather/rows: rows brought together by their labels, in the order in which they come, in bounded
// memory. Depends on buckets.h, row_spool.h.
#pragma once

#include <map>
#include <string>

#include "buckets.h"
#include "row_spool.h"

namespace tetstream {

template <class Row>
class GroupedRows {
 public:
  // How many rows of each label there will be.
  GroupedRows(const std::map<int64_t, uint64_t>& counts, const std::string& temp_dir)
      : next_(firstOf(counts)),
        total_(totalOf(counts)),
        buckets_(bucketsFor(total_, sizeof(Placed)), temp_dir),
        part_(total_ / buckets_.count() + 1),
        rows_(sizeof(Row), temp_dir) {}

  // Returns its place among all, from 0: groups follow each other by label.
  uint64_t add(int64_t label, const Row& row) {
    const uint64_t place = next_.at(label)++;
    buckets_.add(static_cast<size_t>(place / part_), {place, row});
    return place;
  }

  // After the last; before rows are read.
  void finish() {
    Account account;
    for (size_t bucket = 0; bucket < buckets_.count(); ++bucket) {
      const Array<Placed> placed = buckets_.take(bucket, account);
      for (size_t i = 0; i < placed.size(); ++i) rows_.append(&placed[i].row, 1);
    }
    rows_.finish();
  }
  RowSpool& rows() { return rows_; }

 private:
  struct Placed {
    uint64_t place;
    Row row;
    bool operator<(const Placed& other) const { return place < other.place; }
  };
  static std::map<int64_t, uint64_t> firstOf(const std::map<int64_t, uint64_t>& counts) {
    std::map<int64_t, uint64_t> first;
    uint64_t sum = 0;
    for (const auto& [label, count] : counts) {
      first[label] = sum;
      sum += count;
    }
    return first;
  }
  static uint64_t totalOf(const std::map<int64_t, uint64_t>& counts) {
    uint64_t sum = 0;
    for (const auto& [label, count] : counts) sum += count;
    return sum;
  }

  std::map<int64_t, uint64_t> next_;
  uint64_t total_;
  Buckets<Placed> buckets_;
  uint64_t part_;
  RowSpool rows_;
};

}  // namespace tetstream
