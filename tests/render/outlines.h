#pragma once
// The outline of a solid in a picture, by projecting its corners, to compare pictures with.

#include "render/eye.h"
#include "render/scenes.h"
#include "std.h"

namespace carom::test {

struct Point {
  double x, y;  // pixels
};

inline Point projected(const Scene& scene, Size size, const Vec3& p) {
  const Eye eye(camera_of(scene), size);
  const Vec3 q = eye.point(p);
  return {size.width / 2.0 + q.x() / q.z() / eye.pixel, size.height / 2.0 - q.y() / q.z() / eye.pixel};
}

inline double grey_at(const Image& image, const Scene& scene, const Vec3& p) {
  const Point at = projected(scene, {image.width, image.height}, p);
  return grey(image, static_cast<int>(at.x), static_cast<int>(at.y));
}

/// Twice the area of the triangle a, b, p.
inline double side(const Point& a, const Point& b, const Point& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The convex hull, by the monotone chain (Andrew 1979).
inline vector<Point> hull_of(vector<Point> points) {
  ranges::sort(points, [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  vector<Point> hull;
  for (int half = 0; half < 2; ++half) {
    const size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    ranges::reverse(points);
  }
  return hull;
}

/// In pixels; negative: inside.
inline double outside(const vector<Point>& hull, const Point& p) {
  double most = -1e9;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
    most = std::max(most, -side(a, b, p) / hypot(b.x - a.x, b.y - a.y));
  }
  return most;
}

inline double area_of(const vector<Point>& hull) {
  double twice = 0;
  for (size_t i = 0; i < hull.size(); ++i) twice += side({0, 0}, hull[i], hull[(i + 1) % hull.size()]);
  return twice / 2;
}

/// Of a box's corners, or of many points on a cylinder's rims.
inline vector<Point> outline_of_solid(const Scene& scene, Size size, const Vec3& center, const Volume& volume) {
  vector<Point> points;
  const bool box = volume.shape == Shape::box;
  for (int i = 0; i < (box ? 8 : 400); ++i) {
    const double angle = M_PI / 100 * (i / 2);
    const Vec3 corner = box ? Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)
                            : Vec3(std::cos(angle), i % 2 ? 1 : -1, std::sin(angle));
    points.push_back(projected(scene, size, center + volume.half.cwiseProduct(corner)));
  }
  return hull_of(points);
}

}  // namespace carom::test
