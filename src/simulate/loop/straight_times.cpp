// Times of impact of one ball with many, in vectors. All vector widths have the arithmetic of sphere_contact_time in
// the same order, so that the bits do not depend on the processor.
#include "simulate/loop/straight_times.h"

#include "numerics/vectors.h"
#include "std.h"

namespace carom {

namespace {

#define KERNEL_FILE "simulate/loop/straight_times_kernel.inc"
#include "numerics/each_width.inc"

}  // namespace

vector<StraightKernel> straight_kernels() {
  return EACH_WIDTH(find);
}

size_t straight_times(const StraightTask& task, Meet* found) {
  static const StraightKernel widest = straight_kernels().back();
  return widest(task, found);
}

}  // namespace carom
