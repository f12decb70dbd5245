// A sphere and a wall, in the wall's own frame: p = (along right, along up, along normal) from its centre.
// In that frame every part of the enlarged wall is a sphere contact in two or three coordinates, or a plane contact in
// one.

#include "geometry/contact_time.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

struct LocalPath {
  Vec3 p, v, a;
  // m/s: scale of the rounding of an approach to the rim. The normal there turns by the rounding of positions over the
  // radius.
  double rounded_speed;
  double at(int k, double t) const { return p[k] + t * (v[k] + 0.5 * t * a[k]); }
};

/// The wall's motion seen from the sphere, converted to the sphere's motion seen from the wall.
LocalPath to_local(const Wall& wall, const RelativeMotion& m, double radius) {
  const auto frame = [&](const Vec3& u) { return Vec3(-u.dot(wall.right), -u.dot(wall.up), -u.dot(wall.normal)); };
  const double size = (wall.center - m.d).cwiseAbs().sum() + wall.center.cwiseAbs().sum() + 2 * m.moved;
  return {frame(m.d), frame(m.w), frame(m.a), m.w.cwiseAbs().sum() * (1 + size / radius)};
}

RelativeMotion of_wall(const Wall& wall, const Vec3& x, const Vec3& v, const Vec3& a) {
  return {wall.center - x, -v, -a, v.cwiseAbs().sum(), false};
}

constexpr double rounding = 16 * 0x1p-53;

/// Whether a path at time t is beyond the rim at `rim` along axis k, or within rounding of it.
/// Short of the rim, a ball that slides on the face all but touches the edge's cylinder. That contact belongs to the
/// face.
bool beyond_rim(const LocalPath& path, int k, double rim, double t) {
  const double p = path.at(k, t);
  const double rounding_of_p = 0x1p-44 * (std::abs(path.p[k]) + std::abs(p) + std::abs(rim));
  return rim > 0 ? p >= rim - rounding_of_p : p <= rim + rounding_of_p;
}

/// The first entry into a cylinder about the line through `axis` in the direction `along`, on its stretch.
/// A curved path can enter the endless cylinder twice, and its first entry may lie beyond the stretch.
double edge_contact_time(const LocalPath& path, int along, double half_length, const Vec3& axis, double radius,
                         bool just_left, double horizon) {
  const auto on_edge = [&](double t) {
    return std::abs(path.at(along, t)) <= half_length && beyond_rim(path, 1 - along, axis[1 - along], t);
  };

  RelativeMotion m{path.p - axis, path.v, path.a, 0, just_left};
  m.d[along] = m.w[along] = m.a[along] = 0;
  m.speeds = path.rounded_speed;
  if (m.a.isZero(0)) {
    const double t = sphere_contact_time(m, radius, horizon);
    return t < never && on_edge(t) ? t : never;
  }

  CurvedContacts contacts(m, radius, horizon);
  double t = contacts.next();
  while (t < never && !on_edge(t)) t = contacts.next();
  return t;
}

/// The entry into the half-space behind a face moved out by the radius, if it falls on the rectangle.
double face_contact_time(const LocalPath& path, double side, const double half[2], double radius, bool just_left,
                         bool on_rim, double horizon) {
  const double gap = side * path.p.z() - radius, speed = side * path.v.z(), acceleration = side * path.a.z();
  const auto over = [&](double t) { return std::abs(path.at(0, t)) <= half[0] && std::abs(path.at(1, t)) <= half[1]; };

  double t = never;
  if (just_left || gap > 0 || (gap > -radius && over(0))) {
    t = plane_contact_time(gap, speed, acceleration, rounding * path.v.norm(), just_left, horizon);
  } else if (acceleration < 0 && speed > 0) {
    // Beside the rectangle or beyond it, the path meets the face only after it has risen over it, at the later root.
    const double disc = speed * speed - 2 * acceleration * gap;
    if (disc > 0) t = (speed + sqrt(disc)) / -acceleration;
  }

  // The path has just left the face over its rim.
  if (on_rim && t == 0) return never;
  return t <= horizon && over(t) ? t : never;
}

}  // namespace

FeatureTime wall_contact_time(const Wall& wall, const Vec3& x, const Vec3& v, const Vec3& a, double radius,
                              uint8_t left, double horizon) {
  return wall_contact_time(wall, of_wall(wall, x, v, a), radius, left, horizon);
}

FeatureTime wall_contact_time(const Wall& wall, const RelativeMotion& motion, double radius, uint8_t left,
                              double horizon) {
  const LocalPath path = to_local(wall, motion, radius);
  const double half[2] = {wall.half_width, wall.half_height};

  FeatureTime first{never, no_feature};
  const auto offer = [&](double t, uint8_t feature) {
    if (!(t < first.time)) return;
    first = {t, feature};
    // A later contact does not matter.
    horizon = min(horizon, t);
  };

  const bool on_rim = left != no_feature && left >= wall_edges;
  for (uint8_t face : {wall_front, wall_back})
    offer(face_contact_time(path, face == wall_front ? 1 : -1, half, radius, left == face, on_rim, horizon), face);

  const double signs[2] = {1, -1};
  for (int k = 0; k < 4; ++k) {
    const auto feature = uint8_t(wall_edges + k);
    Vec3 axis = Vec3::Zero();
    axis[k / 2] = signs[k % 2] * half[k / 2];
    offer(edge_contact_time(path, 1 - k / 2, half[1 - k / 2], axis, radius, left == feature, horizon), feature);
  }

  for (int k = 0; k < 4; ++k) {
    const auto feature = uint8_t(wall_corners + k);
    const Vec3 corner(signs[k % 2] * half[0], signs[k / 2] * half[1], 0);
    const double t =
        sphere_contact_time({path.p - corner, path.v, path.a, path.rounded_speed, left == feature}, radius, horizon);
    if (t < never && beyond_rim(path, 0, corner.x(), t) && beyond_rim(path, 1, corner.y(), t)) offer(t, feature);
  }

  return first;
}

Vec3 nearest_on_wall(const Wall& wall, const Vec3& center, const Vec3& x) {
  const Vec3 d = x - center;
  const double u = clamp(d.dot(wall.right), -wall.half_width, wall.half_width);
  const double w = clamp(d.dot(wall.up), -wall.half_height, wall.half_height);
  return center + u * wall.right + w * wall.up;
}

Vec3 nearest_on_wall(const Wall& wall, const Vec3& x) {
  return nearest_on_wall(wall, wall.center, x);
}

FeatureTime wall_release_time(const Wall& wall, const RelativeMotion& motion, double horizon) {
  const LocalPath path = to_local(wall, motion, 1);
  const double half[2] = {wall.half_width, wall.half_height};
  FeatureTime first{never, no_feature};
  for (int k = 0; k < 4; ++k) {
    const int axis = k / 2;
    const double side = k % 2 == 0 ? 1 : -1;
    // The room before this rim, half - side p, falls to zero like the gap above a plane.
    const double t = plane_contact_time(half[axis] - side * path.p[axis], -side * path.v[axis], -side * path.a[axis], 0,
                                        false, horizon);
    if (t < first.time) first = {t, uint8_t(wall_edges + k)};
  }
  return first;
}

}  // namespace carom
