#include "cell_front.h"

#include <algorithm>

namespace tetstream {

CellFront::CellFront(uint64_t vertices, Account& account)
    : numbers_(account, static_cast<size_t>(vertices)),
      ends_(account, static_cast<size_t>(vertices)),
      is_final_(account, static_cast<size_t>(vertices)) {
  std::fill_n(numbers_.data(), numbers_.size(), kNone);
  std::fill_n(ends_.data(), ends_.size(), 0u);
  std::fill_n(is_final_.data(), is_final_.size(), uint8_t{0});
}

unsigned CellFront::takeLast(const uint32_t corners[4], uint32_t place) {
  unsigned uses = 0;
  uint32_t latest = corners[0];
  for (unsigned j = 0; j < 4; ++j) {
    uint32_t& last = numbers_[corners[j]];
    if (last == kNone) {
      last = place;
      uses |= 1u << j;
    }
    if (last > numbers_[latest]) latest = corners[j];
  }
  ++ends_[latest];
  return uses;
}

void CellFront::turnRound() {
  std::fill_n(numbers_.data(), numbers_.size(), kNone);
}

void CellFront::introduce(uint32_t vertex) {
  if (active_ == 0) lowest_ = introduced_;
  numbers_[vertex] = static_cast<uint32_t>(introduced_++);
  statistics_.width = std::max(statistics_.width, ++active_);
  statistics_.span = std::max(statistics_.span, introduced_ - lowest_);
}

void CellFront::finalize(uint32_t vertex) {
  live_cells_ -= ends_[vertex];
  is_final_[numbers_[vertex]] = 1;
  if (--active_ > 0)
    while (is_final_[static_cast<size_t>(lowest_)]) ++lowest_;
}

void CellFront::takeFirst(const uint32_t corners[4], unsigned last_uses) {
  for (int j = 0; j < 4; ++j)
    if (numbers_[corners[j]] == kNone) introduce(corners[j]);
  ++live_cells_;
  for (int j = 0; j < 4; ++j)
    if (last_uses >> j & 1) finalize(corners[j]);
  statistics_.cells = std::max(statistics_.cells, live_cells_);
}

void CellFront::finish() {
  ends_.resize(0);
  is_final_.resize(0);
}

}  // namespace tetstream
