// A thickness that bodies could sink into would be a wrong picture. A constant one that is thin enough for any body
// would leave a rail of a table a line.
#include "render/wall_thickness.h"

#include "physics/body_now.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr double thin = 0.04;  // of a body's radius
// Of a wall's longer side, and at most of its shorter one: the proportions of a board and of a rail.
constexpr double of_longer = 0.02, of_shorter = 0.6;

double most(const Wall& wall) {
  const auto [shorter, longer] = std::minmax({2 * wall.half_width, 2 * wall.half_height});
  return min(of_longer * longer, of_shorter * shorter);
}

}  // namespace

WallThickness::WallThickness(const Scene& scene) : scene_(scene) {
  const World& world = scene.world;
  if (world.walls.empty()) return;
  if (!world.radius.empty()) least_ = thin * *ranges::min_element(world.radius);
  for (const Wall& wall : world.walls) {
    array<bool, 2>& met = met_.emplace_back(array{false, false});
    for (const Vec3& position : scene.initial.position) met[wall.normal.dot(position - wall.center) < 0 ? 1 : 0] = true;
  }
}

double WallThickness::depth(size_t i, double side, const State& state) const {
  const Wall& wall = scene_.world.walls[i];
  const double least = min(least_, most(wall));
  if (met_[i][side > 0 ? 0 : 1]) return least;

  double depth = most(wall);
  for (Entity body = 0; body < state.position.size(); ++body) {
    if (is_gone(state, body)) continue;
    const Vec3 way = state.position[body] - wall.center;
    const double reach = volume_now(scene_.world, state, body).reach(), above = side * wall.normal.dot(way);
    if (above - reach >= depth || above <= -reach) continue;

    // Of a ball beyond an edge, the part that the wall's thickness could meet.
    const double beyond = hypot(max(std::abs(wall.right.dot(way)) - wall.half_width, 0.0),
                                max(std::abs(wall.up.dot(way)) - wall.half_height, 0.0));
    if (beyond >= reach) continue;
    const double half = sqrt(reach * reach - beyond * beyond);
    if (above > -half) depth = max(min(depth, above - half), least);
  }
  return depth;
}

WallDepths WallThickness::of(size_t wall, const State& state) const {
  return {depth(wall, 1, state), depth(wall, -1, state)};
}

}  // namespace carom
