// Two hundred random scenes with contact, strings and far places, of which an independent method knows the motion:
// check --accuracy, a tolerance and the bench state errors that contain the true ones.
// Measured: true errors are at most 3.6 times those of --accuracy, 2.2 times those of the bench, and 1.2 times a
// tolerance that is met.
#include <gtest/gtest.h>

#include "bench/reference.h"
#include "engine/accuracy.h"
#include "run/contact_scenes.h"
#include "std.h"

namespace carom {
namespace {

/// The error that a run with a tolerance states (m), or infinity if it says that the tolerance is not met. `steps`: its
/// own.
double stated_with_tolerance(Scene scene, double tolerance, StepChoice& steps) {
  scene.simulate.tolerance = tolerance;
  EngineChoice engine = choose_engine(scene);
  settle_steps(scene, engine, [] {});
  steps = engine.steps;
  return engine.shortfall.empty() ? tolerance : infinity;
}

TEST(ContactAccuracy, OfTwoHundredScenesIsContainedInWhatIsStated) {
  int scenes = 0, met = 0, known = 0;
  double greatest = 0, of_tolerances = 0, of_benches = 0;  // true error over what is stated
  for (uint64_t seed = 0; scenes < 200; ++seed) {
    const optional<SceneWithTruth> of = ContactScenes(seed).make();
    if (!of) continue;
    ++scenes;
    const double error = of->error();

    const Assessment all = assess(of->scene, choose_engine(of->scene), [] {});
    const double stated = std::max(all.rounding, all.integrator.value_or(0));
    if (!std::isnan(all.integrator.value_or(0))) {
      ++known;
      EXPECT_LE(error, 10 * stated) << seed << ": " << of->what;
      greatest = std::max(greatest, error / stated);
    }

    StepChoice steps;
    const double tolerance = pow(10.0, -4 - static_cast<double>(seed % 7));
    const double with_tolerance = stated_with_tolerance(of->scene, tolerance, steps);
    if (isfinite(with_tolerance)) {
      ++met;
      EXPECT_LE(of->error(steps), 10 * with_tolerance) << seed << ": " << of->what;
      of_tolerances = std::max(of_tolerances, of->error(steps) / with_tolerance);
    }

    const Reference reference = make_reference(of->scene, {}, {[] {}, [](double, const string&) {}});
    if (reference.chaotic) continue;
    EXPECT_LE(error, 10 * reference.error.position) << seed << ": " << of->what;
    of_benches = std::max(of_benches, error / reference.error.position);
  }
  EXPECT_GT(known, 190);
  EXPECT_GT(met, 150);
  std::printf(
      "true errors are at most %.2g times those that check states, %.2g tolerances, %.2g times those of benches; "
      "%d known, %d tolerances met\n",
      greatest, of_tolerances, of_benches, known, met);
}

}  // namespace
}  // namespace carom
