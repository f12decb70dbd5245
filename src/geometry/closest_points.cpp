// The closest points of a box or an upright cylinder and a wall at an angle to it.
// Two convex bodies that do not overlap are nearest where a corner of one faces the other, or where two edges cross.
// The candidates are so few that all are tried. Ties give the middle of all closest points.

#include "geometry/pair.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// The point of a box or a cylinder nearest to p, both from its centre.
Vec3 clamped(const Volume& v, const Vec3& p) {
  if (v.shape == Shape::box) return p.cwiseMax(-v.half).cwiseMin(v.half);
  const double rho = sqrt(p.x() * p.x() + p.z() * p.z());
  const double shrink = rho > v.half.x() ? v.half.x() / rho : 1;
  return {shrink * p.x(), clamp(p.y(), -v.half.y(), v.half.y()), shrink * p.z()};
}

struct Segment {
  Vec3 from, along;
};

/// Parameters in [0, 1] at which two segments are nearest. Ericson, Real-Time Collision Detection (2005), 5.1.9.
array<double, 2> closest_parameters(const Segment& p, const Segment& q) {
  const Vec3 r = p.from - q.from;
  const double a = p.along.squaredNorm(), e = q.along.squaredNorm(), b = p.along.dot(q.along);
  const double c = p.along.dot(r), f = q.along.dot(r), det = a * e - b * b;
  double s = det > 0 ? clamp((b * f - c * e) / det, 0.0, 1.0) : 0.5;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = clamp(t, 0.0, 1.0);
    s = clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

/// The parameter at which a segment is nearest to a cylinder. The distance is convex, and its slope is bisected.
double nearest_parameter(const Segment& p, const Volume& cylinder) {
  double low = 0, high = 1;
  const auto slope = [&](double s) {
    const Vec3 x = p.from + s * p.along;
    return (x - clamped(cylinder, x)).dot(p.along);
  };
  if (slope(low) >= 0) return low;
  if (slope(high) <= 0) return high;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (slope(middle) < 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

Vec3 foremost(const Volume& v, const Vec3& n) {
  if (v.shape == Shape::sphere) return v.half.x() * n;
  Vec3 reach;
  for (int k = 0; k < 3; ++k) reach[k] = v.half[k] * ((n[k] > 0) - (n[k] < 0));
  if (v.shape == Shape::box) return reach;

  const Vec3 level(n.x(), 0, n.z());
  const double length = level.norm();
  return Vec3(0, reach.y(), 0) + (length > 0 ? v.half.x() / length : 0) * level;
}

ClosestPoints closest_points(const Volume& a, const Vec3& xa, const Wall& wall, const Vec3& xb) {
  // All positions are from a's centre.
  const Vec3 center = xb - xa, right = wall.half_width * wall.right, up = wall.half_height * wall.up;

  vector<ClosestPoints> all;
  array<Segment, 4> edges;

  // The wall's corners and edges.
  for (size_t k = 0; k < 4; ++k) {
    const double s = k % 2 == 0 ? 1 : -1, t = k / 2 == 0 ? 1 : -1;
    const Vec3 corner = center + s * right + t * up;
    all.push_back({clamped(a, corner), corner});
    edges[k] = k / 2 == 0 ? Segment{center + s * right - up, 2 * up} : Segment{center + s * up - right, 2 * right};
  }

  if (a.shape == Shape::box) {
    // The box's corners, and its edges with the wall's.
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner = a.half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
      all.push_back({corner, nearest_on_wall(wall, center, corner)});
      for (int axis = 0; axis < 3; ++axis) {
        if (corner[axis] > 0) continue;
        const Segment edge{corner, 2 * a.half[axis] * Vec3::Unit(axis)};

        for (const Segment& other : edges) {
          const auto [s, t] = closest_parameters(edge, other);
          all.push_back({edge.from + s * edge.along, other.from + t * other.along});
        }
      }
    }
  } else {
    // Candidates: the cylinder's foremost point towards the wall's plane, and the wall's edges.
    const Vec3 n = wall.normal.dot(center) > 0 ? wall.normal : Vec3(-wall.normal);
    const Vec3 end = foremost(a, n);
    all.push_back({end, nearest_on_wall(wall, center, end)});

    for (const Segment& edge : edges) {
      const Vec3 p = edge.from + nearest_parameter(edge, a) * edge.along;
      all.push_back({clamped(a, p), p});
    }
  }

  // The middle of all that are nearest.
  double least = never;
  for (const ClosestPoints& p : all) least = min(least, (p.on_b - p.on_a).norm());
  const double tie = least + 0x1p-48 * (a.half.sum() + wall.half_width + wall.half_height);

  ClosestPoints middle{Vec3::Zero(), Vec3::Zero()};
  int count = 0;
  for (const ClosestPoints& p : all) {
    if (!((p.on_b - p.on_a).norm() <= tie)) continue;
    middle.on_a += p.on_a;
    middle.on_b += p.on_b;
    ++count;
  }

  return {xa + middle.on_a / count, xa + middle.on_b / count};
}

}  // namespace carom
