// Fixed surfaces near a position. With many surfaces, a cache by cell of space holds those that come near the cell.
// Cells are two to four times as wide as the reach, so that one cell serves many searches. With few surfaces a loop
// over all is as fast.
#include "simulate/space/surfaces_near.h"

#include "geometry/contact_time.h"
#include "geometry/shell.h"
#include "numerics/whole.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

// For so many surfaces a loop over all is as fast.
constexpr size_t few = 12;
// Number of cells in the cache.
constexpr size_t most_cells = 65536;

/// Half the edges of the box around a wall (m).
Vec3 half_of(const Wall& wall) {
  return wall.half_width * wall.right.cwiseAbs() + wall.half_height * wall.up.cwiseAbs();
}

}  // namespace

size_t SurfacesNear::Hash::operator()(const Cell& cell) const {
  auto hash = uint64_t(cell.size);
  for (const int64_t c : {cell.x, cell.y, cell.z}) {
    hash = (hash ^ uint64_t(c)) * 0x9E3779B97F4A7C15;
    hash ^= hash >> 29;
  }
  return hash;
}

SurfacesNear::SurfacesNear(const World& world) : world_(world) {
  for (const Plane& plane : world.planes)
    planes_.push_back({plane.normal, plane.point.dot(plane.normal), 0x1p-48 * plane.point.cwiseAbs().sum()});
  for (Entity k = 0; k < world.fixed_count(); ++k) all_.push_back(world.body_count() + k);
  if (!world.moves()) return;
  for (const Entity e : all_) sweep(e);
}

/// Finds the places of a thing's centre, and how far out a plane goes.
void SurfacesNear::sweep(Entity e) {
  const Vec3& start = world_.fixed_position(e);
  Places& places = places_.emplace_back(Places{start, start});
  if (!world_.moves(e)) return;

  const SurfaceMotion& motion = world_.motion(e);
  if (world_.is_plane(e)) {
    HalfSpace& plane = planes_[e - world_.body_count()];
    const double out = swept_along(motion, plane.normal);
    plane.offset += out;
    if (out < never) plane.rounding += 0x1p-48 * std::abs(out);
    return;
  }

  for (int axis = 0; axis < 3; ++axis) {
    places.low[axis] -= swept_along(motion, -Vec3::Unit(axis));
    places.high[axis] += swept_along(motion, Vec3::Unit(axis));
  }
}

inline bool SurfacesNear::is_near(Entity e, const Vec3& center, double reach) const {
  if (world_.is_plane(e)) {
    const HalfSpace& plane = planes_[e - world_.body_count()];
    return center.dot(plane.normal) - plane.offset <= reach + plane.rounding + 0x1p-48 * center.cwiseAbs().sum();
  }
  if (world_.is_obstacle(e)) {
    const Obstacle& o = world_.obstacle(e);
    // Deep inside it is not near.
    if (o.hollow != Hollow::none) return is_shell_near(o, center, reach);
    return ((center - o.center).cwiseAbs() - o.volume.half).cwiseMax(0).squaredNorm() <= reach * reach;
  }
  return (center - nearest_on_wall(world_.wall(e), center)).squaredNorm() <= reach * reach;
}

bool SurfacesNear::is_shell_near(const Obstacle& shell, const Vec3& center, double reach) {
  const Vec3 p = center - shell.center;
  const double rounding = 0x1p-48 * (center.cwiseAbs().sum() + shell.center.cwiseAbs().sum());
  return Shell(shell).distance(p) <= reach + rounding;
}

/// The same where things move: whether the surface is ever near.
bool SurfacesNear::comes_near(Entity e, const Vec3& center, double reach) const {
  if (!world_.moves(e) || world_.is_plane(e)) return is_near(e, center, reach);
  const Places& places = places_[e - world_.body_count()];
  const Vec3 half = world_.is_obstacle(e) ? world_.obstacle(e).volume.half : half_of(world_.wall(e));
  const Vec3 nearest = center.cwiseMax(places.low).cwiseMin(places.high);
  return ((center - nearest).cwiseAbs() - half).cwiseMax(0).squaredNorm() <= reach * reach;
}

/// Adds those that are ever near.
void SurfacesNear::take_ever_near(const vector<Entity>& from, const Vec3& center, double reach,
                                  vector<Entity>& found) const {
  for (const Entity e : from)
    if (comes_near(e, center, reach)) found.push_back(e);
}

void SurfacesNear::find(const Vec3& center, double reach, vector<Entity>& found) {
  found.clear();
  const vector<Entity>* candidates = &all_;

  // Cells are two to four times as wide as the reach, so that one serves many searches.
  int size;
  std::frexp(2 * reach, &size);
  const double width = std::ldexp(1.0, size);
  const Vec3 at = center / width;

  // With many surfaces the candidates are those near the whole cell, which are kept.
  if (all_.size() > few && (at.array().abs() < 0x1p40).all() && width > 0 && width < 0x1p1000) {
    const Cell cell{whole_below(at.x()), whole_below(at.y()), whole_below(at.z()), size};
    auto known = cells_.find(cell);
    if (known == cells_.end()) {
      if (cells_.size() >= most_cells) cells_.clear();
      const Vec3 middle = width * Vec3(double(cell.x) + 0.5, double(cell.y) + 0.5, double(cell.z) + 0.5);
      vector<Entity> in_reach;
      // Half of the cell's diagonal.
      take_ever_near(all_, middle, (0.5 + 0.8661) * width, in_reach);
      known = cells_.emplace(cell, std::move(in_reach)).first;
    }
    candidates = &known->second;
  }

  if (world_.moves()) [[unlikely]]
    return take_ever_near(*candidates, center, reach, found);
  for (const Entity e : *candidates)
    if (is_near(e, center, reach)) found.push_back(e);
}

}  // namespace carom
