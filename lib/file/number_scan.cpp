#include "number_scan.h"

#include <algorithm>
#include <cstring>

#include "values.h"

namespace tetstream {

namespace {

constexpr size_t kNumberBytes = 1 << 12;

// Integers of type Stored, or floats, to wide ones.
template <class Stored, class Wide>
void convert(const char* bytes, size_t count, Wide* out) {
  for (size_t i = 0; i < count; ++i, bytes += sizeof(Stored)) {
    Stored value;
    std::memcpy(&value, bytes, sizeof value);
    out[i] = static_cast<Wide>(value);
  }
}

template <class Narrow, class Long, class Wide>
void readBinary(FileScan& file, bool swapped, Wide* out, size_t count, size_t width,
                const char* what) {
  char copy[kNumberBytes];
  while (count > 0) {
    const size_t n = std::min(count, sizeof copy / width);
    const char* bytes = swapped ? nullptr : file.bytesInBuffer(n * width);
    if (!bytes) {
      file.bytes(copy, n * width, what);
      if (swapped) swapBytes(reinterpret_cast<unsigned char*>(copy), width, n);
      bytes = copy;
    }
    if (width == sizeof(Narrow))
      convert<Narrow>(bytes, n, out);
    else
      convert<Long>(bytes, n, out);
    out += n;
    count -= n;
  }
}

}  // namespace

void NumberScan::binaryIntegers(int64_t* out, size_t count, size_t width, const char* what) {
  readBinary<int32_t, int64_t>(file_, swapped_, out, count, width, what);
}

void NumberScan::binaryReals(double* out, size_t count, size_t width, const char* what) {
  readBinary<float, double>(file_, swapped_, out, count, width, what);
}

uint64_t NumberScan::count(size_t width, size_t least_bytes, const char* what) {
  const int64_t found = integer(width, what);
  if (found < 0) file_.failBad(textOf("%s is %lld", what, static_cast<long long>(found)));
  file_.checkClaim(static_cast<uint64_t>(found), least_bytes, what);
  return static_cast<uint64_t>(found);
}

std::optional<RowsPlace> NumberScan::rowsHere(uint64_t rows, size_t row_bytes) const {
  if (!binary_ || rows == 0 || row_bytes > FileWindow::kMostBytes) return std::nullopt;
  std::shared_ptr<ByteSource> file = file_.source();
  if (!file || rows > file_.bytesLeft() / row_bytes) return std::nullopt;
  return RowsPlace{std::move(file), file_.offset(), rows, row_bytes, swapped_};
}

}  // namespace tetstream
