#include "file_window.h"

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

}  // namespace tetstream
