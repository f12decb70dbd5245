#pragma once
// Times of collision of bodies on their flights.
#include "simulate/contact/exact_bodies.h"
#include "std.h"

namespace carom {

class ExactCollisionTimes {
 public:
  explicit ExactCollisionTimes(const ExactBodies& bodies) : bodies_(bodies) {}

  /// The time at which bodies i and j collide, and the feature. Infinite: not before their flights end.
  /// It is computed from the later of their flights' starts, lower number first. (i, j) and (j, i) give the same bits.
  /// Where the two certainly stay apart up to `until` (s), it may be infinite too.
  Instant of_pair(Entity i, Entity j, uint8_t& feature, double until = never) const;
  /// The time at which body i strikes a fixed thing that never moves, computed from its flight's start.
  Instant of_surface(Entity i, Entity surface, uint8_t& feature) const;
  /// The same for a fixed thing that moves, on its present leg. Where it swings, it is that before `until` (s).
  [[gnu::noinline]] Instant of_moving(Entity i, Entity surface, uint8_t& feature, double until) const;
  /// The time at which a string goes taut, computed as that of a pair.
  [[gnu::noinline]] Instant of_string(Entity string) const;

 private:
  Instant of_swinging(Entity i, Entity surface, uint8_t& feature, double until) const;
  double clear_time(Entity i, const Flight& f, double t, Entity surface) const;
  Instant of_curves(Entity a, const Flight& p, Entity b, const Flight& q, const RelativeMotion& m,
                    uint8_t& feature) const;
  static PolynomialPath::Terms relative_displacement(const Flight& p, double tp, const Flight& q, double tq,
                                                     double length);
  FeatureTime of_piece(Entity a, const Flight& p, double tp, Entity b, const Flight& q, double tq, double length,
                       double speeds, uint8_t left) const;
  /// The latest end of body i's flight.
  [[gnu::always_inline]] Instant end_of(Entity i) const {
    return min(bodies_.flight_end(i), Instant{bodies_.options.duration, 0});
  }
  double noise_in_contact(Entity i) const;

  const ExactBodies& bodies_;
};

}  // namespace carom
