#pragma once
// Where bodies are at instants of a motion, and when they collide: what a camera that frames the motion goes by.
// Collisions are counted by instant and body, so that any number of them takes the same memory.

#include "physics/collision.h"
#include "physics/state.h"
#include "physics/world_now.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The number of evenly spaced instants that are worth collecting of so many bodies.
int64_t worthwhile_instants(Entity bodies);

class MotionSamples {
 public:
  /// `scene` must outlive this object. Of a camera that frames certain things, the bodies among them alone count.
  explicit MotionSamples(const Scene& scene);

  /// Takes what happened since the last instant, in order. A body may come to rest without any notice.
  void strike(span<const Collision> collisions);
  /// Takes the next instant in order.
  void add(const State& state);

  size_t instants() const { return times_.size(); }
  double time(size_t instant) const { return times_[instant]; }  // s
  const vector<Entity>& bodies() const { return bodies_; }
  /// With the times that events have set so far.
  const World& world() const { return world_; }

  // By instant, and by number in bodies().
  bool is_there(size_t instant, size_t i) const { return of(instant, i).scale > 0; }
  /// m, of its centre. Where it has collided since the instant before, the place of that.
  const Vec3& center(size_t instant, size_t i) const { return of(instant, i).center; }
  Volume volume(size_t instant, size_t i) const;
  /// What its collisions since the instant before have changed of its momentum, about (N s). Negative: there were none.
  double impulse(size_t instant, size_t i) const { return double{impulses_[instant * bodies_.size() + i]}; }

 private:
  struct Sample {
    Vec3 center;
    double scale;  // of its volume; 0: it is not there
  };
  const Sample& of(size_t instant, size_t i) const { return samples_[instant * bodies_.size() + i]; }
  bool may_go_back(const State& state, Entity body, double time) const;

  const Scene& scene_;
  WorldNow known_;
  const World& world_;
  bool flies_freely_;  // gravity alone acts between collisions
  vector<Entity> bodies_;
  vector<double> times_, struck_;  // struck_: s, of the last collision of each body
  vector<Vec3> velocities_;        // m/s, at the last instant
  vector<Sample> samples_;
  vector<float> impulses_;
};

}  // namespace carom
