#include "file_window.h"

#include <atomic>
#include <cstring>

#include "status.h"

namespace tetstream {

// Short requests in sequence are not to cost a system call each.
constexpr size_t kLeastRead = 64 << 10;

const unsigned char* FileWindow::bytes(uint64_t offset, size_t size) {
  if (offset >= begin_ && offset - begin_ <= size_ && size <= size_ - (offset - begin_))
    return held_.data() + (offset - begin_);
  size_ = 0;
  const size_t wanted = std::max(size, kLeastRead);
  if (held_.size() < wanted) held_.resize(wanted);
  const size_t got = file_->readAt(offset, held_.data(), wanted);
  if (got < size)
    fail(Status::kBadData, "%s: byte %llu: the file ends here, and was longer when it was opened",
         file_->name().c_str(), static_cast<unsigned long long>(offset + got));
  begin_ = offset;
  size_ = got;
  return held_.data();
}

namespace {

constexpr uint64_t kFirstRows = 1 << 14;  // that one thread looks at before it asks others

template <class Integer>
bool anyIn(const unsigned char* rows, size_t row_bytes, size_t count) {
  Integer any = 0;
  for (size_t i = 0; i < count; ++i) {
    Integer value;
    std::memcpy(&value, rows + i * row_bytes, sizeof value);
    any |= value;
  }
  return any != 0;
}

bool anyInRange(const RowsPlace& place, size_t at_byte, size_t width, uint64_t first,
                uint64_t count, const std::atomic<bool>& found) {
  FileWindow window(place.file);
  bool any = false;
  forPlacedRows(window, place, first, count, [&](const unsigned char* rows, size_t n, uint64_t) {
    any = width == 4 ? anyIn<uint32_t>(rows + at_byte, place.row_bytes, n)
                     : anyIn<uint64_t>(rows + at_byte, place.row_bytes, n);
    return !any && !found;
  });
  return any;
}

}  // namespace

bool anyNonZero(const RowsPlace& place, size_t at_byte, size_t width, const Tasks* tasks) {
  std::atomic<bool> found = false;
  const uint64_t alone = std::min(place.rows, kFirstRows);
  if (anyInRange(place, at_byte, width, 0, alone, found)) return true;
  const uint64_t rest = place.rows - alone;
  const size_t parts = tasks && rest > kFirstRows ? tasks->threads() : 1;
  const auto look = [&](size_t part) {
    const uint64_t begin = rest / parts * part,
                   end = part + 1 == parts ? rest : begin + rest / parts;
    if (anyInRange(place, at_byte, width, alone + begin, end - begin, found)) found = true;
  };
  if (parts > 1)
    tasks->forParts(parts, look);
  else
    look(0);
  return found;
}

}  // namespace tetstream
