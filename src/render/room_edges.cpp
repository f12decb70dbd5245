// Intersects each two planes in a line, and cuts the line at all other planes.
#include "render/room_edges.h"

#include "physics/world.h"
#include "render/surfaces.h"
#include "std.h"

namespace carom {
namespace {

// More planes than a room has: their edges would be a mesh of lines.
constexpr size_t most_planes = 64;

/// The part of the line of two planes that is on the free side of all others. False: none, or it is endless.
bool edge_of(const vector<Plane>& planes, size_t i, size_t j, Vec3& from, Vec3& to) {
  const Plane &a = planes[i], &b = planes[j];
  const Vec3 along = a.normal.cross(b.normal);
  const double sine = along.norm();
  if (sine < 1e-9) return false;

  const Vec3 direction = along / sine;

  // The point of the line nearest to a's: on both planes.
  const Vec3 within = b.normal - a.normal.dot(b.normal) * a.normal;
  const Vec3 start = a.point + b.normal.dot(b.point - a.point) / within.squaredNorm() * within;

  // Each other plane cuts off one end.
  double low = -infinity, high = -low;
  for (size_t k = 0; k < planes.size(); ++k) {
    if (k == i || k == j) continue;
    const double slope = planes[k].normal.dot(direction), height = planes[k].normal.dot(start - planes[k].point);

    if (std::abs(slope) < 1e-12) {
      if (height < 0) return false;
    } else if (slope > 0) {
      low = max(low, -height / slope);
    } else {
      high = min(high, -height / slope);
    }
  }

  if (!isfinite(low) || !isfinite(high) || low >= high) return false;
  from = start + low * direction, to = start + high * direction;
  return true;
}

}  // namespace

vector<Stroke> room_edges(const Scene& scene) {
  vector<Plane> planes;
  for (size_t i = 0; i < scene.world.planes.size(); ++i)
    if (look_of_fixed(scene, i).visible) planes.push_back(scene.world.planes[i]);

  vector<Stroke> edges;
  if (planes.size() > most_planes) return edges;
  for (size_t i = 0; i < planes.size(); ++i)
    for (size_t j = i + 1; j < planes.size(); ++j) {
      Stroke stroke;
      if (!edge_of(planes, i, j, stroke.from, stroke.to)) continue;

      stroke.least_width = 1.3;
      stroke.color = {0.12, 0.13, 0.15};
      stroke.from_opacity = stroke.to_opacity = 0.4;
      edges.push_back(stroke);
    }
  return edges;
}

}  // namespace carom
