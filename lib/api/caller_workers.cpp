#include "caller_workers.h"

#include <new>
#include <utility>

#include "guard.h"
#include "option_values.h"

namespace tetstream {

// A piece of work on its way through the caller's pool.
using Ticket = std::shared_ptr<Work>;

extern "C" {
static void runTicket(void* argument) {
  const std::unique_ptr<Ticket> ticket(static_cast<Ticket*>(argument));
  (*ticket)->run();
}
}

namespace {

class CallerWorkers final : public Workers {
 public:
  explicit CallerWorkers(const tetstream_pool_callbacks& callbacks) : callbacks_(callbacks) {}

  size_t threads() const override { return static_cast<size_t>(callbacks_.threads); }

  bool submit(std::shared_ptr<Work> work) noexcept override {
    std::unique_ptr<Ticket> ticket(new (std::nothrow) Ticket(std::move(work)));
    try {
      if (!ticket || callbacks_.submit(callbacks_.user, runTicket, ticket.get()) != 0) return false;
    } catch (...) {  // it did not take it either
      return false;
    }
    static_cast<void>(ticket.release());  // runTicket has it
    return true;
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
