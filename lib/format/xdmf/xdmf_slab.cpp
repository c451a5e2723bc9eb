#include "xdmf_slab.h"

#include <algorithm>
#include <cstring>

#include "rows_at_once.h"

namespace tetstream {

namespace {

// Runs that are shorter are picked out of what is read together.
constexpr uint64_t kLongRun = 256;

class SlabValues final : public Values {
 public:
  SlabValues(std::unique_ptr<Values> values, std::vector<SlabRange> ranges)
      : values_(std::move(values)), ranges_(std::move(ranges)) {
    for (const SlabRange& range : ranges_) size_ *= range.size;
    // What is whole along its direction lies together with its neighbour in the one before.
    while (ranges_.size() > 1) {
      const SlabRange last = ranges_.back();
      SlabRange& before = ranges_[ranges_.size() - 2];
      if (last.count != last.size || before.stride != 1) break;
      before = {before.begin * last.size, 1, before.count * last.size, before.size * last.size};
      ranges_.pop_back();
    }
    run_ = ranges_.back().stride == 1 ? ranges_.back().count : 1;
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    while (count > 0) {
      const auto n = static_cast<size_t>(std::min<uint64_t>(count, run_ - first % run_));
      const uint64_t at = placeOf(first);
      if (n >= kLongRun)
        values_->read(at, n, to, type);
      else
        pick(at, n, to, type);
      to += n * sizeOf(type);
      first += n;
      count -= n;
    }
  }

 private:
  uint64_t placeOf(uint64_t index) const {
    uint64_t place = 0, width = 1;
    for (size_t d = ranges_.size(); d-- > 0;) {
      const SlabRange& range = ranges_[d];
      place += (range.begin + index % range.count * range.stride) * width;
      index /= range.count;
      width *= range.size;
    }
    return place;
  }

  void pick(uint64_t at, size_t count, unsigned char* out, ScalarType type) {
    if (type != held_type_ || at < held_first_ || at + count > held_first_ + held_count_) {
      held_count_ = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, size_ - at));
      held_first_ = at;
      held_type_ = type;
      values_->read(at, held_count_, held_, type);
    }
    std::memcpy(out, held_ + (at - held_first_) * sizeOf(type), count * sizeOf(type));
  }

  std::unique_ptr<Values> values_;
  std::vector<SlabRange> ranges_;
  uint64_t size_ = 1, run_ = 1;
  uint64_t held_first_ = 0;
  size_t held_count_ = 0;
  ScalarType held_type_ = ScalarType::kFloat64;
  unsigned char held_[kRowsAtOnce * sizeof(double)];
};

}  // namespace

bool fitsSlab(const SlabRange& range) {
  return range.count > 0 && range.stride > 0 && range.begin < range.size &&
         (range.size - 1 - range.begin) / range.stride >= range.count - 1;
}

std::unique_ptr<Values> openSlab(std::unique_ptr<Values> values, std::vector<SlabRange> ranges) {
  return std::make_unique<SlabValues>(std::move(values), std::move(ranges));
}

}  // namespace tetstream
