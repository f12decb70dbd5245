// Scenes of many collisions and of walls, against their comments and the closed forms.
#include <gtest/gtest.h>

#include "physics/energy.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "std.h"

namespace carom::testing {
namespace {

size_t among_balls(const Played& run) {
  return run.tally.body_body;
}

TEST(BilliardBreak, TheFirstCollisionIsTheClosedForm) {
  const string file = "billiard_break";
  const double b = 0.004, d = 0.05715, v = 7, share = sqrt(1 - b * b / (d * d));
  const double time = (1.27 - sqrt(d * d - b * b)) / v;

  const Played run = play(file, {0.1733});
  const Collision& first = run.collisions[0];
  EXPECT_NEAR(first.time, time, 4e-16);
  EXPECT_LT((first.normal - Vec3(share, 0, -b / d)).norm(), 1e-14);
  EXPECT_NEAR(first.approach_speed, v * share, 1e-14);
  EXPECT_NEAR(run.states[0].velocity[run.number("one")].norm(), v * share * 1.95 / 2, 1e-14);

  EXPECT_NEAR(stated(file, "(1.27 - sqrt(d^2 - b^2)) / v = "), time, 5e-16);
  EXPECT_NEAR(stated(file, "along the normal (sqrt(1 - (b/d)^2), 0, -b/d) = ("), share, 5e-13);
  EXPECT_NEAR(stated(file, "at v sqrt(1 - (b/d)^2) = "), v * share, 5e-13);
  EXPECT_NEAR(stated(file, "(1+e)/2 of that, "), v * share * 1.95 / 2, 5e-13);
}

TEST(BilliardBreak, EveryBallMovesAndStaysOnTheTable) {
  const Played run = play("billiard_break");
  ASSERT_EQ(run.end.position.size(), 16u);
  for (size_t i = 0; i < 16; ++i) {
    const Vec3& x = run.end.position[i];
    EXPECT_GT((x - run.scene.initial.position[i]).norm(), 0.001) << run.scene.roster.name(i);
    EXPECT_NEAR(x.y(), 0.028575, 1e-15);
    EXPECT_LT(std::abs(x.x()), 1.27 - 0.028575 + 1e-12);
    EXPECT_LT(std::abs(x.z()), 0.635 - 0.028575 + 1e-12);
  }

  EXPECT_NEAR(kinetic_energy(run.scene.world, run.scene.initial),
              stated("billiard_break", "less than half of the initial kinetic energy of "), 1e-14);
  EXPECT_LT(kinetic_energy(run.scene.world, run.end), 4.165 / 2);
}

TEST(BilliardBreak, TheRackIsATenthOfAMillimetreApart) {
  const Played run = play("billiard_break");
  for (size_t i = 1; i < 16; ++i) {
    double nearest = 1;
    for (size_t j = 1; j < 16; ++j) {
      if (i != j) nearest = std::min(nearest, (run.scene.initial.position[i] - run.scene.initial.position[j]).norm());
    }
    EXPECT_NEAR(nearest - 0.05715, 1e-4, 1e-7);
  }
}

TEST(NewtonsCradleGap, OneBallMovesAtATimeToTheLastBit) {
  const string file = "newtons_cradle_gap";
  const Played run = play(file, {0.25, 0.8, 2.2});

  const double first_pass[] = {0.484375, 0.5, 0.515625, 0.53125, 1.1875, 1.84375};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(run.collisions[i].time, first_pass[i]) << i;

  EXPECT_EQ(run.states[1].velocity, (vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(run.states[2].velocity, (vector<Vec3>{{-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));

  EXPECT_EQ(run.of("left")[0].time, stated(file, "red strikes the left wall at "));
  EXPECT_EQ(run.of("orange")[4].time, stated(file, "and orange again at "));
  EXPECT_EQ(run.of("right")[0].time, stated(file, "(0.9375 - 0.28125) = "));

  EXPECT_EQ(run.collisions[10].time - run.collisions[0].time, stated(file, "repeats every "));
  EXPECT_EQ(run.collisions.size(), stated(file, "repeats every 2.75 s "));
  EXPECT_EQ(among_balls(run), stated(file, "in 5.5 s, "));
  EXPECT_EQ(kinetic_energy(run.scene.world, run.end), stated(file, "the energy stays "));
}

TEST(NewtonsCradleTouching, TwoInTwoOutToTheLastBit) {
  const string file = "newtons_cradle_touching";
  const Played run = play(file, {0.8, 2.2});

  const auto at = [&](double time) {
    return ranges::count_if(run.collisions, [&](const Collision& c) { return c.time == time; });
  };

  EXPECT_EQ(run.states[0].velocity, (vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(run.states[1].velocity, (vector<Vec3>{{-1, 0, 0}, {-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));

  EXPECT_EQ(at(0.5), 6);
  EXPECT_EQ(at(stated(file, "(0.9375 - 0.25) = ")), 3);
  EXPECT_EQ(at(stated(file, "6 more collisions at ")), 6);
  EXPECT_EQ(at(stated(file, "to the left wall, 3 there at ")), 3);
  EXPECT_EQ(at(0.5 + stated(file, "repeats every ")), 6);

  EXPECT_EQ(run.collisions.size(), stated(file, "repeats every 2.75 s "));
  EXPECT_EQ(among_balls(run), stated(file, "in 5.5 s, "));
  EXPECT_EQ(kinetic_energy(run.scene.world, run.end), stated(file, "the energy stays "));
}

TEST(PiByCollisions, CountsThreeHundredAndFourteen) {
  const string file = "pi_by_collisions";
  const Played run = play(file);
  const double quotient = M_PI / std::atan(sqrt(1 / 10000.0));
  EXPECT_EQ(run.collisions.size(), floor(quotient));
  EXPECT_NEAR(stated(file, "= floor("), quotient, 5e-5);
  EXPECT_EQ(run.collisions.size(), stated(file, "floor(314.1697) = "));
  EXPECT_EQ(among_balls(run), stated(file, "314 collisions, "));
  EXPECT_EQ(run.collisions[0].time, stated(file, "/ 0.5 m/s = "));
  EXPECT_NEAR(run.collisions[312].time, stated(file, "the 313th at "), 0.0005);
  EXPECT_NEAR(run.collisions[313].time, stated(file, "with a slow light ball, at "), 0.0005);
  EXPECT_NEAR(kinetic_energy(run.scene.world, run.end), stated(file, "the energy stays "), 1e-9);
}

TEST(PiToSixDigits, Counts314159) {
  const string file = "pi_to_six_digits";
  const Played run = play(file);
  const double quotient = M_PI / std::atan(sqrt(1e-10));
  EXPECT_EQ(run.collisions.size(), floor(quotient));
  EXPECT_NEAR(stated(file, "= floor("), quotient, 5e-3);
  EXPECT_EQ(run.collisions.size(), stated(file, "floor(314159.27) = "));
  EXPECT_EQ(among_balls(run), stated(file, "314159 collisions, "));
  EXPECT_EQ(run.tally.body_fixed, stated(file, "between the balls and "));
  EXPECT_LT(run.tally.last_collision, stated(file, "with the wall, all within "));
}

TEST(GasInARoom, KeepsItsEnergyAndPushesTheWalls) {
  const string file = "gas_in_a_room";
  const Played run = play(file);
  const World& world = run.scene.world;
  const double energy = kinetic_energy(world, run.scene.initial);
  EXPECT_NEAR(kinetic_energy(world, run.end), energy, 1e-13 * energy);

  double push = 0;            // N s, of all walls
  Vec3 taken = Vec3::Zero();  // N s, by the walls
  for (const Collision& c : run.collisions) {
    if (c.kind != CollisionKind::body_fixed) continue;
    push += c.impulse;
    taken += c.impulse * c.normal;
  }

  const Vec3 change = momentum(world, run.end) - momentum(world, run.scene.initial);
  EXPECT_LT((change + taken).norm(), 1e-11);  // measured: 2e-13, of momenta that sum to 4e3

  const double force = push / 6 / run.scene.simulate.duration, ideal = 2 * energy / (3 * 1.9);
  EXPECT_NEAR(stated(file, "2 E / (3 L) = "), ideal, 0.05);
  EXPECT_NEAR(stated(file, "with E = "), energy, 0.005);
  EXPECT_NEAR(stated(file, "over the six walls and 6 s: "), force, 0.05);
  EXPECT_NEAR(stated(file, "N, a factor of "), force / ideal, 0.0005);

  const double filling = 200 * 4 / 3.0 * M_PI * pow(0.05, 3) / 8;
  EXPECT_NEAR(stated(file, "pi r^3 / 8 m^3 = "), filling, 5e-5);
  EXPECT_NEAR(stated(file, "gives a factor of "),
              (1 + filling + filling * filling - pow(filling, 3)) / pow(1 - filling, 3), 0.0005);
  EXPECT_EQ(stated(file, "gives a factor of 1.054; "), run.tally.body_fixed);
}

TEST(WallFlyOver, FaceEdgeAndCornerAreStruckWithTheirNormals) {
  const string file = "wall_fly_over";
  const Played run = play(file, {0.7, 0.8});
  const Entity wall = run.number("wall"), floor = run.number("floor");
  const State &after = run.states[0], &level = run.states[1];
  const double g = g_n;

  EXPECT_EQ(run.of("over")[0].b, floor);
  EXPECT_NEAR(level.position[run.number("over")].x(), 0, 1e-15);
  EXPECT_NEAR(level.position[run.number("over")].y(), stated(file, "5.2 t - g t^2/2 = "), 1e-14);
  EXPECT_EQ(run.of("past")[0].b, floor);
  EXPECT_NEAR(run.scene.initial.position[run.number("past")].z() - 0.1 - 0.6, stated(file, "is beside it at 0.8 s, "),
              1e-15);

  const Collision face = run.of("face")[0], edge = run.of("edge")[0], corner = run.of("corner")[0];
  EXPECT_EQ(face.b, wall);
  EXPECT_NEAR(face.time, stated(file, "(2 - r) / 2.5 = "), 1e-15);
  EXPECT_NEAR(play(file, {0.77}).states[0].velocity[run.number("face")].x(), stated(file, "-0.8 * 2.5 = "), 1e-15);

  EXPECT_EQ(edge.b, wall);
  EXPECT_NEAR(edge.time, 0.6, 1e-14);
  EXPECT_LT((edge.normal - Vec3(1, -1, 0).normalized()).norm(), 1e-13);
  EXPECT_NEAR(edge.approach_speed, stated(file, "4 / sqrt(2) = "), 5e-13);
  const Vec3 fall(0, -g * (0.7 - 0.6), 0);
  EXPECT_LT((after.velocity[run.number("edge")] - fall - Vec3(-1.1, 2.1, 0)).norm(), 1e-12);

  EXPECT_EQ(corner.b, wall);
  EXPECT_NEAR(corner.time, 0.6, 1e-14);
  EXPECT_LT((corner.normal - Vec3(1, -1, 1).normalized()).norm(), 1e-13);
  EXPECT_NEAR(corner.approach_speed, stated(file, "4.5 / sqrt(3) = "), 5e-13);
  EXPECT_LT((after.velocity[run.number("corner")] - fall - Vec3(-0.2, 1.2, -2.2)).norm(), 1e-12);
}

}  // namespace
}  // namespace carom::testing
