// The stepped simulator's contact group: piles that fall, settle and lie.
#include <gtest/gtest.h>

#include "physics/sweeps.h"
#include "simulate/pile.h"
#include "simulate/random.h"
#include "simulate/stepped.h"

namespace carom {
namespace {

std::unique_ptr<Simulator> stepped(const Problem& problem, double step, Integrator method = Integrator::rk4) {
  SteppedOptions options;
  options.duration = problem.options.duration;
  options.step = step;
  options.integrator = method;
  options.record_collisions = false;
  return make_stepped_simulator(problem.world, problem.initial, options);
}

TEST(ContactGroup, OfEverySizeComesToRestByEveryMethodAtEveryStep) {
  for (const auto& [side, layers] : {std::pair(2, 8), std::pair(3, 10), std::pair(4, 4), std::pair(5, 5)})
    for (const Integrator method : {Integrator::euler, Integrator::verlet, Integrator::rk4})
      for (const double step : {0.01, 0.004}) {
        SCOPED_TRACE(testing::Message() << side << " by " << layers << ", " << static_cast<int>(method) << ", "
                                        << step);
        const Problem problem = loose_pile(side, layers, 200);
        expect_pile_at_rest(problem, *stepped(problem, step, method), {190, 195, 200}, 2e-3, 1e-6);
      }
}

TEST(ContactGroup, GainsNoEnergyAsItSettles) {
  for (const int side : {3, 5})
    for (const double step : {0.01, 0.002}) {
      const Problem problem = loose_pile(side, 6, 10);
      const auto simulator = stepped(problem, step);
      double least = energy(problem, problem.initial);
      for (int k = 0; k <= 333; ++k) {
        const double t = k * 0.03;  // where steps end: in between energy is known to first order
        go_to(*simulator, t);
        const double now = energy(problem, simulator->state());
        EXPECT_LT(now, 1.0003 * least) << side << " at " << t << " by " << step;
        least = std::min(least, now);
      }
      const Tally& tally = simulator->tally();
      const double first = energy(problem, problem.initial);
      EXPECT_NEAR((energy(problem, simulator->state()) + tally.energy_lost) / first, 1, 1e-9);  // measured: 3e-10
    }
}

TEST(ContactGroup, HardlyOverlapsWhileItFalls) {
  const Problem problem = loose_pile(7, 7, 3);
  for (const double step : {0.02, 0.01, 0.001}) {
    const auto simulator = stepped(problem, step);
    go_to(*simulator, 3);
    EXPECT_LT(simulator->tally().max_overlap, 5e-3) << step;
  }
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

TEST(Sweeps, ComeToWhereTheOtherSolverIs) {
  Random random;
  std::vector<double> inverse_mass;
  std::vector<Vec3> free;
  for (int k = 0; k < 60; ++k) {
    inverse_mass.push_back(1 / random(1, 3));
    free.emplace_back(random(-1, 1), random(-1, 1), random(-1, 1));
  }
  std::vector<ContactConstraint> pairs;
  for (std::uint32_t k = 0; k < 150; ++k) {
    const auto a = static_cast<std::uint32_t>(random(0, 60)), b = static_cast<std::uint32_t>(random(0, 60));
    const Vec3 normal = Vec3(random(-1, 1), random(-1, 1), random(-1, 1)).normalized();
    if (a == b) continue;
    pairs.push_back({a, k % 5 == 0 ? ContactConstraint::fixed : b, normal, random(-0.2, 0.2), 1e-12, random(0, 1)});
  }
  std::vector<ContactConstraint> other = pairs;
  std::vector<Vec3> u = free, v = free;
  Sweeps sweeps;
  EXPECT_TRUE(sweeps.solve(inverse_mass, u, pairs, 3000));
  EXPECT_TRUE(solve({inverse_mass, v, other}).solved());
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_LT((u[k] - v[k]).norm(), 1e-10) << k;
  for (const ContactConstraint& p : pairs) {
    const Vec3 w = (p.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : u[p.b]) - u[p.a];
    EXPECT_GE(p.force, 0);
    EXPECT_GT(p.normal.dot(w), p.target - 1e-10);
  }
}

TEST(Sweeps, NeverLeaveMoreKineticEnergyThanThereWasHoweverBadTheGuess) {
  Random random;
  for (int run = 0; run < 100; ++run) {
    const std::vector<double> inverse_mass{1, 0.5, 20, 1};
    std::vector<Vec3> u;
    double before = 0, after = 0;
    for (int k = 0; k < 4; ++k) {
      u.emplace_back(random(-1, 1), 0, 0);
      before += 0.5 / inverse_mass[static_cast<std::size_t>(k)] * u.back().squaredNorm();
    }
    std::vector<ContactConstraint> pairs;
    for (std::uint32_t k = 0; k < 3; ++k) pairs.push_back({k, k + 1, Vec3(1, 0, 0), 0, 0, random(0, 10)});
    Sweeps().solve(inverse_mass, u, pairs, 2);
    for (std::size_t k = 0; k < 4; ++k) after += 0.5 / inverse_mass[k] * u[k].squaredNorm();
    EXPECT_LE(after, before + 1e-12);
  }
}

}  // namespace
}  // namespace carom
