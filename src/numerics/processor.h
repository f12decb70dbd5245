#pragma once
// The vector instructions of the present processor, for kernels in several widths.
//
// Functions between CAROM_BEGIN_AVX2 or CAROM_BEGIN_AVX512 and CAROM_END_TARGET are compiled for processors with these
// instructions. Headers must be included before. Their functions are not affected.

#ifdef __clang__
#define CAROM_BEGIN_AVX2 _Pragma("clang attribute push(__attribute__((target(\"avx2\"))), apply_to = function)")
#define CAROM_BEGIN_AVX512 \
  _Pragma("clang attribute push(__attribute__((target(\"avx512f,avx512dq,avx512vl\"))), apply_to = function)")
#define CAROM_END_TARGET _Pragma("clang attribute pop")
#else
#define CAROM_BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2\")")
#define CAROM_BEGIN_AVX512 \
  _Pragma("GCC push_options") _Pragma("GCC target(\"avx512f,avx512dq,avx512vl,prefer-vector-width=512\")")
#define CAROM_END_TARGET _Pragma("GCC pop_options")
#endif

namespace carom {

inline bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

/// The parts of AVX-512 in the kernels' target options.
inline bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

/// After a library's wide vectors: it may leave the upper parts of registers in use, which slows narrow instructions.
inline void end_wide_vectors() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx")) __asm__ volatile("vzeroupper");
#endif
}

}  // namespace carom
