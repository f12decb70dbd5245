#pragma once
// The exact simulator. It goes from event to event along paths in closed form, or along a method's steps. See
// exact_simulator.h.

#include "physics/contact_quality.h"
#include "physics/integrator.h"
#include "physics/watched_impulse.h"
#include "simulate/simulator.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

struct World;

struct ExactOptions {
  double duration = 0;  // s; no later event is scheduled
  // m/s; slower impacts under load end in resting contact; 0: depends on the case (exact_bodies.h).
  double rest_speed = 0;
  uint64_t max_collisions = 0;  // limit, an error beyond it; 0: no limit
  // The method for free flights without a closed form; except with dop853, for all flights that bend.
  Integrator integrator = Integrator::dop853;
  // s: with dop853 the longest step; steps of other methods end at its multiples.
  double step = infinity;
  // Of dop853, as a share of a radius and of speeds. In islands it is never greater than the default.
  double step_error = exact_tolerance::step_error;
  // false: dop853 computes all flights that bend.
  bool closed_forms = true;
  const ContactQuality* quality = &quality_of(QualityLevel::normal);  // of crowds
  int threads = 1;                                                    // of crowds; they change no result
  bool merge = false;                                                 // bodies that meet become one
  bool one_by_one = false;        // impacts of one instant act one after the other, the fastest first
  bool record_collisions = true;  // false: there is no buffer, and collisions() stays empty
  bool record_paths = false;      // false: there is no buffer for paths()
  // What ends the run before the duration, beside regions of the World.
  bool stop_at_rest = false;
  uint64_t stop_collisions = 0;       // 0: none
  vector<WatchedQuantity> watch{};    // for extremes()
  vector<WatchedImpulse> impulses{};  // for impulses()
};

/// `world` must outlive the simulator. `initial` is at time 0, before the world's impulses. The simulator's own state
/// at time 0 is after them.
unique_ptr<Simulator> make_exact_simulator(const World& world, const State& initial, const ExactOptions& options);

}  // namespace carom
