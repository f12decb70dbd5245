// A random scene as a scene file.

#include "physics/world.h"
#include "std.h"
#include "stress/digits.h"
#include "stress/scene.h"

namespace carom::stress {

namespace {

using stress::text;

string text(const Vec3& v) {
  return "[" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + "]";
}

string text(const Volume& v) {
  if (v.shape == Shape::sphere) return "radius: " + text(v.half.x());
  if (v.shape == Shape::cylinder)
    return "cylinder: {radius: " + text(v.half.x()) + ", height: " + text(2 * v.half.y()) + "}";
  return "box: " + text(Vec3(2 * v.half));
}

string text(const optional<double>& restitution) {
  return restitution ? ", restitution: " + text(*restitution) : "";
}

string text(const UniformForce& law) {
  return "uniform: " + text(law.force);
}
string text(const UniformAcceleration& law) {
  return "acceleration: " + text(law.value);
}
string text(const Drag& law) {
  return "drag: {linear: " + text(law.linear) + ", quadratic: " + text(law.quadratic) + ", wind: " + text(law.wind) +
         "}";
}
string text(const Spring& law) {
  return "spring: {anchor: " + text(law.anchor) + ", stiffness: " + text(law.stiffness) +
         ", rest_length: " + text(law.rest_length) + ", damping: " + text(law.damping) + "}";
}
string text(const Attractor& law) {
  return "attractor: {center: " + text(law.center) + ", strength: " + text(law.strength) +
         ", softening: " + text(law.softening) + "}";
}

/// b0, b1, …, then p, w, o, s for planes, walls, obstacles, strings.
string name(const World& world, Entity e) {
  if (world.is_body(e)) return "b" + to_string(e);
  const auto k = e - world.body_count();
  if (world.is_plane(e)) return "p" + to_string(k);
  if (world.is_wall(e)) return "w" + to_string(k - world.planes.size());
  if (world.is_obstacle(e)) return "o" + to_string(k - world.planes.size() - world.walls.size());
  return "s" + to_string(k - world.fixed_count());
}

string name(const World& world, const EntityRange& range) {
  return range.first + range.count > world.entity_count() ? "" : name(world, range.first);
}

/// A time, or the event that sets it.
string time_text(const World& world, TriggeredEnd::Of of, size_t index, uint32_t window, bool ends, double time) {
  const auto& all = world.triggers.ends;
  const auto end = ranges::find_if(all, [&](const TriggeredEnd& e) {
    return e.of == of && e.index == index && e.window == window && e.ends == ends;
  });
  if (end == all.end()) return text(time);

  const Trigger& trigger = world.triggers.all[end->trigger];
  const string after = ", after: " + text(end->after) + "}";
  if (trigger.regions) return "{region: r" + to_string(trigger.regions->first) + after;
  const string b = name(world, trigger.b);
  return "{collision: [" + name(world, trigger.a) + (b.empty() ? "" : ", " + b) + "]" + after;
}

string window_text(const World& world, TriggeredEnd::Of of, size_t index, uint32_t window, double from, double until) {
  return "from: " + time_text(world, of, index, window, false, from) +
         (isfinite(until) ? ", until: " + time_text(world, of, index, window, true, until) : "");
}

string bodies(const RandomScene& scene) {
  const World& world = scene.world;
  string out = world.volume.empty() ? "balls:\n" : "bodies:\n";
  for (Entity i = 0; i < world.body_count(); ++i) {
    out += "  " + name(world, i) + ": {mass: " + text(world.mass[i]) + ", " + text(world.volume_of(i)) +
           ", position: " + text(scene.initial.position[i]) + ", velocity: " + text(scene.initial.velocity[i]) +
           ", restitution: " + text(world.restitution[i]);
    if (!world.impulse.empty()) out += ", impulse: " + text(world.impulse[i]);
    if (world.comes_later(i)) out += ", appear: " + text(world.appears[i]);
    out += "}\n";
  }
  return world.body_count() == 0 ? "" : out;
}

string windows(const World& world, Entity e) {
  const SurfaceMotion& motion = world.motion(e);
  string list;
  const auto add = [&](const string& window, const Vec3& velocity) {
    list += (list.empty() ? "{" : ", {") + window + ", velocity: " + text(velocity) + "}";
  };

  if (!motion.windows.empty()) {
    for (uint32_t w = 0; w < motion.windows.size(); ++w)
      add(window_text(world, TriggeredEnd::Of::motion, e - world.body_count(), w, motion.windows[w].from,
                      motion.windows[w].until),
          motion.windows[w].velocity);
    return "[" + list + "]";
  }

  for (size_t k = 0; k < motion.legs.size(); ++k) {
    const MotionLeg& leg = motion.legs[k];
    const double until = k + 1 < motion.legs.size() ? motion.legs[k + 1].from : motion.every;
    if (!leg.velocity.isZero(0))
      add("from: " + text(leg.from) + (isfinite(until) ? ", until: " + text(until) : ""), leg.velocity);
  }
  return isfinite(motion.every) ? "{every: " + text(motion.every) + ", windows: [" + list + "]}" : "[" + list + "]";
}

/// Of swings those on a sine that starts in its middle or at an end.
string motion(const World& world, Entity e) {
  if (!world.moves(e)) return "";
  const Swing* swing = world.swing(e);
  if (swing == nullptr) return ", motion: " + windows(world, e);
  const bool in_middle = swing->cosine.isZero(0);
  return ", motion: {sine: {amplitude: " + text(in_middle ? swing->sine : swing->cosine) +
         ", period: " + text(swing->period) + ", phase: " + (in_middle ? "0" : "90") + "}}";
}

string hollow(const Obstacle& obstacle) {
  if (obstacle.hollow == Hollow::none) return "";
  return string(", inside: true, open: ") + (obstacle.hollow == Hollow::whole        ? "none"
                                             : obstacle.hollow == Hollow::lower_half ? "top"
                                             : obstacle.hollow == Hollow::upper_half ? "bottom"
                                                                                     : "both");
}

string fixed(const World& world) {
  string out;
  Entity e = world.body_count();
  if (!world.planes.empty()) out += "planes:\n";
  for (const Plane& p : world.planes) {
    out += "  " + name(world, e) + ": {point: " + text(p.point) + ", normal: " + text(p.normal) + text(p.restitution) +
           motion(world, e) + "}\n";
    ++e;
  }

  if (!world.walls.empty()) out += "walls:\n";
  for (const Wall& w : world.walls) {
    out += "  " + name(world, e) + ": {center: " + text(w.center) + ", normal: " + text(w.normal) +
           ", up: " + text(w.up) + ", size: [" + text(2 * w.half_width) + ", " + text(2 * w.half_height) + "]" +
           text(w.restitution) + motion(world, e) + "}\n";
    ++e;
  }

  if (!world.obstacles.empty()) out += "obstacles:\n";
  for (const Obstacle& o : world.obstacles) {
    out += "  " + name(world, e) + ": {position: " + text(o.center) + ", " + text(o.volume) + hollow(o) +
           text(o.restitution) + motion(world, e) + "}\n";
    ++e;
  }
  return out;
}

string strings(const World& world) {
  string out = world.strings.empty() ? "" : "strings:\n";
  for (size_t k = 0; k < world.strings.size(); ++k) {
    const String& s = world.strings[k];
    out += "  " + name(world, world.string_number(k)) +
           ": {from: " + (s.other == no_entity ? text(s.anchor) : name(world, s.other)) +
           ", to: " + name(world, s.body) + ", length: " + text(s.length) + ", restitution: " + text(s.restitution) +
           (s.rod ? ", rod: true" : "") +
           (isfinite(s.until) ? ", until: " + time_text(world, TriggeredEnd::Of::string, k, 0, true, s.until) : "") +
           "}\n";
  }
  return out;
}

string on_text(const World& world, const vector<Entity>& bodies) {
  string on;
  for (Entity i : bodies) on += (on.empty() ? "" : ", ") + name(world, i);
  return on.empty() ? "" : ", on: [" + on + "]";
}

string regions(const World& world) {
  string out = world.regions.empty() ? "" : "regions:\n";
  for (size_t k = 0; k < world.regions.size(); ++k) {
    const WorldRegion& r = world.regions[k];
    out += "  r" + to_string(k) + ": {" +
           (r.is_side() ? "plane: {point: " + text(r.position) + ", normal: " + text(r.normal) + "}"
                        : text(r.volume) + ", position: " + text(r.position)) +
           on_text(world, r.on) + ", action: " +
           (r.removes ? "remove"
            : r.stops ? "stop"
                      : "none") +
           "}\n";
  }

  return out;
}

string forces(const World& world) {
  using Of = TriggeredEnd::Of;
  string out;
  for (size_t k = 0; k < world.forces.size(); ++k) {
    const Force& f = world.forces[k];
    out += "  - {" + std::visit([](const auto& law) { return text(law); }, f.law) + ", " +
           window_text(world, Of::force, k, 0, f.from, f.until) + on_text(world, f.on) + "}\n";
  }

  // Between bodies.
  for (size_t k = 0; k < world.springs.size(); ++k) {
    const BodySpring& s = world.springs[k];
    out += "  - {spring: {from: " + name(world, s.a) + ", to: " + name(world, s.b) +
           ", stiffness: " + text(s.stiffness) + ", rest_length: " + text(s.rest_length) +
           ", damping: " + text(s.damping) + "}, " + window_text(world, Of::body_spring, k, 0, s.from, s.until) + "}\n";
  }
  for (size_t k = 0; k < world.gravitations.size(); ++k) {
    const Gravitation& g = world.gravitations[k];
    out += "  - {gravitation: {constant: " + text(g.constant) + ", softening: " + text(g.softening) + "}, " +
           window_text(world, Of::gravitation, k, 0, g.from, g.until) + on_text(world, g.on) + "}\n";
  }
  return out.empty() ? "" : "forces:\n" + out;
}

string restitution(const World& world) {
  static const char* const rules[] = {"average",        "minimum",       "maximum", "product",
                                      "geometric_mean", "mass_weighted", "book"};
  string out = "restitution: {combine: " + string(rules[static_cast<int>(world.combine)]);
  string list;
  for (const PairRestitution& p : world.pairs)
    list += (list.empty() ? "" : ", ") + ("{between: [" + name(world, p.a_first)) + ", " + name(world, p.b_first) +
            "], value: " + (p.value ? text(*p.value) : string("none")) + "}";
  return out + (list.empty() ? "" : ", pairs: [" + list + "]") + "}\n";
}

}  // namespace

string as_yaml(const RandomScene& scene, const string& more) {
  const ExactOptions& o = scene.options;
  string simulate = "simulate: {duration: " + text(o.duration) + more;
  if (o.rest_speed > 0) simulate += ", rest_speed: " + text(o.rest_speed);
  if (o.merge) simulate += ", contact: merge";
  if (o.max_collisions > 0) simulate += ", max_collisions: " + to_string(o.max_collisions);
  return "# seed " + to_string(scene.seed) + ", family " + scene.family +
         "\nscene: 1\ngravity: " + text(scene.world.gravity) + "\n" + restitution(scene.world) + bodies(scene) +
         fixed(scene.world) + strings(scene.world) + regions(scene.world) + forces(scene.world) + simulate +
         "}\noutput: {trajectory: {every: " + text(o.duration / 100) +
         "}, collisions: true, energy: {every: " + text(o.duration / 100) + "}}\n";
}

}  // namespace carom::stress
