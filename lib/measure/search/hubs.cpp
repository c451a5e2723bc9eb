#include "hubs.h"

#include <algorithm>
#include <bit>

#include "row_number.h"

namespace tetstream {

// Zeros are one place, whatever their signs.
static uint64_t numberAt(const double place[3]) {
  const double at[3] = {place[0] + 0.0, place[1] + 0.0, place[2] + 0.0};
  return numberOf(at, 3, 0);
}

// visit(place, its number) for the corners of the sample.
template <class Visit>
static void forCorners(const RowView& rows, Visit&& visit) {
  const size_t step = rows.count / Hubs::kSample + 1;
  for (size_t i = 0; i < rows.count; i += step)
    for (size_t c = 0; c < rows.shape.corners; ++c) {
      const double* const place = rows.shape.place(rows.row(i), c);
      visit(place, numberAt(place));
    }
}

// Counted by some bits of their numbers first, about four corners to a count: the few counts that
// are high have all corners of hubs.
Hubs::Hubs(const RowView& rows, Account& account) {
  Array<uint32_t> counts(account, std::bit_ceil(std::min(rows.count, kSample) + 1));
  std::fill_n(counts.data(), counts.size(), 0u);
  const auto countOf = [&](uint64_t number) -> uint32_t& {
    return counts[static_cast<size_t>(number) & (counts.size() - 1)];
  };
  forCorners(rows, [&](const double*, uint64_t number) { ++countOf(number); });
  size_t many = 0;
  for (size_t i = 0; i < counts.size(); ++i) many += counts[i] >= kManyRows ? counts[i] : 0;
  if (many == 0) return;
  Array<uint64_t> numbers(account, many);
  many = 0;
  forCorners(rows, [&](const double*, uint64_t number) {
    if (countOf(number) >= kManyRows) numbers[many++] = number;
  });
  std::sort(numbers.data(), numbers.data() + many);
  for (size_t i = 0, end; i < many; i = end) {
    for (end = i; end < many && numbers[end] == numbers[i];) ++end;
    if (end - i >= kManyRows) hubs_.push_back({numbers[i], {}});
  }
  forCorners(rows, [&](const double* place, uint64_t number) {
    if (const uint32_t hub = findNumber(number); hub != kNone)
      std::copy_n(place, 3, hubs_[hub].place);
  });
}

uint32_t Hubs::findNumber(uint64_t number) const {
  const auto at = std::lower_bound(hubs_.begin(), hubs_.end(), number,
                                   [](const Hub& hub, uint64_t n) { return hub.number < n; });
  const bool is_there = at != hubs_.end() && at->number == number;
  return is_there ? static_cast<uint32_t>(at - hubs_.begin()) : kNone;
}

uint32_t Hubs::find(const double place[3]) const {
  return hubs_.empty() ? kNone : findNumber(numberAt(place));
}

}  // namespace tetstream
