// Times of impact of one ball with many, in vectors. The kernel is compiled for each vector width and chosen by the
// processor at run time. All widths have the arithmetic of sphere_contact_time in the same order, so that the bits do
// not depend on the processor.
#include "simulate/loop/straight_times.h"

#include "numerics/processor.h"
#include "std.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace carom {

namespace {

namespace pairs {
#define LANES 2
#include "simulate/loop/straight_times_kernel.inc"
#undef LANES
}  // namespace pairs

#ifdef __x86_64__
CAROM_BEGIN_AVX2
namespace fours {
#define LANES 4
#include "simulate/loop/straight_times_kernel.inc"
#undef LANES
}  // namespace fours
CAROM_END_TARGET

CAROM_BEGIN_AVX512
namespace eights {
#define LANES 8
#include "simulate/loop/straight_times_kernel.inc"
#undef LANES
}  // namespace eights
CAROM_END_TARGET
#endif

}  // namespace

vector<StraightKernel> straight_kernels() {
  vector<StraightKernel> kernels{pairs::find};
#ifdef __x86_64__
  if (has_avx2()) kernels.push_back(fours::find);
  if (has_avx512()) kernels.push_back(eights::find);
#endif
  return kernels;
}

size_t straight_times(const StraightTask& task, Meet* found) {
  static const StraightKernel widest = straight_kernels().back();
  return widest(task, found);
}

}  // namespace carom
