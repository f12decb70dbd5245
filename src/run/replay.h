#pragma once
// Repeats a run from its recorded paths: the same states, bit for bit, without simulating.
#include <functional>
#include <vector>

#include "physics/path_piece.h"
#include "simulate/simulator.h"

namespace carom {

struct World;

/// Reads the next piece of a record, in order. False: the end. May throw.
using NextPiece = std::function<bool(PathPiece&)>;

/// A Simulator that follows recorded paths. It has no collisions and no contact forces.
class Replay final : public Simulator {
 public:
  /// `world` and `next` are those of one run, `tally` that of its end. `world` must outlive this object.
  Replay(const World& world, NextPiece next, const Tally& tally);

  void advance_to(double time) override;  // never backwards
  double time() const override { return time_; }
  const State& state() override;
  std::span<const Collision> collisions() const override { return {}; }
  std::span<const PathPiece> paths() const override { return passed_; }
  const Tally& tally() const override { return tally_; }  // of the whole run

 private:
  void take(const PathPiece& piece);

  const World& world_;
  NextPiece next_;
  Tally tally_;
  std::vector<PathPiece> now_;     // the present piece, by body
  std::vector<PathPiece> passed_;  // since the last advance_to
  PathPiece coming_;
  bool more_ = false;
  double time_ = 0;  // s
  State state_;
  bool fresh_ = false;
  // Once bodies have merged; empty before.
  std::vector<double> mass_, radius_;
  std::vector<Volume> volume_;
  std::vector<Entity> part_of_;
};

}  // namespace carom
