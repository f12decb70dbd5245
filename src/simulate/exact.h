#pragma once
// The exact simulator: from event to event along paths in closed form, or of a method in steps. See exact_simulator.h.
#include <cstdint>
#include <limits>
#include <memory>

#include "physics/integrator.h"
#include "simulate/simulator.h"
#include "simulate/tolerances.h"

namespace carom {

struct World;

struct ExactOptions {
  double duration = 0;  // s; nothing later is scheduled
  double rest_speed =
      0;  // m/s; slower impacts under load end in resting contact; 0: chosen by the case (exact_bodies.h)
  std::uint64_t max_collisions = 0;            // stop with an error after so many; 0: no limit
  Integrator integrator = Integrator::dop853;  // of free flights without a closed form; but for dop853 of all that bend
  double step = std::numeric_limits<double>::infinity();  // s: of dop853 the longest; others' end at its multiples
  double step_error = exact_tolerance::step_error;        // of dop853: of a radius, and of speeds
  bool closed_forms = true;                               // false: dop853 follows all that bend, too
  bool merge = false;                                     // bodies that meet become one
  bool record_collisions = true;                          // false: no buffer is made and collisions() stays empty
  bool record_paths = false;                              // false: nor is one for paths()
};

/// `world` must outlive the simulator. `initial` is at time 0, before the world's impulses; the
/// simulator's own state at time 0 is after them.
std::unique_ptr<Simulator> make_exact_simulator(const World& world, const State& initial, const ExactOptions& options);

}  // namespace carom
