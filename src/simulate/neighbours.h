#pragma once
// Who may meet whom soon. A body lives in a region, a ball that its centre cannot leave unnoticed; bodies whose regions
// are near enough for them to touch know each other, and so do a body and the surfaces within its region
// (near-neighbour lists: Donev, Torquato & Stillinger, J. Comput. Phys. 202 (2005) 737). A region grows while it is
// lonely, so a ball that flies off costs little, however far it goes. Results must not depend on who is listed beyond
// those that meet, nor on the lists' order.
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/prefetch.h"
#include "physics/world.h"
#include "simulate/large_pages.h"
#include "simulate/list_pool.h"
#include "simulate/region.h"
#include "simulate/region_grid.h"
#include "simulate/surfaces_near.h"

namespace carom {

class Neighbours {
 public:
  /// `world` must outlive this.
  explicit Neighbours(const World& world);

  /// All bodies at once, where they are at the start (m).
  void start(const std::vector<Vec3>& x);

  /// Bodies that body i may meet within its region, and surfaces.
  std::span<const Entity> bodies(Entity i) const { return near(i).first(known_[i].count - known_[i].surfaces); }
  std::span<const Entity> surfaces(Entity i) const { return near(i).last(known_[i].surfaces); }
  /// Both.
  std::span<const Entity> near(Entity i) const { return {pool_.data(known_[i]), known_[i].count}; }

  /// m, where body i's region is, and how far the body's centre may go from there.
  Vec3 center(Entity i) const {
    const Region& r = region_[i];
    return origin_ + unit_ * Vec3(r.x, r.y, r.z);
  }
  double room(Entity i) const { return unit_ * sure(region_[i].half) - world_.radius[i]; }

  /// Asks memory for who is near body i, and for what is known of them.
  void prefetch_known(Entity i) const { prefetch(&known_[i]); }
  void prefetch_list(Entity i) const {
    const std::uint32_t* const list = pool_.data(known_[i]);
    for (std::uint32_t k = 0; k < known_[i].count; k += 16) prefetch(list + k);
  }
  void prefetch_region(Entity i) const { prefetch(&region_[i]); }

  /// A new region for a body at x (m), wider where few are near and narrower where many are. `ahead`: m, the path on
  /// which its middle may be. One that has left several on one path gets a wider one. Gives who has come to the list,
  /// valid until regions change.
  std::span<const Entity> renew(Entity i, const Vec3& x, const Vec3& ahead);
  /// Body i goes another path from now on.
  void turned(Entity i) { known_[i].left = 0; }

  /// A narrower region, about x.
  void shrink(Entity i, const Vec3& x);

  /// A region for a body that stays about x (m): it reaches `reach` (m) from there at least, and not much farther.
  /// Bodies that both reach half of a gap know each other. Who comes to the list is for the caller to look at.
  void hold(Entity i, const Vec3& x, double reach);

  /// Now and then, when no list is being read: what lists have left behind is given back.
  void tidy();

  /// Body i is no more.
  void remove(Entity i);

 private:
  /// Who is near a body: bodies, then surfaces.
  struct Known : ListPool::List {
    std::int16_t level = 0;           // of its region's half width
    std::uint32_t surfaces : 24 = 0;  // at the list's end
    std::uint32_t left : 8 = 0;       // regions on its path, up to many
  };
  static_assert(sizeof(Known) == 16);

  Region around(const Vec3& x, int level) const;
  double rounding_at(Entity i, const Vec3& x) const;
  int level_for(Entity i, const Vec3& x, double room) const;
  void find(Entity i, const Region& region);
  void write(Entity i);
  void add(Entity j, Entity i);
  void drop(Entity j, Entity i);
  void settle(Entity i, const Region& region, int level);
  void settle_down(Entity i, const Vec3& x, const Vec3& ahead, int level);

  const World& world_;
  Vec3 origin_ = Vec3::Zero();  // m
  double unit_ = 1;             // m; regions are in units of it, from origin_
  LargeVector<Region> region_;
  ListPool pool_;
  LargeVector<Known> known_;
  RegionGrid grid_;
  SurfacesNear surfaces_;
  std::vector<Entity> found_, came_, gone_, found_surfaces_;  // scratch, the first three longer than what they hold
  std::size_t found_count_ = 0, came_count_ = 0;
};

}  // namespace carom
