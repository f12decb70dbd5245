#pragma once
// When bodies on their flights collide.
#include "simulate/exact_bodies.h"

namespace carom {

class ExactCollisionTimes {
 public:
  explicit ExactCollisionTimes(const ExactBodies& bodies) : bodies_(bodies) {}

  /// When bodies i and j collide, infinite: not before their flights end; and at what feature. From the later of their
  /// flights' starts, lower number first: the same bits for (i, j) and (j, i).
  Instant of_pair(Entity i, Entity j, std::uint8_t& feature) const;
  /// When body i strikes a fixed thing: from its flight's start.
  Instant of_surface(Entity i, Entity surface, std::uint8_t& feature) const;

 private:
  Instant of_curves(Entity a, const Flight& p, Entity b, const Flight& q, const RelativeMotion& m,
                    std::uint8_t& feature) const;
  FeatureTime of_piece(Entity a, const Flight& p, double tp, Entity b, const Flight& q, double tq, double length,
                       double speeds, std::uint8_t left) const;
  Instant end_of(Entity i) const;
  double noise_in_contact(Entity i) const;

  const ExactBodies& bodies_;
};

}  // namespace carom
