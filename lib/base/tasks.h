// base: work shared out among threads. Depends on workers.h.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "workers.h"

namespace tetstream {

// Cores that the process may use, at least 1.
size_t coresToUse();

// The caller's thread and those that help it. One caller at a time.
class Tasks {
 public:
  // With `brought`, which is borrowed, no thread is started; without, those that are needed are,
  // and end with the object.
  explicit Tasks(size_t threads, Workers* brought = nullptr);
  ~Tasks();
  size_t threads() const { return threads_; }
  // Calls work(0) to work(count - 1), some of them at the same time, the first on the caller's
  // thread, and returns when all have. A part that no thread has begun is the caller's. Throws what
  // the first of them threw that did. Not from within.
  void forParts(size_t count, const std::function<void(size_t)>& work) const;
  // Has the work run beside what the caller does; false: nobody will.
  bool submit(Work* work) const { return workers_->submit(Kept<Work>(work)); }

 private:
  class Parts;
  size_t threads_;
  std::unique_ptr<Workers> own_;
  Workers* workers_;
  Kept<Parts> parts_;
};

// work(0) to work(count - 1), at the same time where there are tasks; without, one after the other.
void doEach(const Tasks* tasks, size_t count, const std::function<void(size_t)>& work);
void doBoth(const Tasks* tasks, const std::function<void()>& one,
            const std::function<void()>& other);

}  // namespace tetstream
