#pragma once
// The one interface to all engines that carry a World forward in time. A run calls it for each output time, never for
// each event.

#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/extremes.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "physics/world_region.h"
#include "simulate/simulation_error.h"
#include "std.h"

namespace carom {

/// The work of a simulator so far. Results do not depend on it.
struct Effort {
  uint64_t pair_tests = 0;     // computed times of impact of pairs of bodies
  uint64_t surface_tests = 0;  // computed times of impact of bodies and fixed surfaces
  uint64_t events = 0;         // taken from the queue
  uint64_t regions = 0;        // bodies that left their region, a part of the events
  // Steps of islands along paths with an error beyond rounding, which a smaller error of each step reduces.
  uint64_t inexact_steps = 0;
  double next = infinity;  // s, time of the next event; infinite: there is none
};

/// Carries a World forward from its initial State. Queries never change the motion.
class Simulator {
 public:
  virtual ~Simulator() = default;

  /// Advances to `time` (s), or less far if the collision buffer is full or many events have passed.
  /// Call it again while time() < `time`. Throws SimulationError.
  /// A run that has ended, as the tally says, stands still: only time() goes on.
  virtual void advance_to(double time) = 0;
  virtual double time() const = 0;   // s
  virtual const State& state() = 0;  // at time(), or at the run's end; valid until the next advance_to
  /// Collisions since the last advance_to, in order. Empty if they are not recorded.
  virtual span<const Collision> collisions() const = 0;
  /// Pieces of paths since the last advance_to, in order. Before the first advance these are the paths at time 0. Empty
  /// if they are not recorded.
  virtual span<const PathPiece> paths() const { return {}; }
  /// Crossings of the World's regions since the last advance_to, by time, then region, then body. All are recorded. The
  /// first advance has those at time 0.
  virtual span<const RegionCrossing> crossings() const { return {}; }
  virtual const Tally& tally() const = 0;  // up to time()
  /// The extremes of the watched quantities from time 0 to time(), in the order in which they are watched.
  virtual vector<Extremes> extremes() const { return {}; }
  /// The sums of impulses (N s) that are watched over the run, in the order in which they are watched. To be called at
  /// its end: before, the present steps of crowds are missing.
  virtual vector<double> impulses() const { return {}; }
  virtual Effort effort() const { return {}; }  // up to the present; zero where it is not counted
  /// At time(), ordered by a, then b. Valid until the next advance_to.
  virtual span<const ContactForce> contacts() { return {}; }

  /// The whole state at time(), with what has been recorded since the last advance_to. Only this version of the program
  /// reads the bytes, on a processor of this kind. Saving changes nothing. Empty: it cannot be saved.
  virtual string save() { return {}; }
  /// Takes that state over. The simulator then goes on with the same bits as the one that was saved. It must be newly
  /// made, from the same World, State and options. Throws ArchiveError where the bytes do not fit. The simulator is
  /// then of no more use.
  virtual void restore(string_view /*bytes*/) { throw SimulationError("this simulator cannot be restored"); }
};

}  // namespace carom
