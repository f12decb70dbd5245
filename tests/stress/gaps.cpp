#include "stress/gaps.h"

#include "geometry/touch.h"
#include "physics/world.h"
#include "std.h"

namespace carom::stress {

namespace {

using Real = long double;

Real clamped(Real x, Real half) {
  return std::clamp(x, -half, half);
}

/// Of gaps along directions at right angles: the distance, or the least way out.
Real joined(Real p, Real q) {
  return p > 0 && q > 0 ? hypot(p, q) : std::max(p, q);
}

Real level(const Long3& d) {
  return hypot(d.x(), d.z());
}

Real sphere_and_box(const Long3& d, Real radius, const Vec3& half) {
  Long3 out;
  for (int k = 0; k < 3; ++k) out[k] = d[k] - clamped(d[k], half[k]);
  if (out.squaredNorm() > 0) return out.norm() - radius;
  Real inside = -half[0];
  for (int k = 0; k < 3; ++k) inside = std::max(inside, std::abs(d[k]) - half[k]);
  return inside - radius;
}

Real sphere_and_cylinder(const Long3& d, Real radius, const Vec3& half) {
  return joined(level(d) - half.x(), std::abs(d.y()) - half.y()) - radius;
}

Real box_and_cylinder(const Long3& d, const Vec3& box, const Vec3& cylinder) {
  const Real x = d.x() - clamped(d.x(), box.x()), z = d.z() - clamped(d.z(), box.z());
  const Real out = x == 0 && z == 0 ? std::max(std::abs(d.x()) - box.x(), std::abs(d.z()) - box.z()) : hypot(x, z);
  return joined(out - cylinder.x(), std::abs(d.y()) - box.y() - cylinder.y());
}

Real volumes(const Long3& d, const Volume& a, const Volume& b) {
  if (a.shape > b.shape) return volumes(-d, b, a);
  if (a.shape == Shape::sphere && b.shape == Shape::sphere)
    return d.norm() - (static_cast<Real>(a.half.x()) + b.half.x());
  if (a.shape == Shape::sphere && b.shape == Shape::box) return sphere_and_box(d, a.half.x(), b.half);
  if (a.shape == Shape::sphere) return sphere_and_cylinder(d, a.half.x(), b.half);

  if (a.shape == Shape::cylinder && b.shape == Shape::cylinder)
    return joined(level(d) - (static_cast<Real>(a.half.x()) + b.half.x()),
                  std::abs(d.y()) - (static_cast<Real>(a.half.y()) + b.half.y()));
  if (a.shape == Shape::cylinder) return box_and_cylinder(d, b.half, a.half);

  Real gap[3];
  for (int k = 0; k < 3; ++k) gap[k] = std::abs(d[k]) - (static_cast<Real>(a.half[k]) + b.half[k]);
  return joined(joined(gap[0], gap[1]), gap[2]);
}

/// The distance of a point from a shell, along which the axis of its half or of its side is y.
Real from_shell(const Long3& d, const Obstacle& shell) {
  const Real r = shell.volume.half.x(), y = d.y();
  if (shell.hollow == Hollow::side) return hypot(level(d) - r, y - clamped(y, shell.volume.half.y()));
  const bool beyond_rim =
      (shell.hollow == Hollow::lower_half && y > 0) || (shell.hollow == Hollow::upper_half && y < 0);
  return beyond_rim ? hypot(level(d) - r, y) : std::abs(d.norm() - r);
}

Real at_plane(const Long3& x, const Volume& v, const Plane& p, const Long3& point) {
  const Long3 n = p.normal.cast<Real>();
  Real reach = v.half.x();
  if (v.shape == Shape::cylinder) reach = v.half.x() * level(n) + v.half.y() * std::abs(n.y());
  if (v.shape == Shape::box) reach = v.half.cast<Real>().dot(n.cwiseAbs());
  return (x - point).dot(n) - reach;
}

Real sphere_at_wall(const Long3& x, Real radius, const Wall& w, const Long3& center) {
  const Long3 d = x - center;
  const Real r = d.dot(w.right.cast<Real>()), u = d.dot(w.up.cast<Real>()), n = d.dot(w.normal.cast<Real>());
  return hypot(r - clamped(r, w.half_width), u - clamped(u, w.half_height), n) - radius;
}

}  // namespace

long double gap(const World& world, Entity a, const Long3& xa, Entity b, const Long3& xb) {
  const Volume v = world.volume_of(a);
  if (world.is_body(b)) return volumes(xb - xa, v, world.volume_of(b));
  if (world.is_plane(b)) return at_plane(xa, v, world.plane(b), xb);
  if (world.is_shell(b)) return from_shell(xa - xb, world.obstacle(b)) - v.half.x();
  if (world.is_obstacle(b)) return volumes(xb - xa, v, world.obstacle(b).volume);
  if (v.shape == Shape::sphere) return sphere_at_wall(xa, v.half.x(), world.wall(b), xb);
  return touch(world, a, xa.cast<double>(), b, xb.cast<double>()).gap;
}

}  // namespace carom::stress
