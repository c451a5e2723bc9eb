#include "memory.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <sys/mman.h>
#include <unistd.h>

namespace tetstream {

// Arrays of so many bytes lie on large pages, where the system has them on request: a window that
// is far larger than the caches finds most of its vertices without a walk through page tables then.
// In smaller ones the memory up to the end of a page of 2 MB would weigh more than that.
constexpr size_t kLeastOnLargePages = size_t{4} << 20;

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

// Sizes of a whole budget are not rounded.
static size_t scaled(size_t bytes, double factor) {
  return factor == 1 ? bytes : static_cast<size_t>(std::ceil(factor * static_cast<double>(bytes)));
}

Account::Account(size_t budget_bytes, double share)
    : budget_(budget_bytes), share_(share), limit_(scaled(budget_bytes, share)) {}

void Account::refuse(size_t bytes) {
  refused_.store(true, std::memory_order_relaxed);
  fail(Status::kNoMemory, "the memory budget of %zu bytes is too small: at least %zu are needed",
       budget_, scaled(bytes, 1 / share_));
}

void Account::charge(size_t bytes) {
  size_t before = used(), after;
  do {
    after = checkedAdd(before, bytes);
    if (limit_ != 0 && after > limit_) refuse(after);
  } while (!used_.compare_exchange_weak(before, after, std::memory_order_relaxed));
  size_t peak = this->peak();
  while (after > peak && !peak_.compare_exchange_weak(peak, after, std::memory_order_relaxed)) {
  }
}

// note: whole pages, with what the allocator has before the array, so that what it took from the
// system for the array alone stays in one piece and grows without a copy.
static void askForLargePages(void* data, size_t bytes) {
#ifdef MADV_HUGEPAGE
  static const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t before = reinterpret_cast<uintptr_t>(data) % page;
  const size_t all = (before + bytes + page - 1) / page * page;
  madvise(static_cast<char*>(data) - before, all, MADV_HUGEPAGE);  // or does without
#else
  (void)data, (void)bytes;
#endif
}

void askForPages(void* data, size_t bytes) noexcept {
#ifdef MADV_POPULATE_WRITE
  static const auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const size_t before = -reinterpret_cast<uintptr_t>(data) % page;
  const size_t whole = bytes > before ? (bytes - before) / page * page : 0;
  // note: a single one may as well come when it is written; before Linux 5.14 all do.
  if (whole > page) madvise(static_cast<char*>(data) + before, whole, MADV_POPULATE_WRITE);
#else
  (void)data, (void)bytes;
#endif
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
    account.failedOtherwise();
    fail(Status::kNoMemory, "the system has no %zu bytes of memory left", new_bytes);
  }
  if (new_bytes < old_bytes) account.release(old_bytes - new_bytes);
  const bool is_bounded = account.limit() != 0;  // then no byte is to be paid for that is not used
  if (!is_bounded && new_bytes >= kLeastOnLargePages) askForLargePages(data, new_bytes);
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
