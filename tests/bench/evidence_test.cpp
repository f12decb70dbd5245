// The choice of the reference run and its error, with runs of one body at made-up positions.
#include "bench/evidence.h"
#include "physics/world.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

const vector<double> instants = {0.25, 0.75};  // s
constexpr double rounding = 1e-15;             // m

World one_body() {
  World world;
  world.mass = {1};
  world.radius = {0.1};
  world.restitution = {1};
  return world;
}

/// The body's position is wrong by `off` (m) at both instants.
RecordedRun run_off(double off) {
  RecordedRun run;
  for (int k = 0; k < 2; ++k) {
    State state;
    state.position = {Vec3(1 + off, 0, 0)};
    state.velocity = {Vec3(0, 0, 0)};
    run.states.push_back(state);
  }
  run.duration = 1;
  run.hash = static_cast<uint64_t>(1e18 * std::abs(off));
  return run;
}

Differences error(double position) {
  return {position, 0, 0, 0, 0};
}

const SimulationMethod exact,
    dop853{.engine = Engine::stepped, .integrator = Integrator::dop853, .steps = {.error = 1e-14}};

class EvidenceTest : public ::testing::Test {
 protected:
  Evidence of_exact(double off) {
    return {world_, instants, 1, error(rounding), 1e-16, {exact, run_off(off), error(rounding)}};
  }
  /// A method of this order: its error is `coarse` (m) in steps of 1/16 s, which are halved `halvings` times. `bias`:
  /// m, the error that it converges to.
  static void add_series(Evidence& evidence, Integrator integrator, int order, double coarse, int halvings,
                         double bias = 0) {
    for (int k = 0; k <= halvings; ++k)
      evidence.add_halved(
          {.engine = Engine::stepped, .integrator = integrator, .steps = {.length = std::ldexp(1.0 / 16, -k)}},
          run_off(bias + std::ldexp(coarse, -order * k)));
  }

  const World world_ = one_body();
};

TEST_F(EvidenceTest, AConfirmedExactRunIsTheReferenceToRounding) {
  Evidence evidence = of_exact(0);
  evidence.add({dop853, run_off(3e-14), error(5e-14)});
  add_series(evidence, Integrator::verlet, 2, 1e-3, 6);
  add_series(evidence, Integrator::rk4, 4, 1e-4, 6);
  const Verdict verdict = evidence.verdict();
  EXPECT_EQ(verdict.reference, 0u);
  EXPECT_EQ(verdict.error.position, rounding);
  ASSERT_EQ(verdict.witnesses.size(), 3u);
  for (const Witness& witness : verdict.witnesses) EXPECT_TRUE(witness.agrees) << full_name_of(witness.method);
  EXPECT_NEAR(verdict.witnesses[2].apart, 1e-4 / std::exp2(24), 1e-15);
}

TEST_F(EvidenceTest, AnExactRunThatTwoOthersContradictIsNotTheReference) {
  Evidence evidence = of_exact(1.1e-2);
  evidence.add({dop853, run_off(3e-14), error(5e-14)});
  add_series(evidence, Integrator::rk4, 4, 1e-4, 6);
  const Verdict verdict = evidence.verdict();
  EXPECT_TRUE(evidence.findings()[verdict.reference].method.is_stepped_by(Integrator::dop853));
  EXPECT_EQ(verdict.error.position, 5e-14);
  EXPECT_FALSE(verdict.witnesses[0].agrees);
  EXPECT_NEAR(verdict.witnesses[0].apart, 1.1e-2, 1e-12);
  EXPECT_TRUE(verdict.witnesses[1].agrees);
}

// Both may step over a bend of the path.
TEST_F(EvidenceTest, MethodsOfFixedStepsAloneDoNotOverruleTheExactRunButItsErrorIsTheirDifference) {
  Evidence evidence = of_exact(0);
  add_series(evidence, Integrator::verlet, 2, 1e-3, 6, 0.5);
  add_series(evidence, Integrator::rk4, 4, 1e-4, 6, 0.5);
  const Verdict verdict = evidence.verdict();
  EXPECT_EQ(verdict.reference, 0u);
  EXPECT_NEAR(verdict.error.position, 0.5, 1e-6);
  for (const Witness& witness : verdict.witnesses) EXPECT_FALSE(witness.agrees);
}

TEST_F(EvidenceTest, WhereTwoMethodsContradictEachOtherTheErrorIsAtLeastTheirDifference) {
  Evidence evidence = of_exact(0);
  evidence.add({dop853, run_off(1e-3), error(5e-14)});
  const Verdict verdict = evidence.verdict();
  EXPECT_EQ(verdict.reference, 0u);
  EXPECT_NEAR(verdict.error.position, 1e-3, 1e-12);
}

TEST_F(EvidenceTest, AMethodThatDoesNotConvergeIsNoEvidence) {
  Evidence evidence = of_exact(0);
  for (int k = 0; k < 8; ++k)
    evidence.add_halved({.engine = Engine::stepped, .steps = {.length = std::ldexp(1.0, -k)}},
                        run_off(k % 2 == 0 ? 0.1 : 0.2));
  EXPECT_TRUE(evidence.verdict().witnesses.empty());
}

TEST_F(EvidenceTest, ARunWithTheVeryBitsOfTheReferenceIsNoEvidence) {
  Evidence evidence = of_exact(0);
  for (int k = 0; k < 8; ++k)
    evidence.add_halved({.engine = Engine::stepped, .steps = {.length = std::ldexp(1.0, -k)}}, run_off(0));
  EXPECT_TRUE(evidence.verdict().witnesses.empty());
}

// Rounding of a position near 1 m in 1,000,000 steps adds up to 1e-10 m. Differences of 2e-11 m are below that.
TEST_F(EvidenceTest, RoundingInEachOfManyStepsIsNoContradiction) {
  Evidence evidence = of_exact(0);
  for (const double off : {3e-11, 2.5e-11, 2e-11})
    evidence.add_halved({.engine = Engine::stepped, .steps = {.length = 1e-6}}, run_off(off));
  ASSERT_EQ(evidence.verdict().witnesses.size(), 0u);  // it no longer converges
  for (const double off : {1e-9, 1e-10, 2e-11})
    evidence.add_halved({.engine = Engine::stepped, .integrator = Integrator::verlet, .steps = {.length = 1e-6}},
                        run_off(off));
  ASSERT_EQ(evidence.verdict().witnesses.size(), 1u);
  EXPECT_TRUE(evidence.verdict().witnesses[0].agrees);
}

}  // namespace
}  // namespace carom
