// Positions and velocities of fixed things that move, and one list of the instants at which any velocity changes.
#include "simulate/path/moving_things.h"

#include "numerics/polynomial.h"
#include "std.h"

namespace carom {

namespace {

DoubleDouble time_of(const Instant& at) {
  return {at.hi, at.lo};
}

}  // namespace

MovingThings::MovingThings(const World& world)
    : world_(world), any_(any_of(world.motions, [](const auto& legs) { return !legs.empty(); })) {
  for (const vector<MotionLeg>& legs : world.motions)
    for (const MotionLeg& leg : legs)
      if (leg.from > 0) switches_.push_back(leg.from);
  ranges::sort(switches_);
  switches_.erase(std::unique(switches_.begin(), switches_.end()), switches_.end());
}

Vec3 MovingThings::position(Entity e, const Instant& at) const {
  return carom::fixed_position(world_, e, time_of(at));
}

Vec3 MovingThings::velocity(Entity e, const Instant& at) const {
  return carom::fixed_velocity(world_, e, time_of(at));
}

Instant MovingThings::leg_start(Entity e, const Instant& at) const {
  return world_.moves(e) ? Instant{leg_at(world_.legs(e), time_of(at)).from, 0} : Instant{};
}

bool MovingThings::switches(Entity e, const Instant& at) const {
  return at.hi > 0 && world_.moves(e) && leg_start(e, at) == at;
}

double MovingThings::next_switch(double time) const {
  const auto next = std::upper_bound(switches_.begin(), switches_.end(), time);
  return next == switches_.end() ? never : *next;
}

}  // namespace carom
