#include "made_values.h"

#include <algorithm>
#include <cstring>

#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

void writeInteger(int64_t value, ScalarType type, unsigned char* out) {
  convertScalars(&value, ScalarType::kInt64, out, type, 1);
}

class PartValues final : public Values {
 public:
  explicit PartValues(std::vector<ValuesPart> parts) : parts_(std::move(parts)) {
    uint64_t end = 0;
    for (const ValuesPart& part : parts_) ends_.push_back(end += part.count);
  }

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    while (count > 0) {
      const auto found = std::upper_bound(ends_.begin(), ends_.end(), first);
      if (found == ends_.end()) fail(Status::kInternal, "values behind the last part are read");
      const auto part = static_cast<size_t>(found - ends_.begin());
      if (part != open_) values_ = parts_[part].open();
      open_ = part;
      const auto n = static_cast<size_t>(std::min<uint64_t>(count, *found - first));
      values_->read(first - (*found - parts_[part].count), n, to, type);
      to += n * sizeOf(type);
      first += n;
      count -= n;
    }
  }

 private:
  std::vector<ValuesPart> parts_;
  std::vector<uint64_t> ends_;
  size_t open_ = SIZE_MAX;
  std::unique_ptr<Values> values_;
};

class ShiftedValues final : public Values {
 public:
  ShiftedValues(std::unique_ptr<Values> values, int64_t shift)
      : values_(std::move(values)), shift_(shift) {}
  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    int64_t held[kRowsAtOnce];
    for (size_t n; count > 0; first += n, count -= n) {
      n = std::min(count, kRowsAtOnce);
      values_->read(first, n, held, ScalarType::kInt64);
      // Wraps around as unsigned numbers do: what does not fit is no point of any mesh.
      for (size_t i = 0; i < n; ++i, to += sizeOf(type))
        writeInteger(
            static_cast<int64_t>(static_cast<uint64_t>(held[i]) + static_cast<uint64_t>(shift_)),
            type, to);
    }
  }

 private:
  std::unique_ptr<Values> values_;
  int64_t shift_;
};

class SequenceValues final : public Values {
 public:
  SequenceValues(int64_t first, int64_t step) : first_(first), step_(step) {}
  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    auto* to = static_cast<unsigned char*>(out);
    for (size_t i = 0; i < count; ++i, to += sizeOf(type))
      writeInteger(first_ + static_cast<int64_t>(first + i) * step_, type, to);
  }

 private:
  int64_t first_, step_;
};

class ColumnValues final : public Values {
 public:
  explicit ColumnValues(std::vector<std::unique_ptr<Values>> columns)
      : columns_(std::move(columns)) {}
  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    const size_t width = columns_.size(), bytes = sizeOf(type);
    uint64_t row = first / width;
    auto* to = static_cast<unsigned char*>(out);
    for (size_t rows = count / width, n; rows > 0; rows -= n, row += n, to += n * width * bytes) {
      n = std::min(rows, kRowsAtOnce);
      for (size_t c = 0; c < width; ++c) {
        unsigned char held[kRowsAtOnce * sizeof(double)];
        columns_[c]->read(row, n, held, type);
        for (size_t i = 0; i < n; ++i)
          std::memcpy(to + (i * width + c) * bytes, held + i * bytes, bytes);
      }
    }
  }

 private:
  std::vector<std::unique_ptr<Values>> columns_;
};

}  // namespace

std::unique_ptr<Values> openParts(std::vector<ValuesPart> parts) {
  return std::make_unique<PartValues>(std::move(parts));
}

std::unique_ptr<Values> openShifted(std::unique_ptr<Values> values, int64_t shift) {
  return std::make_unique<ShiftedValues>(std::move(values), shift);
}

std::unique_ptr<Values> openSequence(int64_t first, int64_t step) {
  return std::make_unique<SequenceValues>(first, step);
}

std::unique_ptr<Values> openColumns(std::vector<std::unique_ptr<Values>> columns) {
  return std::make_unique<ColumnValues>(std::move(columns));
}

}  // namespace tetstream
