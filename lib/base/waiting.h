// base: waiting for somebody at the other end, which another thread can end, and during which a
// thread may do something else. Depends on nothing.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <utility>

namespace tetstream {

class Waiting {
 public:
  // From any thread: who waits now, soon does no more, and who would later, not at all.
  void end() noexcept { is_over_.store(true, std::memory_order_relaxed); }
  // Until `fd` has bytes, has come to its end, or has failed, which a read tells then. False: the
  // waiting was ended. Throws what is done meanwhile throws.
  bool forBytes(int fd) const;

  // What the thread that says so does, twenty times a second, while it waits: for bytes, or for
  // another one that does; or nothing. Not while it does that.
  void doMeanwhile(std::function<void()> work) {
    thread_ = std::this_thread::get_id();
    meanwhile_ = std::move(work);
  }
  // By who waits for another thread, each time that it has waited so long.
  void meanwhile() const {
    if (std::this_thread::get_id() == thread_ && meanwhile_) meanwhile_();
  }
  static constexpr int kMilliseconds = 50;

 private:
  std::atomic<bool> is_over_ = false;
  std::atomic<std::thread::id> thread_{};  // others look at it while they wait
  std::function<void()> meanwhile_;
};

}  // namespace tetstream
