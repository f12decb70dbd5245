#include <algorithm>
#include <cmath>

#include "physics/contact_time.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

// How many neighbours a region is sized for. Fewer: it grows and is left less often. More: it shrinks and tests fewer
// pairs.
constexpr std::size_t few_neighbours = 8, many_neighbours = 24;
constexpr double least_room = 0.02;  // of the radius

}  // namespace

void ExactSimulator::forget_neighbours(Entity i) {
  for (Entity j : near_[i]) {
    if (!world_.is_body(j)) continue;
    std::vector<Entity>& list = near_[j];
    const auto found = std::find(list.begin(), list.end(), i);
    *found = list.back();
    list.pop_back();
  }
  near_[i].clear();
}

void ExactSimulator::find_neighbours(Entity i) {
  const Region& region = region_[i];
  forget_neighbours(i);
  std::vector<Entity>& list = near_[i];
  if (!part_of_.empty() && part_of_[i] != i) return;
  grid_.near(region.center, region.half, [&](Entity j) {
    if (j == i || (!part_of_.empty() && part_of_[j] != j)) return;
    const double reach = region.half + region_[j].half;
    if ((region.center - region_[j].center).cwiseAbs().maxCoeff() > reach) return;
    list.push_back(j);
    near_[j].push_back(i);
  });
  const double slack = region.half - world_.radius[i];  // how far the centre may go along an axis, rounding included
  for (Entity e = world_.body_count(); e < world_.body_count() + world_.fixed_count(); ++e) {
    if (world_.is_plane(e)) {
      const Plane& plane = world_.plane(e);
      if (plane_gap(region.center, plane.point, plane.normal, world_.radius[i]) <=
          slack * plane.normal.cwiseAbs().sum())
        list.push_back(e);
    } else if (world_.is_obstacle(e)) {
      const Obstacle& o = world_.obstacle(e);
      const Vec3 away = ((region.center - o.center).cwiseAbs() - o.volume.half).cwiseMax(0);
      if (away.maxCoeff() <= region.half) list.push_back(e);
    } else {
      // The body's centre is within sqrt(3) rooms of the region's.
      const double away2 = (region.center - nearest_on_wall(world_.wall(e), region.center)).squaredNorm();
      if (away2 <= 3 * region.half * region.half) list.push_back(e);
    }
  }
}

/// A new region around where the body is now. One that leaves region after region on one and the same flight tries a
/// wider one: in company that flies along, it costs no more.
void ExactSimulator::rebuild_region(Entity i) {
  Region& region = region_[i];
  const auto bodies = [&] {
    return static_cast<std::size_t>(
        std::count_if(near_[i].begin(), near_[i].end(), [&](Entity e) { return world_.is_body(e); }));
  };
  const std::size_t known = bodies();
  region.left = region.version == version_[i] ? region.left + 1 : 0;
  region.version = version_[i];
  const bool far = region.left >= 8;
  if (known < few_neighbours) region.room *= 2;
  if (known > many_neighbours && !far) region.room *= 0.5;
  region.center = flight_[i].position(now_ - flight_[i].start);
  const double radius = world_.radius[i];
  const double rounding = 0x1p-48 * (region.center.cwiseAbs().maxCoeff() + radius);
  const auto build = [&](double room) {
    region.room = std::max({room, least_room * radius, rounding});
    region.half = radius + region.room + rounding;
    grid_.put(i, region.center, region.half);
    find_neighbours(i);
  };
  if (far && known >= few_neighbours) {
    region.left = 4;
    const double room = region.room;
    build(2 * room);
    if (bodies() <= 2 * known) return;
    region.room = room;
  }
  for (;;) {
    build(region.room);
    if (bodies() <= 2 * many_neighbours || region.room <= std::max(least_room * radius, rounding)) return;
    region.room *= 0.5;
  }
}

}  // namespace carom
