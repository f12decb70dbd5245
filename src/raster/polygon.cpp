// The convex hull of a solid's corners, cut at the near plane. A cylinder's rims are polygons so fine that they deviate
// by less than a twentieth of a pixel.
#include "raster/polygon.h"

#include <numbers>

#include "std.h"

namespace carom::raster {
namespace {

double side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The convex hull, counterclockwise, by the monotone chain (Andrew 1979).
vector<PlanePoint> hull_of(vector<PlanePoint> points) {
  if (points.size() < 3) return {};
  ranges::sort(points, [](const PlanePoint& a, const PlanePoint& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });

  // The lower half, then the upper one.
  vector<PlanePoint> hull;
  for (int half = 0; half < 2; ++half) {
    const size_t start = hull.size();
    for (const PlanePoint& p : points) {
      while (hull.size() >= start + 2 && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    ranges::reverse(points);
  }

  return hull;
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
  vector<PlanePoint> hull() { return hull_of(std::move(points_)); }

 private:
  double near_;
  vector<PlanePoint> points_;
};

void project_box(const array<Float3, 3>& axes, const Solid& solid, Projection& to) {
  const auto corner = [&](int k) {
    Vec3 p = vec(solid.center);
    for (size_t i = 0; i < 3; ++i) p += (k >> i & 1 ? 1 : -1) * double{solid.half[i]} * vec(axes[i]);
    return p;
  };
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 3; ++i)
      if (!(k >> i & 1)) to.add(corner(k), corner(k | 1 << i));
}

void project_cylinder(const Lens& lens, const Solid& solid, Projection& to) {
  const Vec3 c = vec(solid.center), h = double{solid.half[1]} * vec(lens.axes[1]);
  const Vec3 u = double{solid.half[0]} * vec(lens.axes[0]), v = double{solid.half[0]} * vec(lens.axes[2]);

  // A regular polygon of n corners deviates from its circle by r pi^2 / (2 n^2).
  const double z = std::max(c.z() - solid.radius, double{lens.near});
  const double pixels = solid.half[0] / (z * lens.pixel);
  const int corners = std::clamp(int(std::ceil(std::numbers::pi * std::sqrt(10 * pixels))), 12, 512);

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

}  // namespace

vector<PlanePoint> outline_polygon(const Shot& shot, const Solid& solid) {
  Projection projection(shot.lens.near);
  if (solid.kind == SolidKind::box || solid.kind == SolidKind::wall)
    project_box(axes_of(shot, solid), solid, projection);
  if (solid.kind == SolidKind::cylinder) project_cylinder(shot.lens, solid, projection);
  return projection.hull();
}

}  // namespace carom::raster
