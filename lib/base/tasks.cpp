#include "tasks.h"

#include <sched.h>

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace tetstream {

size_t coresToUse() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(CPU_COUNT(&set), 1);
  return std::max(std::thread::hardware_concurrency(), 1u);
}

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
