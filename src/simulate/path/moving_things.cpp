// Positions and velocities of fixed things that move, and the instants at which a velocity jumps. These are found from
// the motion itself when they are asked for, so that motions that repeat need no list as long as the run.
#include "simulate/path/moving_things.h"

#include "numerics/polynomial.h"
#include "std.h"

namespace carom {

namespace {

DoubleDouble time_of(const Instant& at) {
  return {at.hi, at.lo};
}

Instant instant_of(const DoubleDouble& time) {
  return {time.hi, time.lo};
}

}  // namespace

MovingThings::MovingThings(const World& world) : world_(world) {
  for (size_t fixed = 0; fixed < world.motions.size(); ++fixed)
    if (world.motions[fixed].moves()) moving_.push_back(world.body_count() + Entity(fixed));
  any_ = !moving_.empty();
}

Vec3 MovingThings::position(Entity e, const Instant& at) const {
  return carom::fixed_position(world_, e, time_of(at));
}

Vec3 MovingThings::velocity(Entity e, const Instant& at) const {
  return carom::fixed_velocity(world_, e, time_of(at));
}

Vec3 MovingThings::acceleration(Entity e, const Instant& at) const {
  return carom::fixed_acceleration(world_, e, time_of(at));
}

Instant MovingThings::leg_start(Entity e, const Instant& at) const {
  return world_.moves(e) ? instant_of(carom::leg_start(world_.motion(e), time_of(at))) : Instant{};
}

bool MovingThings::switches(Entity e, const Instant& at) const {
  return at.hi > 0 && world_.moves(e) && leg_start(e, at) == at;
}

Instant MovingThings::next_switch(Entity e, const Instant& at) const {
  return world_.moves(e) ? instant_of(next_leg_start(world_.motion(e), time_of(at))) : Instant{never, 0};
}

Instant MovingThings::next_switch(const Instant& at) const {
  Instant next{never, 0};
  for (const Entity e : moving_) next = min(next, next_switch(e, at));
  return next;
}

bool MovingThings::comes_out(Entity e, Entity floor, const Vec3& n, const Instant& at) const {
  const Swing* const swing = world_.swing(e);
  const Swing* const of_floor = world_.swing(floor);
  if (swing == nullptr && of_floor == nullptr) return n.dot(velocity(e, at) - velocity(floor, at)) > 0;
  return swing == nullptr || of_floor == nullptr || swing->period != of_floor->period ||
         swing->sine.dot(n) != of_floor->sine.dot(n) || swing->cosine.dot(n) != of_floor->cosine.dot(n);
}

}  // namespace carom
