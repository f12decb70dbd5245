#pragma once
// The stepped simulator: in steps of time, for any force. See stepped_simulator.h.
#include <cstdint>
#include <memory>

#include "physics/integrator.h"
#include "simulate/simulator.h"

namespace carom {

struct SteppedOptions {
  double duration = 0;  // s; the last step ends there
  double step = 0.001;  // s
  Integrator integrator = Integrator::rk4;
  double rest_speed = 0;             // m/s; slower impacts under load end in resting contact; 0: by the step alone
  std::uint64_t max_collisions = 0;  // stop with an error after so many; 0: no limit
  bool record_collisions = true;     // false: no buffer is made and collisions() stays empty
};

/// `world` must outlive the simulator. `initial` is at time 0, before the world's impulses; the simulator's own state
/// at time 0 is after them.
std::unique_ptr<Simulator> make_stepped_simulator(const World& world, const State& initial,
                                                  const SteppedOptions& options);

}  // namespace carom
