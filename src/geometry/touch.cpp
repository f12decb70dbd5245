// The gap, normal and point of contact of any pair, by its kind.
// Small gaps are computed in compensated arithmetic from the positions themselves. Their rounded difference would lose
// the last digits.
#include "geometry/touch.h"

#include "geometry/pair.h"
#include "geometry/shell.h"
#include "numerics/compensated.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// The rounding of a gap between things at xa and xb (m).
double rounding_of_gap(const Vec3& xa, const Vec3& xb, double size) {
  return 0x1p-48 * (xa.cwiseAbs().sum() + xb.cwiseAbs().sum() + size);
}

/// The rounding error of x_b - x_a.
Vec3 lost_in_difference(const Vec3& xa, const Vec3& xb) {
  Vec3 lost;
  for (int k = 0; k < 3; ++k) lost[k] = two_sum(xb[k], -xa[k]).lo;
  return lost;
}

Touch touch_spheres(const Vec3& xa, double ra, const Vec3& xb, double rb) {
  const Vec3 d = xb - xa;
  const double distance = d.norm(), s = ra + rb;
  const Vec3 n = distance > 0 ? Vec3(d / distance) : Vec3::UnitX();
  const double gap = squared_gap(d, s) / (distance + s) + n.dot(lost_in_difference(xa, xb));
  return {gap, n, xa + ra * n, 0};
}

Touch touch_string(const Vec3& xa, const Vec3& xb, double length) {
  const Touch points = touch_spheres(xa, 0, xb, length);
  return {-points.gap, -points.normal, xa, 0};
}

Touch touch_shell(const Obstacle& obstacle, const Vec3& xa, double r, const Vec3& xb, uint8_t feature) {
  const Shell shell(obstacle);
  const Vec3 p = xa - xb;
  const Separation s = shell.at(p, r, feature == no_feature ? shell.nearest(p) : feature);
  return {s.gap + s.normal.dot(lost_in_difference(xa, xb)), s.normal, xa + r * s.normal, s.feature};
}

Touch touch_plane(const Plane& plane, const Vec3& point, const Volume& volume, const Vec3& x) {
  const Vec3 n = -plane.normal;
  const double gap = plane_gap(x, point, plane.normal, volume.support(plane.normal));
  return {gap, n, x + foremost(volume, n), 0};
}

Touch touch_wall(const World& world, Entity a, Entity b, const Wall& wall, const Vec3& xa, const Vec3& xb,
                 uint8_t feature) {
  if (feature == no_feature) {
    const PairPrism pair = pair_prism(world, a, b);
    feature = wall_feature(pair.sum.nearest(pair.frame.to(xb - xa)).feature);
  }

  const double r = world.volume_of(a).half.x();
  if (feature < wall_edges) {
    const Vec3 to_body = feature == wall_front ? wall.normal : Vec3(-wall.normal);
    return {plane_gap(xa, xb, to_body, r), -to_body, xa - r * to_body, feature};
  }

  const Vec3 d = nearest_on_wall(wall, xb, xa) - xa;
  const double distance = d.norm();
  const Vec3 n = distance > 0 ? Vec3(d / distance) : wall.normal;
  return {squared_gap(d, r) / (distance + r), n, xa + r * n, feature};
}

/// The middle of what an interval about 0 shares with one about d, of these half lengths.
double middle_of_overlap(double half, double d, double other) {
  return 0.5 * (max(-half, d - other) + min(half, d + other));
}

/// The middle of the area that a disc shares with a rectangle or another disc with its centre at d, from the disc's
/// centre. The disc lies about the origin in the xz-plane.
Vec3 middle_of_areas(double disc, const Volume& other, const Vec3& d) {
  if (other.shape == Shape::cylinder) {
    const Vec3 level(d.x(), 0, d.z());
    const double distance = level.norm();
    if (distance == 0) return Vec3::Zero();
    return middle_of_overlap(disc, distance, other.half.x()) / distance * level;
  }

  Vec3 middle = Vec3::Zero(), nearest = Vec3::Zero();
  for (int k : {0, 2}) {
    middle[k] = middle_of_overlap(disc, d[k], other.half[k]);
    nearest[k] = clamp(0.0, d[k] - other.half[k], d[k] + other.half[k]);
  }
  if (middle.norm() <= disc) return middle;

  // Only a corner of the rectangle is over the disc. The middle is half way from there to the disc's rim.
  const Vec3 across = middle - nearest;
  const double half = nearest.dot(across), length = across.squaredNorm();
  const double inside = max(disc * disc - nearest.squaredNorm(), 0.0);
  const double on_rim = inside > 0 ? inside / (half + sqrt(half * half + length * inside)) : 0;
  return nearest + 0.5 * on_rim * across;
}

/// The point of contact of a and b from a's centre, in the pair's frame. p and s are in that frame too.
Vec3 contact_in_prism(const PairPrism& pair, const Vec3& p, const Separation& s) {
  const Volume &a = pair.a, &b = pair.b;
  if (a.shape == Shape::sphere) return a.half.x() * s.normal;
  if (b.shape == Shape::sphere) return p - (b.half.x() + s.gap) * s.normal;

  Vec3 c;
  for (int k = 0; k < 3; ++k) {
    c[k] = clamp(middle_of_overlap(a.half[k], p[k], b.half[k]), -a.half[k], a.half[k]);
  }
  if (a.shape == Shape::box && b.shape == Shape::box) return c;

  // In the plane of the discs.
  const Vec3 level(s.normal.x(), 0, s.normal.z());
  const double length = level.norm();
  Vec3 m;
  if (length > 0) {
    const Vec3 out = level / length;
    m = a.shape == Shape::cylinder ? Vec3(a.half.x() * out) : Vec3(p - b.half.x() * out - s.gap * s.normal);
  } else if (a.shape == Shape::cylinder) {
    m = middle_of_areas(a.half.x(), b, p);
  } else {
    m = p + middle_of_areas(b.half.x(), a, -p);
  }

  return {m.x(), c.y(), m.z()};
}

Touch touch_prism(const World& world, Entity a, Entity b, const Vec3& xa, const Vec3& xb, uint8_t feature) {
  const PairPrism pair = pair_prism(world, a, b);
  const Vec3 p = pair.frame.to(xb - xa);

  Separation s = feature == no_feature ? pair.sum.nearest(p) : pair.sum.at(p, feature);
  if (pair.sum.sharp(s.feature) && s.gap <= rounding_of_gap(xa, xb, pair.sum.size()))
    s = pair.sum.at(p, pair.sum.foremost_face(p, s.feature));

  const PrismFeature f = PrismFeature::of(s.feature);
  const int k = f.x != 0 ? 0 : f.y != 0 ? 1 : 2, side = f.x + f.y + f.z;
  if (pair.sum.flat(s.feature) && (!pair.frame.turned || k == 1)) {
    s.gap = (two_sum(side * xb[k], -side * xa[k]) - two_sum(pair.a.half[k], pair.b.half[k])).value();
  } else {
    s.gap += s.normal.dot(pair.frame.to(lost_in_difference(xa, xb)));
  }

  return {s.gap, pair.frame.from(s.normal), xa + pair.frame.from(contact_in_prism(pair, p, s)), s.feature};
}

template <typename Sum>
Touch touch_at_an_angle(const Sum& sum, const Volume& volume, const Wall& wall, const Vec3& xa, const Vec3& xb,
                        uint8_t feature) {
  Separation s = feature == no_feature ? sum.nearest(xb - xa) : sum.at(xb - xa, feature);
  s.gap += s.normal.dot(lost_in_difference(xa, xb));
  if (feature == no_feature && s.gap > rounding_of_gap(xa, xb, sum.size())) {
    const ClosestPoints points = closest_points(volume, xa, wall, xb);
    const Vec3 across = points.on_b - points.on_a;
    return {across.norm(), across.normalized(), points.on_a, s.feature};
  }
  // A little apart along the normal the same points are the closest, and they are unambiguous there.
  const Vec3 apart = (0x1p-7 * sum.size() - s.gap) * s.normal;
  return {s.gap, s.normal, closest_points(volume, xa, wall, xb + apart).on_a, s.feature};
}

/// max of n . p over the points p of a fixed thing at `center` (m).
double reach_along(const World& world, Entity fixed, const Vec3& center, const Vec3& n) {
  if (world.is_plane(fixed)) {
    const Plane& plane = world.plane(fixed);
    return (plane.normal - n).norm() <= 0x1p-50 ? n.dot(center) : never;
  }
  if (!world.is_wall(fixed)) return n.dot(center) + world.volume_of(fixed).support(n);
  const Wall& wall = world.wall(fixed);
  return n.dot(center) + wall.half_width * std::abs(n.dot(wall.right)) + wall.half_height * std::abs(n.dot(wall.up));
}

}  // namespace

bool lies_behind(const World& world, Entity a, const Vec3& xa, Entity fixed, const Vec3& xf, const Vec3& n) {
  const Volume volume = world.volume_of(a);
  const double rounding = rounding_of_gap(xa, xf, volume.reach());
  return reach_along(world, fixed, xf, n) <= n.dot(xa) - volume.support(n) + rounding;
}

Touch touch(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, uint8_t feature) {
  const PairKind kind = pair_kind(world, a, b);
  switch (kind) {
    case PairKind::spheres:
      return touch_spheres(xa, world.volume_of(a).half.x(), xb, world.volume_of(b).half.x());
    case PairKind::half_space:
      return touch_plane(world.plane(b), xb, world.volume_of(a), xa);
    case PairKind::sphere_wall:
      return touch_wall(world, a, b, world.wall(b), xa, xb, feature);

    case PairKind::prism:
      return touch_prism(world, a, b, xa, xb, feature);
    case PairKind::box_wall:
    case PairKind::cylinder_wall:
      return with_sum(kind, world, a, b, [&](const auto& sum, const Frame&) {
        return touch_at_an_angle(sum, world.volume_of(a), world.wall(b), xa, xb, feature);
      });

    case PairKind::shell:
      return touch_shell(world.obstacle(b), xa, world.volume_of(a).half.x(), xb, feature);
    case PairKind::string:
      return touch_string(xa, xb, world.string(b).length);
  }
  return {never, Vec3::UnitX(), xa, no_feature};
}

double bending(const World& world, Entity a, const Vec3& xa, Entity b, const Vec3& xb, const Touch& touch,
               const Vec3& w) {
  const Vec3 d = xb - xa;
  const PairKind kind = pair_kind(world, a, b);
  switch (kind) {
    case PairKind::spheres:
      return w.cross(touch.normal).squaredNorm() / d.norm();
    case PairKind::half_space:
      return 0;
    case PairKind::shell:
      return Shell(world.obstacle(b)).bending(xa - xb, touch.feature, w);
    case PairKind::string:
      return -w.cross(touch.normal).squaredNorm() / d.norm();

    default:
      return with_sum(kind, world, a, b, [&](const auto& sum, const Frame& frame) {
        const Vec3 p = frame.to(d);
        const bool of_wall = kind == PairKind::sphere_wall;
        return sum.bending(p, of_wall ? prism_feature(touch.feature, p) : touch.feature, frame.to(w));
      });
  }
}

bool is_flat(const World& world, Entity a, Entity b, uint8_t feature) {
  const PairKind kind = pair_kind(world, a, b);
  switch (kind) {
    case PairKind::spheres:
    case PairKind::shell:
    case PairKind::string:
      return false;

    case PairKind::half_space:
      return true;
    case PairKind::sphere_wall:
      return feature < wall_edges;
    default:
      return with_sum(kind, world, a, b, [&](const auto& sum, const Frame&) { return sum.flat(feature); });
  }
}

}  // namespace carom
