#include "simulate/exact_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "simulate/tolerances.h"

namespace carom {

ExactBodies::ExactBodies(const World& given, const ExactOptions& given_options)
    : options(given_options),
      merged(given, options.merge),
      world(merged.world()),
      bounds(bounds_of(given)),
      same_radius(!options.merge && std::adjacent_find(given.radius.begin(), given.radius.end(), std::not_equal_to{}) ==
                                        given.radius.end()),
      applied(given.body_count(), given.gravity),
      working(given.body_count(), Vec3::Zero()),
      flights(given.body_count(), given.gravity),
      body(given.body_count()),
      neighbours(world),
      islands(given.body_count()),
      log(options.max_collisions, options.record_collisions) {}

Vec3 ExactBodies::velocity_without_kick(Entity i, const Instant& at) const {
  const Vec3 v = flights[i].velocity(at - flights[i].start);
  return is_stepped(i) ? without_kick(v, at, islands.kicked_until[i], islands.kick[i]) : v;
}

std::vector<Entity> ExactBodies::known_to(Entity i) const {
  const std::span<const Entity> near = neighbours.near(i);
  std::vector<Entity> known(near.begin(), near.end());
  std::sort(known.begin(), known.end());
  return known;
}

Touch ExactBodies::touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature) const {
  if (world.is_body(b) && world.volume.empty()) {
    // By the actual distance, not the sum of the radii: then the normal is a unit vector and energy is kept to
    // rounding.
    const Vec3 d = xb - xa;
    const double distance = d.norm();
    const Vec3 n = d / distance;
    return {distance - (world.radius[a] + world.radius[b]), n, xa + world.radius[a] * n, 0};
  }
  return touch(world, a, xa, b, xb, feature);
}

double ExactBodies::load_on(Entity i) const {
  return world.fixed_count() == 0 && world.forces.empty() ? 0 : applied[i].norm();
}

double ExactBodies::slow_speed(double press, double length) const {
  return options.rest_speed > 0 ? options.rest_speed : exact_tolerance::slow_impact * std::sqrt(press * length);
}

}  // namespace carom
