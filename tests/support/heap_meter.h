// tests/support: what a program has allocated with new, and the most that it had. To be included by
// one file of it.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

static size_t held_bytes = 0, peak_bytes = 0;

// Every allocation carries its size in front of it.
constexpr size_t kMeteredFront = alignof(std::max_align_t);

__attribute__((noinline)) void* operator new(size_t size) {
  auto* block = static_cast<char*>(std::malloc(size + kMeteredFront));
  if (!block) throw std::bad_alloc();
  *reinterpret_cast<size_t*>(block) = size;
  held_bytes += size;
  if (held_bytes > peak_bytes) peak_bytes = held_bytes;
  return block + kMeteredFront;
}
// Sanitizers' own would not call the one above.
__attribute__((noinline)) void* operator new(size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
__attribute__((noinline)) void operator delete(void* p) noexcept {
  if (!p) return;
  char* block = static_cast<char*>(p) - kMeteredFront;
  held_bytes -= *reinterpret_cast<size_t*>(block);
  std::free(block);
}
__attribute__((noinline)) void operator delete(void* p, size_t) noexcept {
  operator delete(p);
}
