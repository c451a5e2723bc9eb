#include "tasks.h"

#include <sched.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "unlocked.h"
#include "wait_briefly.h"

namespace tetstream {

size_t coresToUse() {
  cpu_set_t set;
  CPU_ZERO(&set);
  const bool is_known = sched_getaffinity(0, sizeof set, &set) == 0;
  const size_t cores = is_known ? static_cast<size_t>(CPU_COUNT(&set)) : 0;
  return std::max<size_t>(cores > 0 ? cores : std::thread::hardware_concurrency(), 1);
}

// What is shared out at the time. run() helps with it, on a helper's thread; if it comes late it
// helps with what is shared out by then, or finds nothing.
class Tasks::Parts final : public Work {
 public:
  void run() noexcept override {
    std::unique_lock<std::mutex> lock(mutex_);
    --helpers_;
    ++running_;
    while (next_ < count_) runPart(next_++, lock);
    if (--running_ == 0) done_.notify_one();
  }

  // Begins, and returns how many more should help so that `wanted` do.
  size_t begin(size_t count, const std::function<void(size_t)>& work, size_t wanted) {
    const std::lock_guard<std::mutex> lock(mutex_);
    errors_.assign(count, nullptr);
    work_ = &work;
    count_ = count;
    next_ = 1;
    const size_t more = wanted - std::min(wanted, helpers_);
    helpers_ += more;
    return more;
  }
  void countRefused() {
    const std::lock_guard<std::mutex> lock(mutex_);
    --helpers_;
  }

  // The caller's part, and what nobody has begun.
  void finish() {
    std::unique_lock<std::mutex> lock(mutex_);
    runPart(0, lock);
    while (next_ < count_) runPart(next_++, lock);
    waitBriefly(done_, lock, [this] { return running_ == 0; });
    for (const std::exception_ptr& error : errors_)
      if (error) std::rethrow_exception(error);
  }

 private:
  // With the mutex held, but not while it runs.
  void runPart(size_t part, std::unique_lock<std::mutex>& lock) {
    errors_[part] = doUnlocked(lock, [&] { (*work_)(part); });
  }

  std::mutex mutex_;
  std::condition_variable done_;
  const std::function<void(size_t)>* work_ = nullptr;
  size_t next_ = 0, count_ = 0;  // of the parts that nobody has begun
  size_t helpers_ = 0;           // asked to come, and not here yet
  size_t running_ = 0;           // here
  std::vector<std::exception_ptr> errors_;
};

Tasks::Tasks(size_t threads, Workers* brought)
    : threads_(std::max<size_t>(threads, 1)),
      own_(brought ? nullptr : startWorkers(threads_ - 1)),
      workers_(brought ? brought : own_.get()),
      parts_(new Parts) {}

// The threads end first: one of them may be on its way to find that nothing is left to do.
Tasks::~Tasks() {
  own_.reset();
}

void Tasks::forParts(size_t count, const std::function<void(size_t)>& work) const {
  if (count == 0) return;
  const size_t more = parts_->begin(count, work, std::min(threads_, count) - 1);
  for (size_t i = 0; i < more; ++i)
    if (!submit(parts_.get())) parts_->countRefused();
  parts_->finish();
}

void doEach(const Tasks* tasks, size_t count, const std::function<void(size_t)>& work) {
  if (tasks && count > 1)
    tasks->forParts(count, work);
  else
    for (size_t i = 0; i < count; ++i) work(i);
}

void doBoth(const Tasks* tasks, const std::function<void()>& one,
            const std::function<void()>& other) {
  doEach(tasks, 2, [&](size_t i) { i == 0 ? one() : other(); });
}

}  // namespace tetstream
