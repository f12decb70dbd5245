// A thousand random scenes under forces of all kinds and sizes: a run's error estimate holds.
#include <gtest/gtest.h>

#include "engine/accuracy.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {
namespace {

/// 10^a, a between these.
double decades(Random& random, double from, double to) {
  return pow(10.0, from + (to - from) * random(0, 1));
}

Vec3 anywhere(Random& random, double size) {
  return {random(-size, size), random(-size, size), random(-size, size)};
}

void add_force(Scene& scene, Random& random) {
  switch (static_cast<int>(random(0, 4))) {
    case 0:
      scene.world.forces.push_back(
          {Attractor{anywhere(random, 1), decades(random, -3, 1), random(0, 1) < 0.3 ? 0 : decades(random, -5, -1)}});
      break;

    case 1:
      scene.world.forces.push_back({Spring{anywhere(random, 1), decades(random, -5, 5), random(0, 1),
                                           random(0, 1) < 0.5 ? 0 : decades(random, -5, 5)}});
      break;

    case 2:
      scene.world.forces.push_back({Drag{decades(random, -5, 5), decades(random, -5, 5), anywhere(random, 1)}});
      break;

    default:
      scene.world.forces.push_back({UniformAcceleration{anywhere(random, 10)}, random(0, 0.5)});
  }
}

Scene random_scene(uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.world.gravity = Vec3::Zero();

  const int bodies = 1 + static_cast<int>(random(0, 3));
  for (int k = 0; k < bodies; ++k) {
    scene.world.mass.push_back(decades(random, -1, 1));
    scene.world.radius.push_back(decades(random, -4, -1.5));
    scene.world.restitution.push_back(1);
    scene.initial.position.push_back(anywhere(random, 0.8) + Vec3(2.0 * k, 0, 0));
    scene.initial.velocity.push_back(anywhere(random, 3));
  }

  const int forces = 1 + static_cast<int>(random(0, 3));
  for (int k = 0; k < forces; ++k) add_force(scene, random);
  if (random(0, 1) < 0.5) scene.world.planes.push_back({Vec3(0, -2, 0), Vec3(0, 1, 0), 1.0});

  scene.simulate.duration = 1;
  scene.simulate.engine = Engine::stepped;
  scene.simulate.integrator = Integrator::dop853;
  scene.simulate.tolerance = decades(random, -9, -3);
  return scene;
}

/// m: greatest distance of all positions at a few instants from those of a run with the smallest possible step errors.
double true_error(const Scene& scene, const EngineChoice& engine) {
  StepChoice finest = engine.steps;
  finest.error = 0x1p-52;
  const auto run = make_simulator(scene, {}, engine.steps), truth = make_simulator(scene, {}, finest);
  double most = 0;
  for (int k = 1; k <= 20; ++k) {
    for (Simulator* one : {run.get(), truth.get()})
      while (one->time() < 0.05 * k) one->advance_to(0.05 * k);
    for (size_t i = 0; i < scene.world.mass.size(); ++i)
      most = std::max(most, (run->state().position[i] - truth->state().position[i]).norm());
  }
  return most;
}

TEST(RandomAccuracy, OfAThousandScenesIsAsReported) {
  int met = 0, unmet = 0, refused = 0;
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    const Scene scene = random_scene(seed);
    EngineChoice engine = choose_engine(scene);
    try {
      settle_steps(scene, engine, [] {});
      if (!engine.shortfall.empty()) {
        ++unmet;
        continue;
      }

      ++met;
      EXPECT_LT(true_error(scene, engine), *scene.simulate.tolerance) << seed << ": " << engine.why;
    } catch (const SimulationError&) {
      ++refused;
    }
  }

  EXPECT_GT(met, 950) << unmet << " not met, " << refused << " refused";
}

}  // namespace
}  // namespace carom
