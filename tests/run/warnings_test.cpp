// The advice of warnings names what the scene has.
#include "run/warnings.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

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

/// The warning of a run with contact problems that were not solved to rounding.
std::string contact_warning(std::vector<double> masses, std::uint64_t problems) {
  Scene scene;
  scene.world.mass = std::move(masses);
  Tally tally;
  tally.doubtful = problems;
  const std::vector<Warning> warnings = warnings_of(scene, EngineChoice{}, scene.initial, Summary{}, tally);
  return warnings.empty() ? "" : warnings.back().text;
}

TEST(ContactWarning, AdvisesOnMassesOnlyWhereTheyAreUnequal) {
  EXPECT_EQ(contact_warning({1, 1e6, 3}, 2),
            "2 contact problems were not solved to rounding: make masses less unequal, which are from 1 to 1e+06 kg");
  const std::string other =
      "1 contact problem was not solved to rounding: compare dependent figures with those of a start that differs "
      "slightly";
  EXPECT_EQ(contact_warning({2, 2, 2}, 1), other);
  EXPECT_EQ(contact_warning({1, 5}, 1), other);
  EXPECT_EQ(contact_warning({1, 5}, 0), "");
}

}  // namespace
}  // namespace carom
