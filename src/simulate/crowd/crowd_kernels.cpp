// The vector kernels of crowds, for pairs and for fours of rows.
#include "simulate/crowd/crowd_kernels.h"

#include "geometry/contact_time.h"
#include "numerics/processor.h"
#include "std.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace carom {

namespace {

namespace pairs {
#define LANES 2
#include "simulate/crowd/crowd_kernels.inc"
#undef LANES
}  // namespace pairs

#ifdef __x86_64__
CAROM_BEGIN_AVX2
namespace fours {
#define LANES 4
#include "simulate/crowd/crowd_kernels.inc"
#undef LANES
}  // namespace fours
CAROM_END_TARGET
#endif

}  // namespace

vector<CrowdKernels> crowd_kernels() {
  vector<CrowdKernels> all{pairs::kernels};
#ifdef __x86_64__
  if (has_avx2()) all.push_back(fours::kernels);
#endif
  return all;
}

const CrowdKernels& widest_crowd_kernels() {
  static const CrowdKernels widest = crowd_kernels().back();
  return widest;
}

}  // namespace carom
