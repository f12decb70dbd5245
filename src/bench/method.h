#pragma once
// One way to simulate a scene: an engine, and its treatment of paths without a closed form.

#include "engine/engine.h"
#include "physics/world.h"
#include "scene/simulate_settings.h"
#include "std.h"

namespace carom {

struct SimulationMethod {
  Engine engine = Engine::exact;
  Integrator integrator = Integrator::rk4;  // of the stepped engine
  StepChoice steps{};

  bool is_stepped_by(Integrator which) const { return engine == Engine::stepped && integrator == which; }
  friend bool operator==(const SimulationMethod&, const SimulationMethod&) = default;
};

/// "exact", "stepped rk4", "book".
string name_of(const SimulationMethod& method);
/// The same with its steps: "stepped rk4 in steps of 1/1024 s", "stepped dop853 to 1e-12".
string full_name_of(const SimulationMethod& method);
/// "1/16 s", or a decimal for other steps, or "1e-12" for dop853. Empty: the method has no steps.
string steps_text(const SimulationMethod& method);

/// The stepped engine with dop853. Where all paths have closed forms it still integrates them in steps.
SimulationMethod dop853(const World& world, double step_error);

/// The scene's settings with this method, without its steps.
Simulate settings_of(const Simulate& simulate, const SimulationMethod& method);

}  // namespace carom
