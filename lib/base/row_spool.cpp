#include "row_spool.h"

#include <algorithm>
#include <bit>
#include <condition_variable>
#include <cstring>
#include <mutex>

#include "check_sum.h"
#include "status.h"
#include "unlocked.h"

namespace tetstream {

static void writeBlocksTo(SpoolFile& file, const std::vector<unsigned char>& bytes,
                          size_t block_bytes) {
  for (size_t done = 0; done < bytes.size(); done += block_bytes) {
    const size_t size = std::min(bytes.size() - done, block_bytes);
    const uint64_t sum = checkSum(bytes.data() + done, size);
    file.append(bytes.data() + done, size);
    file.append(&sum, sizeof sum);
  }
}

// run() writes what waits, on a helper's thread; if it comes late nothing waits.
class RowSpool::Behind final : public Work {
 public:
  Behind(SpoolFile& file, size_t block_bytes) : file_(file), block_bytes_(block_bytes) {}

  // Takes the bytes, and gives other memory for them.
  void write(std::vector<unsigned char>& bytes, const Tasks& tasks) {
    settle();
    bytes_.swap(bytes);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waits_ = true;
    }
    tasks.submit(this);  // where nobody takes it, settle writes
  }

  // Everything is written then. Throws what came of it.
  void settle() {
    Lock lock(mutex_);
    if (waits_) writeWaiting(lock);
    done_.wait(lock, [this] { return !is_busy_; });
    if (error_) std::rethrow_exception(error_);
  }

  // Last.
  void close() noexcept {
    Lock lock(mutex_);
    waits_ = false;
    done_.wait(lock, [this] { return !is_busy_; });
    bytes_ = {};
  }

  void run() noexcept override {
    Lock lock(mutex_);
    if (waits_) writeWaiting(lock);
  }

 private:
  using Lock = std::unique_lock<std::mutex>;

  void writeWaiting(Lock& lock) noexcept {
    waits_ = false;
    is_busy_ = true;
    error_ = doUnlocked(lock, [this] { writeBlocksTo(file_, bytes_, block_bytes_); });
    is_busy_ = false;
    done_.notify_all();
  }

  SpoolFile& file_;
  const size_t block_bytes_;
  std::vector<unsigned char> bytes_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool waits_ = false, is_busy_ = false;
  std::exception_ptr error_;
};

RowSpool::RowSpool(size_t row_bytes, const std::string& temp_dir, SpoolShape shape,
                   const Tasks* tasks)
    : row_bytes_(row_bytes),
      blocks_(shape.blocks),
      shift_(static_cast<unsigned>(
          std::bit_width(std::max<size_t>(shape.block_bytes / row_bytes, 1)) - 1)),
      temp_dir_(temp_dir),
      tasks_(tasks && tasks->threads() > 1 ? tasks : nullptr) {}

RowSpool::~RowSpool() {
  if (behind_) (*behind_)->close();
}

size_t RowSpool::bytesOf(uint64_t block) const {
  const uint64_t in_block = std::min(rows_ - (block << shift_), uint64_t{1} << shift_);
  return static_cast<size_t>(in_block) * row_bytes_;
}

// Whole blocks, at the end the last one, too.
void RowSpool::writeBlocks(bool all) {
  if (!file_) {
    file_.emplace(temp_dir_);
    if (tasks_) behind_.emplace(new Behind(*file_, blockBytes()));
  }
  const size_t whole = all ? held_.size() : held_.size() - held_.size() % blockBytes();
  const std::vector<unsigned char> rest(held_.begin() + static_cast<std::ptrdiff_t>(whole),
                                        held_.end());
  held_.resize(whole);
  if (behind_)
    (*behind_)->write(held_, *tasks_);
  else
    writeBlocksTo(*file_, held_, blockBytes());
  held_.assign(rest.begin(), rest.end());
}

void RowSpool::append(const void* rows, size_t count) {
  const auto* bytes = static_cast<const unsigned char*>(rows);
  rows_ += count;
  for (size_t left = count; left > 0;) {  // never more than a block above what may be held
    const size_t some = std::min(left, size_t{1} << shift_);
    held_.insert(held_.end(), bytes, bytes + some * row_bytes_);
    bytes += some * row_bytes_;
    left -= some;
    if (held_.size() > blocks_ * blockBytes()) writeBlocks(false);
  }
}

void RowSpool::finish() {
  if (!file_) return;
  writeBlocks(true);
  if (behind_) {
    (*behind_)->settle();
    (*behind_)->close();
    behind_.reset();
  }
  held_ = {};  // until it is read
  block_at_.assign(blocks_, 0);
}

void RowSpool::readBlock(uint64_t block, size_t place) {
  if (held_.empty()) held_.resize(blocks_ * blockBytes());
  unsigned char* at = held_.data() + place * blockBytes();
  const uint64_t offset = block * (blockBytes() + sizeof(uint64_t));
  const size_t bytes = bytesOf(block);
  uint64_t sum;
  block_at_[place] = 0;
  file_->readAt(offset, at, bytes);
  file_->readAt(offset + bytes, &sum, sizeof sum);
  if (sum != checkSum(at, bytes))
    fail(Status::kIo, "block %llu of a temporary file was damaged since it was written",
         static_cast<unsigned long long>(block));
  block_at_[place] = block + 1;
}

const void* RowSpool::row(uint64_t index) {
  if (!file_) return held_.data() + static_cast<size_t>(index) * row_bytes_;
  const uint64_t block = index >> shift_;
  const auto place = static_cast<size_t>(block % blocks_);
  if (block_at_[place] != block + 1) readBlock(block, place);
  const uint64_t in_block = index & ((uint64_t{1} << shift_) - 1);
  return held_.data() + place * blockBytes() + static_cast<size_t>(in_block) * row_bytes_;
}

void RowSpool::read(uint64_t first, size_t count, void* out) {
  auto* to = static_cast<unsigned char*>(out);
  for (size_t n; count > 0; first += n, count -= n, to += n * row_bytes_) {
    const uint64_t in_block = first & ((uint64_t{1} << shift_) - 1);
    n = file_ ? static_cast<size_t>(std::min<uint64_t>(count, (uint64_t{1} << shift_) - in_block))
              : count;
    std::memcpy(to, row(first), n * row_bytes_);
  }
}

}  // namespace tetstream
