/// Which instructions for vectors this machine has, for functions that are compiled for several sets.
#pragma once

// MinGW does not align the stack for the wide ones.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32)
#define SONOGLIDE_VECTOR_UNITS 1
#endif

namespace sonoglide::numeric {

enum class VectorUnit { any, avx2, avx512 };

/// The best that this machine has. It decides the time, never a bit.
inline VectorUnit best_vector_unit() {
#ifdef SONOGLIDE_VECTOR_UNITS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return VectorUnit::avx512;
  }
  if (__builtin_cpu_supports("avx2")) {
    return VectorUnit::avx2;
  }
#endif
  return VectorUnit::any;
}

}  // namespace sonoglide::numeric
