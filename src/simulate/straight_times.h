#pragma once
// When one ball meets each of many others that fall as it does, so that their ways past it are straight: two, four or
// eight pairs at a time, whatever the processor has. The arithmetic is that of sphere_contact_time (contact_time.h), in
// the same order, so the bits are the same; pairs for which that takes more than a quadratic are left to it.
#include <cstddef>
#include <span>

#include "simulate/flight.h"

namespace carom {

/// An entry of StraightTimes that sphere_contact_time has to tell: touching, or grazing.
inline constexpr double unsure = -std::numeric_limits<double>::infinity();

/// Times of meeting (s; infinite: none; `unsure`), by place in the list that was asked about.
class StraightTimes {
 public:
  /// radius: m, by body. a: m/s^2, of all of these. end: s, later meetings are none.
  void find(const Flights& flights, std::span<const double> radius, Entity i, std::span<const Entity> others,
            const Vec3& a, double end);

  /// The place of the earliest, by its `hi`; of several the first. There must be one at least.
  std::size_t earliest() const;

  Instant operator[](std::size_t k) const { return {hi_[k], lo_[k]}; }
  void set(std::size_t k, const Instant& time) {
    hi_[k] = time.hi;
    lo_[k] = time.lo;
  }

 private:
  std::vector<double> hi_, lo_;  // as many as are needed, and up to seven more that never come
  std::size_t padded_ = 0;
};

}  // namespace carom
