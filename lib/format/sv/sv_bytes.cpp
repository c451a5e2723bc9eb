#include "sv_bytes.h"

#include <utility>

namespace tetstream {

// One read; large enough that the calls do not count, small against the 2 MB of an L2 cache.
static constexpr size_t kReadBytes = 1 << 16;

SvBytes::SvBytes(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {
  buffer_.reserve(2 * kReadBytes);  // so that data() is never null
}

bool SvBytes::more() {
  if (begin_ > 0) {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  const size_t before = buffer_.size();
  buffer_.resize(before + kReadBytes);
  const size_t got = source_->read(buffer_.data() + before, kReadBytes);
  buffer_.resize(before + got);
  return got > 0;
}

bool SvBytes::want(size_t count) {
  while (size() < count)
    if (!more()) return false;
  return true;
}

void SvBytes::makeSeekable(const std::string& temp_dir) {
  if (seekable()) return;
  std::vector<unsigned char> rest(data(), data() + size());
  buffer_.clear();
  begin_ = 0;
  origin_ = offset_;
  source_ = tetstream::makeSeekable(withPrefix(std::move(rest), std::move(source_)), temp_dir);
}

}  // namespace tetstream
