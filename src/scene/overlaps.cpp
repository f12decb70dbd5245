// Tests bodies from the largest to the smallest against those already in the grid, which keeps the searches cheap.
// Errors are sorted by the bodies' numbers afterwards, so that their order is that of the file.
#include "scene/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr std::size_t max_overlaps_shown = 20;
// In the grid. A heap of bodies in one place must not cost n^2.
constexpr std::size_t max_overlapping_kept = 1000;
// A share of the smaller reach. Places are decimals that were rounded by hand.
constexpr double rounding_of_places = 1e-9;

struct Found {
  Entity later, other;
  double depth;  // m
  Place place;   // of the later one's position
};

void report(const Scene& scene, const Found& found, const std::string& more, Diagnostics& diagnostics) {
  const World& world = scene.world;
  const std::string a = in_backticks(scene.roster.name(found.later)), b = in_backticks(scene.roster.name(found.other));
  if (world.is_plane(found.other) &&
      found.depth > 2 * world.volume_of(found.later).support(world.plane(found.other).normal)) {
    diagnostics.add(found.place, fmt::format("{} is behind {} at the start", a, b),
                    "expected it on the side that the normal points to" + more);
    return;
  }
  diagnostics.add(found.place, fmt::format("{} overlaps {} by {:.6g} m at the start", a, b, found.depth),
                  "expected bodies apart, or just touching" + more);
}

}  // namespace

void check_overlaps(const Scene& scene, std::vector<SingleBody> singles, BodyGrid& grid, Diagnostics& diagnostics) {
  const World& world = scene.world;
  const auto member = [&](Entity body) {
    return BodyGrid::Member{scene.initial.position[body], world.radius[body], body};
  };
  const std::vector<SingleBody> by_number = singles;
  const auto place_of = [&](Entity body) {
    return std::lower_bound(by_number.begin(), by_number.end(), body,
                            [](const SingleBody& single, Entity e) { return single.body < e; })
        ->position;
  };
  std::stable_sort(singles.begin(), singles.end(), [&](const SingleBody& a, const SingleBody& b) {
    return world.radius[a.body] > world.radius[b.body];
  });
  std::vector<Found> found;
  for (const SingleBody& single : singles) {
    if (const auto overlap = grid.find_overlap(member(single.body), rounding_of_places)) {
      const bool is_later = single.body > overlap->entity;
      const Entity later = std::max(overlap->entity, single.body), other = std::min(overlap->entity, single.body);
      found.push_back({later, other, overlap->depth, is_later ? single.position : place_of(later)});
      if (found.size() > max_overlapping_kept) continue;
    }
    grid.insert(member(single.body));
  }

  // Obstacles may stand in one another. One with an error has no volume.
  BodyGrid obstacles(&world);
  std::vector<BodyGrid::Member> members;
  const auto surfaces = static_cast<Entity>(world.planes.size() + world.walls.size());
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    if (!(obstacle.volume.reach() > 0)) continue;
    members.push_back(
        {obstacle.center, obstacle.volume.reach(), world.body_count() + surfaces + static_cast<Entity>(i)});
  }
  std::stable_sort(members.begin(), members.end(),
                   [](const BodyGrid::Member& a, const BodyGrid::Member& b) { return a.radius > b.radius; });
  for (const BodyGrid::Member& obstacle : members) obstacles.insert(obstacle);
  for (const SingleBody& single : singles) {
    if (const auto overlap = obstacles.find_overlap(member(single.body), rounding_of_places)) {
      found.push_back({single.body, overlap->entity, overlap->depth, single.position});
    }
    for (Entity surface = world.body_count(); surface < world.body_count() + surfaces; ++surface) {
      const Vec3& center = scene.initial.position[single.body];
      if (const auto depth = overlap_depth(world, single.body, center, surface, rounding_of_places)) {
        found.push_back({single.body, surface, *depth, single.position});
      }
    }
  }
  for (const BodyGrid::Member& obstacle : members) grid.insert(obstacle);

  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.later, a.other) < std::tie(b.later, b.other);
  });
  for (std::size_t i = 0; i < std::min(found.size(), max_overlaps_shown); ++i) {
    std::string more;
    if (i + 1 == max_overlaps_shown && found.size() > max_overlaps_shown) {
      more = fmt::format("\nand {} more overlaps", found.size() - max_overlaps_shown);
    }
    report(scene, found[i], more, diagnostics);
  }
  if (found.size() > max_overlaps_shown) diagnostics.add_uncounted(found.size() - max_overlaps_shown);
}

}  // namespace carom
