#include "vtu_side_by_side.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <vector>

#include "memory.h"
#include "status.h"
#include "tasks.h"

namespace tetstream {

namespace {

// About so many bytes take half a millisecond to decompress.
constexpr uint64_t kPartBytes = 64 << 10;
constexpr uint64_t kMostPartBytes = 1 << 20;
// Of one array; a mesh has several.
constexpr size_t kMostParts = 8;

class SideBySide final : public ValueBytes {
 public:
  SideBySide(const Helpers& helpers, uint64_t size, uint64_t part_bytes,
             std::unique_ptr<ValueBytes> bytes, OpenBytes open)
      : helpers_(helpers),
        open_(std::move(open)),
        size_(size),
        part_bytes_(part_bytes),
        held_(account_) {
    parts_.resize(std::min(helpers.threads.tasks->threads(), kMostParts));
    parts_[0] = std::move(bytes);
  }

  void readAt(uint64_t offset, void* out, size_t size) override {
    auto* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      if (offset < begin_ || offset >= end_) load(offset);
      if (offset < begin_ || offset >= end_) {
        parts_[0]->readAt(offset, to, size);
        next_ = offset + size;
        return;
      }
      const auto n = static_cast<size_t>(std::min<uint64_t>(size, end_ - offset));
      std::memcpy(to, held_.data() + (offset - begin_), n);
      to += n;
      offset += n;
      size -= n;
      next_ = offset;
    }
  }

 private:
  // Makes the parts from there on, if that is where a sequence goes on.
  void load(uint64_t offset) {
    if (is_damaged_ || offset != next_ || !helpers_.areHere()) return;
    const uint64_t begin = offset - offset % part_bytes_;
    const auto bytes =
        static_cast<size_t>(std::min<uint64_t>(parts_.size() * part_bytes_, size_ - begin));
    end_ = begin_ = 0;
    try {
      if (held_.size() < bytes) held_.resize(bytes);
      helpers_.threads.tasks->forParts(
          static_cast<size_t>((bytes - 1) / part_bytes_ + 1), [&](size_t part) {
            if (!parts_[part]) parts_[part] = open_();
            const uint64_t at = part * part_bytes_;
            parts_[part]->readAt(begin + at, held_.data() + at,
                                 static_cast<size_t>(std::min(part_bytes_, bytes - at)));
          });
    } catch (const Error& error) {
      if (error.status() == Status::kNoMemory) throw;
      // Those who read on in sequence get to it, after what is whole.
      is_damaged_ = true;
      parts_[0] = open_();
      return;
    }
    begin_ = begin;
    end_ = begin + bytes;
  }

  const Helpers helpers_;
  const OpenBytes open_;
  const uint64_t size_, part_bytes_;
  std::vector<std::unique_ptr<ValueBytes>>
      parts_;  // one reads one part, then that of the next turn
  Account account_;
  Array<unsigned char> held_;
  uint64_t begin_ = 0, end_ = 0;  // of what is held
  uint64_t next_ = 0;             // behind what was last read
  bool is_damaged_ = false;
};

class SharedBytes final : public ByteSource {
 public:
  explicit SharedBytes(std::unique_ptr<ByteSource> bytes)
      : ByteSource(bytes->name()), bytes_(std::move(bytes)) {}
  size_t read(void* out, size_t size) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bytes_->read(out, size);
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bytes_->readAt(offset, out, size);
  }
  bool seekable() const override { return bytes_->seekable(); }
  uint64_t size() const override { return bytes_->size(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<ValueBytes> openSideBySide(const Helpers& helpers, uint64_t size,
                                           uint64_t block_bytes, std::unique_ptr<ValueBytes> bytes,
                                           OpenBytes open) {
  const uint64_t part = ((kPartBytes - 1) / block_bytes + 1) * block_bytes;
  if (part > kMostPartBytes || size <= part) return bytes;
  return std::make_unique<SideBySide>(helpers, size, part, std::move(bytes), std::move(open));
}

std::unique_ptr<ByteSource> openShared(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<SharedBytes>(std::move(bytes));
}

}  // namespace tetstream
