#pragma once
// A second implementation of volumes, for tests of the table of pairs: the nearest point of each, its support function,
// and whether two overlap, by alternating projections. Only the types come from physics/.
#include <random>

#include "geometry/contact_time.h"
#include "geometry/touch.h"
#include "std.h"

namespace carom::by_hand {

/// A sphere, cylinder, box, or a wall (a box without thickness, turned).
struct Thing {
  Shape shape;
  Vec3 half;
  Vec3 axis[3] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  // of a wall: right, up, normal

  Vec3 nearest(const Vec3& p) const {
    if (shape == Shape::sphere) return p.norm() > half.x() ? Vec3(p * (half.x() / p.norm())) : p;
    if (shape == Shape::cylinder) {
      const double rho = hypot(p.x(), p.z()), f = rho > half.x() ? half.x() / rho : 1;
      return {p.x() * f, std::clamp(p.y(), -half.y(), half.y()), p.z() * f};
    }
    Vec3 q = Vec3::Zero();
    for (int k = 0; k < 3; ++k) q += std::clamp(p.dot(axis[k]), -half[k], half[k]) * axis[k];
    return q;
  }
  double support(const Vec3& n) const {
    if (shape == Shape::sphere) return half.x() * n.norm();
    if (shape == Shape::cylinder) return half.x() * hypot(n.x(), n.z()) + half.y() * std::abs(n.y());
    double h = 0;
    for (int k = 0; k < 3; ++k) h += half[k] * std::abs(n.dot(axis[k]));
    return h;
  }
};

/// Distance of a at the origin and b at d, not below the true one; close to it unless they nearly touch.
inline double distance(const Thing& a, const Thing& b, const Vec3& d, double enough = 0, int steps = 400) {
  Vec3 p = a.nearest(d), q = d + b.nearest(p - d);
  double last = (p - q).norm();
  for (int k = 0; k < steps && last > enough; ++k) {
    p = a.nearest(q);
    q = d + b.nearest(p - d);
    const double next = (p - q).norm();
    if (next >= last) break;
    last = next;
  }
  return last;
}

inline Thing shrunk(Thing thing, double by) {
  thing.half *= 1 - by;
  return thing;
}

inline Thing of(const World& world, Entity e) {
  if (world.is_wall(e)) {
    const Wall& w = world.wall(e);
    return {Shape::box, Vec3(w.half_width, w.half_height, 0), {w.right, w.up, w.normal}};
  }
  const Volume v = world.volume_of(e);
  return {v.shape, v.half};
}

class Sampler {
 public:
  explicit Sampler(unsigned seed) : engine_(seed) {}
  double uniform(double a, double b) { return a + (b - a) * 0x1p-53 * static_cast<double>(engine_() >> 11); }
  double log_uniform(double a, double b) { return a * pow(b / a, uniform(0, 1)); }
  Vec3 vector(double size) {
    for (;;) {
      const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
      if (x * x + y * y + z * z <= 1) return size * Vec3(x, y, z);
    }
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1) return v.normalized();
    }
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }

 private:
  std::mt19937_64 engine_;
};

enum class Kind { sphere, cylinder, box, tilted_wall, wall_about_y, level_wall, upright_wall };
inline constexpr Kind all_kinds[] = {Kind::sphere,       Kind::cylinder,   Kind::box,         Kind::tilted_wall,
                                     Kind::wall_about_y, Kind::level_wall, Kind::upright_wall};
inline const char* name(Kind kind) {
  const char* names[] = {"sphere", "cylinder", "box", "tilted wall", "wall about y", "level wall", "upright wall"};
  return names[static_cast<int>(kind)];
}

inline Wall make_wall(const Vec3& normal, const Vec3& up, double half_width, double half_height) {
  Wall w{};
  w.center = Vec3::Zero();
  w.normal = normal.normalized();
  w.right = up.cross(w.normal).normalized();
  w.up = w.normal.cross(w.right);
  w.half_width = half_width;
  w.half_height = half_height;
  return w;
}

/// A world of two: body 0 of kind a, and b, a body where `movable`, else an obstacle or a wall (entity 1).
inline World pair_world(Kind a, Kind b, bool movable, Sampler& random, double least = 1e-2) {
  World world;
  world.gravity = Vec3::Zero();

  const auto size = [&] { return random.log_uniform(least, 1); };
  const auto volume = [&](Kind kind) {
    if (kind == Kind::sphere) return Volume::sphere(size());
    if (kind == Kind::cylinder) {
      const double r = size();
      return Volume::cylinder(r, 2 * size());
    }

    const double x = size(), y = size(), z = size();
    return Volume::box(2 * Vec3(x, y, z));
  };

  const auto add = [&](Kind kind) {
    world.volume.push_back(volume(kind));
    world.radius.push_back(world.volume.back().reach());
    world.mass.push_back(1);
    world.restitution.push_back(1);
  };

  add(a);
  const double w = size(), h = size();
  switch (b) {
    case Kind::sphere:
    case Kind::cylinder:
    case Kind::box:
      if (movable) {
        add(b);
      } else {
        world.obstacles.push_back({Vec3::Zero(), volume(b), nullopt});
      }
      break;

    case Kind::tilted_wall:
      world.walls.push_back(make_wall(random.direction(), random.direction(), w, h));
      break;
    case Kind::wall_about_y: {
      const double angle = random.uniform(0, 6.3);
      world.walls.push_back(make_wall(Vec3(std::cos(angle), 0, std::sin(angle)), Vec3::UnitY(), w, h));
      break;
    }

    case Kind::level_wall:
      world.walls.push_back(make_wall(Vec3::UnitY(), Vec3::UnitZ(), w, h));
      break;
    case Kind::upright_wall:
      world.walls.push_back(make_wall(-Vec3::UnitX(), Vec3::UnitY(), w, h));
      break;
  }

  return world;
}

inline const Volume ball = Volume::sphere(0.5), can = Volume::cylinder(0.5, 2), brick = Volume::box({1, 2, 3});

inline World two_bodies(const Volume& a, const Volume& b) {
  World world;
  world.mass = {1, 1};
  world.restitution = {1, 1};
  world.radius = {a.reach(), b.reach()};
  world.volume = {a, b};
  return world;
}

/// Body 0 and obstacle 1.
inline World body_and_obstacle(const Volume& a, const Volume& b) {
  World world;
  world.mass = {1};
  world.restitution = {1};
  world.radius = {a.reach()};
  world.volume = {a};
  world.obstacles = {{Vec3::Zero(), b, nullopt}};
  return world;
}

}  // namespace carom::by_hand
