#include "tasks.h"

#include <sched.h>
#include <signal.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace tetstream {

size_t coresToUse() {
  cpu_set_t set;
  CPU_ZERO(&set);
  const bool is_known = sched_getaffinity(0, sizeof set, &set) == 0;
  const size_t cores = is_known ? static_cast<size_t>(CPU_COUNT(&set)) : 0;
  return std::max<size_t>(cores > 0 ? cores : std::thread::hardware_concurrency(), 1);
}

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

}  // namespace

struct Tasks::Pool {
  std::mutex mutex;
  std::condition_variable begun, done;
  std::vector<std::thread> threads;
  const std::function<void(size_t)>* work = nullptr;
  size_t next = 0, count = 0;  // of the parts that nobody has begun
  size_t running = 0;          // by the pool's threads
  std::vector<std::exception_ptr> errors;
  bool is_over = false;

  // With the mutex held, but not while it runs.
  void runNext(std::unique_lock<std::mutex>& lock) {
    const size_t part = next++;
    lock.unlock();
    std::exception_ptr error;
    try {
      (*work)(part);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    errors[part] = error;
  }

  void serve() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      begun.wait(lock, [this] { return is_over || next < count; });
      if (is_over) return;
      ++running;
      runNext(lock);
      if (--running == 0) done.notify_one();
    }
  }

  void start(size_t wanted) {
    const SignalsHeldBack held_back;
    try {
      while (threads.size() < wanted) threads.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {  // the system has no more: the caller does their parts
    }
  }
};

Tasks::Tasks(size_t threads)
    : threads_(std::max<size_t>(threads, 1)), pool_(std::make_unique<Pool>()) {}

Tasks::~Tasks() {
  {
    const std::lock_guard<std::mutex> lock(pool_->mutex);
    pool_->is_over = true;
  }
  pool_->begun.notify_all();
  for (std::thread& thread : pool_->threads) thread.join();
}

void Tasks::forParts(size_t count, const std::function<void(size_t)>& work) const {
  Pool& pool = *pool_;
  pool.start(std::min(threads_, count) - (count > 0));
  std::unique_lock<std::mutex> lock(pool.mutex);
  pool.errors.assign(count, nullptr);
  pool.work = &work;
  pool.count = count;
  pool.next = 0;
  if (count > 0) {
    pool.begun.notify_all();
    while (pool.next < count) pool.runNext(lock);
  }
  pool.done.wait(lock, [&] { return pool.running == 0; });
  for (const std::exception_ptr& error : pool.errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace tetstream
