// base: what of the processor is not the compiler's to know. Depends on nothing.
#pragma once

namespace tetstream {

// Those for x86-64-v3: what else that level asks for came with these two or before them.
inline bool processorHasV3() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

// A moment's rest in a loop that waits for another thread.
inline void restBriefly() {
#ifdef __x86_64__
  __builtin_ia32_pause();
#endif
}

}  // namespace tetstream
