// What forces act on, and where fixed things that move are.
#include "physics/world.h"

#include "std.h"

namespace carom {

bool acts_on(const Force& force, Entity body) {
  return force.on.empty() || ranges::binary_search(force.on, body);
}

bool acts(const Force& force, Entity body, double time) {
  return time >= force.from && time < force.until && acts_on(force, body);
}

Vec3 fixed_position(const World& world, Entity fixed, const DoubleDouble& time) {
  const Vec3& start = world.fixed_position(fixed);
  return world.moves(fixed) ? place_on(start, world.motion(fixed), time) : start;
}

Vec3 fixed_velocity(const World& world, Entity fixed, const DoubleDouble& time) {
  return world.moves(fixed) ? velocity_on(world.motion(fixed), time) : Vec3(Vec3::Zero());
}

Vec3 fixed_acceleration(const World& world, Entity fixed, const DoubleDouble& time) {
  return world.moves(fixed) ? acceleration_on(world.motion(fixed), time) : Vec3(Vec3::Zero());
}

bool place_fixed_things(const World& world, double time, World& copy) {
  bool changed = false;
  const auto place = [&](size_t fixed, Vec3& x) {
    const Entity e = world.body_count() + Entity(fixed);
    if (!world.moves(e)) return;
    const Vec3 there = fixed_position(world, e, {time, 0});
    changed = changed || there != x;
    x = there;
  };

  // In the order of their numbers.
  size_t fixed = 0;
  for (Plane& plane : copy.planes) place(fixed++, plane.point);
  for (Wall& wall : copy.walls) place(fixed++, wall.center);
  for (Obstacle& obstacle : copy.obstacles) place(fixed++, obstacle.center);

  return changed;
}

}  // namespace carom
