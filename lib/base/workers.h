// base: threads that work beside the caller's. Depends on nothing.
#pragma once

#include <cstddef>
#include <memory>

namespace tetstream {

// A piece of work, which may be run late, when nobody waits for it any more: it finds out by itself
// whether anything is left to do.
class Work {
 public:
  virtual ~Work() = default;
  virtual void run() noexcept = 0;
};

class Workers {
 public:
  virtual ~Workers() = default;
  virtual size_t threads() const = 0;
  // Has the work run once, at any time, by one of the threads or at once. False: nobody will. Only
  // the caller's thread submits.
  virtual bool submit(std::shared_ptr<Work> work) noexcept = 0;
};

// Threads of our own. Each starts when there is work that no other waits for; what nobody has begun
// when they end is dropped. Signals are left to the other threads of the process.
std::unique_ptr<Workers> startWorkers(size_t threads);

}  // namespace tetstream
