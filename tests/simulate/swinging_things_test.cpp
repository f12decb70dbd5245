// Fixed things on a sine or a circle, and in windows that repeat: impacts, rest and lift-off against closed forms and
// against Newton's method in long double, and the work that they do.
#include <gtest/gtest.h>

#include <numbers>

#include "physics/world.h"
#include "simulate/build.h"
#include "simulate/snapshot.h"
#include "std.h"

namespace carom {
namespace {

using Long = long double;

constexpr Long turn = 2 * std::numbers::pi_v<long double>;

/// A table whose height above its place in the file is amplitude sin(2 pi t / period + phase).
struct Table {
  double amplitude;  // m
  double period;     // s
  double phase = 0;  // degrees

  Long angle(Long t) const { return turn * (t / static_cast<Long>(period) + static_cast<Long>(phase) / 360); }
  Long rate() const { return turn / static_cast<Long>(period); }
  Long height(Long t) const { return amplitude * std::sin(angle(t)); }
  Long velocity(Long t) const { return amplitude * rate() * std::cos(angle(t)); }
  Long acceleration(Long t) const { return -rate() * rate() * height(t); }
};

/// The table's amplitude for a greatest acceleration of so many g.
double amplitude_for(double times_g, double period) {
  const double rate = static_cast<double>(turn) / period;
  return times_g * g_n / (rate * rate);
}

/// A ball of radius 0.1 m above the table, `above` (m) it, at speed `up` (m/s) relative to it. Its entity is 0, the
/// table's 1.
Problem on_table(const Table& table, double above, double up, double e) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  const auto start = static_cast<double>(table.height(0));
  problem.ball({0, start + 0.1 + above, 0}, {0, up + static_cast<double>(table.velocity(0)), 0}, 2, 0.1, e);
  problem.plane({0, start, 0}, {0, 1, 0});
  problem.move(1, motion_on_sine({0, table.amplitude, 0}, table.period, table.phase));
  return problem;
}

/// The first time after t at which a ball meets the table that leaves it then at speed v (m/s), by small steps and
/// Newton's method.
Long next_landing(const Table& table, Long t, Long v) {
  const Long start = table.height(t);
  const auto gap = [&](Long s) { return start + v * s - Long{0.5} * g_n * s * s - table.height(t + s); };
  const auto slope = [&](Long s) { return v - g_n * s - table.velocity(t + s); };
  // The gap rises from 0 until its slope is negative for the first time.
  const Long step = table.period / Long{3000};
  Long s = step;
  while (gap(s) > 0) s += step;
  for (int k = 0; k < 60; ++k) {
    const Long change = gap(s) / slope(s);
    s -= change;
  }
  return t + s;
}

TEST(SwingingThings, ABouncingBallLandsWhereNewtonsMethodFindsIt) {
  for (const double e : {1.0, 0.8, 0.5})
    for (const double times_g : {0.3, 1.5, 4.0}) {
      const Table table{amplitude_for(times_g, 0.1), 0.1, 30};
      Problem problem = on_table(table, 0.05, 0.1, e);
      problem.options.duration = 10;
      const Outcome run = run_exact(problem);
      ASSERT_GT(run.collisions.size(), 10u) << e;

      // Each hop starts from what the one before has left.
      double worst = 0;
      size_t followed = 0;
      for (size_t k = 0; k + 1 < run.collisions.size(); ++k) {
        const Collision& hit = run.collisions[k];
        const Long v = table.velocity(hit.time) + static_cast<Long>(hit.separation_speed);
        if (hit.separation_speed < 0.02) continue;
        ++followed;
        worst = max(worst, static_cast<double>(std::abs(next_landing(table, hit.time, v) -
                                                        static_cast<Long>(run.collisions[k + 1].time))));
      }

      EXPECT_GT(followed, 4u);
      EXPECT_LT(worst, 3e-14) << e << ' ' << times_g;
      EXPECT_NEAR(residual(problem, run), 0, 1e-11) << e << ' ' << times_g;
      EXPECT_NEAR(unbooked(problem, run), 0, 1e-12) << e << ' ' << times_g;
    }
}

TEST(SwingingThings, ABallRestsOnATableThatFallsLessThanFreely) {
  for (const double times_g : {0.2, 0.99}) {
    const Table table{amplitude_for(times_g, 0.05), 0.05, -90};
    Problem problem = on_table(table, 0, 0, 0.5);
    problem.options.duration = 1000 * table.period;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    double place = 0, speed = 0, force = 0;
    for (int k = 1; k < 2000; ++k) {
      const double t = k * problem.options.duration / 2000.7;
      go_to(*simulator, t);
      place = max(place, std::abs(static_cast<double>(simulator->state().position[0].y() - 0.1L - table.height(t))));
      speed = max(speed, std::abs(static_cast<double>(simulator->state().velocity[0].y() - table.velocity(t))));
      force = max(force, std::abs(static_cast<double>(force_between(*simulator, 0, 1) -
                                                      2 * (static_cast<Long>(g_n) + table.acceleration(t)))));
    }
    std::cout << times_g << " g: off by " << place << " m, " << speed << " m/s, " << force << " N, "
              << simulator->effort().events << " events\n";
    EXPECT_LT(place, 1e-12);
    EXPECT_LT(speed, 1e-11);
    EXPECT_LT(force, 1e-9);

    const Outcome run = run_exact(problem);
    EXPECT_TRUE(run.all.empty());
    std::cout << "residual " << residual(problem, run) << " J, work " << run.tally.work << " J\n";
    EXPECT_NEAR(residual(problem, run), 0, 1e-11);
  }
}

TEST(SwingingThings, ATableThatFallsFasterThanFreelyLosesItsBallAtThatInstant) {
  for (const double times_g : {1.0001, 1.2, 3.0}) {
    const Table table{amplitude_for(times_g, 0.2), 0.2, -90};
    Problem problem = on_table(table, 0, 0, 0);
    problem.options.duration = 0.6;
    // -90 degrees and on: the table's acceleration is -g where its height is amplitude / times_g.
    const Long off = (std::asin(1 / static_cast<Long>(times_g)) + turn / 4) / table.rate();
    const Long v = table.velocity(off);
    const Long landing = next_landing(table, off, v);

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    for (const double share : {0.1, 0.5, 0.9}) {
      const Long t = off + share * (landing - off);
      go_to(*simulator, static_cast<double>(t));
      const Long s = static_cast<Long>(simulator->time()) - off;
      EXPECT_NEAR(simulator->state().position[0].y(),
                  static_cast<double>(0.1L + table.height(off) + v * s - g_n * s * s / 2), 1e-13)
          << times_g;
    }

    const Outcome run = run_exact(problem);
    EXPECT_NEAR(residual(problem, run), 0, 1e-12) << times_g;
    if (times_g > 1.1) {
      ASSERT_FALSE(run.collisions.empty()) << times_g;
      EXPECT_NEAR(run.collisions[0].time, static_cast<double>(landing), 1e-12) << times_g;
    } else {
      EXPECT_TRUE(run.collisions.empty()) << "so low a hop is none";
      EXPECT_NEAR(run.end.position[0].y(), static_cast<double>(0.1L + table.height(problem.options.duration)), 1e-15);
    }
  }
}

TEST(SwingingThings, AnObstacleOnACircleHitsABallAtTheTimeOfTheClosedForm) {
  for (const double distance : {2.5, 1.2}) {
    Problem problem;
    problem.options.duration = 3;
    problem.ball({distance, 0, 0.5}, {0, 0, 0}, 1, 0.25, 1);
    problem.obstacle({0, -2, 0.5}, Volume::sphere(0.5));
    problem.move(1, motion_on_circle({0, -2, 0.5}, {0, 0, 0}, {0, 0, 3}, 4));

    // The centres are 0.75 m apart: 2^2 + d^2 - 4 d cos(angle) = 0.75^2, from 90 degrees on.
    const Outcome run = run_exact(problem);
    const double cosine = (4 + distance * distance - 0.75 * 0.75) / (4 * distance);
    if (cosine > 1) {
      EXPECT_TRUE(run.collisions.empty());
      continue;
    }
    ASSERT_EQ(run.collisions.size(), 1u);
    const double left = std::acos(cosine);
    EXPECT_NEAR(run.collisions[0].time, 1 - left / (2 * std::numbers::pi) * 4, 1e-14);
    EXPECT_NEAR(residual(problem, run), 0, 1e-13);
  }
}

TEST(SwingingThings, AWallThatShakesSidewaysPushesABallUntilItIsFastest) {
  for (int kind = 0; kind < 3; ++kind) {
    Problem problem;
    problem.options.duration = 2;
    const double amplitude = 0.03, period = 0.5;
    problem.ball({1 - amplitude + 0.2, 0, 0}, {0, 0, 0}, 3, 0.2, 0.5);
    if (kind == 0) problem.plane({1 - amplitude, 0, 0}, {1, 0, 0});
    if (kind == 1) problem.wall({1 - amplitude, 0, 0}, {1, 0, 0}, 2, 2);
    if (kind == 2) problem.obstacle({0.5 - amplitude, 0, 0}, Volume::box({1, 1, 1}));
    problem.move(1, motion_on_sine({amplitude, 0, 0}, period, -90));

    const Outcome run = run_exact(problem);
    const double fastest = amplitude * 2 * std::numbers::pi / period;
    EXPECT_NEAR(run.end.velocity[0].x(), fastest, 1e-12) << kind;
    EXPECT_NEAR(run.end.position[0].x(), 1.2 + fastest * (2 - period / 4), 3e-12) << kind;
    EXPECT_NEAR(residual(problem, run), 0, 1e-12) << kind;
    EXPECT_NEAR(run.tally.work, 1.5 * fastest * fastest, 1e-12) << kind;
  }
}

TEST(SwingingThings, WindowsThatRepeatAreThoseThatAreWrittenOut) {
  const auto problem = [](const SurfaceMotion& motion) {
    Problem made;
    made.world.gravity = Vec3(0, -g_n, 0);
    made.options.duration = 30;
    for (int k = 0; k < 4; ++k) made.ball({1.5 * k, 0.75 + 0.3 * k, 0}, {0, 0, 0}, 1, 0.5, k < 2 ? 0.7 : 0.0);
    made.ball({0.4, 3, 0.2}, {0, 0, 0}, 1, 0.5, 0.5);
    made.plane({0, 0, 0}, {0, 1, 0});
    made.move(5, motion);
    return made;
  };

  const vector<MotionWindow> period = {{0.125, 0.375, {0, 0.5, 0}}, {0.5, 0.75, {0, -0.375, 0}}};
  vector<MotionWindow> all;
  for (int n = 0; n < 30; ++n)
    for (MotionWindow w : period) {
      w.from += n, w.until += n;
      all.push_back(w);
    }

  const Outcome repeated = run_exact(problem(motion_in_windows(period, 1)));
  const Outcome written = run_exact(problem(motion_in_windows(all)));
  ASSERT_EQ(repeated.all.size(), written.all.size());
  ASSERT_GT(repeated.all.size(), 100u);
  for (size_t k = 0; k < written.all.size(); ++k) EXPECT_EQ(repeated.all[k].time, written.all[k].time) << k;
  for (Entity i = 0; i < 5; ++i) EXPECT_EQ(repeated.end.position[i], written.end.position[i]) << i;
  EXPECT_NEAR(residual(problem(motion_in_windows(period, 1)), repeated), 0, 1e-9);
}

/// Three boxes on one another, and three balls between walls: two side by side and one on them. All of it on a table.
Problem piles(const SurfaceMotion& motion) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  for (int k = 0; k < 3; ++k) problem.body(Volume::box({0.2, 0.2, 0.2}), {-1, 0.1 + 0.2 * k, 0}, {0, 0, 0}, 1 + k, 0.5);
  for (int k = 0; k < 2; ++k) problem.ball({0.1 + 0.2 * k, 0.1, 0}, {0, 0, 0}, 1, 0.1, 0.5);
  problem.ball({0.2, 0.1 + sqrt(0.03), 0}, {0, 0, 0}, 2, 0.1, 0.5);

  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.wall({0, 0.5, 0}, {1, 0, 0}, 1, 1);
  problem.wall({0.4, 0.5, 0}, {-1, 0, 0}, 1, 1);
  problem.move(6, motion);
  problem.options.duration = 5;
  return problem;
}

TEST(SwingingThings, PilesGoUpAndDownWithTheirTable) {
  const Table table{amplitude_for(0.6, 0.25), 0.25, -90};
  Problem problem = piles(motion_on_sine({0, table.amplitude, 0}, table.period, table.phase));
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

  double place = 0, force = 0;
  for (int k = 1; k < 50; ++k) {
    const double t = 0.0999 * k;
    go_to(*simulator, t);
    const double up = static_cast<double>(table.height(t)) - static_cast<double>(table.height(0));
    for (Entity i = 0; i < 6; ++i)
      place = max(place, (simulator->state().position[i] - problem.initial.position[i] - Vec3(0, up, 0)).norm());
    force = max(force, std::abs(force_between(*simulator, 0, 6) -
                                static_cast<double>(6 * (static_cast<Long>(g_n) + table.acceleration(t)))));
  }
  std::cout << "piles: off by " << place << " m, " << force << " N, " << simulator->effort().events << " events\n";
  EXPECT_LT(place, 1e-11);
  EXPECT_LT(force, 1e-9);

  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.collisions.empty());
  std::cout << "residual " << residual(problem, run) << " J\n";
  EXPECT_NEAR(residual(problem, run), 0, 1e-9);
}

TEST(SwingingThings, ATableOnACircleIsOneOnASine) {
  const double radius = amplitude_for(1.3, 0.3);
  const auto with = [&](const SurfaceMotion& motion) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.options.duration = 2;
    problem.ball({0.3, 0.1, 0}, {0.25, 0, 0}, 2, 0.1, 0.3);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.move(1, motion);
    return run_exact(problem);
  };

  const Outcome sine = with(motion_on_sine({0, radius, 0}, 0.3, -90));
  const Outcome circle = with(motion_on_circle({0, 0, 0}, {0, radius, 0}, {0, 0, 1}, 0.3));
  ASSERT_GT(sine.collisions.size(), 20u);
  ASSERT_GT(circle.collisions.size(), 20u);
  // What ends the hops is rounding, and their number with it.
  for (size_t k = 0; k < 20; ++k) EXPECT_NEAR(sine.collisions[k].time, circle.collisions[k].time, 1e-12) << k;
  EXPECT_LT((sine.end.position[0] - circle.end.position[0]).norm(), 1e-11);
  EXPECT_NEAR(sine.end.position[0].x(), 0.8, 1e-14) << "there is no friction";
}

TEST(SwingingThings, AGrooveOfTwoPlanesCarriesItsBall) {
  const Table table{amplitude_for(0.5, 0.2), 0.2, -90};
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  problem.options.duration = 10;
  problem.ball({0, 0.1 * sqrt(2.0), 0}, {0, 0, 0.5}, 2, 0.1, 0.5);
  problem.plane({0, 0, 0}, {1, 1, 0});
  problem.plane({0, 0, 0}, {-1, 1, 0});
  for (const Entity e : {1u, 2u}) problem.move(e, motion_on_sine({0, table.amplitude, 0}, table.period, table.phase));

  const Outcome run = run_exact(problem);
  EXPECT_TRUE(run.all.empty());
  const double up = static_cast<double>(table.height(10)) - static_cast<double>(table.height(0));
  EXPECT_LT((run.end.position[0] - Vec3(0, 0.1 * sqrt(2.0) + up, 5)).norm(), 1e-12);
  EXPECT_NEAR(residual(problem, run), 0, 1e-11);
}

/// Balls in a shaken room without a lid.
Problem shaken_room(int balls, double times_g, double e, bool backwards = false) {
  Problem problem;
  problem.world.gravity = Vec3(0, -g_n, 0);
  const auto n = static_cast<Entity>(balls);
  for (int k = 0; k < balls; ++k) {
    const int number = backwards ? balls - 1 - k : k;
    const double off = 0.02 * std::fmod(number * 0.618, 1);
    const double across = 0.02 * std::fmod(number * 0.755, 1);
    problem.ball({-0.18 + 0.12 * (number % 4) + off, 0.06 + 0.13 * (number / 16) + off,
                  -0.18 + 0.12 * (number / 4 % 4) + across},
                 {0, 0, 0}, 1, 0.045, e);
  }

  problem.plane({0, 0, 0}, {0, 1, 0});
  for (const double side : {-1, 1}) {
    problem.plane({0.25 * side, 0, 0}, {-side, 0, 0});
    problem.plane({0, 0, 0.25 * side}, {0, 0, -side});
  }
  const SurfaceMotion shake = motion_on_sine({0.002, amplitude_for(times_g, 0.1), 0}, 0.1, -90);
  for (Entity fixed = n; fixed < n + 5; ++fixed) problem.move(fixed, shake);
  return problem;
}

TEST(SwingingThings, BothEnginesAndEveryOrderOfBodiesGiveOneMotion) {
  for (const double times_g : {0.7, 2.5}) {
    Problem problem = shaken_room(6, times_g, 0.4);
    problem.options.duration = 0.5;
    const Outcome exact = run_exact(problem);
    ASSERT_GT(exact.collisions.size(), 20u);
    EXPECT_NEAR(residual(problem, exact), 0, 1e-11);

    Problem backwards = shaken_room(6, times_g, 0.4, true);
    backwards.options.duration = 0.5;
    const Outcome other = run_exact(backwards);
    for (Entity i = 0; i < 6; ++i)
      EXPECT_LT((other.end.position[5 - i] - exact.end.position[i]).norm(), 1e-9) << times_g << ' ' << i;

    for (const Integrator integrator : {Integrator::dop853, Integrator::rk4, Integrator::verlet}) {
      problem.options.closed_forms = false;
      problem.options.integrator = integrator;
      problem.options.step = integrator == Integrator::dop853 ? infinity : 1e-3;
      const Outcome stepped = run_exact(problem);
      for (Entity i = 0; i < 6; ++i)
        EXPECT_LT((stepped.end.position[i] - exact.end.position[i]).norm(), 1e-9) << times_g << ' ' << i;
    }
  }
}

TEST(SwingingThings, CrowdsInThemBalanceTheirEnergyAndDoNotOverlap) {
  for (const double times_g : {0.5, 2.0}) {
    Problem problem = shaken_room(60, times_g, 0.3);
    problem.options.duration = 1.5;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    const Outcome run = run_to_end(*simulator, problem.options.duration);

    std::cout << times_g << " g: work " << run.tally.work << " J, residual " << residual(problem, run) << " J, overlap "
              << run.tally.max_overlap << " m\n";
    const double turned_over = std::abs(run.tally.work) + run.tally.energy_lost;
    EXPECT_NEAR(unbooked(problem, run), 0, 1e-11 * turned_over) << times_g;
    EXPECT_NEAR(residual(problem, run), 0, 1e-4 * turned_over) << times_g;
    EXPECT_LT(run.tally.max_overlap, 1e-10 * 0.045) << times_g;
    for (const Vec3& x : run.end.position) {
      EXPECT_GT(x.y(), fixed_position(problem.world, 60, {1.5, 0}).y() + 0.045 - 1e-9);
      EXPECT_LT(std::abs(x.z()), 0.25 - 0.045 + 1e-9);
    }
  }
}

TEST(SwingingThings, FarAwayCostNothing) {
  const auto events = [](const SurfaceMotion& motion) {
    Problem problem;
    problem.world.gravity = Vec3(0, -g_n, 0);
    problem.options.duration = 100;
    problem.ball({0, 2, 0}, {0.1, 0, 0}, 1, 0.1, 0.9);
    problem.ball({0.15, 0.1, 0}, {0, 0, 0.2}, 1, 0.1, 0.9);
    problem.plane({0, 0, 0}, {0, 1, 0});
    problem.wall({500, 0, 0}, {1, 0, 0}, 2, 2);
    problem.move(3, motion);

    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
    go_to(*simulator, 100);
    return pair(simulator->effort().events, simulator->effort().surface_tests);
  };
  const vector<MotionWindow> back_and_forth = {{0, 0.01, {1, 0, 0}}, {0.01, 0.02, {-1, 0, 0}}};
  EXPECT_EQ(events(motion_on_sine({1, 0, 0}, 0.01, 0)), events({}));
  EXPECT_EQ(events(motion_in_windows(back_and_forth, 0.02)), events({}));
}

TEST(SwingingThings, LeaveNoRoomForABodyThatTheyPressAgainstAWall) {
  Problem problem;
  problem.options.duration = 1;
  problem.ball({0.1, 0, 0}, {0, 0, 0}, 1, 0.1, 0.5);
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.plane({0.25, 0, 0}, {-1, 0, 0});
  problem.move(2, motion_on_sine({0.1, 0, 0}, 1, 180));
  EXPECT_NE(error_of(problem).find("no room left between"), string::npos);
  // With more room than the amplitude it is struck to and fro.
  problem.world.planes[1].point.x() = 0.302;
  EXPECT_EQ(error_of(problem), "");
}

TEST(SwingingThings, SnapshotsGoOnWithTheSameBits) {
  for (Problem problem :
       {shaken_room(12, 0.7, 0.4), shaken_room(30, 2, 0.3), piles(motion_on_sine({0, 0.01, 0}, 0.4, 90))}) {
    problem.options.duration = 0.4;
    problem.options.record_paths = true;
    expect_same_when_restored([&] { return make_exact_simulator(problem.world, problem.initial, problem.options); },
                              {0.1, 0.25, 0.4}, 2);
  }
}

TEST(SwingingThings, AHollowSphereOrTubeStrikesABallOnItsAxisAsTwoPlanesDo) {
  const auto times = [](int kind) {
    Problem problem;
    problem.ball({0.1, 0, 0}, {0.7, 0, 0}, 1, 0.1);
    if (kind == 0) {
      problem.plane({-1, 0, 0}, {1, 0, 0});
      problem.plane({1, 0, 0}, {-1, 0, 0});
    } else if (kind == 1) {
      problem.world.obstacles.push_back({Vec3::Zero(), Volume::sphere(1), nullopt, Hollow::whole});
    } else {
      problem.world.obstacles.push_back({Vec3::Zero(), Volume::cylinder(1, 3), nullopt, Hollow::side});
    }

    for (Entity e = 1; e < problem.world.entity_count(); ++e) problem.move(e, motion_on_sine({0.1, 0, 0}, 1.3, 20));
    problem.options.duration = 30;
    vector<double> found;
    for (const Collision& c : run_exact(problem).collisions) found.push_back(c.time);
    return found;
  };

  const vector<double> planes = times(0);
  EXPECT_GT(planes.size(), 20u);
  for (const int kind : {1, 2}) {
    const vector<double> hollow = times(kind);
    ASSERT_EQ(hollow.size(), planes.size()) << kind;
    // Each impact makes an error of time greater.
    for (size_t k = 0; k < 7; ++k) EXPECT_NEAR(hollow[k], planes[k], 1e-12) << k << " of " << kind;
  }
}

}  // namespace
}  // namespace carom
