#pragma once
// What a view of a motion is to hold.

#include "physics/state.h"
#include "physics/world_now.h"
#include "render/frustum.h"
#include "render/model.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// A motion as it is collected, instant by instant, for a view in one of two directions. The view is to hold:
///
/// All bodies at all instants, unless they fly away for ever. A body flies away from the instant on after which its
/// distance from the middle of all bodies at the first instant only grows. At least half of the bodies stay in view to
/// the end, those that get least far. So does each of the others, unless the view would become more than twice as wide
/// as with that half alone, and half of the bodies lower than a hundredth of it.
///
/// Walls and obstacles that bodies meet or pass, unless they are larger than the motion. Of larger ones, and of planes,
/// the part at the bodies. Of a floor below, the point under the motion's middle, unless that is farther away than
/// three times the size of the motion. The points that visible strings hang from.
class MotionView {
 public:
  struct Content {
    array<Frustum::Reach, 2> reach;  // by direction
    Extent bodies;                   // or without them all
    Extent near;                     // around all that the bodies met or passed within their own size
    bool empty() const { return reach[0].empty(); }
    void add(const Content& other);
  };

  /// `scene` must outlive this object.
  MotionView(const Scene& scene, const array<Frustum, 2>& directions)
      : scene_(scene), known_(scene.world), world_(known_.at({})), directions_(directions) {}

  /// Takes the next instant in order.
  void add(const State& state);
  /// For the view in one of the directions. Without bodies, the fixed things.
  Content content(size_t direction) const;

  const Frustum& direction(size_t i) const { return directions_[i]; }

 private:
  /// A body since the last instant at which it came no farther.
  struct Departure {
    Content content;
    double distance2 = -1;  // m^2, from the middle, at the previous instant; negative: there was none
  };

  void add(Content& content, const Vec3& position, const Volume& volume) const;
  Content without_the_leaving(const Frustum& frustum, size_t direction) const;
  void add_surroundings(Content& content) const;
  vector<Vec3> places_of(Entity fixed) const;
  void add_fixed_things(Content& content) const;

  const Scene& scene_;
  WorldNow known_;
  const World& world_;  // with the times that events have set
  array<Frustum, 2> directions_;
  Vec3 middle_ = Vec3::Zero();    // m, of all bodies at the first instant
  double start_ = 0, time_ = 0;   // s, of the first and of the previous instant
  Content core_;                  // all but the departures
  vector<Departure> departures_;  // by body; empty before the first instant
};

}  // namespace carom
