#include "tasks.h"

#include <exception>
#include <thread>
#include <vector>

namespace tetstream {

void Tasks::forParts(size_t count, const std::function<void(size_t)>& work) {
  std::vector<std::thread> others;
  std::vector<std::exception_ptr> errors(count);
  const auto guarded = [&](size_t i) {
    try {
      work(i);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  };
  for (size_t i = 1; i < count; ++i) others.emplace_back(guarded, i);
  guarded(0);
  for (std::thread& t : others) t.join();
  for (const std::exception_ptr& e : errors)
    if (e) std::rethrow_exception(e);
}

}  // namespace tetstream
