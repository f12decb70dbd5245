#include "stress/make_scene.h"

#include "physics/world.h"
#include "std.h"
#include "stress/gaps.h"

namespace carom::stress {

namespace {

/// v / |v|, with the roundings of the loader.
Vec3 unit(const Vec3& v) {
  const Vec3 scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / sqrt(scaled.x() * scaled.x() + scaled.y() * scaled.y() + scaled.z() * scaled.z());
}

/// Applies the loader's rounding to v until it no longer changes: so a file gives the same bits.
template <typename Step>
Vec3 settled(Vec3 v, Step step) {
  for (int k = 1;; ++k) {
    const Vec3 next = step(v);
    if (next == v) return v;
    v = next;
    if (k % 8 == 0) v.x() += 0x1p-20;  // the rounding cycles
  }
}

}  // namespace

Maker::Maker(uint64_t seed, RandomScene& made, string_view bytes) : scene(made), random_(seed, bytes) {
  scene.seed = seed;
  scene.options.max_collisions = 20000;
}

double Maker::spread(double low, double high) {
  // Without exp and log, whose bits differ between processors: a power of two, and a number between 1 and 2.
  const int from = std::ilogb(low), to = std::ilogb(high);
  return std::clamp(std::ldexp(uniform(1, 2), whole(from, to)), low, high);
}

Vec3 Maker::direction() {
  for (;;) {
    const Vec3 v = somewhere(1);
    const double square = v.squaredNorm();
    if (square > 0.01 && square <= 1) return v / sqrt(square);
  }
}

Vec3 Maker::within(const Vec3& low, const Vec3& high) {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = uniform(low[k], high[k]);
  return v;
}

void Maker::plane(const Vec3& point, const Vec3& normal) {
  scene.world.planes.push_back({point, settled(normal, unit), nullopt});
}

void Maker::wall(const Vec3& center, const Vec3& normal, const Vec3& up, double width, double height) {
  const Vec3 n = settled(normal, unit);
  const Vec3 u = settled(up, [&](const Vec3& v) {
    const Vec3 along = unit(v);
    return unit(along - n * along.dot(n));
  });
  scene.world.walls.push_back({center, n, unit(u.cross(n)), u, width / 2, height / 2, nullopt});
}

void Maker::room(double half) {
  for (int k = 0; k < 3; ++k) {
    plane(Vec3::Constant(-half), Vec3::Unit(k));
    plane(Vec3::Constant(half), -Vec3::Unit(k));
  }
}

void Maker::obstacle(const Vec3& center, const Volume& volume) {
  scene.world.obstacles.push_back({center, volume, nullopt});
}

Entity Maker::body(const Vec3& x, const Vec3& v, const Volume& volume, double mass, double e) {
  World& world = scene.world;
  world.mass.push_back(mass);
  world.radius.push_back(volume.reach());
  world.volume.push_back(volume);
  world.restitution.push_back(e);
  scene.initial.position.push_back(x);
  scene.initial.velocity.push_back(v);
  return world.body_count() - 1;
}

bool Maker::is_free(const Vec3& x, const Volume& volume) {
  const Entity me = body(x, Vec3::Zero(), volume, 1, 1);
  World& world = scene.world;
  const Long3 at = x.cast<long double>();
  const double margin = 1e-6 * volume.reach();

  bool free = true;
  for (Entity e = 0; free && e < me + 1 + world.fixed_count(); ++e) {
    if (e == me) continue;
    const Vec3 other = e < me ? scene.initial.position[e] : world.fixed_position(e);
    free = gap(world, me, at, e, other.cast<long double>()) > margin;
  }

  world.mass.pop_back();
  world.radius.pop_back();
  world.volume.pop_back();
  world.restitution.pop_back();
  scene.initial.position.pop_back();
  scene.initial.velocity.pop_back();
  return free;
}

bool Maker::fit(double half, const Volume& volume, const Vec3& v, double mass, double e) {
  const Vec3 reach = Vec3::Constant(half) - volume.half;
  if (reach.minCoeff() <= 0) return false;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const Vec3 x = within(-reach, reach);
    if (!is_free(x, volume)) continue;
    body(x, v, volume, mass, e);
    return true;
  }
  return false;
}

Volume Maker::volume(double size) {
  if (chance(0.5)) return Volume::cylinder(size * uniform(0.5, 1), 2 * size * uniform(0.3, 1));
  return Volume::box(2 * size * within(Vec3::Constant(0.3), Vec3::Ones()));
}

Volume Maker::any_volume(double size, double spheres) {
  return chance(spheres) ? Volume::sphere(size) : volume(size);
}

void Maker::gravity(double none) {
  scene.world.gravity = Vec3::Zero();
  if (chance(none)) return;
  const double g = any({9.80665, 1, 0.01, 100});
  scene.world.gravity = chance(0.7) ? Vec3(0, -g, 0) : Vec3(g * direction());
}

double Maker::restitution() {
  return any({0, 0.3, 0.5, 0.9, 1, 1});
}

void Maker::rules() {
  World& world = scene.world;
  if (chance(0.5)) world.combine = static_cast<Combine>(whole(0, 6));

  const auto own = [&](auto& things) {
    for (auto& thing : things)
      if (chance(0.2)) thing.restitution = restitution();
  };
  own(world.planes);
  own(world.walls);
  own(world.obstacles);

  const int all = static_cast<int>(world.body_count() + world.fixed_count());
  if (all < 2 || world.body_count() == 0 || !chance(0.3)) return;
  for (int k = whole(1, 3); k > 0; --k) {
    const auto a = static_cast<Entity>(whole(0, static_cast<int>(world.body_count()) - 1));
    const auto b = static_cast<Entity>(whole(0, all - 1));
    const bool known = any_of(world.pairs, [&](const PairRestitution& p) {
      return (p.a_first == a && p.b_first == b) || (p.a_first == b && p.b_first == a);
    });
    if (a != b && !known) world.pairs.push_back({a, 1, b, 1, restitution()});
  }
}

void Maker::motions(World& world, const State& initial, double duration, double speed) {
  for (Entity e = world.body_count(); e < world.body_count() + world.fixed_count(); ++e) {
    if (!chance(0.5)) continue;
    vector<MotionWindow> windows;
    double from = chance(0.4) ? 0 : duration * uniform(0, 0.7);
    for (int k = whole(1, 3); k > 0; --k) {
      const bool last = k == 1 && chance(0.3);
      const double until = last ? infinity : from + duration * uniform(0.01, 0.3);
      const Vec3 along = chance(0.5) ? Vec3(any({-1, 1}) * Vec3::Unit(whole(0, 2))) : direction();
      windows.push_back({from, until, speed * uniform(0, 1) * along});
      from = chance(0.3) ? until : until + duration * uniform(0.01, 0.3);
    }

    world.motions.resize(world.fixed_count());
    SurfaceMotion& motion = world.motions[e - world.body_count()];
    if (chance(0.6) || world.body_count() == 0) {
      motion = motion_in_windows(windows);
      continue;
    }

    // Events set some of their ends.
    const auto wait = [&](size_t w, bool ends, uint32_t trigger) {
      (ends ? windows[w].until : windows[w].from) = not_yet;
      const double after = chance(0.5) ? 0 : duration * uniform(0, 0.3);
      world.triggers.ends.push_back(
          {TriggeredEnd::Of::motion, e - world.body_count(), uint32_t(w), ends, trigger, after});
    };
    for (size_t w = 0; w < windows.size(); ++w) {
      if (chance(0.6)) wait(w, false, event(world, initial));
      if (chance(0.3)) wait(w, true, event(world, initial));
    }
    motion = motion_by_events(windows);
  }
}

uint32_t Maker::event(World& world, const State& initial) {
  const auto body = static_cast<Entity>(whole(0, static_cast<int>(world.body_count()) - 1));
  Trigger trigger{.a = {body, 1}, .b = {0, no_entity}};
  if (chance(0.3)) {
    const Vec3 near = initial.position[body] + world.radius[body] * uniform(0, 4) * direction();
    world.regions.push_back({.position = near, .normal = direction(), .on = {body}});
    trigger = {.regions = EntityRange{uint32_t(world.regions.size() - 1), 1}};
  }
  world.triggers.all.push_back(trigger);
  return uint32_t(world.triggers.all.size() - 1);
}

void Maker::forces(double duration, double acceleration) {
  World& world = scene.world;
  for (int k = whole(1, 4); k > 0; --k) {
    const bool per_mass = chance(0.5);
    const Vec3 value = acceleration * uniform(0, 1) * direction();
    const double mass = world.mass.empty() ? 1 : world.mass[0];
    const double from = chance(0.5) ? 0 : duration * uniform(0, 1);
    const double until = chance(0.6) ? from + duration * uniform(0.01, 0.7) : infinity;

    if (per_mass)
      world.forces.push_back({UniformAcceleration{value}, from, until});
    else
      world.forces.push_back({UniformForce{mass * value}, from, until});

    for (Entity i = 0; i < world.body_count(); ++i)
      if (chance(0.4)) world.forces.back().on.push_back(i);
  }

  if (!chance(0.5)) return;
  for (Entity i = 0; i < world.body_count(); ++i)
    world.impulse.push_back(chance(0.5) ? Vec3(world.mass[i] * somewhere(1)) : Vec3(Vec3::Zero()));
}

}  // namespace carom::stress
