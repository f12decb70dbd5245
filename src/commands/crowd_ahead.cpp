// Bodies that fall onto one another lose 1 - e^2 of their energy in the time of a fall. A heap is at rest some falls
// later.
#include "commands/crowd_ahead.h"

#include "physics/restitution.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

/// s of CPU time, of a body in a step of the longest length: mostly the sweeps over its contacts.
constexpr double step_of_body = 1.2e-6;
/// s of CPU time, of the impacts of a body from its landing until it lies: some 600 (measured with e from 0 to 0.8).
constexpr double landing_of_body = 3e-4;
/// Pieces of the path of a body in these impacts.
constexpr double landing_pieces_of_body = 600;
/// Fewer bodies seldom have so many changes of contact that they move as a crowd.
constexpr Entity least_bodies = 64;
/// Times of the fall from the heap's beginning until it is at rest.
constexpr double falls_to_rest = 5;

/// How far a body falls, and with what restitution it lands.
struct Landing {
  double height = never;  // m
  double restitution = 1;
};

Landing landing_of(const World& world, Entity i, const Vec3& x) {
  const Vec3 down = world.gravity.normalized();
  Landing first;
  for (Entity e = world.body_count(); e < world.entity_count(); ++e) {
    if (!(world.is_plane(e) || world.is_wall(e)) || !may_meet(world, i, e)) continue;
    const Vec3& normal = world.is_plane(e) ? world.plane(e).normal : world.wall(e).normal;
    const double slope = normal.dot(down);
    const double height = normal.dot(world.fixed_position(e) - x) / slope;
    if (slope != 0 && height > 0 && height < first.height) first = {height, pair_restitution(world, i, e)};
  }
  return first;
}

}  // namespace

CrowdAhead crowd_ahead(const Scene& scene, Engine engine) {
  const World& world = scene.world;
  const double load = world.gravity.norm();
  if (engine == Engine::book || scene.simulate.contact.merge) return {};
  if (world.body_count() < least_bodies || !(load > 0)) return {};

  // The last body to land, and what the impacts of all take.
  double height = 0;  // m
  double kept = 0;    // of the energy
  for (Entity i = 0; i < world.body_count(); ++i) {
    const Landing landing = landing_of(world, i, scene.initial.position[i]);
    if (landing.height == never) return {};
    height = max(height, landing.height);
    kept += landing.restitution * landing.restitution / world.body_count();
  }
  if (!(kept < 1)) return {};

  const double fall = sqrt(2 * height / load);
  const double smallest = *ranges::min_element(world.radius);
  const ContactQuality& quality = quality_of(scene.simulate.contact.quality);
  const double step = quality.longest_step * sqrt(2 * smallest / load);

  CrowdAhead ahead;
  ahead.from = fall / (1 - kept);
  ahead.until = world.moves() ? never : ahead.from + falls_to_rest * fall;
  ahead.landing = landing_of_body * world.body_count();
  ahead.rate = step_of_body * world.body_count() / step;
  ahead.landing_pieces = landing_pieces_of_body * world.body_count();
  ahead.piece_rate = world.body_count() / step;
  return ahead;
}

double time_ahead(const CrowdAhead& crowd, double time, double duration, double rate) {
  const double from = clamp(crowd.from, time, duration);
  const double until = clamp(crowd.until, from, duration);
  if (time >= crowd.until) return rate * (duration - time);
  if (time >= crowd.from) return rate * (until - from);
  const double landing = crowd.from < duration ? crowd.landing : 0;
  return rate * (from - time) + landing + crowd.rate * (until - from);
}

PiecesAhead pieces_ahead(const CrowdAhead& crowd, double time, double duration, double rate) {
  const double from = clamp(crowd.from, time, duration);
  const double until = clamp(crowd.until, from, duration);
  PiecesAhead ahead{rate * (from - time), crowd.piece_rate * (until - from)};
  if (crowd.from > time && crowd.from < duration) ahead.of_events += crowd.landing_pieces;
  return ahead;
}

}  // namespace carom
