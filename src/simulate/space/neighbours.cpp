// Near-neighbour lists (Donev, Torquato & Stillinger, J. Comput. Phys. 202 (2005) 737) on a grid without bounds
// (region_grid.h). A list is valid until its body leaves its region, so that a body that flies far alone costs little.
// A grid of fixed cells would cost an event for each cell. The size of a region adapts to the number of bodies in it.
#include "simulate/space/neighbours.h"

#include "physics/body_now.h"
#include "physics/restitution.h"
#include "simulate/space/touching.h"
#include "std.h"

namespace carom {

namespace {

// The number of neighbours for which a region is sized. With fewer it grows, and is left less often.
constexpr size_t few_neighbours = 7;
// With more it shrinks, and needs fewer pair tests.
constexpr size_t many_neighbours = 40;
// A body that leaves several regions in a row without an event may have more than a few.
constexpr size_t many_on_the_way = 16;
constexpr int wider = 2;  // levels, of a quarter octave
// The first room of a region, as a share of the radius.
constexpr double first_room = 1;
// The least room, as a share of the radius.
constexpr double least_room = 0.02;
// The limit of positions, in units of unit_. Beyond it all bodies are neighbours.
constexpr double farthest = 0x1p+60;

}  // namespace

Neighbours::Neighbours(const World& world)
    : world_(world),
      some_pass_(some_pass(world)),
      region_(world.body_count()),
      lists_(world.body_count()),
      surfaces_(world) {}

void Neighbours::start(const vector<Vec3>& x) {
  const Entity n = world_.body_count();
  if (n == 0) return;
  Vec3 low = x[0];
  Vec3 high = x[0];
  for (const Vec3& at : x) {
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }

  // Most regions are then the widest of an octave.
  unit_ = (1 + first_room) * (1 + 0x1p-18) * median_radius(world_);
  origin_ = 0.5 * low + 0.5 * high;
  grid_.start(around(low, 0), around(high, 0));

  vector<pair<int, size_t>> expected;  // regions, by level
  for (Entity i = 0; i < n; ++i) {
    if (world_.comes_later(i)) continue;
    const int level = level_for(i, x[i], first_room * world_.radius[i]);
    region_[i] = around(x[i], level);
    lists_[i].level = int16_t(level);
    const auto known = ranges::find_if(expected, [&](const auto& e) { return e.first == level; });
    known == expected.end() ? (void)expected.emplace_back(level, 1) : (void)++known->second;
  }

  // All regions enter the grid before the first list is written.
  for (const auto& [level, regions] : expected) grid_.expect(level, regions);
  for (Entity i = 0; i < n; ++i)
    if (!world_.comes_later(i)) grid_.put(i, region_, lists_[i].level);
  for (Entity i = 0; i < n; ++i) {
    if (world_.comes_later(i)) continue;
    find(i, region_[i]);
    write(i);
  }

  // Crowded regions shrink.
  for (Entity i = 0; i < n; ++i)
    if (bodies(i).size() > 2 * many_neighbours) shrink(i, x[i]);
}

void Neighbours::admit(Entity i, const Vec3& x) {
  lists_[i].level = int16_t(level_for(i, x, first_room * world_.radius[i]));
  region_[i] = around(x, lists_[i].level);
  grid_.put(i, region_, lists_[i].level);
  find(i, region_[i]);
  for (size_t k = 0; k < found_count_; ++k) add(found_[k], i);
  write(i);
}

Region Neighbours::around(const Vec3& x, int level) const {
  const Vec3 p = ((x - origin_) / unit_).cwiseMax(-farthest).cwiseMin(farthest);
  return {float(p.x()), float(p.y()), float(p.z()), half_of_level(level)};
}

/// The room that rounding needs at x (m), in m.
double Neighbours::rounding_at(Entity i, const Vec3& x) const {
  return 0x1p-20 * ((x - origin_).cwiseAbs().maxCoeff() + world_.radius[i]);
}

/// The level that gives body i at x (m) this room (m), and at least that for rounding.
int Neighbours::level_for(Entity i, const Vec3& x, double room) const {
  const Vec3 outside = ((x - origin_).cwiseAbs() - Vec3::Constant(farthest * unit_)).cwiseMax(0);
  const double room_of_all = max({room, least_room * world_.radius[i], rounding_at(i, x)}) + 2 * outside.norm();
  return clamp(level_of_half((room_of_all + world_.radius[i]) / unit_), -400, widest_level);
}

/// Stores in found_ the bodies that may touch body i in this region.
void Neighbours::find(Entity i, const Region& region) {
  const size_t candidates = grid_.near(region, found_);
  found_count_ = select_touching(region, region_.data(), found_.data(), candidates, true, found_.data());
  const auto end = found_.begin() + ptrdiff_t(found_count_), own = std::find(found_.begin(), end, i);
  if (own != end) *own = found_[--found_count_];
  if (some_pass_) [[unlikely]]
    found_count_ = keep_those_met(i, found_, found_count_);
}

/// Moves those that body i does not pass through to the front of the first `count` in `found`. Returns their number.
size_t Neighbours::keep_those_met(Entity i, vector<Entity>& found, size_t count) const {
  const auto end = found.begin() + ptrdiff_t(count);
  return size_t(std::remove_if(found.begin(), end, [&](Entity e) { return !may_meet(world_, i, e); }) - found.begin());
}

void Neighbours::tidy() {
  if (!pool_.wasteful()) return;
  ListPool tidied;
  for (NeighbourList& list : lists_) tidied.copy(pool_, list);
  pool_ = std::move(tidied);
}

/// Writes the bodies that were found, and the surfaces near body i, to its list.
void Neighbours::write(Entity i) {
  NeighbourList& list = lists_[i];
  surfaces_.find(center(i), unit_ * double(region_[i].half), found_surfaces_);
  if (some_pass_) [[unlikely]]
    found_surfaces_.resize(keep_those_met(i, found_surfaces_, found_surfaces_.size()));
  pool_.reserve(list, found_count_ + found_surfaces_.size());
  uint32_t* const to = pool_.data(list);
  std::copy_n(found_surfaces_.begin(), found_surfaces_.size(), std::copy_n(found_.begin(), found_count_, to));
  list.surfaces = uint32_t(found_surfaces_.size()) & 0xFFFFFF;
  list.count = uint32_t(found_count_ + found_surfaces_.size());
}

/// Adds i to body j's list.
void Neighbours::add(Entity j, Entity i) {
  NeighbourList& list = lists_[j];
  pool_.push_back(list, i);
  if (const uint32_t surfaces = list.surfaces; surfaces > 0) {
    uint32_t* const of = pool_.data(list);
    std::swap(of[list.count - 1 - surfaces], of[list.count - 1]);
  }
}

/// Removes i from body j's list.
void Neighbours::drop(Entity j, Entity i) {
  NeighbourList& list = lists_[j];
  uint32_t* const of = pool_.data(list);
  const uint32_t last = --list.count - list.surfaces;
  *pool_.find(list, i) = of[last];
  of[last] = of[list.count];
}

/// Gives body i a new region, with its bodies in found_. Updates the lists of bodies that enter and leave its
/// neighbourhood.
void Neighbours::settle(Entity i, const Region& region, int level) {
  const Region old = region_[i];
  const span<const Entity> known = bodies(i);

  // Bodies that are no longer near lose body i from their lists.
  gone_.resize(max(gone_.size(), known.size() + select_slack));
  const size_t gone = select_touching(region, region_.data(), known.data(), known.size(), false, gone_.data());
  for (size_t k = 0; k < gone; ++k) prefetch(pool_.data(lists_[gone_[k]]));
  for (size_t k = 0; k < gone; ++k) drop(gone_[k], i);

  // Bodies that were not near before receive it.
  came_.resize(max(came_.size(), found_count_ + select_slack));
  came_count_ = select_touching(old, region_.data(), found_.data(), found_count_, false, came_.data());
  for (size_t k = 0; k < came_count_; ++k) prefetch(pool_.data(lists_[came_[k]]) + lists_[came_[k]].count);
  for (size_t k = 0; k < came_count_; ++k) add(came_[k], i);

  region_[i] = region;
  grid_.move(i, old, lists_[i].level, region_, level);
  lists_[i].level = int16_t(level);
  write(i);
}

/// Takes the widest region from this level down that does not contain too many bodies.
void Neighbours::settle_down(Entity i, const Vec3& x, const Vec3& ahead, int level) {
  const double enough = max(least_room * world_.radius[i], rounding_at(i, x));
  const double far = ahead.norm();

  for (;; level -= wider) {
    double room = unit_ * sure(half_of_level(level)) - world_.radius[i];
    const bool least = !(room >= enough);
    if (least) {
      level = level_for(i, x, 0);
      room = unit_ * sure(half_of_level(level)) - world_.radius[i];
    }

    // The region lies ahead, as far as its room allows.
    const double share = far > 0 && room > 0 ? min(1.0, 0.9 * room / far) : 0;
    const Region region = around(x + share * ahead, level);
    find(i, region);
    if (found_count_ <= 2 * many_neighbours || least) return settle(i, region, level);
  }
}

span<const Entity> Neighbours::renew(Entity i, const Vec3& x, const Vec3& ahead) {
  constexpr uint32_t several = 4;
  const bool often = lists_[i].left == several;
  if (!often) lists_[i].left = (lists_[i].left + 1) & 0xFF;
  const size_t known = bodies(i).size();
  int level = lists_[i].level;
  if (known < few_neighbours || (often && known < many_on_the_way)) level += wider;
  if (known > (often ? 2 * many_neighbours : many_neighbours)) level -= wider;
  settle_down(i, x, ahead, level);
  return {came_.data(), came_count_};
}

void Neighbours::shrink(Entity i, const Vec3& x) {
  settle_down(i, x, Vec3::Zero(), lists_[i].level - wider);
}

void Neighbours::stay(Entity i, const Vec3& x, double reach) {
  const int level = level_for(i, x, 2 * reach);
  const double left = room(i) - (x - center(i)).norm();
  if (left >= reach && lists_[i].level <= level + wider) return;
  const Region region = around(x, level);
  find(i, region);
  settle(i, region, level);
}

void Neighbours::remove(Entity i) {
  for (const Entity j : bodies(i)) drop(j, i);
  lists_[i].count = 0;
  lists_[i].surfaces = 0;
  grid_.remove(i, region_[i], lists_[i].level);
}

}  // namespace carom
