// Computes outlines. A ball has an ellipse, by which its edge is smooth and its depth free of cancellation. A box, a
// cylinder and a wall have the convex hull of their corners, cut at the near plane. A cylinder's rims are polygons so
// fine that they deviate by less than a twentieth of a pixel.
#include "raster/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "raster/outline.h"

namespace carom::raster {
namespace {

/// In the plane z = 1.
struct PlanePoint {
  double x, y;
};

double side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The convex hull, counterclockwise, by the monotone chain (Andrew 1979).
std::vector<PlanePoint> hull_of(std::vector<PlanePoint> points) {
  if (points.size() < 3) return {};
  std::sort(points.begin(), points.end(),
            [](const PlanePoint& a, const PlanePoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<PlanePoint> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const PlanePoint& p : points) {
      while (hull.size() >= start + 2 && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

Vec3 vec(const Float3& v) {
  return {v[0], v[1], v[2]};
}

/// Collects the projections of a polyhedron's edges, as far as they are before the near plane.
class Projection {
 public:
  explicit Projection(double near) : near_(near) {}
  void add(Vec3 a, Vec3 b) {
    if (a.z() < b.z()) std::swap(a, b);
    if (a.z() <= near_) return;
    points_.push_back({a.x() / a.z(), a.y() / a.z()});
    if (b.z() <= near_) b = a + (a.z() - near_) / (a.z() - b.z()) * (b - a);
    const double z = std::max(b.z(), near_);
    points_.push_back({b.x() / z, b.y() / z});
  }
  std::vector<PlanePoint> hull() { return hull_of(std::move(points_)); }

 private:
  double near_;
  std::vector<PlanePoint> points_;
};

void project_box(const Lens& lens, const Solid& solid, Projection& to) {
  const auto corner = [&](int k) {
    Vec3 p = vec(solid.center);
    for (std::size_t i = 0; i < 3; ++i) p += (k >> i & 1 ? 1 : -1) * double{solid.half[i]} * vec(lens.axes[i]);
    return p;
  };
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 3; ++i)
      if (!(k >> i & 1)) to.add(corner(k), corner(k | 1 << i));
}

void project_wall(const Solid& solid, const WallAxes& axes, Projection& to) {
  const Vec3 c = vec(solid.center);
  const Vec3 u = double{solid.half[0]} * vec(axes.right), v = double{solid.half[1]} * vec(axes.up);
  const Vec3 corners[4] = {c - u - v, c + u - v, c + u + v, c - u + v};
  for (int k = 0; k < 4; ++k) to.add(corners[k], corners[(k + 1) % 4]);
}

void project_cylinder(const Lens& lens, const Solid& solid, Projection& to) {
  const Vec3 c = vec(solid.center), h = double{solid.half[1]} * vec(lens.axes[1]);
  const Vec3 u = double{solid.half[0]} * vec(lens.axes[0]), v = double{solid.half[0]} * vec(lens.axes[2]);
  // A regular polygon of n corners deviates from its circle by r pi^2 / (2 n^2).
  const double z = std::max(c.z() - solid.radius, double{lens.near});
  const double pixels = solid.half[0] / (z * lens.pixel);
  const int corners = std::clamp(static_cast<int>(std::ceil(std::numbers::pi * std::sqrt(10 * pixels))), 12, 512);
  // The polygon of the circle's area.
  const double step = 2 * std::numbers::pi / corners, wide = std::sqrt(step / std::sin(step));
  Vec3 last = c + wide * u;
  for (int k = 1; k <= corners; ++k) {
    const Vec3 next = c + wide * (std::cos(step * k) * u + std::sin(step * k) * v);
    to.add(last - h, next - h);
    to.add(last + h, next + h);
    to.add(next - h, next + h);
    last = next;
  }
}

/// Bounds in the plane z = 1 as pixels, with a margin of half a pixel around.
PixelBounds pixels(const Lens& lens, double left, double right, double bottom, double top) {
  // std::ceil and std::floor would be calls.
  const auto first = [](double x, int most) {
    x = std::clamp(x, 0.0, static_cast<double>(most));
    const int i = static_cast<int>(x);
    return static_cast<std::int16_t>(i < x ? i + 1 : i);
  };
  const auto end = [](double x, int most) {
    x = std::clamp(x, -1.0, most - 1.0);
    const int i = static_cast<int>(x);
    return static_cast<std::int16_t>(i > x ? i : i + 1);
  };
  // The middle of pixel i is at left + i pixel.
  return {first((left - lens.left) / lens.pixel - 0.5, lens.width),
          first((lens.top - top) / lens.pixel - 0.5, lens.height),
          end((right - lens.left) / lens.pixel + 0.5, lens.width),
          end((lens.top - bottom) / lens.pixel + 0.5, lens.height)};
}

/// The outline of a ball, with the pixels that it may cover.
PixelBounds outline_ball(const Lens& lens, const Solid& solid, Silhouette& to) {
  Outline o{};
  if (!outline_of(vec(solid.center), solid.radius, o)) {
    to.wide = true;
    return bounds_of_ball(lens, solid.center, solid.radius);
  }
  double a = std::sqrt(o.ax * o.ax + o.ay * o.ay), b = std::sqrt(o.bx * o.bx + o.by * o.by);
  const double ex = o.ax / a, ey = o.ay / a;
  // A ball that is smaller than a pixel is larger and fainter. The edge of a disc is blurred over a pixel, which adds
  // pi / 12 pixels to its area; the opacity takes them off where they count.
  const double least = 0.75 * lens.pixel, seen = 2 * lens.pixel;
  BallOutline& ball = to.ball;
  if (lens.smooth && b < seen) {
    const double longer = std::max(a, least), shorter = std::max(b, least);
    ball.opacity = static_cast<float>(a * b / (longer * shorter + lens.pixel * lens.pixel / 12));
    a = longer, b = shorter;
  }
  ball.x = static_cast<float>(o.x), ball.y = static_cast<float>(o.y);
  ball.xx = static_cast<float>(ex / a), ball.xy = static_cast<float>(ey / a);
  ball.yx = static_cast<float>(-ey / b), ball.yy = static_cast<float>(ex / b);
  ball.per_a = static_cast<float>(1 / a), ball.per_b = static_cast<float>(1 / b);
  ball.depth2 = static_cast<float>(o.depth2);
  const double wide = std::sqrt(a * a * ex * ex + b * b * ey * ey), high = std::sqrt(a * a * ey * ey + b * b * ex * ex);
  return pixels(lens, o.x - wide, o.x + wide, o.y - high, o.y + high);
}

}  // namespace

PixelBounds bounds_of_ball(const Lens& lens, const Float3& center, float radius) {
  const double near = center[2] - radius, far = center[2] + radius;
  if (far <= lens.near) return {};
  if (near <= lens.near) return {0, 0, static_cast<std::int16_t>(lens.width), static_cast<std::int16_t>(lens.height)};
  const auto low = [&](double x) { return x / (x < 0 ? near : far); };
  const auto high = [&](double x) { return x / (x > 0 ? near : far); };
  return pixels(lens, low(center[0] - radius), high(center[0] + radius), low(center[1] - radius),
                high(center[1] + radius));
}

PixelBounds Silhouettes::add_polygon(const Shot& shot, const Solid& solid, Silhouette& to) {
  const Lens& lens = shot.lens;
  Projection projection(lens.near);
  if (solid.kind == SolidKind::box) project_box(lens, solid, projection);
  if (solid.kind == SolidKind::cylinder) project_cylinder(lens, solid, projection);
  if (solid.kind == SolidKind::wall) project_wall(solid, shot.walls[solid.part], projection);
  const std::vector<PlanePoint> hull = projection.hull();
  if (hull.size() < 3) return {};

  to.first_edge = static_cast<std::int32_t>(edges_.size());
  const std::size_t pairs = (hull.size() + 1) / 2;
  to.edge_pairs = static_cast<std::int32_t>(pairs);
  const auto edge = [&](std::size_t i) -> Edge {
    if (i >= hull.size()) return {0, 0, 1e6F};
    const PlanePoint &p = hull[i], &q = hull[(i + 1) % hull.size()];
    const double length = std::hypot(q.x - p.x, q.y - p.y) * lens.pixel;
    const double a = -(q.y - p.y) / length, b = (q.x - p.x) / length;
    return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(-a * p.x - b * p.y)};
  };
  for (std::size_t i = 0; i < pairs; ++i) {
    edges_.push_back(edge(i));
    edges_.push_back(edge(i + pairs));
  }
  const auto [left, right] = std::minmax_element(hull.begin(), hull.end(), [](auto& p, auto& q) { return p.x < q.x; });
  const auto [bottom, top] = std::minmax_element(hull.begin(), hull.end(), [](auto& p, auto& q) { return p.y < q.y; });
  return pixels(lens, left->x, right->x, bottom->y, top->y);
}

void Silhouettes::fill(const Shot& shot) {
  edges_.clear();
  all_.resize(shot.solids.size());
  for (std::size_t i = 0; i < shot.solids.size(); ++i) {
    const Solid& solid = shot.solids[i];
    Silhouette& to = all_[i];
    to = {};
    to.nearest = solid.center[2] - solid.radius;
    if (solid.shadow_only) {
      to.bounds = {};
    } else if (solid.kind == SolidKind::ball) {
      to.bounds = outline_ball(shot.lens, solid, to);
    } else if (solid.kind == SolidKind::mesh) {
      to.bounds = bounds_of_ball(shot.lens, solid.center, solid.radius);
    } else {
      to.bounds = add_polygon(shot, solid, to);
    }
  }
}

}  // namespace carom::raster
