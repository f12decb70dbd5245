#pragma once
// The crossings of bodies and regions of the World. A body's next crossing is found when its path has changed, and
// counts when the body is sure to be across: beyond the boundary by more than rounding. Another change of the path
// before that withdraws it. A body thus enters and leaves by turns, and a body on the boundary does neither.
// Finding crossings changes nothing else.

#include "numerics/tournament.h"
#include "simulate/path/paths.h"
#include "std.h"

namespace carom {

class Crossings {
  struct Before {
    const Crossings* crossings;
    bool operator()(uint32_t i, uint32_t j) const { return crossings->before(i, j); }
  };

 public:
  /// `flight_end`: the latest end of a body's flight.
  Crossings(const BodyPaths& bodies, function<Instant(Entity)> flight_end);

  bool any() const { return !bodies_.world.regions.empty(); }
  void begin_advance();
  /// Finds body i's next crossings on its path from an instant on, at which everything has happened.
  void follow(Entity i, const Instant& from);
  /// Forgets body i, which has no path any more.
  void forget(Entity i);

  /// When the next crossing is sure. Infinite: there is none.
  Instant first_sure() const;
  /// A crossing, its instant, and when it was sure.
  struct Taken {
    RegionCrossing crossing;
    Instant at, sure;
  };
  /// Records the next crossing.
  Taken take() { return take(queue_->first()); }
  /// The same for one that is at `time` (s) at the latest, sure or not. None: there is no such crossing.
  optional<Taken> take_until(double time);
  /// The same for one of body i that is at the instant `last` at the latest.
  optional<Taken> take_of(Entity i, const Instant& last);

  /// Records that body i appears in the world at present.
  void note_appearance(Entity i) {
    recorded_.push_back({max(bodies_.now.hi, latest_), RegionCrossing::world, i, true});
  }

  /// Since the last begin_advance. Sorted by time, region and body after sort(), with
  /// appearances first.
  span<const RegionCrossing> recorded() const { return recorded_; }
  void sort();
  bool full() const { return recorded_.size() >= capacity; }

  void keep(auto& archive) {
    archive.sized(standing_);
    archive(next_, recorded_, latest_);
    if (queue_) archive(*queue_);
  }

 private:
  static constexpr size_t capacity = 4096;
  /// A body's standing towards a region.
  enum Standing : uint8_t { outside, inside, apart };
  struct Next {
    uint32_t region;
    Instant at, sure;

    void keep(auto& archive) { archive(region, at, sure); }
  };

  bool before(Entity i, Entity j) const;
  Standing& standing(uint32_t region, Entity i) { return standing_[region * bodies_.body.size() + i]; }
  void find(Entity i, uint32_t region, const Instant& from);
  void schedule(Entity i);
  Taken take(Entity i);

  const BodyPaths& bodies_;
  const function<Instant(Entity)> flight_end_;
  vector<Standing> standing_;           // by region, then body
  LazyArray<vector<Next>> next_;        // by body: the next crossing of each region, the first of them last
  optional<Tournament<Before>> queue_;  // none: there are no regions
  vector<RegionCrossing> recorded_;
  double latest_ = 0;  // s, of all before these
};

}  // namespace carom
