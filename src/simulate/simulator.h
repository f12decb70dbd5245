#pragma once
// The one interface to all engines that carry a World forward in time. Crossed once per output time, never per event.
#include <cstdint>
#include <limits>
#include <span>

#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "simulate/simulation_error.h"

namespace carom {

/// What a simulator did to get where it is. Results do not depend on it.
struct Effort {
  std::uint64_t pair_tests = 0;                           // pairs of bodies asked when they meet
  std::uint64_t surface_tests = 0;                        // bodies asked when they meet a fixed surface
  std::uint64_t events = 0;                               // taken from the queue, and
  std::uint64_t regions = 0;                              // of these, bodies that left their region
  double next = std::numeric_limits<double>::infinity();  // s, when the next one is scheduled; infinite: there is none
};

/// Carries a World forward from its initial State. Asking never changes what happens next.
class Simulator {
 public:
  virtual ~Simulator() = default;

  /// Goes on to `time` (s), or less far: until the collision buffer is full, or many events have passed. Call again
  /// while time() < `time`. Throws SimulationError.
  virtual void advance_to(double time) = 0;
  virtual double time() const = 0;   // s
  virtual const State& state() = 0;  // at time(); valid until the next advance_to
  virtual std::span<const Collision> collisions()
      const = 0;  // since the last advance_to, in order; empty if not recorded
  /// Since the last advance_to, those of its bodies' paths at time 0 before the first; in order; empty if not recorded.
  virtual std::span<const PathPiece> paths() const { return {}; }
  virtual const Tally& tally() const = 0;                          // up to time()
  virtual Effort effort() const { return {}; }                     // up to now; zero where it is not counted
  virtual std::span<const ContactForce> contacts() { return {}; }  // at time(), by a, then b; until the next advance_to
};

}  // namespace carom
