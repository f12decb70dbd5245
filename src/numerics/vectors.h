#pragma once
// The compiler's vectors (__attribute__((vector_size)), which have operators for all arithmetic, on any processor),
// with what they lack: vectors.inc. Kernels are written once for any width, and compiled for each: each_width.inc.
#include <cstring>

#include "numerics/processor.h"
#include "std.h"

#define FORCED static inline __attribute__((always_inline))

namespace carom {

#define VECTOR_BITS 128
#include "numerics/vectors.inc"
#undef VECTOR_BITS

}  // namespace carom
