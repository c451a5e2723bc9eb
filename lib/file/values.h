// file: the values of one array of a file as numbers of our types, read by range. Depends on
// text_pieces.h, base.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "bytes.h"
#include "plain_number.h"
#include "scalar.h"
#include "text_pieces.h"

namespace tetstream {

// How a file may hold numbers.
enum class ValueType {
  kInt8,
  kUInt8,
  kInt16,
  kUInt16,
  kInt32,
  kUInt32,
  kInt64,
  kUInt64,
  kFloat32,
  kFloat64
};

inline size_t sizeOf(ValueType t) {
  constexpr size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<int>(t)];
}
inline bool isFloat(ValueType t) {
  return t >= ValueType::kFloat32;
}
// The type of ours that holds all of its values, or, of UInt64, all that we can hold.
ScalarType scalarOf(ValueType type);

class Values {
 public:
  virtual ~Values() = default;
  // Values [first, first + count) as plain numbers of `type`; throws if an integer does not fit.
  // Sequential calls are the fast ones.
  virtual void read(uint64_t first, size_t count, void* out, ScalarType type) = 0;
};

class ValueBytes {
 public:
  virtual ~ValueBytes() = default;
  // Bytes [offset, offset + size) of the values; sequential calls are the fast ones.
  virtual void readAt(uint64_t offset, void* out, size_t size) = 0;
};

// `what` names the file and the array in messages.
std::unique_ptr<Values> openBinaryValues(std::unique_ptr<ValueBytes> bytes, const std::string& what,
                                         ValueType type, bool big_endian);

// Exactly `count` numbers, at least one, as text between blanks in bytes [begin, end) of the file.
// Where they are read in sequence the helpers, if there are any, read ahead, which gives the same
// numbers and errors.
struct TextPlace {
  uint64_t begin = 0, end = 0, count = 0;
};
std::unique_ptr<Values> openTextValues(ByteSource& bytes, const std::string& what, ValueType type,
                                       const TextPlace& place, const Helpers& helpers = {});

bool isSame(ValueType a, ScalarType b);

// Of what convertValues reads, and for its message: the array and the number of the first value.
struct StoredValues {
  ValueType type;
  const std::string& what;
  uint64_t first;
};
// `count` values in this machine's byte order to those of our type; throws if one does not fit.
void convertValues(const unsigned char* in, const StoredValues& stored, unsigned char* out,
                   ScalarType type, size_t count);

// Turns the bytes of each of `count` values of `size` bytes around.
void swapBytes(unsigned char* bytes, size_t size, size_t count);

// "FILE: array "NAME"", for messages.
std::string placeOf(const ByteSource& bytes, const std::string& array);

}  // namespace tetstream
