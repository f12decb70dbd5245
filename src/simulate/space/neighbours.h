#pragma once
// Which bodies may meet soon. A body has a region: a ball that its centre does not leave without an event. Bodies are
// neighbours if their regions are so near that they may touch, unless they pass through each other. Surfaces within its
// region are neighbours of a body too.
// The method is that of near-neighbour lists (Donev, Torquato & Stillinger, J. Comput. Phys. 202 (2005) 737). A region
// with few neighbours grows, so that a ball that flies off costs little, however far it goes. Results must not depend
// on extra neighbours, nor on the order of lists.

#include "numerics/large_pages.h"
#include "numerics/prefetch.h"
#include "physics/world.h"
#include "simulate/space/list_pool.h"
#include "simulate/space/region.h"
#include "simulate/space/region_grid.h"
#include "simulate/space/surfaces_near.h"
#include "std.h"

namespace carom {

class Neighbours {
 public:
  /// `world` must outlive this object.
  explicit Neighbours(const World& world);

  /// Places all bodies at once, at their positions at the start (m), but for those that come later.
  void start(const vector<Vec3>& x);
  /// Places a body that comes later at x (m). The caller must examine its neighbours.
  void admit(Entity i, const Vec3& x);

  /// Bodies that body i may meet within its region, and surfaces.
  span<const Entity> bodies(Entity i) const { return near(i).first(lists_[i].count - lists_[i].surfaces); }
  span<const Entity> surfaces(Entity i) const { return near(i).last(lists_[i].surfaces); }
  /// Bodies and surfaces.
  span<const Entity> near(Entity i) const { return {pool_.data(lists_[i]), lists_[i].count}; }

  /// The centre of body i's region (m), and how far the body's centre may go from there (m).
  Vec3 center(Entity i) const {
    const Region& r = region_[i];
    return origin_ + unit_ * Vec3(r.x, r.y, r.z);
  }
  double room(Entity i) const { return unit_ * sure(region_[i].half) - world_.radius[i]; }

  /// Prefetches the data of body i's neighbours.
  void prefetch_header(Entity i) const { prefetch(&lists_[i]); }
  void prefetch_list(Entity i) const {
    const uint32_t* const list = pool_.data(lists_[i]);
    for (uint32_t k = 0; k < lists_[i].count; k += 16) prefetch(list + k);
  }
  void prefetch_region(Entity i) const { prefetch(&region_[i]); }

  /// Makes a new region for a body at x (m), wider where few bodies are near and narrower where many are.
  /// `ahead`: the path on which its middle may be (m). A body that has left several regions on one path gets a wider
  /// one.
  /// Returns the bodies that are new in the list, valid until regions change.
  span<const Entity> renew(Entity i, const Vec3& x, const Vec3& ahead);
  /// Registers that body i has a new path.
  void turned(Entity i) { lists_[i].left = 0; }

  /// Makes a narrower region, about x.
  void shrink(Entity i, const Vec3& x);

  /// Makes a region for a body that stays about x (m). It extends at least `reach` (m) from there, and not much
  /// farther. Two bodies that both reach half of a gap are neighbours. The caller must examine the bodies that are new
  /// in the list.
  void stay(Entity i, const Vec3& x, double reach);

  /// Frees memory that lists have left. Call it from time to time, when no list is being read.
  void tidy();

  /// Removes body i.
  void remove(Entity i);

  template <typename Archive>
  void keep(Archive& archive) {
    archive.same(origin_, unit_);
    archive.sized(region_);
    archive(grid_);

    // Lists, not their places in the pool.
    for (Entity i = 0; i < lists_.size(); ++i) {
      NeighbourList& list = lists_[i];
      vector<Entity> all(near(i).begin(), near(i).end());
      uint32_t surfaces = list.surfaces, left = list.left;
      archive(list.level, all, surfaces, left);
      if constexpr (Archive::reads) {
        pool_.reserve(list, all.size());
        ranges::copy(all, pool_.data(list));
        list.count = uint32_t(all.size());
        list.surfaces = surfaces & 0xFFFFFF;
        list.left = left & 0xFF;
      }
    }
  }

 private:
  /// The neighbours of a body: bodies, then surfaces.
  struct NeighbourList : ListPool::List {
    int16_t level = 0;           // of its region's half width
    uint32_t surfaces : 24 = 0;  // at the list's end
    uint32_t left : 8 = 0;       // regions on its path, up to many
  };
  static_assert(sizeof(NeighbourList) == 16);

  Region around(const Vec3& x, int level) const;
  double rounding_at(Entity i, const Vec3& x) const;
  int level_for(Entity i, const Vec3& x, double room) const;
  void find(Entity i, const Region& region);
  [[gnu::noinline]] size_t keep_those_met(Entity i, vector<Entity>& found, size_t count) const;
  void write(Entity i);
  void add(Entity j, Entity i);
  void drop(Entity j, Entity i);
  void settle(Entity i, const Region& region, int level);
  void settle_down(Entity i, const Vec3& x, const Vec3& ahead, int level);

  const World& world_;
  const bool some_pass_;        // some pairs pass through each other: they are no neighbours
  Vec3 origin_ = Vec3::Zero();  // m
  double unit_ = 1;             // m; regions are in units of it, from origin_
  LargeVector<Region> region_;
  ListPool pool_;
  LargeVector<NeighbourList> lists_;
  RegionGrid grid_;
  SurfacesNear surfaces_;
  // Scratch. The first three are longer than their contents.
  vector<Entity> found_, came_, gone_, found_surfaces_;
  size_t found_count_ = 0, came_count_ = 0;
};

}  // namespace carom
