// The advice of warnings names what the scene has.
#include "run/warnings.h"

#include <gtest/gtest.h>

#include "scene/scene.h"

namespace carom {
namespace {

/// The warning of a run that gained 1 J of 4 J without impacts or work.
std::string energy_warning(const Scene& scene) {
  Summary summary;
  summary.energy.start = 4;
  summary.energy.end = 5;
  summary.energy.residual = 1;
  summary.energy.turnover = 4;
  EngineChoice engine;
  engine.engine = Engine::exact;
  const std::vector<Warning> warnings = warnings_of(scene, engine, scene.initial, summary, Tally{});
  return warnings.size() == 1 ? warnings[0].text : "";
}

TEST(EnergyWarning, AdvisesToSoftenAnAttractorOnlyWhereThereIsOne) {
  const std::string gained = "the method gained 1 J beyond impacts and work, 0.25 of the energy turned over: ";
  Scene scene;
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration");
  scene.world.forces.push_back({Spring{}});
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration");
  scene.world.forces.push_back({Attractor{}});
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration, or soften the attractor");
}

}  // namespace
}  // namespace carom
