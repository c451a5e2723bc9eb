// base: which builds of the kernels the processor can run. Depends on nothing.
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

}  // namespace tetstream
