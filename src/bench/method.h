#pragma once
// One way to simulate a scene: an engine, and how it goes through paths that have no closed form.
#include <string>

#include "physics/world.h"
#include "run/engine.h"
#include "scene/simulate_settings.h"

namespace carom {

struct SimulationMethod {
  Engine engine = Engine::exact;
  Integrator integrator = Integrator::rk4;  // of engine stepped
  StepChoice steps{};

  bool is_stepped_by(Integrator which) const { return engine == Engine::stepped && integrator == which; }
  friend bool operator==(const SimulationMethod&, const SimulationMethod&) = default;
};

/// "exact", "stepped rk4", "book".
std::string name_of(const SimulationMethod& method);
/// The same with its steps: "stepped rk4 in steps of 1/1024 s", "stepped dop853 to 1e-12".
std::string full_name_of(const SimulationMethod& method);
/// "1/16 s", or a decimal where it is no such fraction; "1e-12" of dop853; empty: it has no steps.
std::string steps_text(const SimulationMethod& method);

/// Engine stepped, by dop853; where all paths have closed forms it follows them by steps too.
SimulationMethod dop853(const World& world, double step_error);

/// The scene's settings by this method, but for its steps.
Simulate settings_of(const Simulate& simulate, const SimulationMethod& method);

}  // namespace carom
