// layout: the order of records by small keys, by counting: 4 bytes a record and 4 a key. Depends on
// memory.h.
#pragma once

#include "memory.h"

namespace tetstream {

// Keys are below `keys`; equal ones stay as they came. First every record's key is counted, then
// each is put, in the same order.
class CountedOrder {
 public:
  CountedOrder(uint64_t records, uint64_t keys, Account& account);
  static uint64_t bytesFor(uint64_t records, uint64_t keys);

  void count(uint32_t key) { ++starts_[key]; }
  void beginPutting();
  void put(uint32_t key, uint32_t record) { records_[starts_[key]++] = record; }

  size_t size() const { return records_.size(); }
  uint32_t operator[](size_t place) const { return records_[place]; }

 private:
  Array<uint32_t> starts_, records_;  // of a key: the place of the next record that has it
};

}  // namespace tetstream
