#include "values.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "status.h"

namespace tetstream {

static uint16_t reversed(uint16_t v) {
  return __builtin_bswap16(v);
}
static uint32_t reversed(uint32_t v) {
  return __builtin_bswap32(v);
}
static uint64_t reversed(uint64_t v) {
  return __builtin_bswap64(v);
}

template <class T>
static void reverseEach(unsigned char* bytes, size_t count) {
  for (size_t i = 0; i < count; ++i, bytes += sizeof(T)) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    value = reversed(value);
    std::memcpy(bytes, &value, sizeof value);
  }
}

void swapBytes(unsigned char* bytes, size_t size, size_t count) {
  if (size == 2) reverseEach<uint16_t>(bytes, count);
  if (size == 4) reverseEach<uint32_t>(bytes, count);
  if (size == 8) reverseEach<uint64_t>(bytes, count);
}

namespace {

constexpr size_t kConvertBytes = 1 << 14;

// Returns the index of the first value that does not fit, or count. Only wide integers to narrower
// or signed ones can fail: the reader never asks for floats as integers.
template <class In, class Out>
size_t convertEach(const unsigned char* in, unsigned char* out, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    In value;
    std::memcpy(&value, in + i * sizeof(In), sizeof value);
    if constexpr (std::is_integral_v<In> && std::is_integral_v<Out>) {
      if (!std::in_range<Out>(value)) return i;
    }
    const Out converted = static_cast<Out>(value);
    std::memcpy(out + i * sizeof(Out), &converted, sizeof converted);
  }
  return count;
}

template <class In>
size_t convertFrom(const unsigned char* in, unsigned char* out, ScalarType type, size_t count) {
  switch (type) {
    case ScalarType::kFloat32:
      return convertEach<In, float>(in, out, count);
    case ScalarType::kFloat64:
      return convertEach<In, double>(in, out, count);
    case ScalarType::kInt32:
      return convertEach<In, int32_t>(in, out, count);
    case ScalarType::kInt64:
      return convertEach<In, int64_t>(in, out, count);
  }
  return 0;
}

size_t convertSome(const unsigned char* in, ValueType from, unsigned char* out, ScalarType to,
                   size_t count) {
  switch (from) {
    case ValueType::kInt8:
      return convertFrom<int8_t>(in, out, to, count);
    case ValueType::kUInt8:
      return convertFrom<uint8_t>(in, out, to, count);
    case ValueType::kInt16:
      return convertFrom<int16_t>(in, out, to, count);
    case ValueType::kUInt16:
      return convertFrom<uint16_t>(in, out, to, count);
    case ValueType::kInt32:
      return convertFrom<int32_t>(in, out, to, count);
    case ValueType::kUInt32:
      return convertFrom<uint32_t>(in, out, to, count);
    case ValueType::kInt64:
      return convertFrom<int64_t>(in, out, to, count);
    case ValueType::kUInt64:
      return convertFrom<uint64_t>(in, out, to, count);
    case ValueType::kFloat32:
      return convertFrom<float>(in, out, to, count);
    case ValueType::kFloat64:
      return convertFrom<double>(in, out, to, count);
  }
  return 0;
}

}  // namespace

bool isSame(ValueType a, ScalarType b) {
  return (a == ValueType::kFloat32 && b == ScalarType::kFloat32) ||
         (a == ValueType::kFloat64 && b == ScalarType::kFloat64) ||
         (a == ValueType::kInt32 && b == ScalarType::kInt32) ||
         (a == ValueType::kInt64 && b == ScalarType::kInt64);
}

void convertValues(const unsigned char* in, const StoredValues& stored, unsigned char* out,
                   ScalarType type, size_t count) {
  const size_t good = convertSome(in, stored.type, out, type, count);
  if (good == count) return;
  uint64_t value;
  std::memcpy(&value, in + good * sizeof value, sizeof value);  // no other type has such values
  fail(Status::kUnsupported, "%s: value %llu does not fit into a signed 64-bit integer: it is %llu",
       stored.what.c_str(), static_cast<unsigned long long>(stored.first + good),
       static_cast<unsigned long long>(value));
}

namespace {

class BinaryValues final : public Values {
 public:
  BinaryValues(std::unique_ptr<ValueBytes> bytes, const std::string& what, ValueType type,
               bool big_endian)
      : bytes_(std::move(bytes)),
        what_(what),
        type_(type),
        swap_(big_endian != (std::endian::native == std::endian::big)) {}

  void read(uint64_t first, size_t count, void* out, ScalarType type) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    const size_t size = sizeOf(type_);
    if (isSame(type_, type)) {
      bytes_->readAt(first * size, to, count * size);
      if (swap_) swapBytes(to, size, count);
      return;
    }
    unsigned char stored[kConvertBytes];
    while (count > 0) {
      const size_t n = std::min(count, kConvertBytes / size);
      bytes_->readAt(first * size, stored, n * size);
      if (swap_) swapBytes(stored, size, n);
      convertValues(stored, {type_, what_, first}, to, type, n);
      to += n * sizeOf(type);
      first += n;
      count -= n;
    }
  }

 private:
  std::unique_ptr<ValueBytes> bytes_;
  std::string what_;
  ValueType type_;
  bool swap_;
};

}  // namespace

ScalarType scalarOf(ValueType type) {
  switch (type) {
    case ValueType::kFloat32:
      return ScalarType::kFloat32;
    case ValueType::kFloat64:
      return ScalarType::kFloat64;
    case ValueType::kUInt32:
    case ValueType::kInt64:
    case ValueType::kUInt64:
      return ScalarType::kInt64;
    default:
      return ScalarType::kInt32;
  }
}

std::unique_ptr<Values> openBinaryValues(std::unique_ptr<ValueBytes> bytes, const std::string& what,
                                         ValueType type, bool big_endian) {
  return std::make_unique<BinaryValues>(std::move(bytes), what, type, big_endian);
}

std::string placeOf(const ByteSource& bytes, const std::string& array) {
  return bytes.name() + ": array \"" + array + "\"";
}

}  // namespace tetstream
