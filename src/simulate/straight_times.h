#pragma once
// When one ball meets each of many others that fall as it does, so that their ways past it are straight: two, four or
// eight pairs at a time, whatever the processor has. The arithmetic is that of sphere_contact_time (contact_time.h), in
// the same order, so the bits are the same; pairs for which that takes more than a quadratic are left to it.
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "simulate/flight.h"

namespace carom {

/// An impact that only sphere_contact_time can tell the time of, or that there is none: touching, or grazing.
inline constexpr double unsure = -std::numeric_limits<double>::infinity();

struct Meet {
  Instant time;  // hi may be `unsure`
  Entity with;
};

/// Body i's impacts with others are asked for. None of them is in the contact group; all have the same acceleration.
struct StraightTask {
  const Flights::Core* flights;
  const double* radius;  // m, by body; null: all have the same,
  double own_radius;     // m, as body i
  Entity i;
  std::span<const Entity> others;
  Vec3 a;       // m/s^2
  bool latest;  // none of the others' flights began after body i's
  double end;   // s, later impacts are none
};

/// Writes the impacts, each by itself, in the others' order; gives how many. There must be room for as many as others.
std::size_t straight_times(const StraightTask& task, Meet* found);

/// What straight_times chooses from, on this processor.
using StraightKernel = std::size_t (*)(const StraightTask& task, Meet* found);
std::vector<StraightKernel> straight_kernels();

}  // namespace carom
