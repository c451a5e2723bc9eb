#include "byte_watch.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "waiting.h"

namespace tetstream {

using Clock = std::chrono::steady_clock;

static constexpr std::chrono::milliseconds kPause{20};

bool TellingPause::isOver() {
  const Clock::time_point now = Clock::now();
  if (now - told_ < kPause) return false;
  told_ = now;
  return true;
}

// Helpers may read, too, and count.
struct ByteWatch::State {
  Tell tell;
  const std::thread::id thread = std::this_thread::get_id();
  TellingPause pause;
  std::atomic<uint64_t> done{0};
  uint64_t total = 0;
  bool is_total_known = true;
  std::vector<std::shared_ptr<Waiting>> waited;  // during which it tells, too

  size_t count(size_t bytes) {
    done.fetch_add(bytes, std::memory_order_relaxed);
    if (std::this_thread::get_id() != thread || !tell || !pause.isOver()) return bytes;
    const double share =
        static_cast<double>(done) / static_cast<double>(std::max<uint64_t>(total, 1));
    tell(is_total_known ? std::min(share, 1.0) : -1);
    return bytes;
  }
};

namespace {

class WatchedSource final : public ByteSource {
 public:
  using Count = std::function<size_t(size_t)>;
  WatchedSource(std::unique_ptr<ByteSource> bytes, Count count)
      : ByteSource(bytes->name()), bytes_(std::move(bytes)), count_(std::move(count)) {}

  size_t read(void* out, size_t size) override { return count_(bytes_->read(out, size)); }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return count_(bytes_->readAt(offset, out, size));
  }
  bool seekable() const override { return bytes_->seekable(); }
  uint64_t size() const override { return bytes_->size(); }
  std::shared_ptr<Waiting> waiting() const override { return bytes_->waiting(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
  Count count_;
};

class WatchedSink final : public ByteSink {
 public:
  WatchedSink(std::unique_ptr<ByteSink> bytes, std::function<void()> tell)
      : ByteSink(bytes->name()), bytes_(std::move(bytes)), tell_(std::move(tell)) {}

  void write(const void* data, size_t size) override {
    tell_();
    bytes_->write(data, size);
  }
  void writeAt(uint64_t offset, const void* data, size_t size) override {
    tell_();
    bytes_->writeAt(offset, data, size);
  }
  bool seekable() const override { return bytes_->seekable(); }
  bool waits() const override { return bytes_->waits(); }
  void commit() override { bytes_->commit(); }

 private:
  std::unique_ptr<ByteSink> bytes_;
  std::function<void()> tell_;
};

}  // namespace

ByteWatch::ByteWatch(Tell tell) {
  if (!tell) return;
  state_ = std::make_shared<State>();
  state_->tell = std::move(tell);
}

ByteWatch::~ByteWatch() {
  if (!state_) return;
  state_->tell = nullptr;
  for (const auto& waiting : state_->waited) waiting->doMeanwhile({});
}

std::unique_ptr<ByteSource> ByteWatch::watched(std::unique_ptr<ByteSource> bytes) const {
  if (!state_ || !bytes) return bytes;
  if (bytes->seekable())
    state_->total += bytes->size();
  else
    state_->is_total_known = false;
  if (std::shared_ptr<Waiting> waiting = bytes->waiting()) {
    waiting->doMeanwhile([state = state_.get()] { state->count(0); });
    state_->waited.push_back(std::move(waiting));
  }
  return std::make_unique<WatchedSource>(
      std::move(bytes), [state = state_](size_t size) { return state->count(size); });
}

std::unique_ptr<ByteSink> watched(std::unique_ptr<ByteSink> bytes, std::function<void()> tell) {
  if (!tell) return bytes;
  return std::make_unique<WatchedSink>(std::move(bytes), std::move(tell));
}

}  // namespace tetstream
