// Selection of regions that may touch a given one, in vectors of four, eight or sixteen. The widest that the processor
// has is chosen at run time. All kernels give the bits of may_touch (region.h), so that results do not depend on the
// processor.
#include "simulate/space/touching.h"

#include "numerics/vectors.h"
#include "std.h"

namespace carom {

namespace {

// gcc 12 warns of its own undefined registers (its bug 105593).
#pragma GCC diagnostic push
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#define KERNEL_FILE "simulate/space/touching_kernel.inc"
#include "numerics/each_width.inc"

#pragma GCC diagnostic pop

}  // namespace

vector<SelectKernel> select_kernels() {
  return EACH_WIDTH(select);
}

size_t select_touching(const Region& region, const Region* regions, const Entity* bodies, size_t count, bool touching,
                       Entity* to) {
  static const SelectKernel widest = select_kernels().back();
  return widest(region, regions, bodies, count, touching, to);
}

}  // namespace carom
