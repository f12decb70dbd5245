#include "commands/engine.h"

#include "simulate/book.h"
#include "simulate/exact.h"

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

}  // namespace

EngineChoice choose_engine(const Simulate& simulate) {
  switch (simulate.engine) {
    case Engine::automatic:
      return {"exact", "auto: every path of this scene has a closed form"};
    case Engine::exact:
      return {"exact", ""};
    case Engine::book:
      return {"book", ""};
    case Engine::stepped:
      break;
  }
  throw SimulationError("this version has no stepped engine; it has exact and book");
}

std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions) {
  if (choose_engine(scene.simulate).name == "exact") return make_exact(scene, record_collisions);
  BookOptions options;
  options.step = scene.simulate.step.value_or(options.step);
  options.as_printed = scene.simulate.as_printed;
  options.max_collisions = scene.simulate.max_collisions.value_or(options.max_collisions);
  options.record_collisions = record_collisions;
  return make_book_simulator(scene.world, scene.initial, options);
}

std::unique_ptr<Simulator> make_oracle(const Scene& scene) {
  return make_exact(scene, true);
}

}  // namespace carom
