#include "memory.h"

#include <cstdio>
#include <cstdlib>

namespace tetstream {

size_t checkedMultiply(size_t a, size_t b) {
  size_t product;
  if (__builtin_mul_overflow(a, b, &product))
    fail(Status::kNoMemory, "a size of %zu times %zu bytes does not fit into memory", a, b);
  return product;
}

size_t checkedAdd(size_t a, size_t b) {
  size_t sum;
  if (__builtin_add_overflow(a, b, &sum))
    fail(Status::kNoMemory, "a size of %zu plus %zu bytes does not fit into memory", a, b);
  return sum;
}

void Account::charge(size_t bytes) {
  size_t before = used(), after;
  do {
    after = checkedAdd(before, bytes);
    if (limit_ != 0 && after > limit_)
      fail(Status::kNoMemory,
           "the memory budget of %zu bytes is too small: at least %zu are needed", limit_, after);
  } while (!used_.compare_exchange_weak(before, after, std::memory_order_relaxed));
  size_t peak = this->peak();
  while (after > peak && !peak_.compare_exchange_weak(peak, after, std::memory_order_relaxed)) {
  }
}

void* reallocateBytes(Account& account, void* old, size_t old_bytes, size_t new_bytes) {
  if (new_bytes == old_bytes) return old;
  if (new_bytes > old_bytes) account.charge(new_bytes - old_bytes);
  if (new_bytes == 0) {
    std::free(old);
    account.release(old_bytes);
    return nullptr;
  }
  void* data = std::realloc(old, new_bytes);
  if (!data) {
    if (new_bytes > old_bytes) account.release(new_bytes - old_bytes);
    fail(Status::kNoMemory, "the system has no %zu bytes of memory left", new_bytes);
  }
  if (new_bytes < old_bytes) account.release(old_bytes - new_bytes);
  return data;
}

void freeBytes(Account& account, void* old, size_t old_bytes) noexcept {
  std::free(old);
  account.release(old_bytes);
}

uint64_t peakResidentBytes() {
  std::FILE* file = std::fopen("/proc/self/status", "r");
  if (!file) return 0;
  char line[128];
  unsigned long long kilobytes = 0;
  while (std::fgets(line, sizeof line, file))
    if (std::sscanf(line, "VmHWM: %llu kB", &kilobytes) == 1) break;
  std::fclose(file);
  return kilobytes * 1024;
}

}  // namespace tetstream
