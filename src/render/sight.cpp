// A body is hidden if most of five points of it are: its middle, and four on two thirds of the way to its outline. A
// line of sight meets a convex thing in an interval of it.
#include "render/sight.h"

#include "render/lighting.h"
#include "render/surfaces.h"
#include "std.h"

namespace carom {
namespace {

/// A part of a line of sight, which goes from 0 at the eye to 1.
struct LinePart {
  double from = 0, until = 1;
  /// Keeps the part where low <= at + t * way <= high.
  void cut(double at, double way, double low, double high) {
    if (way == 0) {
      if (at < low || at > high) until = -1;
      return;
    }
    const double a = (low - at) / way, b = (high - at) / way;
    from = max(from, min(a, b));
    until = min(until, max(a, b));
  }
  /// Keeps the part where |at + t * way| <= radius.
  void cut(const Vec3& at, const Vec3& way, double radius) {
    const double a = way.squaredNorm(), b = at.dot(way), c = at.squaredNorm() - radius * radius;
    const double root2 = b * b - a * c;
    if (!(root2 > 0) || a == 0) {
      if (!(a == 0 && c <= 0)) until = -1;
      return;
    }
    from = max(from, (-b - sqrt(root2)) / a);
    until = min(until, (-b + sqrt(root2)) / a);
  }
};

Vec3 place_of(const World& world, Entity fixed, double time) {
  return world.moves(fixed) ? fixed_position(world, fixed, {time, 0}) : world.fixed_position(fixed);
}

}  // namespace

bool is_between(const Volume& volume, const Vec3& center, const Vec3& eye, const Vec3& point) {
  const Vec3 at = eye - center, way = point - eye;
  LinePart part;
  const Vec3& half = volume.half;

  if (volume.shape == Shape::sphere) {
    part.cut(at, way, half.x());
  } else {
    part.cut(at.y(), way.y(), -half.y(), half.y());
    if (volume.shape == Shape::box) {
      for (const int axis : {0, 2}) part.cut(at[axis], way[axis], -half[axis], half[axis]);
    } else {
      part.cut(Vec3(at.x(), 0, at.z()), Vec3(way.x(), 0, way.z()), half.x());
    }
  }

  return part.from > 0 && part.until - part.from > 1e-9;
}

Sight::Sight(const Scene& scene) : scene_(scene) {
  const World& world = scene.world;
  for (size_t i = world.planes.size(); i < world.fixed_count(); ++i) {
    const Entity e = Entity(world.body_count() + i);
    const FixedLook& look = look_of_fixed(scene, i);
    if (look.visible && is_opaque(look.surface) && !world.is_shell(e)) opaque_.push_back(e);
  }
}

bool Sight::hides(const World& world, Entity e, const Vec3& at, const Vec3& eye, const Vec3& point) const {
  // A flat part of a hollow obstacle is drawn from within alone.
  const Vec3& inward = look_of_fixed(scene_, e - world.body_count()).inward;
  if (!inward.isZero(0) && !(inward.dot(eye - at) > 0)) return false;
  if (!world.is_wall(e)) return is_between(world.obstacle(e).volume, at, eye, point);

  const Wall& wall = world.wall(e);
  const double of_eye = wall.normal.dot(eye - at), of_point = wall.normal.dot(point - at);
  if (!(of_eye * of_point < 0)) return false;
  const Vec3 there = eye + of_eye / (of_eye - of_point) * (point - eye) - at;
  return std::abs(wall.right.dot(there)) < wall.half_width && std::abs(wall.up.dot(there)) < wall.half_height;
}

bool Sight::is_hidden(const World& world, double time, const Vec3& eye, const Vec3& point) const {
  return ranges::any_of(opaque_, [&](Entity e) { return hides(world, e, place_of(world, e, time), eye, point); });
}

vector<Entity> Sight::hiders(const World& world, double time, const Vec3& eye, const CameraFrame& view,
                             const Vec3& center, double radius) const {
  const double side = 2.0 / 3 * radius;
  const array<Vec3, 5> points{center, center + side * view.right, center - side * view.right, center + side * view.up,
                              center - side * view.up};
  const auto most = [&](ptrdiff_t count) { return 2 * size_t(count) > points.size(); };
  array<bool, 5> hidden{};
  vector<Entity> alone, together;

  for (const Entity e : opaque_) {
    const Vec3 at = place_of(world, e, time);
    ptrdiff_t count = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      if (!hides(world, e, at, eye, points[i])) continue;
      hidden[i] = true;
      ++count;
    }
    if (count > 0) together.push_back(e);
    if (most(count)) alone.push_back(e);
  }

  if (!alone.empty()) return alone;
  return most(ranges::count(hidden, true)) ? together : alone;
}

}  // namespace carom
