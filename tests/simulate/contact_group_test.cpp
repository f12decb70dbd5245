// Piles that fall, settle and lie, with free flights in steps of a given length.
#include <gtest/gtest.h>

#include "numerics/polynomial.h"
#include "physics/force_law.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "simulate/pile.h"
#include "simulate/random.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

unique_ptr<Simulator> stepped(const Problem& problem, double step, Integrator method = Integrator::rk4) {
  ExactOptions options;
  options.duration = problem.options.duration;
  options.step = step;
  options.integrator = method;
  options.record_collisions = false;
  return make_exact_simulator(problem.world, problem.initial, options);
}

TEST(ContactGroup, OfEverySizeComesToRestByEveryMethodAtEveryStep) {
  SLOW_WITH_SANITIZERS();
  for (const auto& [side, layers] : {pair(2, 8), pair(3, 10), pair(4, 4), pair(5, 5)})
    for (const auto& [method, step] :
         {pair(Integrator::euler, 0.01), pair(Integrator::verlet, 0.01), pair(Integrator::rk4, 0.01)}) {
      SCOPED_TRACE(testing::Message() << side << " by " << layers << ", " << static_cast<int>(method) << ", " << step);
      Problem problem = loose_pile(side, layers, 200);
      problem.world.forces = {{Drag{1, 0, Vec3::Zero()}}};  // else balls that are free may slide on and on
      expect_pile_at_rest(problem, *stepped(problem, step, method), {190, 195, 200}, 1e-9, 1e-9, 1e-30);
    }
}

TEST(ContactGroup, OfARowThatIsPushedIsNotPutToRest) {
  for (const int n : {25, 60})
    for (const double step : {1 / 256.0, 1 / 512.0}) {
      Problem problem;
      problem.world.gravity = Vec3(0, -9.80665, 0);
      problem.options.duration = 1;
      for (int k = 0; k < n; ++k) problem.ball({1.0 * k, 0.5, 0}, {0, 0, 0}, 1, 0.5, 0.5);
      problem.plane({0, 0, 0}, {0, 1, 0});
      problem.world.forces.push_back({UniformForce{Vec3(3, 0, 0)}, 0, never, {0}});

      const auto simulator = stepped(problem, step);
      go_to(*simulator, 1);

      const double way = 0.5 * 3 / n;  // m
      for (int k = 0; k < n; ++k)
        EXPECT_NEAR(simulator->state().position[static_cast<size_t>(k)].x() - k, way, 1e-12 * n) << n << ", " << step;
      EXPECT_EQ(simulator->tally().stepped_contact, 0);
    }
}

TEST(ContactGroup, GainsNoEnergyAsItSettles) {
  SLOW_WITH_SANITIZERS();
  for (const int side : {3, 5}) {
    const Problem problem = loose_pile(side, 6, 10);
    const auto simulator = stepped(problem, 0.01);

    double least = energy(problem, problem.initial);
    for (int k = 0; k <= 333; ++k) {
      const double t = k * 0.03;  // the instantaneous energy is right to first order
      go_to(*simulator, t);
      const double now = energy(problem, simulator->state());
      EXPECT_LT(now, 1.0003 * least) << side << " at " << t;
      least = std::min(least, now);
    }

    go_to(*simulator, 10);
    const Tally& tally = simulator->tally();
    const double first = energy(problem, problem.initial);
    const double last = energy(problem, simulator->state());
    EXPECT_NEAR((last + tally.energy_lost + tally.method_error) / first, 1, 1e-9);  // measured: 3e-10
    EXPECT_NEAR(tally.method_error, -tally.doubts.contact_made, 1e-10);             // errors of a crowd's steps
    EXPECT_LT(tally.doubts.contact_made / first, 1e-3);
  }
}

TEST(ContactGroup, HardlyOverlapsWhileItFalls) {
  SLOW_WITH_SANITIZERS();
  const Problem problem = loose_pile(7, 7, 3);
  const auto simulator = stepped(problem, 0.01);
  go_to(*simulator, 3);
  EXPECT_LT(simulator->tally().max_overlap, 1e-9);
}

TEST(ContactGroup, GivesItsForcesWhileItStillMoves) {
  const Problem problem = loose_pile(4, 4, 3);
  const auto simulator = stepped(problem, 0.01);
  go_to(*simulator, 3);
  EXPECT_GT(kinetic_energy(problem.world, simulator->state()), 0);
  EXPECT_GT(simulator->tally().resting, 56u);
  double on_floor = 0;
  for (const ContactForce& c : simulator->contacts())
    if (c.b == problem.world.body_count()) on_floor += c.force;
  EXPECT_NEAR(on_floor / (64 * 9.80665), 1, 0.1);
}

// Bodies far away change the order in which neighbours are found.
TEST(ContactGroup, MovesToTheSameBitsWhateverIsFarAway) {
  SLOW_WITH_SANITIZERS();
  const Problem alone = loose_pile(4, 4, 3);
  Problem others = alone;
  for (int k = 0; k < 500; ++k)
    others.ball({1e3 + 2.0 * k, 1e3 + 0.5 * (k % 7), 0}, {0.1 * (k % 3), 0, 0}, 1, 0.3 + 1e-3 * k);
  const auto a = stepped(alone, 0.01), b = stepped(others, 0.01);
  go_to(*a, 3);
  go_to(*b, 3);
  for (Entity i = 0; i < alone.world.body_count(); ++i) {
    EXPECT_EQ(a->state().position[i], b->state().position[i]) << i;
    EXPECT_EQ(a->state().velocity[i], b->state().velocity[i]) << i;
  }
}

}  // namespace
}  // namespace carom
