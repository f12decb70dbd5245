// A hashed grid with one level for each octave of diameters: cells as large as the members of a level.
// One grid with a single cell size would need many cells for large bodies or hold many bodies in each cell.
// Cells are chains in one array of buckets, so space is unbounded and memory is proportional to the members.
#include "scene/grid.h"

#include "geometry/touch.h"
#include "numerics/prefetch.h"
#include "numerics/whole.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint32_t none = 0xFFFFFFFF;

double dot(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

int64_t cell_of(double x, double cell) {
  // Beyond the range of integers all cells are one.
  return whole_below(x / cell);
}

}  // namespace

double touch_tolerance(double relative, double smaller_reach, const Vec3& a, const Vec3& b) {
  const double largest = max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  return relative * smaller_reach + 4 * 0x1p-52 * largest;
}

void BodyGrid::reserve(size_t members) {
  members_.reserve(members);
  level_.reserve(members);
  size_t size = 64;
  while (size < 4 * members) size *= 2;
  if (size <= heads_.size()) return;
  heads_.assign(size, none);
  for (uint32_t i = 0; i < members_.size(); ++i) link(i);
}

size_t BodyGrid::bucket(uint32_t level, int64_t x, int64_t y, int64_t z) const {
  // Cells that are neighbours along x share a cache line.
  const uint64_t row =
      uint64_t(y) * 0x9E3779B97F4A7C15ULL + uint64_t(z) * 0xC2B2AE3D27D4EB4FULL + level * 0x165667B19E3779F9ULL;
  return (uint64_t(x) + (row ^ (row >> 29))) & (heads_.size() - 1);
}

size_t BodyGrid::bucket(uint32_t level, const Vec3& center) const {
  const double cell = levels_[level].cell;
  return bucket(level, cell_of(center.x(), cell), cell_of(center.y(), cell), cell_of(center.z(), cell));
}

void BodyGrid::link(uint32_t i) {
  uint32_t& head = heads_[bucket(level_[i], members_[i].member.center)];
  members_[i].next = head;
  head = i;
}

void BodyGrid::insert(const Member& member) {
  if (2 * (members_.size() + 1) > heads_.size()) reserve(max<size_t>(64, 2 * members_.size()));
  int exponent = 0;
  std::frexp(2 * member.radius, &exponent);
  const auto index = uint32_t(members_.size());
  auto level = ranges::find_if(levels_, [&](const Level& l) { return l.exponent == exponent; });
  if (level == levels_.end()) level = levels_.insert(level, {exponent, 2 * member.radius, 0, {}});
  level->largest = max(level->largest, 2 * member.radius);
  level->members.push_back(index);
  members_.push_back({member, none});
  level_.push_back(uint32_t(level - levels_.begin()));
  link(index);
}

optional<BodyGrid::Overlap> BodyGrid::overlap_with(const Member& member, const Member& body, double relative) const {
  const Vec3 d = member.center - body.center;
  const double sum = member.radius + body.radius;
  const double squared = dot(d, d);
  if (squared >= sum * sum) return nullopt;
  const double depth = is_ball(member.entity) && is_ball(body.entity)
                           ? sum - sqrt(squared)
                           : -touch(*world_, body.entity, body.center, member.entity, member.center).gap;
  if (depth <= touch_tolerance(relative, min(member.radius, body.radius), member.center, body.center)) {
    return nullopt;
  }
  if (world_ != nullptr && !may_meet(*world_, body.entity, member.entity)) return nullopt;
  return Overlap{member.entity, depth};
}

optional<BodyGrid::Overlap> BodyGrid::overlap_in_chain(uint32_t head, const Member& body, double relative) const {
  for (uint32_t i = head; i != none; i = members_[i].next)
    if (auto overlap = overlap_with(members_[i].member, body, relative)) return overlap;
  return nullopt;
}

BodyGrid::Cells BodyGrid::cells_about(const Level& level, const Member& body) const {
  const double reach = body.radius + level.largest / 2;
  Cells cells;
  for (int k = 0; k < 3; ++k) {
    cells.low[k] = cell_of(body.center[k] - reach, level.cell);
    cells.high[k] = cell_of(body.center[k] + reach, level.cell);
    cells.count *= double(cells.high[k] - cells.low[k] + 1);
  }
  return cells;
}

/// visit(bucket) returns whether to continue.
template <typename Visit>
void BodyGrid::each_bucket(uint32_t level, const Cells& cells, Visit visit) const {
  for (int64_t z = cells.low[2]; z <= cells.high[2]; ++z)
    for (int64_t y = cells.low[1]; y <= cells.high[1]; ++y)
      for (int64_t x = cells.low[0]; x <= cells.high[0]; ++x)
        if (!visit(bucket(level, x, y, z))) return;
}

optional<BodyGrid::Overlap> BodyGrid::find_overlap(const Member& body, double relative) const {
  optional<Overlap> overlap;
  for (uint32_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    const Cells cells = cells_about(level, body);
    // For a large body among few small ones it is cheaper to test them all.
    if (cells.count > double(level.members.size()) + 27) {
      for (const uint32_t i : level.members)
        if ((overlap = overlap_with(members_[i].member, body, relative))) return overlap;
      continue;
    }
    // The body's own cell comes first, because most overlaps are found there.
    if ((overlap = overlap_in_chain(heads_[bucket(l, body.center)], body, relative))) return overlap;
    each_bucket(l, cells, [&](size_t at) { return !(overlap = overlap_in_chain(heads_[at], body, relative)); });
    if (overlap) return overlap;
  }
  return nullopt;
}

vector<BodyGrid::Overlap> BodyGrid::all_overlaps(const Member& body, double relative) const {
  vector<Overlap> all;
  const auto look = [&](uint32_t i) {
    if (const auto overlap = overlap_with(members_[i].member, body, relative)) all.push_back(*overlap);
  };

  for (uint32_t l = 0; l < levels_.size(); ++l) {
    const Cells cells = cells_about(levels_[l], body);
    if (cells.count > double(levels_[l].members.size())) {
      for (const uint32_t i : levels_[l].members) look(i);
      continue;
    }

    each_bucket(l, cells, [&](size_t at) {
      for (uint32_t i = heads_[at]; i != none; i = members_[i].next) look(i);
      return true;
    });
  }
  return all;
}

void BodyGrid::prefetch(const Member& body, Prefetch what) const {
  if (levels_.size() != 1) return;
  const Cells cells = cells_about(levels_[0], body);
  if (cells.count > 64) return;
  each_bucket(0, cells, [&](size_t at) {
    if (what == Prefetch::cells)
      carom::prefetch(&heads_[at]);
    else if (heads_[at] != none)
      carom::prefetch(&members_[heads_[at]]);
    return true;
  });
}

namespace {

double ball_depth(const Vec3& center, double radius, const Plane& plane) {
  return radius - dot(center - plane.point, plane.normal);
}

double ball_depth(const Vec3& center, double radius, const Wall& wall) {
  // Distance to the nearest point of the rectangle.
  const Vec3 d = center - wall.center;
  const double across = max(0.0, std::fabs(dot(d, wall.right)) - wall.half_width);
  const double along = max(0.0, std::fabs(dot(d, wall.up)) - wall.half_height);
  const double away = dot(d, wall.normal);
  return radius - sqrt(across * across + along * along + away * away);
}

}  // namespace

optional<double> overlap_depth(const World& world, Entity body, const Vec3& center, Entity surface, double relative) {
  const double reach = world.radius[body];
  const double depth = world.volume_of(body).shape != Shape::sphere
                           ? -touch(world, body, center, surface, world.fixed_position(surface)).gap
                       : world.is_plane(surface) ? ball_depth(center, reach, world.plane(surface))
                                                 : ball_depth(center, reach, world.wall(surface));
  if (depth <= touch_tolerance(relative, reach, center, world.fixed_position(surface))) return nullopt;
  if (!may_meet(world, body, surface)) return nullopt;
  return depth;
}

bool touches_no_surface(const World& world, Entity body, const Vec3& center) {
  const auto end = Entity(world.body_count() + world.planes.size() + world.walls.size());
  for (Entity surface = world.body_count(); surface < end; ++surface) {
    if (overlap_depth(world, body, center, surface)) return false;
  }
  return true;
}

}  // namespace carom
