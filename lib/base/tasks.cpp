#include "tasks.h"

#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace tetstream {

void Tasks::forParts(size_t count, const std::function<void(size_t)>& work) const {
  std::vector<std::exception_ptr> errors(count);
  const auto guarded = [&](size_t part) {
    try {
      work(part);
    } catch (...) {
      errors[part] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(count);
  size_t started = 1;
  try {
    for (; started < count && started < threads_; ++started) others.emplace_back(guarded, started);
  } catch (const std::system_error&) {  // the system has no more threads: parts wait for this one
  }
  if (count > 0) guarded(0);
  for (size_t part = started; part < count; ++part) guarded(part);
  for (std::thread& thread : others) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace tetstream
