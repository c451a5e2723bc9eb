#include "placed_numbers.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <type_traits>

#include "status.h"
#include "stored_number.h"

namespace tetstream {

namespace {

// Rows as they lie: of each, `count` numbers from `at` on.
struct StoredRows {
  const unsigned char* at;
  size_t row_bytes, count;
};

template <class Stored, class Out, bool kSwapped, size_t kCount>
void convertRows(const StoredRows& in, size_t rows, unsigned char* out) {
  const size_t count = kCount ? kCount : in.count;
  for (size_t i = 0; i < rows; ++i, out += count * sizeof(Out)) {
    const unsigned char* row = in.at + i * in.row_bytes;
    for (size_t k = 0; k < count; ++k) {
      const auto value = static_cast<Out>(storedNumber<Stored, kSwapped>(row + k * sizeof(Stored)));
      std::memcpy(out + k * sizeof value, &value, sizeof value);
    }
  }
}

// Loops over a number of numbers that the compiler knows are several times as fast.
template <class Stored, class Out, bool kSwapped>
void convertAny(const StoredRows& in, size_t rows, unsigned char* out) {
  if (in.row_bytes == in.count * sizeof(Stored))
    return convertRows<Stored, Out, kSwapped, 1>({in.at, sizeof(Stored), 1}, rows * in.count, out);
  if (in.count == 1) return convertRows<Stored, Out, kSwapped, 1>(in, rows, out);
  if (in.count == 3) return convertRows<Stored, Out, kSwapped, 3>(in, rows, out);
  convertRows<Stored, Out, kSwapped, 0>(in, rows, out);
}

// Without its sign a number that is not finite has the largest exponent: one more is a sign.
template <class Stored, bool kSwapped>
bool areFinite(const StoredRows& in, size_t rows) {
  using Bits = std::conditional_t<sizeof(Stored) == 4, uint32_t, uint64_t>;
  constexpr Bits sign = Bits{1} << (8 * sizeof(Bits) - 1);
  constexpr Bits exponent_1 = Bits{1} << (std::numeric_limits<Stored>::digits - 1);
  Bits any = 0;
  for (size_t i = 0; i < rows; ++i)
    for (size_t k = 0; k < in.count; ++k) {
      const auto bits = storedNumber<Bits, kSwapped>(in.at + i * in.row_bytes + k * sizeof(Bits));
      any |= (bits & ~sign) + exponent_1;
    }
  return (any & sign) == 0;
}

using Convert = void (*)(const StoredRows&, size_t, unsigned char*);
using Check = bool (*)(const StoredRows&, size_t);

template <bool kSwapped>
Convert findConvert(const NumbersOfRow& numbers, ScalarType type) {
  if (numbers.real && numbers.width == 4)
    return type == ScalarType::kFloat32 ? convertAny<float, float, kSwapped>
                                        : convertAny<float, double, kSwapped>;
  if (numbers.real)
    return type == ScalarType::kFloat32 ? convertAny<double, float, kSwapped>
                                        : convertAny<double, double, kSwapped>;
  if (numbers.width == 8) return convertAny<int64_t, int64_t, kSwapped>;
  return type == ScalarType::kInt32 ? convertAny<int32_t, int32_t, kSwapped>
                                    : convertAny<int32_t, int64_t, kSwapped>;
}

template <bool kSwapped>
Check findCheck(const NumbersOfRow& numbers) {
  if (!numbers.finite) return nullptr;
  return numbers.width == 4 ? areFinite<float, kSwapped> : areFinite<double, kSwapped>;
}

class PlacedNumbers final : public RowReader {
 public:
  PlacedNumbers(std::shared_ptr<FileWindow> window, const RowsPlace& place,
                const NumbersOfRow& numbers, ScalarType type)
      : window_(std::move(window)),
        place_(place),
        numbers_(numbers),
        out_bytes_(numbers.count * sizeOf(type)),
        convert_(place.swapped ? findConvert<true>(numbers, type)
                               : findConvert<false>(numbers, type)),
        check_(place.swapped ? findCheck<true>(numbers) : findCheck<false>(numbers)) {}

  void read(uint64_t first, size_t count, void* out) override {
    auto* to = static_cast<unsigned char*>(out);
    forPlacedRows(
        *window_, place_, first, count, [&](const unsigned char* rows, size_t n, uint64_t at) {
          const StoredRows stored = {rows + numbers_.at_byte, place_.row_bytes, numbers_.count};
          if (check_ && !check_(stored, n)) failPosition(stored, at);
          convert_(stored, n, to);
          to += n * out_bytes_;
          return true;
        });
  }

 private:
  [[noreturn]] void failPosition(StoredRows rows, uint64_t first) const {
    uint64_t row = first;
    for (; check_(rows, 1); ++row) rows.at += rows.row_bytes;
    fail(Status::kBadData, "%s: byte %llu: a position is not a finite number",
         window_->file().name().c_str(),
         static_cast<unsigned long long>(place_.begin + row * place_.row_bytes + numbers_.at_byte));
  }

  std::shared_ptr<FileWindow> window_;
  RowsPlace place_;
  NumbersOfRow numbers_;
  size_t out_bytes_;
  Convert convert_;
  Check check_;
};

class ConstantRows final : public RowReader {
 public:
  ConstantRows(int64_t value, ScalarType type) : value_(value), type_(type) {}
  void read(uint64_t, size_t count, void* out) override {
    if (type_ == ScalarType::kInt64)
      std::fill_n(static_cast<int64_t*>(out), count, value_);
    else
      std::fill_n(static_cast<int32_t*>(out), count, static_cast<int32_t>(value_));
  }

 private:
  int64_t value_;
  ScalarType type_;
};

constexpr uint64_t kFirstRows = 1 << 14;  // that one thread looks at before it asks others

// In either byte order: 0 is the same in both.
template <class Integer>
bool anyIn(const unsigned char* rows, size_t row_bytes, size_t count) {
  Integer any = 0;
  for (size_t i = 0; i < count; ++i) any |= storedNumber<Integer, false>(rows + i * row_bytes);
  return any != 0;
}

bool anyInRange(const RowsPlace& place, const NumbersOfRow& integer, uint64_t first, uint64_t count,
                const std::atomic<bool>& found) {
  FileWindow window(place.file);
  bool any = false;
  forPlacedRows(window, place, first, count, [&](const unsigned char* rows, size_t n, uint64_t) {
    any = integer.width == 4 ? anyIn<uint32_t>(rows + integer.at_byte, place.row_bytes, n)
                             : anyIn<uint64_t>(rows + integer.at_byte, place.row_bytes, n);
    return !any && !found;
  });
  return any;
}

}  // namespace

std::shared_ptr<RowReader> placeNumbers(std::shared_ptr<FileWindow> window, const RowsPlace& place,
                                        const NumbersOfRow& numbers, ScalarType type) {
  return std::make_shared<PlacedNumbers>(std::move(window), place, numbers, type);
}

bool anyNonZero(const RowsPlace& place, const NumbersOfRow& integer, const Tasks* tasks) {
  std::atomic<bool> found = false;
  const uint64_t alone = std::min(place.rows, kFirstRows);
  if (anyInRange(place, integer, 0, alone, found)) return true;
  const uint64_t rest = place.rows - alone;
  const size_t parts = tasks && rest > kFirstRows ? tasks->threads() : 1;
  const auto look = [&](size_t part) {
    const uint64_t begin = rest / parts * part,
                   end = part + 1 == parts ? rest : begin + rest / parts;
    if (anyInRange(place, integer, alone + begin, end - begin, found)) found = true;
  };
  if (parts > 1)
    tasks->forParts(parts, look);
  else
    look(0);
  return found;
}

std::shared_ptr<RowReader> placeConstant(int64_t value, ScalarType type) {
  return std::make_shared<ConstantRows>(value, type);
}

}  // namespace tetstream
