#pragma once
// Repeats a run from its recorded paths: the same states, bit for bit, without simulating.

#include "physics/closed_motion.h"
#include "physics/recorded.h"
#include "physics/world_now.h"
#include "simulate/path/instant.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

class FlightsReader;
struct World;

/// Reads the next part of a record, in order. False: the end. May throw.
using NextRecorded = function<bool(Recorded&)>;

/// A Simulator that follows recorded paths. It has no contact forces. Of collisions it knows time, kind and bodies, if
/// they are recorded.
class Replay final : public Simulator {
 public:
  /// `world` and `next` are those of one run, `tally` that of its end. `world` must outlive this object.
  /// counts: collisions are recorded, and the tally has those up to time().
  Replay(const World& world, NextRecorded next, const Tally& tally, bool counts = false);

  void advance_to(double time) override;  // never backwards
  double time() const override { return time_; }
  const State& state() override;
  span<const Collision> collisions() const override { return collisions_; }
  span<const PathPiece> paths() const override { return passed_; }
  /// Of the whole run, apart from counts, and the end, which is there once it is reached.
  const Tally& tally() const override { return tally_; }

 private:
  void take_coming();
  void take(const PathPiece& piece);
  void take_joint(const PathPiece& piece);
  Vec3 force_at(Entity body, double time, const Vec3& x, const Vec3& v) const;
  void place(size_t body, const Instant& at);

  WorldNow known_;  // with all times that events have set
  const World& world_;
  NextRecorded next_;
  Tally tally_;
  optional<RunEnd> end_;
  vector<PathPiece> now_;                  // the present piece, by body
  vector<optional<ClosedMotion>> closed_;  // by body; empty: no piece has been one
  // Since the last advance_to.
  vector<PathPiece> passed_;
  vector<Collision> collisions_;
  Recorded coming_;
  bool more_ = false;
  double time_ = 0;  // s
  State state_;
  bool fresh_ = false;
  // Once bodies have merged; empty before.
  vector<double> mass_, radius_;
  vector<Volume> volume_;
  vector<Entity> part_of_;
};

/// The motion of a record in a file. `world` is that of its run and must outlive the simulator, which throws
/// ExportError while it advances.
unique_ptr<Simulator> replay_from(unique_ptr<FlightsReader> reader, const World& world);

}  // namespace carom
