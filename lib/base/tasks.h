// base: work shared out among threads. Depends on nothing.
#pragma once

#include <cstddef>
#include <functional>

namespace tetstream {

// Cores that the process may use, at least 1.
size_t coresToUse();

class Tasks {
 public:
  explicit Tasks(size_t threads) : threads_(threads) {}
  size_t threads() const { return threads_; }
  // Calls work(0) to work(count - 1), some of them at the same time, the first on the caller's
  // thread, and returns when all have. Throws what the first of them threw that did.
  void forParts(size_t count, const std::function<void(size_t)>& work) const;

 private:
  size_t threads_;
};

}  // namespace tetstream
