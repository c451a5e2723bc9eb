#include "file_scan.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "plain_number.h"
#include "text_number.h"

namespace tetstream {

namespace {

constexpr size_t kBufferBytes = 1 << 18;
// What is in the buffer before a number is parsed, so that it is parsed where it lies.
constexpr size_t kAhead = kMostWordBytes;

std::string countText(uint64_t count) {
  return std::to_string(count);
}

}  // namespace

FileScan::FileScan(std::unique_ptr<ByteSource> bytes, char comment, const TextThreads& threads)
    : bytes_(std::move(bytes)), comment_(comment), threads_(threads), buffer_(kBufferBytes + 1) {}

bool FileScan::refill() {
  if (ended_ && unread_at_ == unread_.size()) return false;
  std::memmove(buffer_.data(), buffer_.data() + at_, filled_ - at_);
  filled_ -= at_;
  origin_ += at_;
  at_ = 0;
  if (filled_ == kBufferBytes) return true;
  const bool is_first = origin_ + filled_ == 0;
  const size_t got = readText(buffer_.data() + filled_, kBufferBytes - filled_);
  filled_ += got;
  buffer_[filled_] = 0;
  if (is_first) passByteOrderMark();
  return got > 0;
}

// As editors of Windows put before text in UTF-8.
void FileScan::passByteOrderMark() {
  static constexpr std::string_view kMark = "\xef\xbb\xbf";
  const auto begins = [this] {  // as far as it is there
    return kMark.starts_with(std::string_view(buffer_.data(), std::min(filled_, kMark.size())));
  };
  while (filled_ > 0 && filled_ < kMark.size() && begins() && refill()) {
  }
  if (filled_ >= kMark.size() && begins()) at_ = kMark.size();
}

size_t FileScan::readText(char* out, size_t size) {
  if (unread_at_ < unread_.size()) {
    const size_t n = std::min(size, unread_.size() - unread_at_);
    std::memcpy(out, unread_.data() + unread_at_, n);
    unread_at_ += n;
    return n;
  }
  unread_ = {};
  unread_at_ = 0;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  const size_t got = ended_ ? 0 : readFile(out, size);
  ended_ = got == 0;
  return got;
}

size_t FileScan::readFile(char* out, size_t size) {
  if (!has_jumped_) return bytes_->read(out, size);
  const size_t got = bytes_->readAt(read_to_, out, size);
  read_to_ += got;
  return got;
}

bool FileScan::atEnd() {
  leaveAhead();
  return at_ == filled_ && !refill();
}

// To the next word; false at the end of the file.
bool FileScan::passBlanks() {
  leaveAhead();
  for (;;) {
    while (isBlank(buffer_[at_])) line_ += buffer_[at_++] == '\n';
    if (at_ == filled_) {
      if (!refill()) return false;
    } else if (buffer_[at_] == comment_ && comment_) {
      line();
    } else {
      while (filled_ - at_ < kAhead && refill()) {
      }
      return true;
    }
  }
}

size_t FileScan::wordSize() {
  size_t size = 0;
  const size_t most = std::min(filled_ - at_, kAhead);
  while (size < most && !isBlank(buffer_[at_ + size])) ++size;
  if (size == kAhead) failBad("a word of more than " + countText(kAhead) + " characters");
  return size;
}

std::string_view FileScan::peekWord() {
  if (!passBlanks()) return {};
  return {buffer_.data() + at_, wordSize()};
}

std::string_view FileScan::word() {
  const std::string_view found = peekWord();
  at_ += found.size();
  return found;
}

std::string_view FileScan::line() {
  leaveAhead();
  size_t size = 0;
  const char* found = nullptr;
  for (;;) {
    found = static_cast<const char*>(
        std::memchr(buffer_.data() + at_ + size, '\n', filled_ - at_ - size));
    if (found) break;
    size = filled_ - at_;
    if (size == kBufferBytes) failBad("a line of more than " + countText(kBufferBytes) + " bytes");
    if (!refill()) break;
  }
  if (found) size = static_cast<size_t>(found - buffer_.data()) - at_;
  std::string_view text(buffer_.data() + at_, size);
  at_ += size + (found ? 1 : 0);
  line_ += found ? 1 : 0;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

bool FileScan::lineEnds() {
  leaveAhead();
  for (;;) {
    while (buffer_[at_] == ' ' || buffer_[at_] == '\t' || buffer_[at_] == '\r') ++at_;
    if (at_ < filled_) break;
    if (!refill()) return true;
  }
  return buffer_[at_] == '\n' || (comment_ && buffer_[at_] == comment_);
}

std::string FileScan::place() const {
  if (binary_) return name() + ": byte " + countText(offset());
  return name() + ": line " + countText(line_ + (ahead_ ? ahead_->place().lines : 0));
}

void FileScan::failHere(Status status, const std::string& text) const {
  throw Error(status, place() + ": " + text);
}

void FileScan::failWord(std::string_view word, const char* what) const {
  if (word.empty()) failBad(std::string("the file ends where ") + what + " should be");
  failBad(quoted(word) + " is no number; " + what + " should be here");
}

// ------------------------------------------------------------------------------ rows of numbers

void FileScan::expectRows(uint64_t rows, const RowPattern& pattern) {
  leaveAhead();
  const bool is_long = rows >= threads_.piece_bytes / pattern.width();
  if (!threads_.tasks || threads_.tasks->threads() < 2 || !is_long) return;
  unread_.erase(unread_.begin(), unread_.begin() + static_cast<std::ptrdiff_t>(unread_at_));
  unread_.insert(unread_.begin(), buffer_.data() + at_, buffer_.data() + filled_);
  unread_at_ = 0;
  origin_ += at_;
  at_ = filled_ = 0;
  buffer_[0] = 0;
  ahead_ = std::make_unique<NumbersAhead>(
      threads_, RowParser(pattern, comment_), rows,
      [this](char* out, size_t size, bool* fails) { return readTextAhead(out, size, fails); });
}

// Up to `size` bytes, fewer only at the end, or where reading failed, which is said when all text
// before was used.
size_t FileScan::readTextAhead(char* out, size_t size, bool* fails) {
  size_t done = 0;
  try {
    while (const size_t got = done < size && !error_ ? readText(out + done, size - done) : 0)
      done += got;
  } catch (...) {
    error_ = std::current_exception();
  }
  *fails = error_ != nullptr;
  return done;
}

void FileScan::stopAhead() {
  const RowParser::Place place = ahead_->place();
  std::vector<char> text = ahead_->textLeft();
  text.insert(text.end(), unread_.begin() + static_cast<std::ptrdiff_t>(unread_at_), unread_.end());
  unread_ = std::move(text);
  unread_at_ = 0;
  origin_ += place.bytes;
  line_ += place.lines;
  ahead_.reset();
}

// Plain numbers, each with a blank behind it, within what is in the buffer. Returns how many.
template <class Number>
size_t FileScan::plainNumbers(Number* out, size_t count) {
  if (filled_ - at_ < kPlainNumberBytes) return 0;
  const char* at = buffer_.data() + at_;
  const char* const last = buffer_.data() + filled_ - kPlainNumberBytes;
  uint64_t lines = 0;
  size_t done = 0;
  for (; done < count; ++done) {
    while (isBlank(*at)) lines += *at++ == '\n';
    if (at > last) break;
    const char* end = readPlain(at, out + done);
    if (!end || !isBlank(*end)) break;
    at = end;
  }
  at_ = static_cast<size_t>(at - buffer_.data());
  line_ += lines;
  return done;
}

template <class Number>
Number FileScan::number(const char* what) {
  if (!passBlanks()) failWord({}, what);
  const char* begin = buffer_.data() + at_;
  Number value = 0;
  const char* end = readWord(begin, begin + std::min(filled_ - at_, kAhead), &value);
  if (!end || end == begin + kAhead) failWord({begin, wordSize()}, what);
  at_ = static_cast<size_t>(end - buffer_.data());
  return value;
}

// Of numbers that were read ahead as many as there are, or one that is not plain. Returns how many.
template <class Number>
[[gnu::noinline]] size_t FileScan::otherNumbers(Number* out, size_t count, const char* what) {
  const size_t taken = ahead_ ? ahead_->take(out, count) : 0;
  if (taken == 0) *out = number<Number>(what);
  return std::max<size_t>(taken, 1);
}

// note: in text that is read ahead nothing is in the buffer, and so no plain number.
template <class Number>
void FileScan::numbers(Number* out, size_t count, const char* what) {
  while (count > 0) {
    const size_t plain = plainNumbers(out, count);
    out += plain;
    count -= plain;
    if (count == 0) break;
    const size_t some = otherNumbers(out, count, what);
    out += some;
    count -= some;
  }
}

template void FileScan::numbers(int64_t* out, size_t count, const char* what);
template void FileScan::numbers(double* out, size_t count, const char* what);

void FileScan::failRange(int64_t value, const char* what, int64_t least, int64_t most) const {
  failBad(textOf("%s is %lld, not %lld to %lld", what, static_cast<long long>(value),
                 static_cast<long long>(least), static_cast<long long>(most)));
}

std::string FileScan::text(const char* what) {
  if (!passBlanks()) failBad(std::string("the file ends where ") + what + " should be");
  if (buffer_[at_] != '"') return std::string(word());
  const char* begin = buffer_.data() + at_ + 1;
  const size_t most = std::min(filled_ - at_, kAhead) - 1;
  const char* end = static_cast<const char*>(std::memchr(begin, '"', most));
  if (!end) failBad(std::string("no closing quote of ") + what);
  at_ += static_cast<size_t>(end - begin) + 2;
  return std::string(begin, end);
}

void FileScan::expect(const char* wanted) {
  const std::string_view found = word();
  if (found == wanted) return;
  if (found.empty()) failBad(std::string("the file ends where ") + wanted + " should be");
  failBad(quoted(found) + " where " + wanted + " should be");
}

void FileScan::bytes(void* out, size_t size, const char* what) {
  leaveAhead();
  binary_ = true;
  char* to = static_cast<char*>(out);
  while (size > 0) {
    if (at_ == filled_ && !refill())
      failBad(std::string("the file ends where ") + what + " should be");
    const size_t part = std::min(size, filled_ - at_);
    std::memcpy(to, buffer_.data() + at_, part);
    at_ += part;
    to += part;
    size -= part;
  }
}

std::string_view FileScan::peekBytes(size_t size) {
  leaveAhead();
  while (filled_ - at_ < size && refill()) {
  }
  return {buffer_.data() + at_, std::min(size, filled_ - at_)};
}

void FileScan::skipPast(std::string_view mark) {
  leaveAhead();
  for (;;) {
    const std::string_view held(buffer_.data() + at_, filled_ - at_);
    const size_t found = held.find(mark);
    if (found != held.npos) {
      line_ += static_cast<uint64_t>(
          std::count(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
      at_ += found + mark.size();
      return;
    }
    const size_t passed = held.size() < mark.size() ? 0 : held.size() - mark.size() + 1;
    line_ += static_cast<uint64_t>(
        std::count(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(passed), '\n'));
    at_ += passed;
    if (!refill()) failBad("the file ends without " + quoted(mark));
  }
}

void FileScan::skipTo(uint64_t place, const char* what) {
  leaveAhead();
  if (place > origin_ + filled_ && unread_at_ == unread_.size() && bytes_->seekable()) {
    if (place > bytes_->size()) failBad(std::string("the file ends within ") + what);
    origin_ = read_to_ = place;
    has_jumped_ = true;
    at_ = filled_ = 0;
    buffer_[0] = 0;
    return;
  }
  while (offset() < place) {
    if (at_ == filled_ && !refill()) failBad(std::string("the file ends within ") + what);
    at_ += static_cast<size_t>(std::min<uint64_t>(filled_ - at_, place - offset()));
  }
}

uint64_t FileScan::bytesLeft() const {
  if (!bytes_->seekable()) return std::numeric_limits<uint64_t>::max();
  return bytes_->size() > offset() ? bytes_->size() - offset() : 0;
}

void FileScan::checkClaim(uint64_t count, uint64_t least_bytes, const char* what) const {
  // note: the bytes after the last one may be missing, as the last line's end may.
  if (count <= (bytesLeft() == std::numeric_limits<uint64_t>::max()
                    ? bytesLeft()
                    : (bytesLeft() + 1) / least_bytes))
    return;
  failBad(textOf("%llu %s cannot be in the %llu bytes that are left",
                 static_cast<unsigned long long>(count), what,
                 static_cast<unsigned long long>(bytesLeft())));
}

}  // namespace tetstream
