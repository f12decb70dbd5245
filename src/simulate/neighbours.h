#pragma once
// Who may meet whom soon. A body lives in a region, a box that it cannot leave unnoticed; bodies whose regions overlap
// know each other, and so do a body and the surfaces within its region (near-neighbour lists: Donev, Torquato &
// Stillinger, J. Comput. Phys. 202 (2005) 737). A region grows while it is lonely, so a ball that flies off costs
// little, however far it goes. Results must not depend on who is listed beyond those that meet, nor on the lists'
// order.
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/world.h"
#include "simulate/region_grid.h"

namespace carom {

class Neighbours {
 public:
  struct Region {
    Vec3 center = Vec3::Zero();  // m
    double room = 0;             // m, how far the body's centre may go from the region's, along each axis
    double half = 0;             // m, half width: room and radius
  };

  /// `world` must outlive this.
  explicit Neighbours(const World& world);

  /// All bodies at once, where they are at the start (m).
  void start(const std::vector<Vec3>& x);

  /// Bodies and surfaces that body i may meet within its region.
  const std::vector<Entity>& near(Entity i) const { return near_[i]; }
  const Region& region(Entity i) const { return region_[i]; }

  /// Whether a body has come to body i's list since this was asked last.
  bool has_news(Entity i) { return std::exchange(news_[i], 0) != 0; }

  /// A new region about x (m), wider where few are near and narrower where many are. `far`: the body goes a long way;
  /// it gets a wider one than that if that costs no more. Whether it did.
  bool renew(Entity i, const Vec3& x, bool far);

  /// A new region for a body at x (m) that may go as far as `reach` (m) along each axis, and whose way later leads
  /// along `drift` (m): it lies ahead, as far as drift goes, so that it is left late.
  void cover(Entity i, const Vec3& x, double reach, const Vec3& drift);

  /// Half the room, about x.
  void shrink(Entity i, const Vec3& x) {
    region_[i].room *= 0.5;
    renew(i, x, false);
  }

  /// Body i is no more.
  void remove(Entity i) {
    forget(i);
    grid_.remove(i);
  }

 private:
  void forget(Entity i);
  void find(Entity i);
  void build(Entity i, double room);
  std::size_t bodies_near(Entity i) const;

  const World& world_;
  std::vector<Region> region_;
  std::vector<std::vector<Entity>> near_;
  std::vector<std::uint8_t> news_;
  RegionGrid grid_;
};

}  // namespace carom
