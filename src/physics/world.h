#pragma once
// What never changes during a run. What changes is State (state.h).

#include "numerics/vec3.h"
#include "physics/body_spring.h"
#include "physics/entity.h"
#include "physics/force_law.h"
#include "physics/gravitation.h"
#include "physics/surface_motion.h"
#include "physics/trigger.h"
#include "physics/volume.h"
#include "physics/world_region.h"
#include "std.h"

namespace carom {

/// An unbounded one-sided surface. Free space is where (x - point) . normal > 0.
struct Plane {
  Vec3 point;                    // m
  Vec3 normal;                   // unit, to the free side
  optional<double> restitution;  // none: the moving body's
};

/// A two-sided rectangle without thickness.
struct Wall {
  Vec3 center;                   // m
  Vec3 normal;                   // unit
  Vec3 right;                    // unit, along the width; right x up = normal
  Vec3 up;                       // unit, along the height
  double half_width;             // m
  double half_height;            // m
  optional<double> restitution;  // none: the moving body's
};

/// What there is of an obstacle: its whole volume, or part of its surface alone. That is a shell: it has two sides and
/// no thickness, as a wall has, and balls alone meet it.
enum class Hollow : uint8_t {
  none,        // a solid obstacle
  whole,       // a sphere
  lower_half,  // of a sphere, open at the top
  upper_half,  // of a sphere, open at the bottom
  side         // of a cylinder, without its ends
};

/// A body that no impact moves.
struct Obstacle {
  Vec3 center;  // m
  Volume volume;
  optional<double> restitution;  // none: the moving body's
  Hollow hollow = Hollow::none;
};

/// An inextensible, massless string between the centres of two bodies, or of a body and a fixed point. It is slack
/// while the distance is below its length; where it goes taut is an impact. A rod holds the distance both ways.
struct String {
  Entity body;                 // the tied body
  Entity other = no_entity;    // the other body; none: the anchor holds the other end
  Vec3 anchor = Vec3::Zero();  // m, fixed
  double length = 0;           // m, > 0
  double restitution = 0;      // of the impact where it goes taut, >= 0
  bool rod = false;
  double until = infinity;  // s, when it is cut
};

/// A force in a window of time, on some bodies or on all.
struct Force {
  ForceLaw law;
  double from = 0;          // s, when it sets in
  double until = infinity;  // s, when it ceases
  vector<Entity> on{};      // ascending; empty: all bodies
};

/// Whether a force acts on a body, at some time and at `time` (s).
bool acts_on(const Force& force, Entity body);
bool acts(const Force& force, Entity body, double time);

/// The rule that makes a pair's coefficient of restitution from two (restitution.h).
enum class Combine : uint8_t { average, minimum, maximum, product, geometric_mean, mass_weighted, book };

/// A coefficient that overrides the rule, for every pair with one entity in each range.
struct PairRestitution {
  Entity a_first, a_count;
  Entity b_first, b_count;
  optional<double> value;  // none: they pass through each other
};

/// Balls that come into the world one after the other, each where there is room for it.
struct Pour {
  Entity first, count;
  double rate;    // 1/s; the first one is due at World::appears
  Vec3 center;    // m, of the space
  Volume within;  // the space that a ball lies wholly inside
  uint64_t seed;  // of their places
};

/// Bodies, fixed surfaces and the laws between them. Arrays are indexed by body.
struct World {
  vector<double> mass;         // kg, > 0
  vector<double> radius;       // m, > 0: volume.reach(), for a ball its radius
  vector<Volume> volume;       // about the position; empty: all are spheres
  vector<double> restitution;  // >= 0; above 1 makes energy
  vector<Vec3> impulse;        // N s, applied at time 0, or as the body appears; empty: none
  vector<double> appears;      // s, when it is due in the world; infinitely early: it is there; empty: all are there
  vector<Pour> pours;          // of those that are due later
  vector<Plane> planes;
  vector<Wall> walls;
  vector<Obstacle> obstacles;
  vector<SurfaceMotion> motions;  // by fixed thing; empty: nothing moves
  vector<Force> forces;
  Vec3 gravity = Vec3(0, -9.80665, 0);  // m/s^2
  Combine combine = Combine::average;
  vector<PairRestitution> pairs;  // the last match counts
  vector<WorldRegion> regions;
  vector<String> strings;
  // Forces between bodies.
  vector<BodySpring> springs{};
  vector<Gravitation> gravitations{};
  // Times of these laws, motions and strings that events set.
  Triggers triggers{};

  Entity body_count() const { return Entity(mass.size()); }
  Entity fixed_count() const { return Entity(planes.size() + walls.size() + obstacles.size()); }
  Entity entity_count() const { return Entity(strings_from() + strings.size()); }
  bool is_body(Entity e) const { return e < body_count(); }
  /// Whether body i is not in the world at the start.
  bool comes_later(Entity i) const { return !appears.empty() && appears[i] >= 0; }
  /// Whether it is a plane, a wall or an obstacle.
  bool is_fixed(Entity e) const { return e >= body_count() && e < strings_from(); }
  bool is_plane(Entity e) const { return e >= body_count() && e - body_count() < planes.size(); }
  bool is_wall(Entity e) const { return e >= walls_from() && e < obstacles_from(); }
  bool is_obstacle(Entity e) const { return e >= obstacles_from() && e < strings_from(); }
  bool is_shell(Entity e) const { return is_obstacle(e) && obstacle(e).hollow != Hollow::none; }
  bool is_string(Entity e) const { return e >= strings_from() && e - strings_from() < strings.size(); }
  const Plane& plane(Entity e) const { return planes[e - body_count()]; }
  const Wall& wall(Entity e) const { return walls[e - walls_from()]; }
  const Obstacle& obstacle(Entity e) const { return obstacles[e - obstacles_from()]; }
  const String& string(Entity e) const { return strings[e - strings_from()]; }
  Entity string_number(size_t k) const { return Entity(strings_from() + k); }
  /// The second body of a contact that is named by a body and e: e itself, or the other end of a string. no_entity: the
  /// second thing does not move by forces.
  Entity second_body(Entity e) const { return is_body(e) ? e : is_string(e) ? string(e).other : no_entity; }

  /// The volume of a body or an obstacle.
  Volume volume_of(Entity e) const {
    if (!is_body(e)) return obstacle(e).volume;
    return volume.empty() ? Volume::sphere(radius[e]) : volume[e];
  }
  bool moves() const { return !motions.empty(); }
  /// Whether a fixed thing moves at some time, and how.
  bool moves(Entity e) const { return !motions.empty() && is_fixed(e) && motions[e - body_count()].moves(); }
  const SurfaceMotion& motion(Entity e) const { return motions[e - body_count()]; }
  /// The swing of a fixed thing. Null: it does not swing.
  const Swing* swing(Entity e) const { return moves(e) && motion(e).swing ? &*motion(e).swing : nullptr; }
  /// The point of a plane, the centre of a wall or an obstacle, or the anchor of a string (m), at time 0.
  const Vec3& fixed_position(Entity e) const {
    return is_plane(e)    ? plane(e).point
           : is_wall(e)   ? wall(e).center
           : is_string(e) ? string(e).anchor
                          : obstacle(e).center;
  }

 private:
  size_t walls_from() const { return body_count() + planes.size(); }
  size_t obstacles_from() const { return walls_from() + walls.size(); }
  size_t strings_from() const { return obstacles_from() + obstacles.size(); }
};

/// The point of a plane, or the centre of a wall or an obstacle (m) at a time (s).
Vec3 fixed_position(const World& world, Entity fixed, const DoubleDouble& time);
/// The velocity of a fixed thing (m/s) from a time (s) on, and its acceleration (m/s^2).
Vec3 fixed_velocity(const World& world, Entity fixed, const DoubleDouble& time);
Vec3 fixed_acceleration(const World& world, Entity fixed, const DoubleDouble& time);

/// Sets the positions of planes, walls and obstacles that move (m) to those at a time (s) in a copy of their World.
/// Returns whether any has changed.
bool place_fixed_things(const World& world, double time, World& copy);

}  // namespace carom
