#include "workers.h"

#include <signal.h>

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "wait_briefly.h"

namespace tetstream {
namespace {

// No signal is delivered to threads that are started while it lives.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

class OwnWorkers final : public Workers {
 public:
  explicit OwnWorkers(size_t most) : most_(most) {}

  ~OwnWorkers() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
      given_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
  }

  size_t threads() const override { return most_; }

  bool submit(Kept<Work> work) noexcept override {
    try {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (waiting_ <= queue_.size() && threads_.size() < most_) start();
      if (threads_.empty()) return false;
      queue_.push_back(std::move(work));
      given_.notify_one();
    } catch (const std::exception&) {  // no memory: the caller does it
      return false;
    }
    return true;
  }

 private:
  void start() {
    const SignalsHeldBack held_back;
    threads_.reserve(most_);
    try {
      threads_.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {  // the system has no more
    }
  }

  void serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      ++waiting_;
      waitBriefly(given_, lock, [this] { return is_over_ || !queue_.empty(); });
      --waiting_;
      if (is_over_) return;
      {
        const Kept<Work> work = std::move(queue_.front());
        queue_.pop_front();
        lock.unlock();
        work->run();
      }
      lock.lock();
    }
  }

  const size_t most_;
  std::mutex mutex_;
  std::condition_variable given_;
  std::deque<Kept<Work>> queue_;
  size_t waiting_ = 0;  // threads that have nothing to do
  bool is_over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<Workers> startWorkers(size_t threads) {
  return std::make_unique<OwnWorkers>(threads);
}

}  // namespace tetstream
