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
  /// The position (m), the velocity (m/s) and the acceleration (m/s^2) of a fixed thing at an instant.
  Vec3 position(Entity e, const Instant& at) const;
  Vec3 velocity(Entity e, const Instant& at) const;
  Vec3 acceleration(Entity e, const Instant& at) const;
  /// Whether it has a velocity at that instant. What swings always moves.
  bool moves(Entity e, const Instant& at) const {
    return world_.moves(e) && (world_.swing(e) != nullptr || !velocity(e, at).isZero(0));
  }
  /// The instant from which on it has that velocity.
  Instant leg_start(Entity e, const Instant& at) const;
  /// Whether its velocity jumps at that instant.
  bool switches(Entity e, const Instant& at) const;
  /// The first instant after this one at which its velocity jumps, or that of any thing; `never`: there is none.
  Instant next_switch(Entity e, const Instant& at) const;
  Instant next_switch(const Instant& at) const;

  /// Whether this thing may come out of that one, seen along n, before a velocity of the two jumps. Two that swing
  /// alike do not.
  bool comes_out(Entity e, Entity floor, const Vec3& n, const Instant& at) const;

 private:
  const World& world_;
  vector<Entity> moving_;
  bool any_ = false;
};

}  // namespace carom
