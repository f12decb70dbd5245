#include "commands/engine.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "simulate/book.h"
#include "simulate/exact.h"
#include "simulate/stepped.h"

namespace carom {

namespace {

std::unique_ptr<Simulator> make_exact(const Scene& scene, bool record_collisions) {
  ExactOptions options;
  options.duration = scene.simulate.duration;
  options.rest_speed = scene.simulate.rest_speed.value_or(options.rest_speed);
  options.max_collisions = scene.simulate.max_collisions.value_or(options.max_collisions);
  options.merge = scene.simulate.merge;
  options.record_collisions = record_collisions;
  return make_exact_simulator(scene.world, scene.initial, options);
}

std::unique_ptr<Simulator> make_stepped(const Scene& scene, bool record_collisions) {
  SteppedOptions options;
  options.duration = scene.simulate.duration;
  options.step = scene.simulate.step.value_or(default_step(scene.world, scene.initial));
  options.integrator = scene.simulate.integrator;
  options.rest_speed = scene.simulate.rest_speed.value_or(options.rest_speed);
  options.max_collisions = scene.simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = record_collisions;
  return make_stepped_simulator(scene.world, scene.initial, options);
}

std::unique_ptr<Simulator> make_book(const Scene& scene, bool record_collisions) {
  BookOptions options;
  options.step = scene.simulate.step.value_or(options.step);
  options.as_printed = scene.simulate.as_printed;
  options.max_collisions = scene.simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = record_collisions;
  return make_book_simulator(scene.world, scene.initial, options);
}

}  // namespace

EngineChoice choose_engine(const Scene& scene) {
  switch (scene.simulate.engine) {
    case Engine::automatic:
      if (const Force* varying = varying_force(scene.world))
        return {"stepped", fmt::format("auto: under `{}` paths have no closed form", name_of(varying->law))};
      return {"exact", "auto: every path of this scene has a closed form"};
    case Engine::exact:
      break;
    case Engine::stepped:
      return {"stepped", ""};
    case Engine::book:
      return {"book", ""};
  }
  return {"exact", ""};
}

std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions) {
  const std::string name = choose_engine(scene).name;
  return name == "exact"     ? make_exact(scene, record_collisions)
         : name == "stepped" ? make_stepped(scene, record_collisions)
                             : make_book(scene, record_collisions);
}

std::unique_ptr<Simulator> make_oracle(const Scene& scene) {
  return varying_force(scene.world) == nullptr ? make_exact(scene, true) : make_stepped(scene, true);
}

}  // namespace carom
