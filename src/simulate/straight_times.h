#pragma once
// When one ball meets each of many others that fall as it does, so that their ways past it are straight: two, four or
// eight pairs at a time, whatever the processor has. The arithmetic is that of sphere_contact_time (contact_time.h), in
// the same order, so the bits are the same; pairs for which that takes more than a quadratic are left to it.
#include <cstddef>
#include <limits>
#include <span>

#include "simulate/flight.h"

namespace carom {

/// A meeting that only sphere_contact_time can tell the time of, or that there is none: touching, or grazing.
inline constexpr double unsure = -std::numeric_limits<double>::infinity();

struct Meet {
  Instant time;  // hi may be `unsure`
  Entity with;
};

/// Writes body i's meetings with others, each by itself, in the others' order; gives how many. There must be room for
/// as many as others. radius: m, by body; alike: all the same. a: m/s^2, of all of these. latest: none of the others'
/// flights began after body i's. end: s, later meetings are none.
std::size_t straight_times(const Flights& flights, std::span<const double> radius, Entity i,
                           std::span<const Entity> others, bool alike, const Vec3& a, bool latest, double end,
                           Meet* found);

}  // namespace carom
