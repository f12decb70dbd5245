// What moves bodies in every scene, against the table of modes (modes.h).
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "scenes/play.h"
#include "simulate/loop/exact_simulator.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

/// How often bodies change from one mode to another one in a scene. All zero: it is for the book's engine.
ModeChanges::Counts changes_in(const string& name) {
  const Scene scene = load(name);
  const unique_ptr<Simulator> simulator = make_simulator(scene);
  while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
  const auto* const exact = dynamic_cast<const ExactSimulator*>(simulator.get());
  return exact == nullptr ? ModeChanges::Counts{} : exact->modes().counts();
}

TEST(ModesOfScenes, NoOtherTransitionHappens) {
  SLOW_WITH_SANITIZERS();
  ModeChanges::Counts all{};
  for (const string& name : scene_names()) {
    const ModeChanges::Counts changes = changes_in(name);
    for (size_t from = 0; from < number_of_modes; ++from)
      for (size_t to = 0; to < number_of_modes; ++to) {
        all[from][to] += changes[from][to];
        EXPECT_TRUE(changes[from][to] == 0 || may_become(static_cast<Mode>(from), static_cast<Mode>(to)))
            << name << ": from mode " << from << " to " << to;
      }
  }

  // The scenes make most changes of the table. Single bodies make the others (simulate/modes_test.cpp).
  size_t seen = 0;
  for (const auto& from : all) seen += static_cast<size_t>(ranges::count_if(from, [](auto n) { return n > 0; }));
  EXPECT_GE(seen, 18u);
}

}  // namespace
}  // namespace carom::testing
