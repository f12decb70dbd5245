#pragma once
// What depends on the processor: its vector instructions.
//
// Functions between BEGIN_AVX2 or BEGIN_AVX512 and END_TARGET are compiled for processors with these instructions.
// Headers must be included before. Their functions are not affected.
#include "std.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

#ifdef __clang__
#define BEGIN_AVX2 _Pragma("clang attribute push(__attribute__((target(\"avx2\"))), apply_to = function)")
#define BEGIN_AVX512 \
  _Pragma("clang attribute push(__attribute__((target(\"avx512f,avx512dq,avx512vl\"))), apply_to = function)")
#define END_TARGET _Pragma("clang attribute pop")
#else
#define BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2\")")
#define BEGIN_AVX512 \
  _Pragma("GCC push_options") _Pragma("GCC target(\"avx512f,avx512dq,avx512vl,prefer-vector-width=512\")")
#define END_TARGET _Pragma("GCC pop_options")
#endif

namespace carom {

/// Of kernels for vectors of 128, 256 and 512 bits, those that the present processor can run.
template <typename Kernel>
vector<Kernel> usable_kernels(vector<Kernel> kernels) {
  size_t usable = 1;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) usable = 2;
  // The parts of AVX-512 in the kernels' target options.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    usable = 3;
#endif
  kernels.resize(min(kernels.size(), usable));
  return kernels;
}

/// After a library's wide vectors: it may leave the upper parts of registers in use, which slows narrow instructions.
inline void end_wide_vectors() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx")) __asm__ volatile("vzeroupper");
#endif
}

/// In a loop that waits for another thread: leaves the core to the thread that shares it.
inline void pause_loop() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ volatile("yield");
#endif
}

}  // namespace carom
