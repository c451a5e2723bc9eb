#include "caller_workers.h"

#include "guard.h"
#include "option_values.h"

namespace tetstream {

extern "C" {
static void runWork(void* argument) {
  const Undisturbed undisturbed;
  Work* const work = static_cast<Work*>(argument);
  work->run();
  work->drop();
}
}

namespace {

class CallerWorkers final : public Workers {
 public:
  explicit CallerWorkers(const tetstream_pool_callbacks& callbacks) : callbacks_(callbacks) {}

  size_t threads() const override { return static_cast<size_t>(callbacks_.threads); }

  bool submit(Kept<Work> work) noexcept override {
    work->keep();  // until runWork was called
    try {
      if (callbacks_.submit(callbacks_.user, runWork, work.get()) == 0) return true;
    } catch (...) {  // it did not take it either
    }
    work->drop();
    return false;
  }

 private:
  const tetstream_pool_callbacks callbacks_;
};

}  // namespace

std::shared_ptr<Workers> callerWorkers(const tetstream_pool_callbacks& callbacks) {
  needPlace(reinterpret_cast<const void*>(callbacks.submit), "the callback submit");
  if (callbacks.threads < 0 || callbacks.threads > kMostThreads)
    fail(Status::kBadArgument, "the pool: %d threads are outside 0 to %d", callbacks.threads,
         kMostThreads);
  return std::make_shared<CallerWorkers>(callbacks);
}

}  // namespace tetstream
