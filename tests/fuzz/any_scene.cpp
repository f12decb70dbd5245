#include "fuzz/any_scene.h"

#include <fmt/format.h>

#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"
#include "stress/make_scene.h"

namespace carom::fuzz {

namespace {

using stress::Maker;

struct Units {
  double length, time, mass;
  double speed() const { return length / time; }
};

Volume any_volume(Maker& m, double size, double spheres = 0.4) {
  return m.any_volume(m.chance(0.05) ? 1e-3 * size : size * m.uniform(0.05, 1), spheres);
}

/// Hollow things, large enough for bodies.
void shells(Maker& m, const Units& u) {
  for (int k = m.whole(1, 2); k > 0; --k) {
    const auto hollow = static_cast<Hollow>(m.whole(int(Hollow::whole), int(Hollow::side)));
    const double radius = u.length * m.uniform(1, 4);
    const Volume volume =
        hollow == Hollow::side ? Volume::cylinder(radius, u.length * m.uniform(0.5, 8)) : Volume::sphere(radius);
    m.scene.world.obstacles.push_back({m.somewhere(u.length), volume, nullopt, hollow});
  }
}

void surfaces(Maker& m, const Units& u) {
  const double half = 3 * u.length;
  if (m.chance(0.5)) m.room(half);
  for (int k = m.whole(-2, 2); k > 0; --k)
    m.plane(m.chance(0.5) ? Vec3(0, -half, 0) : Vec3(half * m.direction()),
            m.chance(0.5) ? Vec3::UnitY() : m.direction());
  for (int k = m.whole(-2, 2); k > 0; --k)
    m.wall(m.somewhere(half), m.chance(0.5) ? Vec3(Vec3::Unit(m.whole(0, 2))) : m.direction(), {0.31, 0.7, 0.2},
           u.length * m.uniform(0.01, 3), u.length * m.uniform(0.01, 3));
  for (int k = m.whole(-2, 3); k > 0; --k) m.obstacle(m.somewhere(half), any_volume(m, u.length));
}

void bodies(Maker& m, const Units& u) {
  // Only balls meet shells.
  const bool shells = any_of(m.scene.world.obstacles, [](const Obstacle& o) { return o.hollow != Hollow::none; });
  const bool wide = m.chance(0.15), lively = m.chance(0.05), far = m.chance(0.1);
  const double e = m.restitution();
  for (int k = m.whole(0, 8); k > 0; --k) {
    const double mass = wide ? m.spread(lightest, heaviest) : u.mass * m.spread(0.1, 10);
    const double own = lively ? m.any({1.05, 2}) : m.chance(0.2) ? m.restitution() : e;

    Vec3 v = u.speed() * m.somewhere(1);
    if (m.chance(0.3)) v.setZero();
    if (m.chance(0.05)) v *= m.any({most_speeds, 1e-9, 1e-3});
    if (m.chance(0.2)) v = Vec3(0, -v.norm(), 0);

    const Volume volume = any_volume(m, u.length, shells ? 1 : 0.4);
    const auto& placed = m.scene.initial.position;
    if (!placed.empty() && m.chance(0.3)) {  // touching another, along an axis
      const Entity other = static_cast<Entity>(m.whole(0, static_cast<int>(placed.size()) - 1));
      const int axis = m.whole(0, 2);
      Vec3 x = placed[other];
      x[axis] += m.any({-1, 1}) * (m.scene.world.volume[other].half[axis] + volume.half[axis]);
      m.body(x, m.chance(0.5) ? v : m.scene.initial.velocity[other], volume, mass, own);
    } else {
      m.fit((far ? most_lengths : 3) * u.length, volume, v, mass, own);
    }
  }

  if (m.chance(0.2))
    for (Entity i = 0; i < m.scene.world.body_count(); ++i)
      m.scene.world.impulse.push_back(m.chance(0.5) ? Vec3(m.scene.world.mass[i] * u.speed() * m.somewhere(1))
                                                    : Vec3(Vec3::Zero()));
}

/// Of sizes that matter within the duration and that some thousands of steps can follow.
ForceLaw any_law(Maker& m, const Units& u, double light) {
  const double acceleration = u.speed() / u.time, zero_or_one = m.any({0, 1, 1});
  switch (m.whole(0, 5)) {
    case 0:
      return UniformForce{light * acceleration * m.somewhere(3)};
    case 1:
      return UniformAcceleration{acceleration * m.somewhere(3)};
    case 2:

      return Drag{light / u.time * m.uniform(0, 3), 0, u.speed() * zero_or_one * m.somewhere(1)};
    case 3:
      return Drag{light / u.time * zero_or_one * m.uniform(0, 3), light / u.length * m.uniform(0, 0.5),
                  u.speed() * zero_or_one * m.somewhere(1)};

    case 4:
      return Spring{u.length * m.somewhere(3), light / (u.time * u.time) * m.spread(1e-3, 30),
                    u.length * zero_or_one * m.uniform(0, 2), light / u.time * m.any({0, 0.1, 3})};
    default:
      return Attractor{u.length * m.somewhere(3),
                       m.any({1, 1, 1, -1}) * u.length * u.speed() * u.speed() * m.uniform(0, 3),
                       u.length * m.uniform(0.1, 1)};
  }
}

void forces(Maker& m, const Units& u) {
  World& world = m.scene.world;
  const double light = world.mass.empty() ? u.mass : *ranges::min_element(world.mass);
  const double duration = m.scene.options.duration;
  for (int k = m.whole(-2, 3); k > 0; --k) {
    const double from = m.chance(0.6) ? 0 : duration * m.uniform(0, 1);
    const double until = m.chance(0.3) ? from + duration * m.uniform(0.01, 0.7) : infinity;
    world.forces.push_back({any_law(m, u, light), from, until});
    for (Entity i = 0; i < world.body_count(); ++i)
      if (m.chance(0.4)) world.forces.back().on.push_back(i);
  }
}

void regions(Maker& m, const Units& u) {
  for (int k = m.whole(-2, 2); k > 0; --k) {
    WorldRegion region;
    region.position = m.somewhere(3 * u.length);
    if (m.chance(0.3))
      region.normal = m.direction();
    else
      region.volume = any_volume(m, 3 * u.length);
    for (Entity i = 0; i < m.scene.world.body_count(); ++i)
      if (m.chance(0.4)) region.on.push_back(i);
    region.removes = m.chance(0.5);
    m.scene.world.regions.push_back(std::move(region));
  }
}

/// Strings and rods, many of them taut at time 0.
void strings(Maker& m, const Units& u) {
  World& world = m.scene.world;
  const auto n = static_cast<int>(world.body_count());

  for (int k = n == 0 ? 0 : m.whole(-3, 4); k > 0; --k) {
    String string;
    string.body = static_cast<Entity>(m.whole(0, n - 1));
    const auto other = static_cast<Entity>(m.whole(0, n - 1));
    if (world.comes_later(string.body) || world.comes_later(other)) continue;
    if (m.chance(0.5) && other != string.body) {
      string.other = std::max(string.body, other);
      string.body = std::min(string.body, other);
    } else {
      string.anchor = m.scene.initial.position[string.body] + m.any({0.01, 1, 1, 10}) * u.length * m.somewhere(1);
    }

    const Vec3 to = string.other == no_entity ? string.anchor : m.scene.initial.position[string.other];
    string.length = (m.scene.initial.position[string.body] - to).norm();
    string.rod = m.chance(0.2);
    if (!string.rod && m.chance(0.5)) string.length *= m.uniform(1, 2);
    string.restitution = m.chance(0.6) ? 0 : m.restitution();

    if (string.rod && string.length > 0) {  // it moves across itself
      vector<Vec3>& v = m.scene.initial.velocity;
      const Vec3 along = (m.scene.initial.position[string.body] - to) / string.length;
      const Vec3 other_v = string.other == no_entity ? Vec3(Vec3::Zero()) : v[string.other];
      v[string.body] -= (v[string.body] - other_v).dot(along) * along;
    }

    if (string.length > 0) world.strings.push_back(string);
  }
}

/// Springs between bodies, and gravitation among them.
void couplings(Maker& m, const Units& u) {
  World& world = m.scene.world;
  const auto n = static_cast<int>(world.body_count());
  const double light = n == 0 ? u.mass : *ranges::min_element(world.mass), duration = m.scene.options.duration;
  const auto window = [&](auto& law) {
    if (m.chance(0.3)) law.from = duration * m.uniform(0, 1);
    if (m.chance(0.3)) law.until = law.from + duration * m.uniform(0.01, 0.7);
  };

  for (int k = n < 2 ? 0 : m.whole(1, 6); k > 0; --k) {
    BodySpring spring{static_cast<Entity>(m.whole(0, n - 1)), static_cast<Entity>(m.whole(0, n - 1))};
    if (spring.a == spring.b || world.comes_later(spring.a) || world.comes_later(spring.b)) continue;
    // No stronger across the scene than at its unit.
    const vector<Vec3>& x = m.scene.initial.position;
    const double distance = (x[spring.a] - x[spring.b]).norm();
    spring.stiffness = light / (u.time * u.time) * m.spread(1e-3, 30) * std::min(1.0, 3 * u.length / distance);
    spring.rest_length = u.length * m.any({0, 1, 1}) * m.uniform(0, 4);
    spring.damping = light / u.time * m.any({0, 0, 0.1, 3});
    window(spring);
    world.springs.push_back(spring);
  }

  if (n < 2 || !m.chance(0.3)) return;
  Gravitation law;
  law.constant =
      m.any({1, 1, -1}) * u.length * u.speed() * u.speed() / *ranges::max_element(world.mass) * m.uniform(0, 3);
  law.softening = u.length * m.any({0, 0, 0.1, 1});
  for (Entity i = 0; i < world.body_count(); ++i)
    if (!world.comes_later(i)) law.on.push_back(i);
  window(law);
  if (law.on.size() >= 2) world.gravitations.push_back(law);
}

/// Some bodies come later.
void appearances(Maker& m) {
  World& world = m.scene.world;
  world.appears.assign(world.body_count(), -infinity);
  for (double& due : world.appears)
    if (m.chance(0.4)) due = m.scene.options.duration * m.uniform(0, 0.8);
}

/// Things that shake, and that repeat their windows.
void swings(Maker& m, const Units& u) {
  World& world = m.scene.world;
  world.motions.resize(world.fixed_count());
  for (SurfaceMotion& motion : world.motions) {
    if (motion.moves() || !m.chance(0.6)) continue;
    const double period = u.time * m.spread(0.03, 10);
    if (m.chance(0.5)) {
      motion = motion_on_sine(u.speed() * period * m.spread(1e-3, 0.3) * m.direction(), period, m.any({0, 90}));
      continue;
    }

    const Vec3 v = u.speed() * m.spread(1e-2, 2) * m.direction();
    const double middle = period * m.uniform(0.1, 0.5), end = period * m.uniform(0.6, 1);
    motion = motion_in_windows(array{MotionWindow{0, middle, v}, MotionWindow{middle, end, -v * m.any({1, 1, 0.5})}},
                               period);
  }
}

/// Events set some times of forces and strings.
void events(Maker& m) {
  using Of = TriggeredEnd::Of;
  World& world = m.scene.world;
  if (world.body_count() == 0) return;
  const auto wait = [&](Of of, size_t index, bool ends, double& time) {
    if (!m.chance(0.4)) return;
    time = not_yet;
    const double after = m.chance(0.5) ? 0 : m.scene.options.duration * m.uniform(0, 0.3);
    world.triggers.ends.push_back({of, uint32_t(index), 0, ends, m.event(world, m.scene.initial), after});
  };

  const auto windows = [&](Of of, auto& laws) {
    for (size_t k = 0; k < laws.size(); ++k) {
      wait(of, k, false, laws[k].from);
      if (laws[k].from != not_yet || !isfinite(laws[k].until)) wait(of, k, true, laws[k].until);
    }
  };

  windows(Of::force, world.forces);
  windows(Of::body_spring, world.springs);
  windows(Of::gravitation, world.gravitations);
  for (size_t k = 0; k < world.strings.size(); ++k) wait(Of::string, k, true, world.strings[k].until);
}

/// Keys of `simulate`.
void choose(Maker& m, AnyScene& made) {
  const double duration = made.scene.options.duration;
  const double step = duration / m.any({10, 100, 300, most_steps});
  static constexpr const char* integrators[] = {"euler", "verlet", "rk4"};
  made.engine = m.chance(0.4) ? "auto" : m.chance(0.5) ? "stepped" : m.chance(0.6) ? "exact" : "book";
  made.simulate = fmt::format(", engine: {}", made.engine);
  if (made.engine == "stepped") made.simulate += fmt::format(", integrator: {}", integrators[m.whole(0, 2)]);
  if ((made.engine == "stepped" || made.engine == "book") &&
      (made.engine == "book" || duration > longest_in_default_steps || m.chance(0.7)))
    made.simulate += fmt::format(", step: {}", step);
  if (made.engine == "book" && m.chance(0.3)) made.simulate += ", as_printed: true";
}

/// `tied`: with strings.
void everything(Maker& m, bool tied) {
  Units u{1, 1, 1};
  if (m.chance(0.4)) u = {m.spread(smallest_length, largest_length), m.spread(shortest_time, longest_time), 1};
  m.scene.options.duration = u.time * (m.chance(0.1) ? m.spread(1e-3, 8) : m.uniform(0.1, 5));

  m.gravity(1);
  if (m.chance(0.6)) {
    const double g = u.speed() / u.time * m.any({0.1, 1, 10});
    m.scene.world.gravity = m.chance(0.7) ? Vec3(0, -g, 0) : Vec3(g * m.direction());
  }

  surfaces(m, u);
  if (m.chance(0.2)) shells(m, u);
  bodies(m, u);
  if (m.chance(0.2)) appearances(m);
  forces(m, u);
  m.rules();
  for (PairRestitution& pair : m.scene.world.pairs)
    if (m.chance(0.2)) pair.value.reset();

  m.scene.options.merge = m.chance(0.05);
  if (m.chance(0.1)) m.scene.options.rest_speed = u.speed() * m.spread(1e-6, 1e-1);
  if (m.chance(0.2)) m.motions(m.scene.world, m.scene.initial, m.scene.options.duration, u.speed());
  if (m.chance(0.2)) swings(m, u);
  regions(m, u);
  if (tied) strings(m, u);
  if (tied && m.chance(0.3)) couplings(m, u);
  if (m.chance(0.3)) events(m);

  World& world = m.scene.world;
  const bool spheres = all_of(world.volume, [](const Volume& v) { return v.shape == Shape::sphere; });
  if (spheres) world.volume.clear();
}

}  // namespace

AnyScene make_any_scene(uint64_t seed, string_view bytes) {
  const size_t families = stress::family_names().size();
  const size_t kind = bytes.empty() ? seed % (3 * families) : static_cast<unsigned char>(bytes[0]) % (3 * families);
  // Many swings take longer than a fuzzer of bytes waits.
  const bool tied = bytes.empty();
  bytes.remove_prefix(std::min<size_t>(bytes.size(), 1));
  AnyScene made;
  if (kind < families) {
    // Families have only constant forces; stress/ runs them by the exact engine.
    made.scene = stress::make_scene(kind + families * seed, bytes);
    stress::RandomScene unused;
    Maker maker(seed, unused, bytes.substr(std::min<size_t>(bytes.size(), 64)));
    choose(maker, made);
    return made;
  }
  made.scene.family = "everything";
  Maker maker(seed, made.scene, bytes);
  everything(maker, tied);
  choose(maker, made);
  return made;
}

}  // namespace carom::fuzz
