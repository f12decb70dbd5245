// What a simulator saves is its whole state: a restored one goes on with the same bits.
// Measured: a crowd of 10,000 balls has 1,600 bytes for each, takes 6 ms to save and 4 ms to restore. A gas of 10,648
// balls has 220 bytes, 0.9 ms and 0.6 ms.
#include "simulate/snapshot.h"

#include <random>

#include "physics/archive.h"
#include "physics/world.h"
#include "simulate/pile.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

MakeSimulator maker(const Problem& problem) {
  return [&problem] { return make_exact_simulator(problem.world, problem.initial, problem.options); };
}

Problem recorded(Problem problem) {
  problem.options.record_collisions = true;
  problem.options.record_paths = true;
  const Entity bodies = problem.world.body_count();
  problem.options.watch = {{Quantity::y, 0, bodies}, {Quantity::speed, 0, 1}, {Quantity::speed, 0, 1, {1, 2}, true}};
  problem.options.impulses = {{{{0, problem.world.entity_count()}}},
                              {{{0, 1}}, vector<EntityRange>{{1, bodies}}, {1, 4}}};
  return problem;
}

vector<double> times_until(double end, int count) {
  vector<double> times;
  for (int k = 1; k <= count; ++k) times.push_back(end * k / count);
  return times;
}

TEST(Snapshot, OfAPileGoesOnWithTheSameBitsFromItsFallToItsSleep) {
  SLOW_WITH_SANITIZERS();
  for (const int threads : {1, 2}) {
    Problem problem = recorded(loose_pile(4, 19, 60));
    problem.options.threads = threads;
    expect_same_when_restored(maker(problem), {0.1, 0.6, 1, 1.4, 1.41, 2, 3, 5, 9, 20, 60}, threads == 1 ? 3 : 6);
  }
}

TEST(Snapshot, OfAThousandBallsGoesOnAsTheyBecomeACrowd) {
  SLOW_WITH_SANITIZERS();
  const Problem problem = loose_pile(8, 16, 4);
  expect_same_when_restored(maker(problem), {0.2, 0.8, 1.2, 1.5, 1.8}, 3);
}

TEST(Snapshot, OfACrowdInSlabsIsTheSameByAnyNumberOfThreads) {
  SLOW_WITH_SANITIZERS();
  Problem problem = loose_pile(8, 32, 4);
  const auto simulator = maker(problem)();
  go_to(*simulator, 1.5);
  const string bytes = simulator->save();

  string later;
  for (const int threads : {1, 2}) {
    problem.options.threads = threads;
    const auto other = restored(maker(problem), bytes);
    EXPECT_EQ(other->save(), bytes);
    go_to(*other, 1.55);
    if (threads == 1) later = other->save();
    EXPECT_TRUE(other->save() == later) << "other bits by several threads";
  }
}

TEST(Snapshot, OfASleepingPileWakesAsTheOneThatWasNeverStopped) {
  Problem problem = loose_pile(3, 4, 60);
  problem.ball({1.7, 1800, 1.6}, Vec3::Zero(), 1, 0.5, 0.5);
  expect_same_when_restored(maker(recorded(problem)), {10, 18, 19.17, 19.2, 20, 25, 60}, 1);
}

/// Balls that slide down a globe, one over the other. `rise`: m/s, of the globe.
Problem globe(double rise) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.ball({0.2, sqrt(2.25 - 0.04), 0}, {0, rise, 0}, 1, 0.5, 0);
  problem.ball({-0.3, 4, 0.1}, Vec3::Zero(), 2, 0.25, 0.25);
  problem.obstacle(Vec3::Zero(), Volume::sphere(1));
  problem.plane({0, -3, 0}, {0, 1, 0});
  if (rise != 0) problem.move(2, {{0, 0.7, {0, rise, 0}}});
  problem.options.duration = 8;
  return recorded(problem);
}

TEST(Snapshot, GoesOnWithConstrainedMotionOverAGlobe) {
  for (const double rise : {0.0, 0.25}) {
    const Problem problem = globe(rise);
    expect_same_when_restored(maker(problem), times_until(problem.options.duration, 200), 9);
  }
}

TEST(Snapshot, GoesOnWithBallsInAMovingTroughOfRoundThings) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);

  std::mt19937_64 random(5);
  for (int k = 0; k < 7; ++k)
    problem.ball({0.3 * k - 1 + 1e-3 * static_cast<double>(random() % 100), 2.5 + 0.7 * k, 0.01 * k}, Vec3::Zero(),
                 1 + k % 3, 0.25, 0.3);

  for (int k = -2; k <= 2; ++k) problem.obstacle({0.9 * k, 0.2 * k * k, 0}, Volume::sphere(0.75));
  problem.plane({0, 0, -0.6}, {0, 0, 1});
  problem.plane({0, 0, 0.6}, {0, 0, -1});

  const Entity first = problem.world.body_count() + 2;
  for (int k = 0; k < 5; ++k) problem.move(first + k, {{1, 2, {0.3, 0.1, 0}}, {3, 4, {-0.3, -0.1, 0}}});
  problem.options.duration = 6;
  expect_same_when_restored(maker(recorded(problem)), times_until(6, 150), 60);
}

/// A row of balls on strings, of which the first is lifted, and a slack one beside it.
Problem cradle(double e) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  for (int k = 0; k < 5; ++k) {
    const double x = 0.1 * k, angle = k == 0 ? 0.5 : 0;
    const Vec3 at(x - std::sin(angle), -std::cos(angle), 0);
    const Entity ball = problem.ball(at, Vec3::Zero(), 1, 0.05, e);
    problem.world.strings.push_back({ball, no_entity, Vec3(x, 0, 0), (at - Vec3(x, 0, 0)).norm()});
  }

  const Entity loose = problem.ball({2, -0.5, 0}, {1, 0, 0.5}, 1, 0.05, e);
  problem.world.strings.push_back({loose, no_entity, Vec3(2, 0, 0), 1, 0.5});

  problem.options.duration = 6;
  return recorded(problem);
}

TEST(Snapshot, GoesOnWithACradleAndASwing) {
  for (const double e : {1.0, 0.6, 0.0}) {
    const Problem problem = cradle(e);
    expect_same_when_restored(maker(problem), times_until(6, 120), 40);
  }
}

/// Balls under forces with and without closed forms, in windows, among walls and regions.
Problem forced(Integrator integrator, bool closed_forms) {
  Problem problem;
  std::mt19937_64 random(3);
  const auto some = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (int k = 0; k < 8; ++k)
    problem.ball({k % 2 - 0.5 + 0.1 * some(), k / 2 % 2 - 0.5 + 0.1 * some(), k / 4 - 0.5 + 0.1 * some()},
                 {some(), some(), some()}, 1 + 0.2 * k, 0.1, 0.9);
  problem.room({-1, -1, -1}, {1, 1, 1});
  problem.world.gravity = Vec3(0, -1, 0);
  problem.options.duration = 5;
  problem.options.integrator = integrator;
  problem.options.closed_forms = closed_forms;
  if (integrator != Integrator::dop853) problem.options.step = 0.01;

  WorldRegion region;
  region.volume = Volume::box({1, 1, 1});
  problem.world.regions.push_back(region);
  region.position = Vec3(0.8, 0, 0);
  region.volume = Volume::sphere(0.3);
  region.removes = true;
  region.on = {6, 7};
  problem.world.regions.push_back(region);
  return recorded(problem);
}

TEST(Snapshot, GoesOnWithPathsByEveryMethodUnderEveryForce) {
  SLOW_WITH_SANITIZERS();
  const vector<vector<Force>> cases = {
      {},
      {{Drag{0.3, 0, Vec3(0.1, 0, 0)}, 0, 2}},
      {{Drag{0.3, 0.2, Vec3::Zero()}}},
      {{Spring{Vec3::Zero(), 3, 0, 0}}, {Drag{0.1, 0, Vec3::Zero()}}},
      {{Spring{Vec3(0, 0.1, 0), 3, 0, 0}, 0.5, 4, {1, 2, 7}}},
      {{Spring{Vec3(0, 0.1, 0), 3, 0.4, 0.2}, 0.5, 4}},
      {{Attractor{Vec3(5, 0, 0), 2, 0}, 0, 3, {0, 1, 2, 3}}, {UniformForce{Vec3(0.5, 0, 0)}, 1, 4}}};

  for (const vector<Force>& forces : cases)
    for (const Integrator integrator : {Integrator::dop853, Integrator::rk4, Integrator::verlet, Integrator::euler})
      for (const bool closed_forms : {true, false}) {
        if (!closed_forms && integrator != Integrator::dop853) continue;

        Problem problem = forced(integrator, closed_forms);
        problem.world.forces = forces;
        // The second one is taken out of the world.
        problem.world.strings.push_back({0, 7, Vec3::Zero(), 2.5, 0.5});
        expect_same_when_restored(maker(problem), times_until(5, 25), 11);
      }
}

TEST(Snapshot, GoesOnWithMergingBodies) {
  for (const bool volumes : {false, true}) {
    Problem problem = forced(Integrator::dop853, true);
    if (volumes) problem.body(Volume::box({0.3, 0.2, 0.1}), {0, 0, 0}, {0.1, 0.2, 0}, 2, 0.5);
    problem.options.merge = true;
    problem.world.forces = {{UniformForce{Vec3(0.5, 0, 0)}, 1, 4, {1, 2}}};
    expect_same_when_restored(maker(recorded(problem)), times_until(5, 50), 20);
  }
}

TEST(Snapshot, MayBeTakenWhereABufferIsFull) {
  Problem problem = forced(Integrator::dop853, true);
  for (Vec3& v : problem.initial.velocity) v *= 300;
  problem.world.gravity = Vec3::Zero();
  problem.world.restitution.assign(problem.world.body_count(), 1);
  problem.world.regions.pop_back();
  expect_same_when_restored(maker(problem), {problem.options.duration}, 2);
}

TEST(Snapshot, GoesOnWithTheBooksProgram) {
  Problem problem = forced(Integrator::dop853, true);
  problem.world.impulse.assign(problem.world.body_count(), Vec3(0.1, 0.2, 0));
  for (const bool as_printed : {false, true})
    for (const bool records : {false, true}) {
      BookOptions options;
      options.as_printed = as_printed;
      options.record_paths = options.record_collisions = records;
      options.stop_collisions = 60;
      if (records) options.watch = problem.options.watch;

      const MakeSimulator make = [&] { return make_book_simulator(problem.world, problem.initial, options); };
      expect_same_when_restored(make, times_until(5, 33), 12);
    }
}

TEST(Snapshot, OfARunThatStopsGoesOnToTheSameEnd) {
  Problem problem = loose_pile(2, 2, 3);
  problem.options.stop_collisions = 20;
  expect_same_when_restored(maker(recorded(problem)), times_until(3, 30), 25);
}

TEST(Snapshot, ThatIsTruncatedOrTooLongIsRefused) {
  const Problem problem = cradle(0.6);
  const MakeSimulator make = maker(problem);
  const auto simulator = make();
  go_to(*simulator, 1);
  const string bytes = simulator->save();
  for (size_t length = 0; length < bytes.size(); length += 1 + length / 50)
    EXPECT_THROW(restored(make, bytes.substr(0, length)), ArchiveError) << length;
  EXPECT_THROW(restored(make, bytes.substr(0, bytes.size() - 1)), ArchiveError);
  EXPECT_THROW(restored(make, bytes + '\0'), ArchiveError);
  EXPECT_NO_THROW(restored(make, bytes));
}

TEST(Snapshot, OfAnotherSceneIsRefused) {
  const Problem problem = loose_pile(3, 3, 5);
  const string bytes = maker(problem)()->save();

  Problem more = problem;
  more.ball({1, 20, 1}, Vec3::Zero());
  Problem longer = problem;
  longer.options.duration = 6;
  Problem tied = problem;
  tied.world.strings.push_back({0, no_entity, Vec3(0, 9, 0), 20});
  Problem elsewhere = problem;
  elsewhere.initial.position[26].x() += 0.125;
  Problem watched = recorded(problem);
  for (const Problem* other : {&more, &longer, &tied, &elsewhere, &watched})
    EXPECT_THROW(restored(maker(*other), bytes), ArchiveError);

  const BookOptions options;
  const MakeSimulator book = [&] { return make_book_simulator(problem.world, problem.initial, options); };
  EXPECT_THROW(restored(book, bytes), ArchiveError);
  EXPECT_THROW(restored(maker(problem), book()->save()), ArchiveError);
}

}  // namespace
}  // namespace carom
