#include "simulate/neighbours.h"

#include <algorithm>
#include <cmath>

#include "physics/contact_time.h"

namespace carom {

namespace {

// How many neighbours a region is sized for. Fewer: it grows and is left less often. More: it shrinks and tests fewer
// pairs.
constexpr std::size_t few_neighbours = 8, many_neighbours = 24;
constexpr double least_room = 0.02;  // of the radius

double rounding_at(const Vec3& x, double radius) {
  return 0x1p-48 * (x.cwiseAbs().maxCoeff() + radius);
}

}  // namespace

Neighbours::Neighbours(const World& world)
    : world_(world),
      region_(world.body_count()),
      near_(world.body_count()),
      news_(world.body_count(), 1),
      grid_(world.body_count()) {}

void Neighbours::start(const std::vector<Vec3>& x) {
  for (Entity i = 0; i < world_.body_count(); ++i) {
    const double room = 0.5 * world_.radius[i];
    region_[i] = {x[i], room, room + world_.radius[i]};
    grid_.put(i, x[i], region_[i].half);
  }
  for (Entity i = 0; i < world_.body_count(); ++i) find(i);
}

void Neighbours::forget(Entity i) {
  for (Entity j : near_[i]) {
    if (!world_.is_body(j)) continue;
    std::vector<Entity>& list = near_[j];
    const auto found = std::find(list.begin(), list.end(), i);
    *found = list.back();
    list.pop_back();
  }
  near_[i].clear();
}

void Neighbours::find(Entity i) {
  const Region& region = region_[i];
  forget(i);
  news_[i] = 1;
  std::vector<Entity>& list = near_[i];
  grid_.near(region.center, region.half, [&](Entity j) {
    if (j == i) return;
    const double reach = region.half + region_[j].half;
    if ((region.center - region_[j].center).cwiseAbs().maxCoeff() > reach) return;
    list.push_back(j);
    near_[j].push_back(i);
    news_[j] = 1;
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

std::size_t Neighbours::bodies_near(Entity i) const {
  return static_cast<std::size_t>(
      std::count_if(near_[i].begin(), near_[i].end(), [&](Entity e) { return world_.is_body(e); }));
}

void Neighbours::build(Entity i, double room) {
  Region& region = region_[i];
  const double radius = world_.radius[i], rounding = rounding_at(region.center, radius);
  region.room = std::max({room, least_room * radius, rounding});
  region.half = radius + region.room + rounding;
  grid_.put(i, region.center, region.half);
  find(i);
}

bool Neighbours::renew(Entity i, const Vec3& x, bool far) {
  Region& region = region_[i];
  const std::size_t known = bodies_near(i);
  if (known < few_neighbours) region.room *= 2;
  if (known > many_neighbours && !far) region.room *= 0.5;
  region.center = x;
  if (far && known >= few_neighbours) {
    const double room = region.room;
    build(i, 2 * room);
    if (bodies_near(i) <= 2 * known) return true;
    region.room = room;
  }
  const double least = std::max(least_room * world_.radius[i], rounding_at(x, world_.radius[i]));
  for (;;) {
    build(i, region.room);
    if (bodies_near(i) <= 2 * many_neighbours || region.room <= least) return far && known >= few_neighbours;
    region.room *= 0.5;
  }
}

void Neighbours::cover(Entity i, const Vec3& x, double reach, const Vec3& drift) {
  const std::size_t known = bodies_near(i);
  double room = region_[i].room;
  if (known < few_neighbours) room *= 2;
  if (known > many_neighbours) room *= 0.5;
  const double far = drift.cwiseAbs().maxCoeff();
  for (;; room *= 0.5) {
    const bool least = room <= 1.5 * reach;
    if (least) room = 1.5 * reach;
    const double ahead = std::min(0.99 * (room - reach), far);
    region_[i].center = ahead > 0 ? Vec3(x + ahead / far * drift) : x;
    build(i, room);
    if (least || bodies_near(i) <= 2 * many_neighbours || region_[i].room > room) return;
  }
}

}  // namespace carom
