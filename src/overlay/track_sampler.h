#pragma once
// The recent paths of bodies from states, for motions without recorded paths.
#include <span>
#include <vector>

#include "overlay/tracks.h"
#include "physics/collision.h"
#include "physics/state.h"

namespace carom {

struct World;

class TrackSampler {
 public:
  /// Adds to `tracks`. `world` and `tracks` must outlive this object. `seconds`: the length of the tracks.
  TrackSampler(const World& world, Tracks& tracks, double seconds);

  double next() const { return next_; }  // s: take a state at this time or before
  /// Takes the collisions since the last state, in order.
  void record(std::span<const Collision> collisions);
  /// Adds the paths since the last state.
  void sample(const State& state);

 private:
  struct Known {
    Vec3 x, v, a;                 // at the last state
    std::vector<double> impacts;  // s, times of collisions since then
    bool ended = false;           // has become part of another body
  };

  void add_path(Entity body, Known& known, double time, const Vec3& x, const Vec3& v, const Vec3& a);

  const World& world_;
  Tracks& tracks_;
  double seconds_;
  bool started_ = false;
  double time_ = 0, next_ = 0;  // s
  std::vector<Known> known_;    // by body
};

}  // namespace carom
