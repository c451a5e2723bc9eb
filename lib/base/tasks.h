// base: work shared out among threads. Depends on nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace tetstream {

// Cores that the process may use, at least 1.
size_t coresToUse();

// Threads that wait for work. They start with the first that is shared out, and end with the pool;
// signals are left to the other threads of the process.
class Tasks {
 public:
  explicit Tasks(size_t threads);
  ~Tasks();
  size_t threads() const { return threads_; }
  // Calls work(0) to work(count - 1), some of them at the same time, the first on the caller's
  // thread, and returns when all have. A part that no thread has begun is the caller's. Throws what
  // the first of them threw that did. One caller at a time, and none of them from within.
  void forParts(size_t count, const std::function<void(size_t)>& work) const;

 private:
  struct Pool;
  size_t threads_;
  std::unique_ptr<Pool> pool_;
};

}  // namespace tetstream
