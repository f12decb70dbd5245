// A table of functions makes the simulator of each engine.
// The exact and the stepped engine are one simulator with different options, so events and impacts are the same code.
#include "engine/engine.h"

#include <fmt/format.h>

#include "numerics/processors.h"
#include "physics/coupled_forces.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "simulate/book.h"
#include "simulate/exact.h"
#include "std.h"

namespace carom {

namespace {

/// The arguments of a simulator.
struct SimulatorRequest {
  const World& world;
  const State& initial;
  const Simulate& simulate;
  Recording recording;
  const StepChoice& steps;
};

ExactOptions exact_options(const SimulatorRequest& request) {
  const Simulate& simulate = request.simulate;
  ExactOptions options;
  options.duration = simulate.duration;
  options.rest_speed = simulate.rest_speed.value_or(options.rest_speed);
  options.max_collisions = simulate.max_collisions.value_or(options.max_collisions);

  options.record_collisions = request.recording.collisions;
  options.record_paths = request.recording.paths;
  options.watch = request.recording.watch;
  options.impulses = request.recording.impulses;

  options.stop_at_rest = simulate.stop_at_rest;
  options.stop_collisions = simulate.stop_collisions.value_or(options.stop_collisions);

  options.one_by_one = request.steps.one_by_one;
  options.quality = &quality_of(simulate.contact.quality);
  options.threads = int(share_of_processors());
  if (request.steps.error > 0) options.step_error = request.steps.error;
  return options;
}

/// Follows paths in closed form, from event to event.
unique_ptr<Simulator> make_exact(const SimulatorRequest& request) {
  ExactOptions options = exact_options(request);
  options.merge = request.simulate.contact.merge;
  return make_exact_simulator(request.world, request.initial, options);
}

/// Whether the integrator adapts its steps.
bool chooses_steps(const Simulate& simulate) {
  return simulate.integrator == Integrator::dop853;
}

/// The same with free flights in steps.
unique_ptr<Simulator> make_stepped(const SimulatorRequest& request) {
  const Simulate& simulate = request.simulate;
  const StepChoice& steps = request.steps;
  ExactOptions options = exact_options(request);
  options.integrator = simulate.integrator;
  options.merge = simulate.contact.merge;
  options.closed_forms = !steps.numerical;
  const optional<double> step = steps.length ? steps.length : simulate.step;
  if (step)
    options.step = *step;
  else if (!chooses_steps(simulate))
    options.step = default_step(request.world, request.initial);
  return make_exact_simulator(request.world, request.initial, options);
}

/// Runs frame by frame, as in the chapter's listings.
unique_ptr<Simulator> make_book(const SimulatorRequest& request) {
  const Simulate& simulate = request.simulate;
  BookOptions options;
  options.step = request.steps.length.value_or(simulate.step.value_or(options.step));
  options.as_printed = simulate.as_printed;
  options.max_collisions = simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = request.recording.collisions;
  options.record_paths = request.recording.paths;
  options.watch = request.recording.watch;
  options.stop_at_rest = simulate.stop_at_rest;
  options.stop_collisions = simulate.stop_collisions.value_or(options.stop_collisions);
  return make_book_simulator(request.world, request.initial, options);
}

/// Indexed by Engine. The limits of each engine are in scene/engines.cpp.
constexpr unique_ptr<Simulator> (*makers[])(const SimulatorRequest&) = {nullptr, make_exact, make_stepped, make_book};

}  // namespace

Simulate with_engine(Simulate simulate, Engine engine, Integrator integrator) {
  simulate.engine = engine;
  simulate.integrator = integrator;
  simulate.step.reset();
  simulate.tolerance.reset();
  return simulate;
}

EngineChoice choose_engine(const Scene& scene) {
  EngineChoice choice{engine_of(scene.world, scene.simulate)};
  if (scene.simulate.engine == Engine::automatic) {
    const Force* open = force_without_closed_form(scene.world);
    const bool tied = !scene.world.strings.empty();
    const bool coupled = has_couplings(scene.world);
    choice.why = open != nullptr ? fmt::format("auto: under {} paths have no closed form", open_force_text(*open))
                 : coupled       ? "auto: bodies under forces between them fly as one system"
                 : tied          ? "auto: every path without a taut string has a closed form"
                                 : "auto: every path of this scene has a closed form";
  }
  if (choice.engine != Engine::stepped || scene.simulate.tolerance) return choice;

  // Its steps: adaptive ones, given ones or the default.
  if (!choice.why.empty()) choice.why += "; ";
  if (chooses_steps(scene.simulate)) {
    choice.why += "dop853, adaptive steps";
    if (scene.simulate.step) choice.why += fmt::format(", {:.4g} s at most", *scene.simulate.step);
  } else {
    choice.steps.length = scene.simulate.step.value_or(default_step(scene.world, scene.initial));
    choice.why += fmt::format("{}, steps of {:.4g} s", name_of(scene.simulate.integrator), *choice.steps.length);
  }
  return choice;
}

unique_ptr<Simulator> make_simulator(const World& world, const State& initial, const Simulate& simulate,
                                     Recording recording, const StepChoice& steps) {
  return makers[size_t(engine_of(world, simulate))]({world, initial, simulate, std::move(recording), steps});
}

unique_ptr<Simulator> make_simulator(const Scene& scene, Recording recording, const StepChoice& steps) {
  return make_simulator(scene.world, scene.initial, scene.simulate, std::move(recording), steps);
}

void check_flights(const Scene& scene) {
  if (!scene.output.flights || goes_along_parabolas(scene.world, scene.simulate)) return;
  throw SimulationError("flights need parabolas from impact to impact, and this scene has other paths: leave them out");
}

Engine most_exact(const World& world) {
  return engine_of(world, {});
}

unique_ptr<Simulator> make_oracle(const Scene& scene, bool paths) {
  Simulate simulate = scene.simulate;
  simulate.engine = most_exact(scene.world);
  if (simulate.engine == Engine::stepped) simulate = with_engine(simulate, Engine::stepped, Integrator::dop853);
  return make_simulator(scene.world, scene.initial, simulate, {.collisions = true, .paths = paths});
}

}  // namespace carom
