#include "driver_memory.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace fuzz {

namespace {

std::atomic<bool> is_watching{false};
std::atomic<size_t> limit{0}, largest{0};

void look(size_t bytes) {
  if (!is_watching) return;
  if (bytes > largest) largest = bytes;
  if (limit == 0 || bytes <= limit) return;
  is_watching = false;
  std::fprintf(stderr, "a block of %zu bytes is asked for\n", bytes);
  std::abort();
}

}  // namespace

void limitAllocations(size_t bytes) {
  limit = bytes;
}

void watchAllocations(bool watching) {
  is_watching = watching;
}

size_t largestAllocation() {
  return largest;
}

}  // namespace fuzz

#if defined(TETSTREAM_SANITIZED)

// AddressSanitizer tells.
extern "C" void __sanitizer_malloc_hook(const volatile void*, size_t size) {
  fuzz::look(size);
}
extern "C" void __sanitizer_free_hook(const volatile void*) {}

#elif defined(__GLIBC__)

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);

void* malloc(size_t size) {
  fuzz::look(size);
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  size_t bytes;
  fuzz::look(__builtin_mul_overflow(count, size, &bytes) ? ~size_t{0} : bytes);
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  fuzz::look(size);
  return __libc_realloc(old, size);
}
}

#endif
