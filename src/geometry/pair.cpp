// The table of pairs: for each pair of shapes, which Minkowski sum it makes and in which frame.
// A wall along the axes is a box without thickness, so that the same prism serves it. Other walls have sums of their
// own.
#include "geometry/pair.h"

#include "std.h"

namespace carom {

namespace {

/// Whether v lies along one of the axes.
bool on_axis(const Vec3& v) {
  return (v.x() != 0) + (v.y() != 0) + (v.z() != 0) == 1;
}

bool upright(const Vec3& v) {
  return v.x() == 0 && v.z() == 0;
}

bool in_line(Shape shape, const Wall& wall) {
  if (shape == Shape::box) return on_axis(wall.right) && on_axis(wall.up) && on_axis(wall.normal);
  return upright(wall.normal) || upright(wall.up) || upright(wall.right);
}

/// A wall in line with a volume, as a box without thickness.
Volume thin_box(Shape shape, const Wall& wall, Frame& frame) {
  const double w = wall.half_width, h = wall.half_height;
  if (shape == Shape::box || in_line(Shape::box, wall))
    return {Shape::box, w * wall.right.cwiseAbs() + h * wall.up.cwiseAbs()};
  frame.turned = true;
  frame.x = upright(wall.right) ? wall.up : wall.right;
  frame.z = upright(wall.normal) ? wall.up : wall.normal;
  if (upright(wall.normal)) return {Shape::box, Vec3(w, 0, h)};
  return {Shape::box, upright(wall.up) ? Vec3(w, h, 0) : Vec3(h, w, 0)};
}

}  // namespace

PairKind pair_kind(const World& world, Entity a, Entity b) {
  if (world.is_plane(b)) return PairKind::half_space;
  const Shape shape = world.volume_of(a).shape;
  if (world.is_wall(b)) {
    if (shape == Shape::sphere) return PairKind::sphere_wall;
    if (in_line(shape, world.wall(b))) return PairKind::prism;
    return shape == Shape::box ? PairKind::box_wall : PairKind::cylinder_wall;
  }
  if (!world.is_body(b)) {
    if (world.is_string(b)) return PairKind::string;
    if (world.obstacle(b).hollow != Hollow::none) return PairKind::shell;
  }
  return shape == Shape::sphere && world.volume_of(b).shape == Shape::sphere ? PairKind::spheres : PairKind::prism;
}

PairPrism pair_prism(const World& world, Entity a, Entity b) {
  PairPrism pair{{Vec3::Zero(), 0, 0}, {}, world.volume_of(a), {}};
  if (!world.is_wall(b)) {
    pair.b = world.volume_of(b);
  } else if (const Wall& wall = world.wall(b); pair.a.shape != Shape::sphere) {
    pair.b = thin_box(pair.a.shape, wall, pair.frame);
  } else {
    pair.b = {Shape::box, Vec3(wall.half_width, wall.half_height, 0)};
    pair.frame = {wall.right, wall.up, wall.normal, true};
  }

  // The sum of the parts.
  for (const Volume& v : {pair.a, pair.b}) {
    if (v.shape == Shape::sphere) pair.sum.ball += v.half.x();
    if (v.shape == Shape::cylinder) pair.sum.disc += v.half.x();
    if (v.shape == Shape::cylinder) pair.sum.half.y() += v.half.y();
    if (v.shape == Shape::box) pair.sum.half += v.half;
  }
  return pair;
}

// The sphere lies in the direction -p from the wall's centre. Where a wall's edge has one cylinder, the prism has two
// edges across the wall.
uint8_t prism_feature(uint8_t feature, const Vec3& p) {
  const int across = p.z() < 0 ? -1 : 1;
  if (feature == wall_front) return PrismFeature{0, 0, -1}.code();
  if (feature == wall_back) return PrismFeature{0, 0, 1}.code();
  if (feature < wall_corners) {
    const int edge = feature - wall_edges, sign = edge % 2 == 0 ? -1 : 1;
    return edge / 2 == 0 ? PrismFeature{sign, 0, across}.code() : PrismFeature{0, sign, across}.code();
  }
  const int corner = feature - wall_corners;
  return PrismFeature{corner % 2 == 0 ? -1 : 1, corner / 2 == 0 ? -1 : 1, across}.code();
}

uint8_t wall_feature(uint8_t code) {
  const PrismFeature f = PrismFeature::of(code);
  // 0: on the side to which right or up points.
  const int right = f.x > 0, up = f.y > 0;
  if (f.x != 0 && f.y != 0) return uint8_t(wall_corners + right + 2 * up);
  if (f.x != 0) return uint8_t(wall_edges + right);
  if (f.y != 0) return uint8_t(wall_edges + 2 + up);
  return f.z < 0 ? wall_front : wall_back;
}

}  // namespace carom
