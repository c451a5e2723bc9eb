// stream: a batch whose arrays are its own, so that it can wait. Depends on batch.h, memory.h.
#pragma once

#include <vector>

#include "batch.h"
#include "memory.h"

namespace tetstream {

// Filled again and again, it takes no memory anew for batches of about the same size.
class BatchCopy {
 public:
  BatchCopy(const Schema& schema, Account& account);

  void take(const BatchView& batch);
  const BatchView& view() const { return view_; }  // until the next take
  size_t bytes() const { return used_; }

 private:
  template <class T>
  void place(const T*& array, size_t rows, size_t bytes_per_row);
  void placeAll(BatchView& batch, bool copies);

  size_t position_bytes_;  // of a row
  std::vector<size_t> field_bytes_, cell_bytes_;
  std::vector<const void*> fields_, cell_data_;
  Array<unsigned char> block_;
  size_t used_ = 0;
  bool copies_ = false;  // else counts what is needed
  BatchView view_;
};

}  // namespace tetstream
