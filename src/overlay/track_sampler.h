#pragma once
// The recent paths of bodies from states, for motions without recorded paths.

#include "overlay/tracks.h"
#include "physics/collision.h"
#include "physics/state.h"
#include "std.h"

namespace carom {

struct World;

class TrackSampler {
 public:
  /// Adds to `tracks`. `world` and `tracks` must outlive this object. `seconds`: the length of the tracks.
  TrackSampler(const World& world, Tracks& tracks, double seconds);

  double next() const { return next_; }  // s: take a state at this time or before
  /// Takes the collisions since the last state, in order.
  void record(span<const Collision> collisions);
  /// Adds the paths since the last state of its own times next(). Those until another time are replaced by the next
  /// call, so that paths do not depend on the times of pictures.
  void sample(const State& state);

 private:
  struct Known {
    Vec3 x, v, a;            // at the last state of an own time
    vector<double> impacts;  // s, times of collisions since then
    bool ended = false;      // has become part of another body
    size_t tip = 0;          // pieces until a time that is not an own one
  };

  /// What forces between bodies do to one of them now.
  struct CouplingNow {
    Vec3 acceleration = Vec3::Zero();  // m/s^2
    double rate = 0;                   // 1/s, at which it changes
  };

  vector<CouplingNow> couplings_now(const State& state) const;
  /// Returns the number of pieces. `ends`: the body has become part of another.
  size_t add_path(Entity body, const Known& known, double time, const Known& now, bool ends);

  const World& world_;
  Tracks& tracks_;
  double seconds_;
  bool started_ = false;
  double time_ = 0, next_ = 0;  // s
  vector<Known> known_;         // by body
};

}  // namespace carom
