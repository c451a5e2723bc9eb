// base: waiting for somebody at the other end, which another thread can end. Depends on nothing.
#pragma once

#include <atomic>

namespace tetstream {

class Waiting {
 public:
  // From any thread: who waits now, soon does no more, and who would later, not at all.
  void end() noexcept { is_over_.store(true, std::memory_order_relaxed); }
  // Until `fd` has bytes, has come to its end, or has failed, which a read tells then. False: the
  // waiting was ended.
  bool forBytes(int fd) const noexcept;

 private:
  std::atomic<bool> is_over_ = false;
};

}  // namespace tetstream
