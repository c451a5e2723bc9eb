// base: work shared out among threads. Depends on nothing.
#pragma once

#include <cstddef>
#include <functional>

namespace tetstream {

class Tasks {
 public:
  explicit Tasks(size_t threads) : threads_(threads) {}
  size_t threads() const { return threads_; }
  void forParts(size_t count, const std::function<void(size_t)>& work);

 private:
  size_t threads_;
};

}  // namespace tetstream
