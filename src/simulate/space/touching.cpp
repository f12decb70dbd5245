// Selection of regions that may touch a given one, in vectors of four, eight or sixteen. The widest that the processor
// has is chosen at run time. All kernels give the bits of may_touch (region.h), so that results do not depend on the
// processor.
#include "simulate/space/touching.h"

#include "numerics/processor.h"
#include "std.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace carom {

namespace {

#ifdef __x86_64__

// gcc 12 warns of its own undefined registers (its bug 105593).
#pragma GCC diagnostic push
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace fours {
#define LANES 4
#include "simulate/space/touching_kernel.inc"
#undef LANES
}  // namespace fours

CAROM_BEGIN_AVX2
namespace eights {
#define LANES 8
#include "simulate/space/touching_kernel.inc"
#undef LANES
}  // namespace eights
CAROM_END_TARGET

CAROM_BEGIN_AVX512
namespace sixteens {
#define LANES 16
#include "simulate/space/touching_kernel.inc"
#undef LANES
}  // namespace sixteens
CAROM_END_TARGET

#pragma GCC diagnostic pop

#endif

size_t select_one_by_one(const Region& region, const Region* regions, const Entity* bodies, size_t count, bool touching,
                         Entity* to) {
  size_t kept = 0;
  for (size_t k = 0; k < count; ++k) {
    const Entity body = bodies[k];
    if (may_touch(region, regions[body]) == touching) to[kept++] = body;
  }
  return kept;
}

}  // namespace

vector<SelectKernel> select_kernels() {
  vector<SelectKernel> kernels{select_one_by_one};
#ifdef __x86_64__
  kernels.push_back(fours::select);
  if (has_avx2()) kernels.push_back(eights::select);
  if (has_avx512()) kernels.push_back(sixteens::select);
#endif
  return kernels;
}

size_t select_touching(const Region& region, const Region* regions, const Entity* bodies, size_t count, bool touching,
                       Entity* to) {
  static const SelectKernel widest = select_kernels().back();
  return widest(region, regions, bodies, count, touching, to);
}

}  // namespace carom
