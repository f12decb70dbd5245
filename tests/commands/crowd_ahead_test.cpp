// When bodies will lie in heaps, and the time that this takes.
#include "commands/crowd_ahead.h"

#include <gtest/gtest.h>

#include "commands/program.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

/// So many balls of 0.1 m that fall by 1.9 m at most.
Scene pour(int count, const string& more) {
  const string text = "scene: 1\nballs: {b: {repeat: " + to_string(count) +
                      ", mass: 1, radius: 0.1, position: ['= i', 1.9, 0]}}\nsimulate: {duration: 9}\n" + more;
  const Workplace here;
  here.write("pour.yaml", text);
  return load_scene(here.path("pour.yaml"));
}

TEST(CrowdAhead, FollowsTheFallAndWhatImpactsTake) {
  const Scene scene =
      pour(100, "gravity: [0, -9.5, 0]\nrestitution: 0.5\nplanes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}}\n");
  const CrowdAhead ahead = crowd_ahead(scene, Engine::exact);
  const double fall = sqrt(2 * 1.9 / 9.5);
  EXPECT_NEAR(ahead.from, fall / 0.75, 1e-12);
  EXPECT_NEAR(ahead.until, fall / 0.75 + 5 * fall, 1e-12);
  EXPECT_GT(ahead.rate, 0);

  // Before it, in it, and after it.
  EXPECT_NEAR(time_ahead(ahead, 0, 9, 2), 2 * ahead.from + ahead.landing + ahead.rate * 5 * fall, 1e-12);
  EXPECT_NEAR(time_ahead(ahead, 1, 9, 2), 2 * (ahead.until - 1), 1e-12);
  EXPECT_NEAR(time_ahead(ahead, 5, 9, 2), 8, 1e-12);
  EXPECT_NEAR(time_ahead(ahead, 0, 0.5, 2), 1, 1e-12);
}

TEST(CrowdAhead, IsNoneWhereBodiesDoNotCollect) {
  const string floor = "planes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";
  const auto from = [](const Scene& scene, Engine engine) { return crowd_ahead(scene, engine).from; };
  EXPECT_EQ(from(pour(100, "restitution: 1\n" + floor), Engine::exact), never);
  EXPECT_EQ(from(pour(100, "restitution: 0.5\n"), Engine::exact), never);
  EXPECT_EQ(from(pour(20, "restitution: 0.5\n" + floor), Engine::exact), never);
  EXPECT_EQ(from(pour(100, "restitution: 0.5\n" + floor), Engine::book), never);
  EXPECT_EQ(time_ahead({}, 2, 9, 3), 21);
}

}  // namespace
}  // namespace carom::testing
