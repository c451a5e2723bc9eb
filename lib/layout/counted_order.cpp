#include "counted_order.h"

#include <algorithm>
#include <utility>

namespace tetstream {

CountedOrder::CountedOrder(uint64_t records, uint64_t keys, Account& account)
    : starts_(account, static_cast<size_t>(keys)), records_(account, static_cast<size_t>(records)) {
  std::fill_n(starts_.data(), starts_.size(), 0u);
}

uint64_t CountedOrder::bytesFor(uint64_t records, uint64_t keys) {
  return (records + keys) * sizeof(uint32_t);
}

void CountedOrder::beginPutting() {
  uint32_t sum = 0;
  for (size_t key = 0; key < starts_.size(); ++key) sum += std::exchange(starts_[key], sum);
}

}  // namespace tetstream
