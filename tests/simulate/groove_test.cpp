// Rest on several surfaces at once, and balls on balls.
#include <gtest/gtest.h>

#include "physics/world.h"
#include "simulate/build.h"
#include "std.h"

namespace carom {
namespace {

TEST(Groove, ABallComesToRestInBothPlanesAndSlidesOnByTheClosedForm) {
  // Two planes at 45 degrees meet along z, the whole tilted by gravity's z component.

  Problem problem;
  problem.world.gravity = Vec3(0, -9, 2);
  problem.plane({0, 0, 0}, {1, 1, 0});
  problem.plane({0, 0, 0}, {-1, 1, 0});
  problem.ball({0.1, 1, 0}, {0.3, 0, 0.25}, 2, 0.1, 0.6);
  problem.options.duration = 20;

  const Outcome run = run_exact(problem);
  const Vec3 x = run.end.position[0], v = run.end.velocity[0];

  EXPECT_NEAR(x.z(), 0.25 * 20 + 0.5 * 2 * 400, 1e-12 * 405);
  EXPECT_NEAR(v.z(), 0.25 + 2 * 20, 1e-13 * 40);
  EXPECT_NEAR(x.x(), 0, 1e-12);
  EXPECT_NEAR(x.y(), 0.1 * sqrt(2.0), 1e-12);
  EXPECT_NEAR(hypot(v.x(), v.y()), 0, 1e-12);
  EXPECT_EQ(run.tally.resting, 1u);
  EXPECT_LT(run.tally.collisions(), 2000u);
}

TEST(Corner, ABallInACornerOfARoomStandsStill) {
  Problem problem;
  problem.world.gravity = Vec3(-1, -9, -2);
  problem.room({0, 0, 0}, {3, 3, 3});
  problem.ball({1, 1, 1}, {0.3, -0.2, 0.1}, 1, 0.25, 0.7);
  problem.options.duration = 100;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.end.velocity[0], Vec3(0, 0, 0));
  EXPECT_LT((run.end.position[0] - Vec3(0.25, 0.25, 0.25)).norm(), 1e-15);
}

/// A groove along z that gravity tilts towards its end at z = 0.
Problem groove_of_planes() {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, -1);
  problem.plane({0, 0, 0}, {1, 1, 0});
  problem.plane({0, 0, 0}, {-1, 1, 0});
  problem.plane({0, 0, 0}, {0, 0, 1});
  return problem;
}

TEST(Groove, ABallThatLeansOnRestingOnesOnlyJustStruckRestsWithThem) {
  Problem problem = groove_of_planes();
  const double height = 0.5 * sqrt(2.0);
  for (double z : {0.5, 1.5, 2.5 + 1e-9}) problem.ball({0, height, z}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.options.duration = 1;

  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 1);
  EXPECT_LT(simulator->tally().collisions(), 200u);
  EXPECT_EQ(simulator->tally().resting, 3u);

  const auto contacts = simulator->contacts();
  const auto pair = ranges::find_if(contacts, [](const ContactForce& c) { return c.b == 2; });
  ASSERT_NE(pair, contacts.end());
  EXPECT_NEAR(pair->force, 1, 1e-12);  // N, of the ball's weight along the groove
}

TEST(Groove, BallsAtRestInItStandStillWhileAnotherRollsOffABall) {
  Problem problem = groove_of_planes();
  const double height = 0.5 * sqrt(2.0);
  for (double z : {0.5, 1.5}) problem.ball({0, height, z}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.obstacle({10, 20, 10}, Volume::sphere(2));
  problem.body(Volume::sphere(0.5), {10, 22.5, 10}, {0.01, 0, 0}, 1, 0.5);
  problem.options.duration = 0.5;
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*simulator, 0.5);
  ASSERT_GT(simulator->state().velocity[2].norm(), 0.1) << "the other moves";
  EXPECT_EQ(simulator->tally().resting, 3u) << "and is carried";
  for (size_t i : {0u, 1u}) EXPECT_EQ(simulator->state().velocity[i], Vec3(0, 0, 0));
}

TEST(Groove, ACanThatOneSideThrowsBackAtTheOtherAtOnceComesToRest) {
  // The slope takes all of a strike and keeps the can, so that it is thrown at the wall again without a hop.
  Problem problem;
  problem.world.gravity = Vec3(0, -0.01, 0);

  problem.plane({0.6190810161555866, -1.4257625580382707, 0.010248686928507444},
                {0.5446097485842876, 0.6800825567467852, 0.4908033595603383});
  problem.plane({2, 2, 2}, {-1, 0, 0});
  problem.body(Volume::cylinder(0.3444271546196192, 0.3057767352506796),
               {0.9611822461744686, -1.3857326667293413, 0.6445128248202379},
               {0.16731940288976777, -2.950246491254352, -2.748381666436531}, 1.6081011216408814, 0.3);

  problem.world.pairs = {{0, 1, 1, 1, 0}};
  problem.options.duration = 1;
  problem.options.max_collisions = 1000;

  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.tally.resting, 1u);
  EXPECT_NEAR(run.end.position[0].x(), 2 - 0.3444271546196192, 1e-15);
}

TEST(Room, ABallThatSlidesOnTheFloorBouncesBetweenTheWalls) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.room({0, 0, 0}, {3, 3, 3});
  problem.ball({1, 0.5, 1}, {1, 0, 0}, 1, 0.5, 1);
  problem.options.duration = 10;
  const Outcome run = run_exact(problem);
  EXPECT_EQ(run.collisions.size(), 5u);  // at 1.5, 3.5, 5.5, 7.5, 9.5 s
  EXPECT_EQ(run.end.position[0], Vec3(2, 0.5, 1));
}

TEST(RestingBall, StruckFromTheSideItSlidesAndStaysOnTheFloor) {
  Problem problem;
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {2, 0, 0}, 1, 0.5, 1);
  problem.ball({3, 0.5, 0}, {0, 0, 0}, 1, 0.5, 1);
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_EQ(run.collisions[0].time, 1);
  EXPECT_EQ(run.end.velocity[1], Vec3(2, 0, 0));
  EXPECT_EQ(run.end.position[1].y(), 0.5);
}

TEST(RestingBall, IsStruckByAFallingOneAtTheClosedFormsTime) {
  Problem problem;  // unequal accelerations: the falling ball's path against the resting one's is a parabola
  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.ball({0, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
  problem.ball({0.6, 0.5 + 0.8 + 5, 0}, {0, 0, 0}, 1, 0.5, 0.5);  // at (0.6, 0.8) it touches: after falling 5 m, 1 s
  problem.options.duration = 1;
  const Outcome run = run_exact(problem);
  ASSERT_GE(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, 1, 1e-15);
  EXPECT_LT((run.collisions[0].normal - Vec3(0.6, 0.8, 0)).norm(), 1e-14);
}

TEST(Pile, BallsThatSettleInABoxNeverOverlapNorGainEnergy) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.8, 0);
  problem.room({0, 0, 0}, {0.6, 4, 0.6});

  for (int i = 0; i < 9; ++i)
    problem.ball({0.15 + 0.28 * (i % 2), 0.3 + 0.3 * (i / 4), 0.15 + 0.28 * (i / 2 % 2) + 0.01 * (i % 2)},
                 {0.1 * (i % 2), 0, 0}, 1, 0.1 + 0.01 * (i % 4), 0.4);
  problem.options.duration = 3;

  const double start =
      kinetic_energy(problem.world, problem.initial) + potential_energy(problem.world, problem.initial);
  const Outcome run = run_exact(problem);
  const double end = kinetic_energy(problem.world, run.end) + potential_energy(problem.world, run.end);
  EXPECT_LT(kinetic_energy(problem.world, run.end), 0.1);  // of 26 J; without friction they still slide
  EXPECT_LT(run.tally.max_overlap, 1e-12);
  EXPECT_NEAR(end - start + run.tally.energy_lost, 0, 1e-9);
}

// A V groove with twelve balls at rest, of which two slide along it between others, at 0.46 m/s. Contacts nearly lock
// that motion. It ends by impacts, which lose the energy that is missing.
TEST(Groove, DoesNotStopABallThatSlidesAmongOthersInIt) {
  Problem problem;

  problem.world.gravity = Vec3(0, -10, 0);
  problem.plane({0, 0, 0}, {1, 1, 0});
  problem.plane({0, 0, 0}, {-1, 1, 0});
  problem.plane({0, 0, -0.5}, {0, 0, 1});
  problem.plane({0, 0, 0.5}, {0, 0, -1});

  // The twelve balls.
  problem.ball({-1.3822203826819068e-12, 0.14142135623869517, 0.40000000000000002}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({-6.682501936250432e-09, 0.14142136291981522, 1.9547038923544965e-16}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({0.12296121460844543, 0.26438257084632222, -0.098798175104062178},
               {-0.18152668113198403, -0.18152668113198409, -0.45184521216854184}, 1, 0.1, 0.3);
  problem.ball({-7.5355010429019109e-15, 0.14142135623731705, -0.19999999999999959}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({0.14142135623542074, 0.28284271247651138, 0.40000000000000002}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({0.12296121460683743, 0.26438257084792705, 0.10120182489593783},
               {-0.1815266811319832, -0.18152668113198325, -0.45184521216854184}, 1, 0.1, 0.3);

  problem.ball({0.12247448713915887, 0.26389584337646843, -0.29999999999999988}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({-0.12247448713916263, 0.26389584337647226, -0.30000000000000909}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({0.24494897427832485, 0.38637033051563441, -0.40000000000000002}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({0.24494507422511125, 0.38636643046242081, -0.19999044746802638},
               {0.0029210595519984844, 0.0029210595519984922, -0.007154194158238765}, 1, 0.1, 0.3);
  problem.ball({-1.2587634991732167e-20, 0.14142135623730953, -0.40000000000000002}, {0, 0, 0}, 1, 0.1, 0.3);
  problem.ball({-7.9798651704323865e-13, 0.14142135623810753, 0.19999999999999998}, {0, 0, 0}, 1, 0.1, 0.3);

  problem.options.duration = 0.05;
  const Outcome run = run_exact(problem);
  EXPECT_NEAR(residual(problem, run), 0, 3e-10);  // of 0.28 J of kinetic energy; measured: 1.3e-10
  EXPECT_GT(run.tally.energy_lost, 0.1);
  EXPECT_FALSE(run.collisions.empty());
}

}  // namespace
}  // namespace carom
