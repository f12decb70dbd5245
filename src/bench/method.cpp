// Names and settings of a method.
// The method dop853 ignores closed forms only if all paths have them. Otherwise the engine uses them where they exist.
#include "bench/method.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

string name_of(const SimulationMethod& method) {
  return method.engine == Engine::stepped ? fmt::format("stepped {}", name_of(method.integrator))
                                          : string(name_of(method.engine));
}

string full_name_of(const SimulationMethod& method) {
  const string name = name_of(method), steps = steps_text(method);
  if (steps.empty()) return name;
  return fmt::format("{} {} {}", name, method.steps.length ? "in steps of" : "to", steps);
}

string steps_text(const SimulationMethod& method) {
  if (method.steps.error > 0) return fmt::format("{:.1g}", method.steps.error);
  if (!method.steps.length) return "";
  const double per_second = 1 / *method.steps.length;
  return per_second == std::round(per_second) && per_second < 1e7 ? fmt::format("1/{:.0f} s", per_second)
                                                                  : fmt::format("{:.2g} s", *method.steps.length);
}

SimulationMethod dop853(const World& world, double step_error) {
  const bool numerical = force_without_closed_form(world) == nullptr;
  return {Engine::stepped, Integrator::dop853, {{}, step_error, numerical}};
}

Simulate settings_of(const Simulate& simulate, const SimulationMethod& method) {
  return with_engine(simulate, method.engine, method.integrator);
}

}  // namespace carom
