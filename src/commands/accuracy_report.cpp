// Simulates the scene again with changed data and finer steps (engine/accuracy.h), and describes the differences. A
// single run does not show its own error.
#include "commands/accuracy_report.h"

#include <fmt/format.h>

#include "commands/interrupt.h"
#include "commands/text.h"
#include "engine/accuracy.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

Json finite_or_null(double value) {
  return isfinite(value) ? Json(value) : Json(nullptr);
}

string integrator_text(const Assessment& assessment) {
  if (!assessment.integrator) return "closed forms: no step error";
  if (std::isnan(*assessment.integrator)) return "not known: a smaller step error changes nothing";
  return fmt::format("{} at most, between runs with two step errors", quantity(*assessment.integrator, "m"));
}

string contact_text(const Assessment& assessment) {
  if (assessment.stepped_contact == 0) return "none in steps of crowds";
  return fmt::format("{} in steps of crowds, summed over bodies; they lost {} beyond impacts",
                     quantity(assessment.stepped_contact, "s"), quantity(assessment.method_error, "J"));
}

string chaos_text(const Assessment& assessment) {
  const Growth& growth = assessment.growth;
  if (growth.chaotic) return fmt::format("a disturbance grows e-fold in {}", quantity(growth.lyapunov_time, "s"));
  if (!isfinite(growth.large_at))
    return fmt::format("none: a disturbance of 1e-12 grows by a factor of {:.3g}", growth.factor);
  return fmt::format("no steady growth, but a disturbance of 1e-12 changes the motion before {}",
                     quantity(growth.large_at, "s"));
}

string order_text(const Assessment& assessment) {
  if (!assessment.order) return "rigid bodies leave no impacts of one instant open";
  return fmt::format("{} at most, if impacts of one instant act one by one, the fastest first",
                     quantity(*assessment.order, "m"));
}

string right_text(const Assessment& assessment) {
  const string to = quantity(assessment.tolerance, "m");
  string text = fmt::format("positions are right to {} until ", to);
  text += isfinite(assessment.right_until) ? quantity(assessment.right_until, "s") : "the end";
  if (assessment.order.value_or(0) > assessment.tolerance)
    text += fmt::format(", under carom's law for impacts of one instant; another one changes them by {}",
                        quantity(*assessment.order, "m"));
  return text;
}

Json json_of(const Assessment& assessment) {
  return {{"tolerance_m", assessment.tolerance},
          {"right_until_s", finite_or_null(assessment.right_until)},
          {"rounding_m", assessment.rounding},
          {"integrator_m", assessment.integrator ? finite_or_null(*assessment.integrator) : Json(nullptr)},
          {"stepped_contact_s", assessment.stepped_contact},
          {"method_error_J", assessment.method_error},
          {"order_m", assessment.order ? Json(*assessment.order) : Json(nullptr)},
          {"chaotic", assessment.growth.chaotic},
          {"lyapunov_time_s", finite_or_null(assessment.growth.lyapunov_time)},
          {"growth", assessment.growth.factor}};
}

}  // namespace

AccuracyReport report_accuracy(const Scene& scene, EngineChoice engine) {
  if (scene.world.body_count() == 0 || scene.simulate.duration == 0) return {};
  try {
    if (!engine.steps.length && engine.steps.error == 0) settle_steps(scene, engine, stop_if_interrupted);
    const Assessment all = assess(scene, engine, stop_if_interrupted);

    return {{{"accuracy", right_text(all)},
             {"rounding", fmt::format("{} at most", quantity(all.rounding, "m"))},
             {"integrator", integrator_text(all)},
             {"contact", contact_text(all)},
             {"order", order_text(all)},
             {"chaos", chaos_text(all)}},
            json_of(all)};
  } catch (const SimulationError& error) {
    const SimulationError named =
        error.named([&](Entity body) { return fmt::format("`{}`", scene.roster.name(body)); });
    return {{{"accuracy", fmt::format("a run would stop: {}", named.what())}}, {{"failure", named.what()}}};
  }
}

}  // namespace carom
