#include "overlay/sight.h"

#include "render/lighting.h"
#include "std.h"

namespace carom {
namespace {

/// The part of the way from `from` by `way` at which it first enters a volume about the origin. Infinity: it misses it,
/// or starts inside.
double entry(const Volume& volume, const Vec3& from, const Vec3& way) {
  double first = 0, last = infinity;
  const auto meet = [&](double low, double high) {
    first = max(first, low);
    last = min(last, high);
  };
  const auto slab = [&](int axis) {
    const double a = (-volume.half[axis] - from[axis]) / way[axis], b = (volume.half[axis] - from[axis]) / way[axis];
    if (way[axis] != 0)
      meet(min(a, b), max(a, b));
    else if (std::abs(from[axis]) > volume.half[axis])
      last = -1;
  };

  // |across(from + s way)| = radius, with the axes that are across.
  const auto round = [&](const Vec3& across) {
    const Vec3 x = from.cwiseProduct(across), v = way.cwiseProduct(across);
    const double radius = volume.half.x(), a = v.squaredNorm(), b = x.dot(v), c = x.squaredNorm() - radius * radius;
    const double root2 = b * b - a * c;
    if (a == 0 || root2 < 0) {
      if (c > 0) last = -1;
      return;
    }
    meet((-b - sqrt(root2)) / a, (-b + sqrt(root2)) / a);
  };

  switch (volume.shape) {
    case Shape::sphere:
      round(Vec3(1, 1, 1));
      break;
    case Shape::cylinder:
      round(Vec3(1, 0, 1));
      slab(1);
      break;
    case Shape::box:
      for (int axis = 0; axis < 3; ++axis) slab(axis);
      break;
  }
  return first > 0 && first <= last ? first : infinity;
}

bool crosses(const Wall& wall, const Vec3& center, const Vec3& from, const Vec3& way) {
  const double across = wall.normal.dot(way);
  if (across == 0) return false;
  const double part = wall.normal.dot(center - from) / across;
  if (!(part > 0 && part < 1)) return false;
  const Vec3 at = from + part * way - center;
  return std::abs(at.dot(wall.right)) <= wall.half_width && std::abs(at.dot(wall.up)) <= wall.half_height;
}

}  // namespace

optional<BodyBounds> bounds_of(const Moment& moment, Entity body) {
  const Vec3& x = moment.state.position[body];
  const Volume volume = volume_now(moment.world, moment.state, body);
  const Eye& eye = moment.eye;
  const Vec3 middle = eye.point(x);
  if (!(middle.z() > eye.camera.near && middle.z() < eye.camera.far)) return nullopt;

  BodyBounds bounds{infinity, infinity, -infinity, -infinity};
  const auto include = [&](const Vec3& p) {
    const double z = max(p.z(), eye.camera.near);
    const double right = eye.size.width / 2.0 + p.x() / (z * eye.pixel);
    const double down = eye.size.height / 2.0 - p.y() / (z * eye.pixel);
    bounds = {min(bounds.left, right), min(bounds.top, down), max(bounds.right, right), max(bounds.bottom, down)};
  };

  if (volume.shape == Shape::sphere) {
    const double r = volume.half.x();
    for (const Vec3& side : {Vec3(r, r, 0), Vec3(-r, -r, 0)}) include(middle + side);
  } else {
    for (int i = 0; i < 8; ++i) {
      const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
      include(eye.point(x + sign.cwiseProduct(volume.half)));
    }
  }
  return bounds;
}

bool is_hidden(const Moment& moment, Entity body) {
  const World& world = moment.world;
  const Vec3& from = moment.eye.camera.eye;
  const Vec3 way = moment.state.position[body] - from;
  for (Entity other = 0; other < world.body_count(); ++other) {
    if (other == body || moment.is_part(other)) continue;
    const Volume volume = volume_now(world, moment.state, other);
    if (entry(volume, from - moment.state.position[other], way) < 1) return true;
  }

  const vector<FixedLook>& looks = moment.scene.roster.fixed;
  const auto seen = [&](size_t number) {
    return number >= looks.size() || (looks[number].visible && is_opaque(looks[number].surface));
  };
  const DoubleDouble now{moment.state.time, 0};
  for (size_t i = 0; i < world.walls.size(); ++i) {
    const size_t number = world.planes.size() + i;
    const Vec3 center = fixed_position(world, world.body_count() + Entity(number), now);
    // A part of a hollow obstacle is drawn from its inside alone.
    const bool turned = number < looks.size() && looks[number].inward.dot(from - center) < 0;
    if (seen(number) && !turned && crosses(world.walls[i], center, from, way)) return true;
  }

  for (size_t i = 0; i < world.obstacles.size(); ++i) {
    const size_t number = world.planes.size() + world.walls.size() + i;
    if (!seen(number) || world.obstacles[i].hollow != Hollow::none) continue;
    const Vec3 center = fixed_position(world, world.body_count() + Entity(number), now);
    if (entry(world.obstacles[i].volume, from - center, way) < 1) return true;
  }
  return false;
}

}  // namespace carom
