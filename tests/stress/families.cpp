// Families of random scenes, each for one kind of difficulty.

#include "physics/bounds.h"
#include "physics/world.h"
#include "std.h"
#include "stress/make_scene.h"

namespace carom::stress {

namespace {

/// Balls in a room, perhaps with walls, planes and gravity.
void gas(Maker& m) {
  m.room(2);
  m.gravity(0.5);

  for (int k = m.whole(0, 2); k > 0; --k)
    m.plane(m.within({-1, -1.6, -1}, {1, -1.4, 1}), m.within({-1, 1, -1}, {1, 1, 1}));
  for (int k = m.whole(0, 3); k > 0; --k)
    m.wall(m.somewhere(1.5), m.chance(0.3) ? Vec3::UnitY() : m.direction(), {0.11, 0.3, 1}, m.uniform(0.1, 2),
           m.uniform(0.1, 2));

  const double e = m.restitution();
  const bool spread = m.chance(0.3), still = m.chance(0.3), heavy = m.chance(0.3);
  for (int k = m.whole(1, 40); k > 0; --k)
    m.fit(2, Volume::sphere(spread ? m.spread(1e-3, 0.5) : m.uniform(0.05, 0.3)),
          still && m.chance(0.5) ? Vec3(Vec3::Zero()) : m.somewhere(3), heavy ? m.spread(1e-2, 1e4) : m.uniform(0.5, 2),
          e);

  m.scene.options.duration = m.uniform(0.2, 2);
  m.scene.may_stop = m.scene.world.gravity.isZero() && e == 1;
  if (!m.scene.world.gravity.isZero() && e < 1)
    m.scene.options.max_collisions = 0;  // all come to rest, bounce by bounce
}

/// Few bodies in empty space, at all scales, aimed at each other.
void space(Maker& m) {
  m.gravity(0.7);
  const double speed = m.spread(1e-12, 1e8), radius = m.spread(1e-3, 1), e = m.restitution();
  const double way = radius * m.spread(2, 1e5), duration = std::min(1e6, 2 * way / speed);
  const Vec3 origin = m.chance(0.5) ? Vec3(Vec3::Zero()) : m.somewhere(m.spread(1, 1e8));
  if (!m.scene.world.gravity.isZero() && m.chance(0.5)) m.scene.world.gravity *= way / (duration * duration);
  const bool volumes = m.chance(0.3);
  for (int k = m.whole(1, 8); k > 0; --k) {
    // Aimed at a place near the origin, to be there at half time.
    const Volume v = m.any_volume(std::clamp(radius * m.spread(0.1, 10), 1e-3, 1.0), volumes ? 0.3 : 1);
    const Vec3 velocity = speed * m.uniform(0.2, 1) * m.direction();
    const Vec3 x = origin + m.somewhere(2 * radius) - velocity * (0.5 * duration);
    if (m.is_free(x, v)) m.body(x, velocity, v, m.spread(1e-7, 1e7), e);
  }
  m.scene.options.duration = duration;
}

/// Pairs that meet, graze or narrowly miss.
void grazing(Maker& m) {
  m.gravity(0.6);
  const double e = m.restitution(), duration = m.uniform(1, 3);
  for (int k = m.whole(1, 3); k > 0; --k) {
    const double a = m.spread(1e-3, 1), b = m.spread(1e-3, 1), by = m.any({-1, 1}) * m.spread(1e-15, 1e-3);
    const Vec3 axis = m.direction(), side = axis.cross(m.direction()).normalized(), w = m.uniform(1, 20) * axis;
    const Vec3 meet = m.somewhere(30), drift = m.somewhere(2);
    const double time = 0.5 * duration;

    const Vec3 xa = meet - drift * time, xb = meet + (a + b) * (1 + by) * side - (drift - w) * time;
    if (!m.is_free(xa, Volume::sphere(a))) continue;
    m.body(xa, drift, Volume::sphere(a), m.spread(1e-2, 1e2), e);
    if (m.is_free(xb, Volume::sphere(b))) m.body(xb, drift - w, Volume::sphere(b), m.spread(1e-2, 1e2), e);
  }
  m.scene.options.duration = duration;
}

/// Balls aimed at walls' faces, edges and corners.
void walls(Maker& m) {
  m.gravity(0.4);
  const double e = m.restitution();
  const int count = m.whole(1, 5);
  for (int k = 0; k < count; ++k)
    m.wall(m.somewhere(2), m.chance(0.3) ? Vec3(Vec3::Unit(m.whole(0, 2))) : m.direction(), {0.31, 0.7, 0.2},
           m.uniform(0.05, 3), m.uniform(0.05, 3));

  for (int k = m.whole(1, 8); k > 0; --k) {
    const Wall& w = m.scene.world.walls[static_cast<size_t>(m.whole(0, count - 1))];
    const double radius = m.spread(1e-3, 0.5);
    const auto along = [&] { return m.chance(0.4) ? m.any({-1, 1}) : m.uniform(-1.1, 1.1); };
    const Vec3 target = w.center + w.half_width * along() * w.right + w.half_height * along() * w.up;

    const Vec3 v = m.uniform(0.1, 10) * m.direction();
    const Vec3 x = target + (m.chance(0.5) ? 1.2 : 0.2) * m.somewhere(radius) - v * m.uniform(0.2, 1);
    if (m.is_free(x, Volume::sphere(radius))) m.body(x, v, Volume::sphere(radius), m.uniform(0.1, 2), e);
  }
  m.scene.options.duration = m.uniform(1, 3);
}

/// Every kind of volume, movable and fixed, in a room or not.
void volumes(Maker& m) {
  m.gravity(0.4);
  const bool room = m.chance(0.7);

  if (room) m.room(2);
  const double e = m.restitution();
  for (int k = m.whole(0, 4); k > 0; --k) m.obstacle(m.somewhere(1.5), m.any_volume(m.uniform(0.1, 0.6), 0.33));
  for (int k = m.whole(-2, 2); k > 0; --k)
    m.wall(m.somewhere(1.5), m.chance(0.5) ? Vec3(Vec3::Unit(m.whole(0, 2))) : m.direction(), {0.31, 0.7, 0.2},
           m.uniform(0.1, 2), m.uniform(0.1, 2));
  if (m.chance(0.3)) m.plane(m.within({-1, -1.6, -1}, {1, -1.4, 1}), m.within({-1, 1, -1}, {1, 1, 1}));

  for (int k = m.whole(1, 14); k > 0; --k)
    m.fit(2, m.any_volume(m.uniform(0.05, 0.4), 0.3), m.somewhere(m.chance(0.2) ? 0 : 3), m.uniform(0.5, 2), e);
  m.scene.options.duration = m.uniform(0.2, 1.5);
  m.scene.may_stop = room && e == 1;
}

/// Timed forces and impulses.
void forces(Maker& m) {
  m.gravity(0.5);
  const bool room = m.chance(0.6);
  if (room) m.room(2);
  const double e = m.restitution(), spheres = m.chance(0.6) ? 1 : 0.4;
  for (int k = m.whole(0, 2); k > 0; --k) m.obstacle(m.somewhere(1.5), m.any_volume(m.uniform(0.1, 0.6), 0.33));
  for (int k = m.whole(1, 10); k > 0; --k)
    m.fit(2, m.any_volume(m.uniform(0.05, 0.4), spheres), m.somewhere(3), m.spread(0.1, 10), e);
  m.scene.options.duration = m.uniform(0.5, 2);
  m.forces(m.scene.options.duration, m.any({1, 10, 50}));
  m.scene.may_stop = room && e == 1;
}

/// Bodies that merge when they meet.
void merging(Maker& m) {
  m.gravity(0.6);
  const bool room = m.chance(0.5);
  if (room) m.room(3);
  const double spheres = m.chance(0.6) ? 1 : 0.4;
  for (int k = m.whole(2, 25); k > 0; --k)
    m.fit(3, m.any_volume(m.uniform(0.05, 0.5), spheres), m.somewhere(3), m.spread(0.1, 100), m.restitution());
  m.scene.options.duration = m.uniform(0.5, 3);
  m.scene.options.merge = true;
  if (m.chance(0.3)) m.forces(m.scene.options.duration, 10);
  m.scene.may_stop = room;
}

/// Bodies that rest on the ground and on one another from the start, perhaps struck.
void stacks(Maker& m) {
  m.scene.world.gravity = Vec3(0, -m.any({9.80665, 1, 100}), 0);
  m.plane(Vec3::Zero(), Vec3::UnitY());
  const double e = m.restitution();
  const bool boxes = m.chance(0.6);
  for (int column = m.whole(1, 4); column > 0; --column) {
    double top = 0;
    const double x = 4 * column;
    for (int k = m.whole(1, 5); k > 0; --k) {
      // Whole multiples of 1/64: that they touch is then exact.
      const double size = m.whole(4, 40) / 64.0;
      const Volume v = boxes && m.chance(0.7)
                           ? (m.chance(0.5) ? Volume::box(Vec3(2, 2, 2) * size) : Volume::cylinder(size, 2 * size))
                           : Volume::sphere(size);
      const double aside = boxes && m.chance(0.3) ? m.uniform(-0.5, 0.5) * size : 0;
      m.body({x + aside, top + v.half.y(), 0}, Vec3::Zero(), v, m.spread(0.1, 10), e);
      top += 2 * v.half.y();
    }
  }
  if (m.chance(0.5)) m.fit(12, Volume::sphere(m.uniform(0.1, 0.5)), m.somewhere(8), m.uniform(0.1, 5), e);
  m.scene.options.duration = m.uniform(0.2, 2);
}

/// Rows of touching balls, struck.
void cradles(Maker& m) {
  m.gravity(0.9);
  const double e = m.restitution(), radius = m.any({0.5, 0.125, 0.05, 1e-3}), speed = m.any({1, 3, 1e-6, 1e5});
  const int row = m.whole(2, 8), strikers = m.whole(0, 3);
  const bool equal = m.chance(0.6), across = m.chance(0.3);
  const double spacing = 2 * radius * (m.chance(0.7) ? 1 : 1 + m.spread(1e-15, 1e-3));

  for (int k = 0; k < row; ++k)
    m.body({spacing * k, 0, 0}, Vec3::Zero(), Volume::sphere(radius), equal ? 1 : m.spread(0.01, 100), e);

  for (int k = 0; k < strikers; ++k) {
    const double side = k % 2 == 0 ? -1 : 1;
    const Vec3 x = across ? Vec3(spacing * m.uniform(0, row), radius * (4 + 3 * k), 0)
                          : Vec3(k % 2 == 0 ? -radius * (4 + 3 * k) : spacing * row + radius * (4 + 3 * k), 0, 0);
    const Vec3 v = across ? Vec3(0, -speed, 0) : Vec3(-side * speed, 0, 0);
    if (m.is_free(x, Volume::sphere(radius))) m.body(x, v, Volume::sphere(radius), equal ? 1 : m.spread(0.01, 100), e);
  }

  if (m.chance(0.2)) {
    m.plane({-40 * radius, 0, 0}, Vec3::UnitX());
    m.plane({40 * radius, 0, 0}, -Vec3::UnitX());
  }

  const double pull = m.scene.world.gravity.norm();  // to 1e9 m
  m.scene.options.duration = std::min({1e6, 60 * radius / speed, pull > 0 ? sqrt(2e9 / pull) : 1e6});
}

/// A pile that falls into a box or a groove and comes to rest.
void heaps(Maker& m) {
  m.scene.world.gravity = Vec3(0, -9.80665, 0);
  const bool groove = m.chance(0.4);
  if (groove) {
    m.plane({0, -2, 0}, {m.uniform(0.3, 2), 1, 0});
    m.plane({0, -2, 0}, {-m.uniform(0.3, 2), 1, 0});
    m.plane({0, 0, -1}, Vec3::UnitZ());
    m.plane({0, 0, 1}, -Vec3::UnitZ());
  } else {
    m.room(m.any({1, 1.5}));
  }

  if (m.chance(0.3)) m.obstacle(m.within({-0.5, -1, -0.5}, {0.5, 0, 0.5}), m.any_volume(m.uniform(0.1, 0.4), 0.4));

  const double e = m.any({0, 0.3, 0.5, 0.8}), spheres = m.chance(0.7) ? 1 : 0.3, size = m.uniform(0.08, 0.3);
  const bool equal = m.chance(0.4);

  for (int k = m.whole(2, 40); k > 0; --k)
    m.fit(1, m.any_volume(equal ? size : size * m.uniform(0.3, 1), spheres), m.somewhere(1),
          equal ? 1 : m.spread(0.1, 10), e);

  m.scene.options.duration = m.uniform(0.5, 2);
  m.scene.options.max_collisions = 0;
}

/// Restitution above 1.
void lively(Maker& m) {
  m.gravity(0.5);
  m.room(2);
  const double e = m.any({1.05, 1.2, 2});
  for (int k = m.whole(1, 6); k > 0; --k)
    m.fit(2, m.any_volume(m.uniform(0.1, 0.4), 0.7), m.somewhere(1), m.spread(0.1, 10), e);
  m.scene.options.duration = m.uniform(0.2, 1);
  m.scene.options.max_collisions = 3000;
  m.scene.may_stop = true;
}

/// A ball or none, for long.
void lonely(Maker& m) {
  m.gravity(0.3);
  const double e = m.any({0, 0.3, 0.5, 0.9}), duration = m.spread(1, 1e6);
  if (m.chance(0.7)) m.plane(Vec3::Zero(), m.chance(0.5) ? Vec3::UnitY() : m.direction());
  if (m.chance(0.3)) m.plane(Vec3(1, 0, 0), m.chance(0.5) ? Vec3(-Vec3::UnitX()) : m.direction());
  if (m.chance(0.3)) m.obstacle(m.somewhere(2), m.any_volume(m.uniform(0.1, 1), 0.4));
  for (int k = m.whole(0, 2); k > 0; --k)
    m.fit(6, m.any_volume(m.spread(1e-3, 1), 0.7),
          m.chance(0.3) ? Vec3(Vec3::Zero()) : m.somewhere(m.spread(1e-9, 1e3)), m.spread(1e-3, 1e3), e);
  m.scene.options.duration = duration;
  m.scene.options.rest_speed = m.chance(0.3) ? m.spread(1e-6, 1e-1) : 0;
}

/// Light between heavy: ratios to 1e14.
void hammers(Maker& m) {
  m.scene.world.gravity = Vec3::Zero();
  if (m.chance(0.5)) m.plane({-3, 0, 0}, Vec3::UnitX());
  const double e = m.restitution();
  const bool offset = m.chance(0.4);
  double x = 0;
  for (int k = m.whole(2, 4); k > 0; --k) {
    const double radius = m.uniform(0.1, 0.5);
    m.body({x + radius, offset ? m.uniform(-0.05, 0.05) : 0, 0}, {m.uniform(-2, 2), 0, 0}, Volume::sphere(radius),
           m.spread(1e-7, 1e7), e);
    x += 2 * radius + m.spread(1e-4, 1);
  }

  m.scene.options.duration = m.spread(0.1, 100);
  m.scene.may_stop = true;
}

/// s: until free bodies have travelled a tenth of the limit of doubles.
double time_in_bounds(const RandomScene& scene) {
  const World& world = scene.world;
  double speed = 0, pull = world.gravity.norm();
  for (Entity i = 0; i < world.body_count(); ++i) {
    const Vec3 kick = world.impulse.empty() ? Vec3(Vec3::Zero()) : Vec3(world.impulse[i] / world.mass[i]);
    speed = std::max(speed, (scene.initial.velocity[i] + kick).norm());
  }
  for (const Force& f : world.forces) pull += value(f).norm() / (per_mass(f) ? 1 : *ranges::min_element(world.mass));
  const double way = 0.1 * bounds_of(world).place;
  return 2 * way / (speed + sqrt(speed * speed + 2 * pull * way));
}

struct Family {
  const char* name;
  void (*make)(Maker&);
};
constexpr Family families[] = {{"gas", gas},         {"space", space},   {"grazing", grazing}, {"walls", walls},
                               {"volumes", volumes}, {"forces", forces}, {"merging", merging}, {"stacks", stacks},
                               {"cradles", cradles}, {"heaps", heaps},   {"lively", lively},   {"lonely", lonely},
                               {"hammers", hammers}};

}  // namespace

span<const char* const> family_names() {
  static const auto names = [] {
    array<const char*, std::size(families)> list;
    std::transform(std::begin(families), std::end(families), list.begin(), [](const Family& f) { return f.name; });
    return list;
  }();
  return names;
}

RandomScene make_scene(uint64_t seed, string_view bytes) {
  RandomScene scene;
  const Family& family = families[seed % std::size(families)];
  Maker maker(seed, scene, bytes);
  scene.family = family.name;
  family.make(maker);
  maker.rules();
  World& world = scene.world;
  scene.options.duration = std::min(scene.options.duration, time_in_bounds(scene));
  // Endless bounces may exceed the limit of collisions.
  const auto lasting = [](const auto& thing) { return thing.restitution.value_or(0) >= 1; };
  scene.may_stop = scene.may_stop || any_of(world.restitution, [](double e) { return e >= 1; }) ||
                   any_of(world.pairs, [](const PairRestitution& p) { return p.value >= 1; }) ||
                   any_of(world.planes, lasting) || any_of(world.walls, lasting) || any_of(world.obstacles, lasting);
  const bool spheres = all_of(world.volume, [](const Volume& v) { return v.shape == Shape::sphere; });
  if (spheres && !maker.chance(0.1)) world.volume.clear();
  return scene;
}

RandomScene with_motions(RandomScene scene) {
  RandomScene unused;
  Maker maker(scene.seed, unused);
  const double size = scene.world.radius.empty() ? 1 : scene.world.radius[0];
  maker.motions(scene.world, scene.initial, scene.options.duration,
                size * maker.any({0.1, 1, 10}) / scene.options.duration);
  scene.may_stop = true;  // they may leave a body no room
  return scene;
}

}  // namespace carom::stress
