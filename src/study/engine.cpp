#include "study/engine.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "scene/unsupported.h"
#include "simulate/book.h"
#include "simulate/exact.h"
#include "simulate/step_choice.h"

namespace carom {

namespace {

ExactOptions exact_options(const Simulate& simulate, bool record_collisions) {
  ExactOptions options;
  options.duration = simulate.duration;
  options.rest_speed = simulate.rest_speed.value_or(options.rest_speed);
  options.max_collisions = simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = record_collisions;
  return options;
}

/// Along paths in closed form, from event to event.
std::unique_ptr<Simulator> make_exact(const World& world, const State& initial, const Simulate& simulate,
                                      bool record_collisions, bool record_paths) {
  ExactOptions options = exact_options(simulate, record_collisions);
  options.merge = simulate.merge;
  options.record_paths = record_paths && varying_force(world) == nullptr;
  return make_exact_simulator(world, initial, options);
}

/// Whether the engine chooses its steps as it goes.
bool chooses_steps(const Simulate& simulate) {
  return simulate.integrator == Integrator::dop853;
}

/// The same, with free flights in steps.
std::unique_ptr<Simulator> make_stepped(const World& world, const State& initial, const Simulate& simulate,
                                        bool record_collisions) {
  ExactOptions options = exact_options(simulate, record_collisions);
  options.integrator = simulate.integrator;
  if (simulate.step)
    options.step = *simulate.step;
  else if (!chooses_steps(simulate))
    options.step = default_step(world, initial);
  return make_exact_simulator(world, initial, options);
}

std::unique_ptr<Simulator> make_book(const World& world, const State& initial, const Simulate& simulate,
                                     bool record_collisions) {
  BookOptions options;
  options.step = simulate.step.value_or(options.step);
  options.as_printed = simulate.as_printed;
  options.max_collisions = simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = record_collisions;
  return make_book_simulator(world, initial, options);
}

std::string joined(const std::string& why, const std::string& more) {
  return why.empty() ? more : why + "; " + more;
}

}  // namespace

const char* name_of(Engine engine) {
  switch (engine) {
    case Engine::exact:
      return "exact";
    case Engine::stepped:
      return "stepped";
    case Engine::book:
      return "book";
    case Engine::automatic:
      break;
  }
  return "auto";
}

Simulate with_engine(Simulate simulate, Engine engine, Integrator integrator, std::optional<double> step) {
  simulate.engine = engine;
  simulate.integrator = integrator;
  simulate.step = step;
  simulate.tolerance.reset();
  return simulate;
}

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::euler:
      return "euler";
    case Integrator::verlet:
      return "verlet";
    case Integrator::dop853:
      return "dop853";
    case Integrator::rk4:
      break;
  }
  return "rk4";
}

EngineChoice choose_engine(const Scene& scene) {
  EngineChoice choice{"exact", ""};
  switch (scene.simulate.engine) {
    case Engine::automatic:
      if (const Force* open = force_without_closed_form(scene.world))
        choice = {"stepped", fmt::format("auto: under `{}` paths have no closed form", name_of(open->law))};
      else
        choice.why = "auto: every path of this scene has a closed form";
      break;
    case Engine::exact:
      break;
    case Engine::stepped:
      choice.name = "stepped";
      break;
    case Engine::book:
      choice.name = "book";
      break;
  }
  if (choice.name == "stepped" && chooses_steps(scene.simulate)) {
    const std::string limit = scene.simulate.step ? fmt::format(", {:.4g} s at most", *scene.simulate.step) : "";
    choice.why = joined(choice.why, "dop853, steps of its own" + limit);
  } else if (choice.name == "stepped" && !scene.simulate.tolerance) {
    choice.step = scene.simulate.step.value_or(default_step(scene.world, scene.initial));
    choice.why =
        joined(choice.why, fmt::format("{}, steps of {:.4g} s", name_of(scene.simulate.integrator), *choice.step));
  }
  return choice;
}

void settle_step(const Scene& scene, EngineChoice& engine, const std::function<void()>& look) {
  if (engine.name != "stepped" || engine.step || chooses_steps(scene.simulate)) return;
  const Simulate& simulate = scene.simulate;
  ExactOptions way = exact_options(simulate, false);
  way.integrator = simulate.integrator;
  const StepChoice choice = choose_step(scene.world, scene.initial, way, *simulate.tolerance, look);
  engine.step = choice.step;
  engine.why = joined(engine.why, fmt::format("{}, steps of {:.4g} s, ", name_of(simulate.integrator), choice.step));
  engine.why +=
      choice.chaotic_from <= simulate.duration
          ? fmt::format("chaotic: from {:.4g} s on positions differ by more than {} m, and no later with shorter ones",
                        choice.chaotic_from, *simulate.tolerance)
          : fmt::format("with which positions agree within {:.2g} m", choice.difference);
}

std::unique_ptr<Simulator> make_simulator(const World& world, const State& initial, const Simulate& simulate,
                                          bool record_collisions, bool record_paths) {
  if (simulate.engine == Engine::exact) return make_exact(world, initial, simulate, record_collisions, record_paths);
  const auto make = simulate.engine == Engine::stepped ? make_stepped : make_book;
  return make(world, initial, simulate, record_collisions);
}

std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions, std::optional<double> step,
                                          bool record_paths) {
  Simulate simulate = scene.simulate;
  if (simulate.engine == Engine::automatic)
    simulate.engine = force_without_closed_form(scene.world) == nullptr ? Engine::exact : Engine::stepped;
  if (step) simulate.step = step;
  return make_simulator(scene.world, scene.initial, simulate, record_collisions, record_paths);
}

void check_flights(const Scene& scene) {
  if (!scene.output.flights || goes_along_parabolas(scene.world, scene.simulate)) return;
  throw SimulationError("flights are parabolas from impact to impact, which this scene has not: leave them out");
}

std::unique_ptr<Simulator> make_oracle(const Scene& scene) {
  Simulate simulate = scene.simulate;
  simulate.engine = force_without_closed_form(scene.world) == nullptr ? Engine::exact : Engine::stepped;
  if (simulate.engine == Engine::stepped) simulate = with_engine(simulate, Engine::stepped, Integrator::dop853);
  return make_simulator(scene.world, scene.initial, simulate, true);
}

}  // namespace carom
