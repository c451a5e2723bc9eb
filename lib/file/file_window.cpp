#include "file_window.h"

#include <atomic>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <utility>

#include "status.h"
#include "unlocked.h"

namespace tetstream {

// Short requests in sequence are not to cost a system call each.
constexpr size_t kLeastBytes = 64 << 10;

// As a piece of work: reads the bytes that were asked for. One that comes late finds nothing to do.
class FileWindow::Ahead final : public Work {
 public:
  enum class State { kNone, kWaits, kIsRead, kDone };

  explicit Ahead(std::shared_ptr<ByteSource> file) : file_(std::move(file)) {}

  // When what was asked for before was taken.
  void ask(uint64_t offset, size_t size, const Tasks& tasks) {
    if (bytes_.size() < size) bytes_.resize(size);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      offset_ = offset;
      wanted_ = size;
      state_ = State::kWaits;
    }
    tasks.submit(this);  // where nobody takes it, the caller reads
  }

  // The bytes from there on, in exchange for other memory; returns how many, 0: they are not here.
  size_t take(uint64_t offset, std::vector<unsigned char>& held) {
    const bool is_there = settle() == State::kDone && offset_ == offset;
    if (is_there) held.swap(bytes_);
    return is_there ? got_ : 0;
  }

  // Nothing is read any more; what it was before.
  State settle() noexcept {
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, [this] { return state_ != State::kIsRead; });
    return std::exchange(state_, State::kNone);
  }

  void run() noexcept override {
    std::unique_lock<std::mutex> lock(mutex_);
    if (state_ != State::kWaits) return;
    state_ = State::kIsRead;
    got_ = 0;  // of what fails, too: who reads there says so
    doUnlocked(lock, [this] { got_ = file_->readAt(offset_, bytes_.data(), wanted_); });
    state_ = State::kDone;
    done_.notify_one();
  }

 private:
  std::shared_ptr<ByteSource> file_;
  std::vector<unsigned char> bytes_;
  uint64_t offset_ = 0;
  size_t wanted_ = 0, got_ = 0;
  std::mutex mutex_;
  std::condition_variable done_;
  State state_ = State::kNone;
};

FileWindow::FileWindow(std::shared_ptr<ByteSource> file, const Helpers& helpers)
    : file_(std::move(file)), helpers_(helpers) {}

FileWindow::~FileWindow() {
  if (ahead_) (*ahead_)->settle();
}

const unsigned char* FileWindow::bytes(uint64_t offset, size_t size) {
  if (offset >= begin_ && offset - begin_ <= size_ && size <= size_ - (offset - begin_))
    return held_.data() + (offset - begin_);
  size_ = 0;
  const size_t got = load(offset, size);
  if (got < size)
    fail(Status::kBadData, "%s: byte %llu: the file ends here, and was longer when it was opened",
         file_->name().c_str(), static_cast<unsigned long long>(offset + got));
  begin_ = offset;
  size_ = got;
  if (offset == next_ && size >= kLeastBytes) askAhead(offset + size, size);
  next_ = offset + size;
  return held_.data();
}

size_t FileWindow::load(uint64_t offset, size_t size) {
  const size_t got = ahead_ ? (*ahead_)->take(offset, held_) : 0;
  if (got >= size) return got;
  const size_t wanted = std::max(size, kLeastBytes);
  if (held_.size() < wanted) held_.resize(wanted);
  return file_->readAt(offset, held_.data(), wanted);
}

void FileWindow::askAhead(uint64_t offset, size_t size) {
  if (!helpers_.areHere() || offset >= file_->size()) return;
  if (!ahead_) ahead_.emplace(new Ahead(file_));
  (*ahead_)->ask(offset, size, *helpers_.threads.tasks);
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
