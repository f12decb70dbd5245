#include "simulate/touching.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace carom {

namespace {

#ifdef __x86_64__

// gcc 12 warns of its own undefined registers (its bug 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace fours {
#define LANES 4
#include "simulate/touching_kernel.inc"
#undef LANES
}  // namespace fours

#pragma GCC push_options
#pragma GCC target("avx2")
namespace eights {
#define LANES 8
#include "simulate/touching_kernel.inc"
#undef LANES
}  // namespace eights
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")
namespace sixteens {
#define LANES 16
#include "simulate/touching_kernel.inc"
#undef LANES
}  // namespace sixteens
#pragma GCC pop_options

#pragma GCC diagnostic pop

auto choose() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return sixteens::select;
  return __builtin_cpu_supports("avx2") ? eights::select : fours::select;
}

#else

std::size_t select(const Region& region, const Region* regions, const Entity* bodies, std::size_t count, bool touching,
                   Entity* to) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Entity body = bodies[k];
    if (may_touch(region, regions[body]) == touching) to[kept++] = body;
  }
  return kept;
}

auto choose() {
  return select;
}

#endif

const auto chosen_select = choose();

}  // namespace

std::size_t select_touching(const Region& region, const Region* regions, const Entity* bodies, std::size_t count,
                            bool touching, Entity* to) {
  return chosen_select(region, regions, bodies, count, touching, to);
}

}  // namespace carom
