#pragma once
// Fixed things that move (surface_motion.h), as the parts of the simulator see them: positions and velocities at an
// instant, and the instants at which a velocity changes.

#include "physics/world.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

class MovingThings {
 public:
  /// `world` must outlive this object.
  explicit MovingThings(const World& world);

  /// Whether there are any. Where there are none, no other function need be called.
  bool any() const { return any_; }
  /// The position (m) and the velocity (m/s) of a fixed thing at an instant.
  Vec3 position(Entity e, const Instant& at) const;
  Vec3 velocity(Entity e, const Instant& at) const;
  /// Whether it has a velocity at that instant.
  bool moves(Entity e, const Instant& at) const { return world_.moves(e) && !velocity(e, at).isZero(0); }
  /// The instant from which on it has that velocity.
  Instant leg_start(Entity e, const Instant& at) const;
  /// Whether its velocity changes at that instant.
  bool switches(Entity e, const Instant& at) const;
  /// The first instant after `time` (s) at which the velocity of some thing changes; infinity: there is none.
  double next_switch(double time) const;

 private:
  const World& world_;
  const bool any_;
  vector<double> switches_;  // s, ascending
};

}  // namespace carom
