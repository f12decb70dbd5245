#pragma once
// A scene transformed: mirrored, in other units, with another scene far away. It must move the same, to the bit.

#include "physics/force.h"
#include "simulate/exact.h"
#include "simulate/simulation_error.h"
#include "std.h"

namespace carom::stress {

struct Motion {
  World world;
  State initial;
  double duration = 0;    // s
  double rest_speed = 0;  // m/s
  bool merge = false;
};

/// f for each vector of a scene: places, velocities and directions. Sizes of volumes are left to the caller.
template <typename F>
void each_vector(World& world, State& state, const F& f) {
  for (auto* list : {&state.position, &state.velocity, &world.impulse})
    for (Vec3& v : *list) f(v);
  f(world.gravity);

  for (Plane& p : world.planes) f(p.point), f(p.normal);
  for (Wall& w : world.walls)
    for (Vec3* v : {&w.center, &w.normal, &w.up, &w.right}) f(*v);
  for (Obstacle& o : world.obstacles) f(o.center);
  for (WorldRegion& r : world.regions) f(r.position), f(r.normal);
  for (String& s : world.strings) f(s.anchor);
  for (SurfaceMotion& motion : world.motions) {
    for (MotionLeg& leg : motion.legs) f(leg.velocity), f(leg.start), f(leg.start_low);
    for (MotionWindow& window : motion.windows) f(window.velocity);
    f(motion.gain), f(motion.gain_low);
    if (motion.swing) f(motion.swing->middle), f(motion.swing->sine), f(motion.swing->cosine);
  }

  for (Force& force : world.forces) {
    if (auto* uniform = std::get_if<UniformForce>(&force.law)) f(uniform->force);
    if (auto* even = std::get_if<UniformAcceleration>(&force.law)) f(even->value);
    if (auto* drag = std::get_if<Drag>(&force.law)) f(drag->wind);
    if (auto* spring = std::get_if<Spring>(&force.law)) f(spring->anchor);
    if (auto* attractor = std::get_if<Attractor>(&force.law)) f(attractor->center);
  }
}

/// A mirror leaves right x up = normal no longer.
inline void right_walls(World& world) {
  for (Wall& w : world.walls) w.right = -w.right;
}

/// The scene mirrored across this axis.
inline Motion mirrored(Motion m, int axis) {
  each_vector(m.world, m.initial, [&](Vec3& v) { v[axis] = -v[axis]; });
  right_walls(m.world);
  // A bowl turns over.
  for (Obstacle& o : m.world.obstacles) {
    const Hollow hollow = o.hollow;
    if (axis == 1 && hollow == Hollow::lower_half) o.hollow = Hollow::upper_half;
    if (axis == 1 && hollow == Hollow::upper_half) o.hollow = Hollow::lower_half;
  }
  return m;
}

/// 2^these: the new units' sizes.
struct Units {
  int length, time, mass;
};

inline constexpr Units all_units[] = {{20, 0, 0}, {0, -12, 0}, {0, 0, 30}, {-30, 7, -24}};

/// A time that waits for an event has no unit.
inline void scale_time(double& time, double t) {
  if (time != not_yet) time *= t;
}

inline void scale(vector<Force>& forces, double l, double t, double kg) {
  for (Force& f : forces) {
    scale_time(f.from, t);
    scale_time(f.until, t);
    if (auto* uniform = std::get_if<UniformForce>(&f.law)) uniform->force *= kg * l / (t * t);
    if (auto* even = std::get_if<UniformAcceleration>(&f.law)) even->value *= l / (t * t);
    if (auto* drag = std::get_if<Drag>(&f.law)) {
      drag->linear *= kg / t;
      drag->quadratic *= kg / l;
      drag->wind *= l / t;
    }

    if (auto* spring = std::get_if<Spring>(&f.law)) {
      spring->anchor *= l;
      spring->stiffness *= kg / (t * t);
      spring->rest_length *= l;
      spring->damping *= kg / t;
    }
    if (auto* attractor = std::get_if<Attractor>(&f.law)) {
      attractor->center *= l;
      attractor->strength *= l * l * l / (t * t);
      attractor->softening *= l;
    }
  }
}

/// The same for forces between bodies.
inline void scale_couplings(World& world, double l, double t, double kg) {
  for (BodySpring& spring : world.springs) {
    spring.stiffness *= kg / (t * t);
    spring.rest_length *= l;
    spring.damping *= kg / t;
    scale_time(spring.from, t);
    scale_time(spring.until, t);
  }

  for (Gravitation& law : world.gravitations) {
    law.constant *= l * l * l / (kg * t * t);
    law.softening *= l;
    scale_time(law.from, t);
    scale_time(law.until, t);
  }
}

/// A world, its state, and more numbers of its run.
inline void scale(World& world, State& state, double& duration, double& rest_speed, const Units& units) {
  const double l = std::ldexp(1, units.length), t = std::ldexp(1, units.time), kg = std::ldexp(1, units.mass);
  for (Vec3& x : state.position) x *= l;
  for (Vec3& v : state.velocity) v *= l / t;
  for (Vec3& p : world.impulse) p *= kg * l / t;
  for (double& time : world.appears) time *= t;
  for (Pour& pour : world.pours) pour.rate /= t, pour.center *= l, pour.within.half *= l;
  for (double& x : world.mass) x *= kg;
  for (double& r : world.radius) r *= l;
  for (Volume& v : world.volume) v.half *= l;
  world.gravity *= l / (t * t);

  for (Plane& p : world.planes) p.point *= l;
  for (Wall& w : world.walls) w.center *= l, w.half_width *= l, w.half_height *= l;
  for (Obstacle& o : world.obstacles) o.center *= l, o.volume.half *= l;
  for (WorldRegion& r : world.regions) r.position *= l, r.volume.half *= l;
  for (String& s : world.strings) s.anchor *= l, s.length *= l, scale_time(s.until, t);
  for (SurfaceMotion& motion : world.motions) {
    for (MotionLeg& leg : motion.legs) leg.from *= t, leg.velocity *= l / t, leg.start *= l, leg.start_low *= l;
    for (MotionWindow& w : motion.windows) scale_time(w.from, t), scale_time(w.until, t), w.velocity *= l / t;
    motion.every *= t, motion.gain *= l, motion.gain_low *= l;
    if (!motion.swing) continue;
    motion.swing->period *= t;
    for (Vec3* v : {&motion.swing->middle, &motion.swing->sine, &motion.swing->cosine}) *v *= l;
  }

  for (TriggeredEnd& end : world.triggers.ends) end.after *= t;
  scale(world.forces, l, t, kg);
  scale_couplings(world, l, t, kg);
  duration *= t;
  rest_speed *= l / t;
}

inline Motion scaled(Motion m, const Units& units) {
  scale(m.world, m.initial, m.duration, m.rest_speed, units);
  return m;
}

struct Observed {
  State end;
  uint64_t collisions = 0;
  double energy_lost = 0;  // J
  string error;
};

inline Observed run(const Motion& motion, ExactOptions options = {}) {
  options.duration = motion.duration;
  options.rest_speed = motion.rest_speed;
  options.merge = motion.merge;
  options.record_collisions = false;

  Observed seen;
  try {
    const auto simulator = make_exact_simulator(motion.world, motion.initial, options);
    do simulator->advance_to(motion.duration);
    while (simulator->time() < motion.duration);
    seen.end = simulator->state();
    seen.collisions = simulator->tally().collisions();
    seen.energy_lost = simulator->tally().energy_lost;
  } catch (const SimulationError& error) {
    seen.error = error.what();
  }
  return seen;
}

/// -0 equals 0. So does a number below 1e-290, to which speeds fall impact by impact and where doubles lose digits.
inline bool same(const Vec3& a, const Vec3& b) {
  constexpr double none = 1e-290;
  for (int k = 0; k < 3; ++k)
    if (a[k] != b[k] && !(std::abs(a[k]) < none && std::abs(b[k]) < none)) return false;
  return true;
}

/// The first difference of two runs in a bit; empty: none. `back` transforms b's vectors to those of a.
template <typename Position, typename Velocity>
string difference(const Observed& a, const Observed& b, double lost, const Position& back_x, const Velocity& back_v) {
  if (a.error.empty() != b.error.empty()) return "one ends with an error: " + a.error + b.error;
  if (!a.error.empty()) return {};
  if (a.collisions != b.collisions) return to_string(a.collisions) + " and " + to_string(b.collisions) + " collisions";
  for (size_t i = 0; i < a.end.position.size(); ++i)
    if (!same(a.end.position[i], back_x(b.end.position[i])) || !same(a.end.velocity[i], back_v(b.end.velocity[i])))
      return "body " + to_string(i);
  return a.energy_lost == b.energy_lost * lost ? "" : "energy lost";
}

/// b: of the mirrored scene.
inline string mirror_difference(const Observed& a, const Observed& b, int axis) {
  const auto flip = [&](Vec3 v) {
    v[axis] = -v[axis];
    return v;
  };
  return difference(a, b, 1, flip, flip);
}

/// b: of the scene in these units.
inline string unit_difference(const Observed& a, const Observed& b, const Units& units) {
  const double l = std::ldexp(1, -units.length), t = std::ldexp(1, -units.time), m = std::ldexp(1, -units.mass);
  return difference(
      a, b, m * l * l / (t * t), [&](const Vec3& x) { return Vec3(x * l); },
      [&](const Vec3& v) { return Vec3(v * (l / t)); });
}

/// The numbers of things of one scene in a world with another one, which has no planes. `first`: this one's come first.
inline void shift(EntityRange& range, const World& own, const World& other, bool first) {
  if (range.first + range.count > own.entity_count()) return;  // anything
  const auto before = [&](size_t count) { return first ? 0 : Entity(count); };
  if (own.is_body(range.first)) {
    range.first += before(other.body_count());
    return;
  }

  const Entity e = range.first;
  range.first += other.body_count();
  if (own.is_plane(e)) return;
  range.first += own.is_wall(e) ? before(other.walls.size()) : Entity(other.walls.size());
  if (own.is_wall(e)) return;
  range.first += own.is_obstacle(e) ? before(other.obstacles.size()) : Entity(other.obstacles.size());
  if (own.is_string(e)) range.first += before(other.strings.size());
}

/// The same for what waits for an event: forces are this scene's alone.
inline void shift(TriggeredEnd& end, const World& own, const World& other, bool first) {
  using Of = TriggeredEnd::Of;
  if (!first && end.of == Of::string) end.index += uint32_t(other.strings.size());
  if (!first && end.of == Of::body_spring) end.index += uint32_t(other.springs.size());
  if (end.of != Of::motion) return;
  EntityRange thing{own.body_count() + end.index, 1};
  shift(thing, own, other, first);
  end.index = thing.first - own.body_count() - other.body_count();
}

/// Both scenes in one world, the other one more than a kilometre away and without planes; they share gravity.
/// `first`: this one's bodies come first.
inline Motion together(const Motion& motion, Motion other, bool first) {
  const Vec3 away(1024, 512, -2048);
  for (Vec3& x : other.initial.position) x += away;
  for (Obstacle& o : other.world.obstacles) o.center += away;
  for (Wall& w : other.world.walls) w.center += away;
  for (String& s : other.world.strings) s.anchor += away;
  for (Pour& pour : other.world.pours) pour.center += away;

  const Motion &one = first ? motion : other, &two = first ? other : motion;
  Motion both = motion;
  World& world = both.world;
  const auto join = [](auto& to, const auto& a, const auto& b) {
    to = a;
    to.insert(to.end(), b.begin(), b.end());
  };

  join(world.mass, one.world.mass, two.world.mass);
  join(world.radius, one.world.radius, two.world.radius);
  join(world.restitution, one.world.restitution, two.world.restitution);
  join(both.initial.position, one.initial.position, two.initial.position);
  join(both.initial.velocity, one.initial.velocity, two.initial.velocity);
  join(world.obstacles, one.world.obstacles, two.world.obstacles);
  join(world.walls, one.world.walls, two.world.walls);
  join(world.strings, one.world.strings, two.world.strings);

  join(world.springs, one.world.springs, two.world.springs);

  // Motions, by planes, walls and obstacles.
  world.motions.clear();
  const auto take = [&](const World& from, size_t begin, size_t count) {
    for (size_t k = begin; k < begin + count; ++k)
      world.motions.push_back(from.moves() ? from.motions[k] : SurfaceMotion{});
  };
  for (const World* from : {&one.world, &two.world}) take(*from, 0, from->planes.size());
  for (const World* from : {&one.world, &two.world}) take(*from, from->planes.size(), from->walls.size());
  for (const World* from : {&one.world, &two.world})
    take(*from, from->planes.size() + from->walls.size(), from->obstacles.size());

  // The second one's bodies have other numbers.
  for (size_t k = one.world.springs.size(); k < world.springs.size(); ++k) {
    world.springs[k].a += one.world.body_count();
    world.springs[k].b += one.world.body_count();
  }
  for (size_t k = one.world.strings.size(); k < world.strings.size(); ++k) {
    String& s = world.strings[k];
    s.body += one.world.body_count();
    if (s.other != no_entity) s.other += one.world.body_count();
  }

  // The regions and events are this scene's alone.
  for (WorldRegion& region : world.regions) {
    if (region.on.empty())
      for (Entity i = 0; i < motion.world.body_count(); ++i) region.on.push_back(i);
    for (Entity& i : region.on) i += first ? 0 : other.world.body_count();
  }
  for (Trigger& trigger : world.triggers.all)
    for (EntityRange* range : {&trigger.a, &trigger.b}) shift(*range, motion.world, other.world, first);
  for (TriggeredEnd& end : world.triggers.ends) shift(end, motion.world, other.world, first);

  // Bodies that come later.
  world.appears.clear();
  const bool later = !one.world.appears.empty() || !two.world.appears.empty();
  for (const Motion* m : {&one, &two})
    for (Entity i = 0; later && i < m->world.body_count(); ++i)
      world.appears.push_back(m->world.appears.empty() ? -infinity : m->world.appears[i]);
  join(world.pours, one.world.pours, two.world.pours);
  for (size_t k = one.world.pours.size(); k < world.pours.size(); ++k) world.pours[k].first += one.world.body_count();

  // Lists that only one of them may have.
  const bool shapes = !one.world.volume.empty() || !two.world.volume.empty();
  const bool impulses = !one.world.impulse.empty() || !two.world.impulse.empty();
  world.volume.clear();
  world.impulse.clear();
  for (const Motion* m : {&one, &two})
    for (Entity i = 0; i < m->world.body_count(); ++i) {
      if (shapes) world.volume.push_back(m->world.volume_of(i));
      if (impulses) world.impulse.push_back(m->world.impulse.empty() ? Vec3(Vec3::Zero()) : m->world.impulse[i]);
    }
  return both;
}

}  // namespace carom::stress
