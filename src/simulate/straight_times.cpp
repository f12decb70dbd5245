#include "simulate/straight_times.h"

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace carom {

namespace {

/// What a kernel works on.
struct Task {
  const Flights::Core* flights;
  const double* radius;  // m; null: all have the same
  double own_radius;     // m
  Entity i;
  const Entity* others;
  std::size_t count;
  double a[3];
  bool falls, latest;  // a is not zero; no flight of the others began later
  double end;
};

namespace pairs {
#define LANES 2
#include "simulate/straight_times_kernel.inc"
#undef LANES
}  // namespace pairs

#ifdef __x86_64__
#pragma GCC push_options
#pragma GCC target("avx2")
namespace fours {
#define LANES 4
#include "simulate/straight_times_kernel.inc"
#undef LANES
}  // namespace fours
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")
namespace eights {
#define LANES 8
#include "simulate/straight_times_kernel.inc"
#undef LANES
}  // namespace eights
#pragma GCC pop_options
#endif

auto choose() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return eights::find;
  if (__builtin_cpu_supports("avx2")) return fours::find;
#endif
  return pairs::find;
}

const auto find = choose();

}  // namespace

std::size_t straight_times(const Flights& flights, std::span<const double> radius, Entity i,
                           std::span<const Entity> others, bool alike, const Vec3& a, bool latest, double end,
                           Meet* found) {
  const Task task{.flights = flights.cores(),
                  .radius = alike ? nullptr : radius.data(),
                  .own_radius = radius[i],
                  .i = i,
                  .others = others.data(),
                  .count = others.size(),
                  .a = {a[0], a[1], a[2]},
                  .falls = !a.isZero(0),
                  .latest = latest,
                  .end = end};
  return find(task, found);
}

}  // namespace carom
