// A ball on a plane, against closed forms (data/references/bouncing_ball.json).
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/references.h"
#include "std.h"

namespace carom {
namespace {

Problem drop(const nlohmann::json& r) {
  Problem problem;
  problem.world.gravity = Vec3(0, -r["g"].get<double>(), 0);
  const double radius = r["radius"];
  problem.ball({0, radius + r["height_above_contact"].get<double>(), 0}, {0, r["vz0"].get<double>(), 0}, 1, radius,
               r["e"]);
  problem.plane({0, 0, 0}, {0, 1, 0});
  return problem;
}

TEST(BouncingBall, ImpactsComeAtTheTimesOfTheClosedForm) {
  const auto all = reference("bouncing_ball");
  for (const auto& r : all["vertical"]) {
    Problem problem = drop(r);
    const double e = r["e"];
    problem.options.duration = e < 1 ? r["zeno_time"].get<double>() + 1 : 1000;
    const Outcome run = run_exact(problem);
    for (const auto& impact : r["impacts"]) {
      const size_t n = impact["n"];
      if (n > 1000) continue;
      ASSERT_GE(run.collisions.size(), n) << r["id"];
      const Collision& c = run.collisions[n - 1];
      // Measured: at most 2.2e-16 relative for the first 20, 1.2e-15 for all of them.
      EXPECT_NEAR(c.time / impact["t"].get<double>(), 1, n <= 20 ? 1e-14 : 1e-13) << r["id"] << " impact " << n;
      const double speed = impact["speed_before"];
      EXPECT_NEAR(c.approach_speed, speed, 1e-14 * speed * static_cast<double>(n) + 1e-15)
          << r["id"] << " impact " << n;
    }
  }
}

TEST(BouncingBall, RestsFromTheZenoTimeOn) {
  const auto all = reference("bouncing_ball");
  for (const auto& r : all["vertical"]) {
    if (r["zeno_time"].is_null()) continue;

    Problem problem = drop(r);
    const double zeno = r["zeno_time"];
    problem.options.duration = zeno + 100;

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.all.back().kind, CollisionKind::rest) << r["id"];
    EXPECT_NEAR(run.all.back().time / zeno, 1, 1e-13) << r["id"];
    EXPECT_EQ(run.end.velocity[0], Vec3(0, 0, 0)) << r["id"];
    EXPECT_NEAR(run.end.position[0].y(), problem.world.radius[0], 1e-17) << r["id"];
    EXPECT_EQ(run.tally.resting, 1u);
  }
}

TEST(BouncingBall, DyadicDataGiveBitExactTimes) {
  const auto r = reference("bouncing_ball")["vertical"][0];
  Problem problem = drop(r);
  const Outcome run = run_exact(problem);
  for (size_t n = 1; n <= 50; ++n)
    EXPECT_EQ(run.collisions[n - 1].time, 1.5 - std::ldexp(1.0, 1 - static_cast<int>(n)));
  EXPECT_EQ(run.all.back().time, 1.5);
}

TEST(BouncingBall, RestSpeedEndsTheBouncesEarlierAtTheSameTime) {
  const auto r = reference("bouncing_ball")["vertical"][1];  // e = 0.9
  Problem problem = drop(r);
  problem.options.rest_speed = 0.01;
  const Outcome run = run_exact(problem);
  EXPECT_LT(run.collisions.size(), 65u);
  EXPECT_NEAR(run.all.back().time / r["zeno_time"].get<double>(), 1, 1e-13);
  EXPECT_EQ(run.all.back().kind, CollisionKind::rest);
}

TEST(BouncingBall, SlidesDownASlopeAfterTheBouncesEnd) {
  const auto all = reference("bouncing_ball");
  for (const auto& r : all["incline"]) {
    const double angle = r["angle_deg"].get<double>() * M_PI / 180, g = r["g"], radius = 0.1;
    const Vec3 up_slope(-std::cos(angle), std::sin(angle), 0), normal(std::sin(angle), std::cos(angle), 0);

    Problem problem;
    problem.world.gravity = Vec3(0, -g, 0);
    const Vec3 start = normal * (radius + r["h_perp0"].get<double>());
    problem.ball(start, -r["v_along0"].get<double>() * up_slope, 1, radius, r["e"]);
    problem.plane({0, 0, 0}, normal);
    problem.options.duration = 20;

    const Outcome run = run_exact(problem);
    for (const auto& impact : r["impacts"]) {
      const size_t n = impact["n"];
      if (n <= 20) {
        EXPECT_NEAR(run.collisions[n - 1].time / impact["t"].get<double>(), 1, 1e-14) << r["id"] << n;
      }
    }

    EXPECT_EQ(run.all.back().kind, CollisionKind::rest);
    EXPECT_NEAR(run.all.back().time / r["zeno_time"].get<double>(), 1, 1e-13) << r["id"];

    // The states between, from another run.
    const auto again = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (const auto& s : r["states"]) {
      const double t = s["t"];
      do again->advance_to(t);
      while (again->time() < t);

      const Vec3 x = again->state().position[0] - start, v = again->state().velocity[0];
      const double along = -up_slope.dot(x), scale = std::abs(s["s_along"].get<double>());
      EXPECT_NEAR(along, s["s_along"].get<double>(), 1e-14 * scale) << r["id"] << " t = " << t;
      EXPECT_NEAR(normal.dot(again->state().position[0]) - radius, s["h_perp"].get<double>(), 3e-14 * (1 + scale))
          << r["id"] << t;
      EXPECT_NEAR(-up_slope.dot(v), s["v_along"].get<double>(), 1e-14 * scale + 1e-14) << r["id"] << " t = " << t;
      EXPECT_NEAR(normal.dot(v), s["v_perp"].get<double>(), 2e-14 * (1 + v.norm())) << r["id"] << " t = " << t;
    }
  }
}

TEST(BouncingBall, OnlyTouchingTheFloorAtTheStartIsRestAndNoCollision) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.80665, 0);
  problem.plane({0, -0.11, 0}, {0, 1, 0});
  problem.ball({0.3, 0, 0.2}, {1, 0, 0}, 10, 0.11, 0.9);
  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.all.empty());
  EXPECT_EQ(run.end.velocity[0], Vec3(1, 0, 0));
  EXPECT_EQ(run.end.position[0].y(), 0);
  EXPECT_EQ(run.tally.resting, 1u);
}

}  // namespace
}  // namespace carom
