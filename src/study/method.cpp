#include "study/method.h"

#include <fmt/format.h>

#include <cmath>

#include "physics/force.h"

namespace carom {

std::string name_of(const SimulationMethod& method) {
  return method.engine == Engine::stepped ? fmt::format("stepped {}", name_of(method.integrator))
                                          : name_of(method.engine);
}

std::string full_name_of(const SimulationMethod& method) {
  const std::string name = name_of(method), steps = steps_text(method);
  if (steps.empty()) return name;
  return fmt::format("{} {} {}", name, std::isfinite(method.step) ? "in steps of" : "to", steps);
}

std::string steps_text(const SimulationMethod& method) {
  if (std::isfinite(method.step_error)) return fmt::format("{:.1g}", method.step_error);
  if (!std::isfinite(method.step)) return "";
  const double per_second = 1 / method.step;
  return per_second == std::round(per_second) && per_second < 1e7 ? fmt::format("1/{:.0f} s", per_second)
                                                                  : fmt::format("{:.2g} s", method.step);
}

SimulationMethod dop853(const World& world, double step_error) {
  SimulationMethod method{.engine = Engine::stepped, .integrator = Integrator::dop853, .step_error = step_error};
  method.numerical = force_without_closed_form(world) == nullptr;
  return method;
}

Simulate settings_of(const Simulate& simulate, const SimulationMethod& method) {
  return with_engine(simulate, method.engine, method.integrator);
}

StepChoice steps_of(const SimulationMethod& method) {
  StepChoice steps;
  if (std::isfinite(method.step)) steps.length = method.step;
  if (std::isfinite(method.step_error)) steps.error = method.step_error;
  steps.numerical = method.numerical;
  return steps;
}

}  // namespace carom
