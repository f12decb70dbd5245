// The vector kernels of crowds, for pairs and for fours of rows.
#include "simulate/crowd/crowd_kernels.h"

#include "geometry/contact_time.h"
#include "numerics/vectors.h"
#include "std.h"

namespace carom {

namespace {

#define KERNEL_FILE "simulate/crowd/crowd_kernels.inc"
#define KERNEL_MOST_BITS 256
#include "numerics/each_width.inc"

}  // namespace

vector<CrowdKernels> crowd_kernels() {
  return EACH_WIDTH(kernels);
}

const CrowdKernels& widest_crowd_kernels() {
  static const CrowdKernels widest = crowd_kernels().back();
  return widest;
}

}  // namespace carom
