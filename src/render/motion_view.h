#pragma once
// What a view of a motion is to hold.

#include "render/frustum.h"
#include "render/model.h"
#include "render/motion_samples.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// What happens in a motion is its collisions. A view may hold these with the bodies that take part for some time
/// before and after, or the whole motion, which is:
///
/// All bodies at all instants, unless they fly away for ever. A body flies away from the instant on after which its
/// distance from the middle of all bodies at the first instant only grows. At least half of the bodies stay in view to
/// the end, those that get least far. So does each of the others, unless the view would become more than twice as wide
/// as with that half alone, and half of the bodies lower than a hundredth of it.
///
/// Besides, walls and obstacles that bodies meet or pass, unless they are larger than the motion. Of larger ones, and
/// of planes, the part at the bodies. Of a floor below, the point under the motion's middle, unless that is farther
/// away than three times the size of the motion. The points that visible strings and springs hang from.
class MotionView {
 public:
  struct Content {
    Frustum::Reach reach;
    Extent bodies;  // or without them all
    Extent near;    // around all that the bodies met or passed within their own size
    bool empty() const { return reach.empty(); }
    void add(const Content& other);
  };

  /// The scope of a view: the bodies in a time about their collisions. The last one is the whole motion.
  static constexpr array<double, 6> windows = {0.25, 0.5, 1, 2, 4, infinity};  // s of film before a collision
  static constexpr size_t whole = windows.size() - 1;

  /// `pace`: seconds of motion a second of film. `share`: what happens is the collisions nearest to their middle, which
  /// together have so much of all impulses. All must outlive this object.
  MotionView(const Scene& scene, const MotionSamples& samples, double pace, double share = 1);

  /// Whether nothing collides. All motion then counts as what happens.
  bool is_quiet() const { return quiet_; }
  /// Of the whole motion. Without bodies, the fixed things.
  Content all(const Frustum& frustum) const;
  /// Of the narrower scopes, ascending. Empty: nothing collides.
  array<Content, whole> parts(const Frustum& frustum) const;

  /// What a camera that goes along is to hold at an instant.
  struct Moment {
    Frustum::Reach reach;        // empty: nothing happens
    Vec3 middle = Vec3::Zero();  // m, of the bodies
  };
  /// By instant, with room around each body.
  vector<Moment> moments(const Frustum& frustum, size_t scope) const;

  /// A body as it collides.
  struct Strike {
    size_t instant, body;  // numbers in the samples
  };
  const vector<Strike>& strikes() const { return strikes_; }
  /// Whether a body is in scope at an instant.
  bool is_in(size_t scope, size_t instant, size_t i) const {
    return scope_[instant * samples_.bodies().size() + i] <= scope;
  }

 private:
  /// Where collisions count.
  struct Place {
    Vec3 middle = Vec3::Zero();  // m
    double reach2 = infinity;    // m^2
  };
  Place place_of(double share) const;
  void find_scopes(double pace, const Place& place);
  void find_departures();
  void add(Content& content, const Frustum& frustum, const Vec3& center, const Volume& volume) const;
  void add(Content& content, const Frustum& frustum, size_t instant, size_t i) const;
  Content without_the_leaving(const Frustum& frustum) const;
  void add_what_is_around(Content& content, const Frustum& frustum) const;
  void add_surroundings(Content& content, const Frustum& frustum) const;
  vector<Vec3> places_of(Entity fixed) const;
  void add_fixed_things(Content& content, const Frustum& frustum) const;
  void add_named_things(Content& content, const Frustum& frustum) const;

  const Scene& scene_;
  const MotionSamples& samples_;
  vector<uint8_t> scope_;     // the least that has it, by instant and body
  vector<size_t> departure_;  // by body: the first instant from which on it only goes farther
  vector<Strike> strikes_;    // if nothing collides, all bodies at all instants
  vector<Vec3> anchors_;      // m
  bool quiet_ = false;
  bool is_of_some_;  // the scene names what to frame
  double room_ = 0;  // m, around a body
};

}  // namespace carom
