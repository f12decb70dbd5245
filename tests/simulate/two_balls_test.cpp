// Two balls, against 60-digit references (data/references/two_ball_oblique.json).
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/references.h"
#include "std.h"

namespace carom {
namespace {

constexpr double tight = 5e-15;  // relative, four units in the last place

void expect_close(const Vec3& got, const Vec3& expected, double tolerance, const string& what) {
  EXPECT_LE((got - expected).norm(), tolerance * expected.norm())
      << what << ": " << got.transpose() << " for " << expected.transpose();
}

void expect_case(const nlohmann::json& reference_case, const nlohmann::json& p, const Vec3& gravity) {
  for (const auto& r : reference_case.at("results")) {
    const double e = r.at("e");
    Problem problem;
    problem.world.gravity = gravity;
    problem.ball(vec3(p["p1"]), vec3(p["v1"]), p["m1"], p["R1"], e);
    problem.ball(vec3(p["p2"]), vec3(p["v2"]), p["m2"], p["R2"], e);
    problem.options.duration = 4;

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u) << "e = " << e;
    const Collision& c = run.collisions[0];
    const string what = "e = " + to_string(e);

    EXPECT_NEAR(c.time / r["t_contact"].get<double>(), 1, tight) << what;
    EXPECT_NEAR(c.impulse / r["impulse"].get<double>(), 1, tight) << what;
    EXPECT_NEAR(c.approach_speed / r["approach_speed"].get<double>(), 1, tight) << what;
    EXPECT_NEAR(c.energy_lost, -r["dKE"].get<double>(), tight * r["KE_before"].get<double>()) << what;
    expect_close(c.normal, vec3(r["normal_1to2"]), tight, what + " normal");

    for (const auto& s : r["states"]) {
      const auto again = make_exact_simulator(problem.world, problem.initial, problem.options);
      again->advance_to(s["t"]);
      expect_close(again->state().position[0], vec3(s["p1"]), tight, what + " p1");
      expect_close(again->state().position[1], vec3(s["p2"]), tight, what + " p2");
      expect_close(again->state().velocity[0], vec3(s["v1"]), tight, what + " v1");
      expect_close(again->state().velocity[1], vec3(s["v2"]), tight, what + " v2");
    }
  }
}

TEST(TwoBalls, ObliqueCollisionIsRightToFourUlp) {
  const auto all = reference("two_ball_oblique");
  expect_case(all["case_A"], all["case_A"]["params"], Vec3::Zero());
}

TEST(TwoBalls, UniformGravityLeavesTimeAndNormalUnchanged) {
  const auto all = reference("two_ball_oblique");
  expect_case(all["case_A_gravity"], all["case_A"]["params"], Vec3(0, 0, -9.8125));
}

// They meet obliquely after 1e7 s, 5e10 m below or 1e11 m beside where they began.
TEST(TwoBalls, WhatTheyHaveInCommonTakesNoDigitsOfTheirNormal) {
  for (const bool boxes : {false, true}) {
    const auto meet = [&](const Vec3& gravity, const Vec3& common) {
      Problem problem;
      problem.world.gravity = gravity;

      const Vec3 x(1000.75, 0.375, 0.25), w(-0x1p-13, 0, 0);
      if (boxes) {
        problem.body(Volume::sphere(0.5), {0, 0, 0}, common, 2, 0.5);
        problem.body(Volume::box({1, 0.5, 0.25}), x, common + w, 3, 0.5);
      } else {
        problem.ball({0, 0, 0}, common, 2, 0.5, 0.5);
        problem.ball(x, common + w, 3, 0.5, 0.5);
      }

      problem.options.duration = 1.2e7;
      const Outcome run = run_exact(problem);
      EXPECT_EQ(run.collisions.size(), 1u);
      return run.collisions.empty() ? Collision{} : run.collisions[0];
    };

    const Collision alone = meet(Vec3::Zero(), Vec3::Zero());
    // In other frames and other falls.
    for (const auto& [gravity, common] : {pair(Vec3(0, -1e-3, 0), Vec3(0, 0, 0)),
                                          {Vec3(0, 0, 0), Vec3(8192, 0, 1024)},
                                          {Vec3(1e-4, 2e-4, -1e-3), Vec3(-512, 64, 1024)}}) {
      const Collision there = meet(gravity, common);
      EXPECT_NEAR(there.time / alone.time, 1, 1e-15);
      EXPECT_LT((there.normal - alone.normal).norm(), 1e-12);
      EXPECT_NEAR(there.approach_speed / alone.approach_speed, 1, 1e-12);
    }
  }
}

TEST(TwoBalls, IntegerDataGiveTheExactTime) {
  const auto all = reference("two_ball_oblique");
  expect_case(all["case_B_exact"], all["case_B_exact"]["params"], Vec3::Zero());
}

// The last bits of the time move the normal by sqrt(eps)-sized angles here: n.x is as small as 2e-8 while its rounding
// is that of the time, 4e-16. So velocities are held to absolute rounding, and time and the hit itself to the last
// bits.
TEST(TwoBalls, GrazingHitsAreNeverMissed) {
  const auto all = reference("two_ball_oblique");
  for (const auto& r : all["case_C_grazing"]["results"]) {
    Problem problem;
    const double b = r["impact_parameter"];
    problem.ball({0, 0, 0}, {1, 0, 0});
    problem.ball({4, b, 0}, {0, 0, 0});

    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u) << "b = " << b;
    EXPECT_NEAR(run.collisions[0].time / r["t_contact"].get<double>(), 1, 4e-16) << "b = " << b;
    EXPECT_LE((run.end.velocity[0] - vec3(r["v1_after"])).norm(), 5e-15) << "b = " << b;
    EXPECT_LE((run.end.velocity[1] - vec3(r["v2_after"])).norm(), 5e-15) << "b = " << b;
  }
}

TEST(TwoBalls, PassingByAtExactlyTheSumOfRadiiIsNoCollision) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({4, 1, 0}, {0, 0, 0});
  EXPECT_TRUE(run_exact(problem).collisions.empty());
}

TEST(TwoBalls, NearlyTouchingBallsMeetOnTime) {
  const auto all = reference("two_ball_oblique");
  for (const auto& r : all["case_D_near_touching"]["results"]) {
    Problem problem;
    problem.ball({0, 0, 0}, {1, 1, 0}, 1);
    problem.ball({1 + r["gap"].get<double>(), 0, 0}, {0, 0, 0}, 2);
    const Outcome run = run_exact(problem);
    ASSERT_EQ(run.collisions.size(), 1u);
    EXPECT_NEAR(run.collisions[0].time / r["t_contact"].get<double>(), 1, tight);
    EXPECT_LE((run.end.velocity[0] - vec3(r["v1_after"])).norm(), tight);
    EXPECT_LE((run.end.velocity[1] - vec3(r["v2_after"])).norm(), tight);
  }
}

TEST(TwoBalls, RestitutionAboveOneMakesEnergy) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0}, 1, 0.5, 1.5);
  problem.ball({2, 0, 0}, {-1, 0, 0}, 1, 0.5, 1.5);
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.collisions[0].time, 1.5);
  EXPECT_EQ(run.end.velocity[0], Vec3(-1.5, 0, 0));
  EXPECT_EQ(run.tally.energy_lost, 0.5 * 2 * (1 - 1.5 * 1.5));
}

TEST(TwoBalls, PerfectlyInelasticBallsGoOnTogether) {
  Problem problem;
  problem.ball({-2, 0, 0}, {1, 0, 0}, 1, 0.5, 0);
  problem.ball({2, 0, 0}, {-1, 0, 0}, 3, 0.5, 0);
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.end.velocity[0], Vec3(-0.5, 0, 0));
  EXPECT_EQ(run.end.velocity[1], Vec3(-0.5, 0, 0));
}

}  // namespace
}  // namespace carom
