#include "scene/grid.h"

#include <algorithm>
#include <cmath>

#include "physics/touch.h"

namespace carom {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

double dot(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

std::int64_t cell_of(double x, double cell) {
  // Beyond 4e18 all cells are one: only positions far outside of any scene are.
  return static_cast<std::int64_t>(std::clamp(std::floor(x / cell), -4e18, 4e18));
}

}  // namespace

double touch_tolerance(double relative, double smaller_reach, const Vec3& a, const Vec3& b) {
  const double largest = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  return relative * smaller_reach + 4 * 0x1p-52 * largest;
}

void BodyGrid::reserve(std::size_t members) {
  members_.reserve(members);
  exponents_.reserve(members);
  next_.reserve(members);
  std::size_t size = 64;
  while (size < 2 * members) size *= 2;
  if (size <= heads_.size()) return;
  heads_.assign(size, none);
  for (std::uint32_t i = 0; i < members_.size(); ++i) link(i);
}

std::size_t BodyGrid::bucket(int exponent, std::int64_t x, std::int64_t y, std::int64_t z) const {
  // Cells that are neighbours along x share a line of memory.
  const std::uint64_t row = static_cast<std::uint64_t>(y) * 0x9E3779B97F4A7C15ULL +
                            static_cast<std::uint64_t>(z) * 0xC2B2AE3D27D4EB4FULL +
                            static_cast<std::uint64_t>(exponent) * 0x165667B19E3779F9ULL;
  return (static_cast<std::uint64_t>(x) + (row ^ (row >> 29))) & (heads_.size() - 1);
}

void BodyGrid::link(std::uint32_t i) {
  const Member& member = members_[i];
  const double cell = std::ldexp(1.0, exponents_[i]);
  std::uint32_t& head = heads_[bucket(exponents_[i], cell_of(member.center.x(), cell), cell_of(member.center.y(), cell),
                                      cell_of(member.center.z(), cell))];
  next_[i] = head;
  head = i;
}

void BodyGrid::insert(const Member& member) {
  if (2 * (members_.size() + 1) > heads_.size()) reserve(std::max<std::size_t>(64, 2 * members_.size()));
  int exponent = 0;
  std::frexp(2 * member.radius, &exponent);
  const auto index = static_cast<std::uint32_t>(members_.size());
  members_.push_back(member);
  exponents_.push_back(exponent);
  next_.push_back(none);
  auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& l) { return l.exponent == exponent; });
  if (level == levels_.end()) level = levels_.insert(level, {exponent, std::ldexp(1.0, exponent), {}});
  level->members.push_back(index);
  link(index);
}

std::optional<BodyGrid::Overlap> BodyGrid::overlap_with(std::uint32_t i, const Member& body, double relative) const {
  const Member& member = members_[i];
  const Vec3 d = member.center - body.center;
  const double sum = member.radius + body.radius;
  const double squared = dot(d, d);
  if (squared >= sum * sum) return std::nullopt;
  const double depth = is_ball(member.entity) && is_ball(body.entity)
                           ? sum - std::sqrt(squared)
                           : -touch(*world_, body.entity, body.center, member.entity, member.center).gap;
  if (depth <= touch_tolerance(relative, std::min(member.radius, body.radius), member.center, body.center)) {
    return std::nullopt;
  }
  return Overlap{member.entity, depth};
}

std::optional<BodyGrid::Overlap> BodyGrid::find_overlap(const Member& body, double relative) const {
  const Vec3& center = body.center;
  const double radius = body.radius;
  for (const Level& level : levels_) {
    const double reach = radius + level.cell / 2;
    std::int64_t low[3], high[3];
    double cells = 1;
    for (int k = 0; k < 3; ++k) {
      low[k] = cell_of(center[k] - reach, level.cell);
      high[k] = cell_of(center[k] + reach, level.cell);
      cells *= static_cast<double>(high[k] - low[k] + 1);
    }
    // A large body among few small ones: cheaper to ask them all.
    if (cells > static_cast<double>(level.members.size()) + 27) {
      for (const std::uint32_t i : level.members) {
        if (auto overlap = overlap_with(i, body, relative)) return overlap;
      }
      continue;
    }
    // The body's own cell first: where there is an overlap, it is most often there.
    for (std::uint32_t i = heads_[bucket(level.exponent, cell_of(center.x(), level.cell),
                                         cell_of(center.y(), level.cell), cell_of(center.z(), level.cell))];
         i != none; i = next_[i]) {
      if (auto overlap = overlap_with(i, body, relative)) return overlap;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          for (std::uint32_t i = heads_[bucket(level.exponent, x, y, z)]; i != none; i = next_[i]) {
            if (auto overlap = overlap_with(i, body, relative)) return overlap;
          }
        }
      }
    }
  }
  return std::nullopt;
}

namespace {

double ball_depth(const Vec3& center, double radius, const Plane& plane) {
  return radius - dot(center - plane.point, plane.normal);
}

double ball_depth(const Vec3& center, double radius, const Wall& wall) {
  // Distance to the nearest point of the rectangle.
  const Vec3 d = center - wall.center;
  const double across = std::max(0.0, std::fabs(dot(d, wall.right)) - wall.half_width);
  const double along = std::max(0.0, std::fabs(dot(d, wall.up)) - wall.half_height);
  const double away = dot(d, wall.normal);
  return radius - std::sqrt(across * across + along * along + away * away);
}

}  // namespace

std::optional<double> overlap_depth(const World& world, Entity body, const Vec3& center, Entity surface,
                                    double relative) {
  const double reach = world.radius[body];
  const double depth = world.volume_of(body).shape != Shape::sphere
                           ? -touch(world, body, center, surface, world.fixed_position(surface)).gap
                       : world.is_plane(surface) ? ball_depth(center, reach, world.plane(surface))
                                                 : ball_depth(center, reach, world.wall(surface));
  if (depth <= touch_tolerance(relative, reach, center, world.fixed_position(surface))) return std::nullopt;
  return depth;
}

bool touches_no_surface(const World& world, Entity body, const Vec3& center) {
  const auto end = static_cast<Entity>(world.body_count() + world.planes.size() + world.walls.size());
  for (Entity surface = world.body_count(); surface < end; ++surface) {
    if (overlap_depth(world, body, center, surface)) return false;
  }
  return true;
}

}  // namespace carom
