#pragma once
// What pictures show of the past: collisions of each body, and paths. Only what a scene requests is kept.

#include "overlay/track_sampler.h"
#include "overlay/tracks.h"
#include "physics/collision.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "std.h"

namespace carom {

struct Scene;

/// What pictures need of a simulator besides states.
struct OverlayNeeds {
  bool collisions = false;        // each of them, recorded
  bool collision_counts = false;  // of the tally
  bool paths = false;             // recorded
  bool states = false;            // at times of History::next_sample(), because paths are not recorded
};
/// Of any picture of the scene.
OverlayNeeds picture_needs(const Scene& scene);
/// Of those that the scene requests; nothing, if it requests none.
OverlayNeeds overlay_needs(const Scene& scene);

class History {
 public:
  /// `scene` must outlive this object.
  History(const Scene& scene, const OverlayNeeds& needs);

  /// Take what has been recorded since the last call, in order.
  void record(span<const Collision> collisions);
  void record_paths(span<const PathPiece> pieces);
  /// The time (s) at which the next state is due, at the latest. Infinity: none.
  double next_sample() const;
  /// Takes a state. Call it before each picture, too.
  void sample(const State& state);

  /// Collisions of a body until `time` (s), which is no older than the trails.
  uint64_t collisions_of(Entity body, double time = infinity) const;
  /// The time (s) of a body's last collision. Minus infinity: none.
  double last_collision(Entity body) const { return last_.empty() ? no_collision : last_[body]; }
  /// Null: no trails are requested.
  const Tracks* tracks() const { return tracks_ ? &*tracks_ : nullptr; }

  static constexpr double no_collision = -infinity;

 private:
  void count(Entity body, double time);

  const Scene& scene_;
  OverlayNeeds needs_;
  vector<uint64_t> counts_;        // by body; empty: not needed
  vector<double> last_;            // s, by body; empty: not needed
  vector<vector<double>> recent_;  // s, by body, for trails with colours by collisions; empty: not needed
  optional<Tracks> tracks_;
  optional<TrackSampler> sampler_;
};

}  // namespace carom
