// Contact, solved: against closed forms, against quadruple precision, against itself in other units and orders.
#include "solver/contact_problem.h"
#include "slow_with_sanitizers.h"

#include <gtest/gtest.h>

#include <numeric>

#include "solver/active_set.h"
#include "solver/contact_cases.h"
#include "solver/contact_interior_point.h"
#include "solver/contact_reference.h"
#include "std.h"

namespace carom {
namespace {

using namespace contact_cases;
using Verdict = Certificate::Verdict;

/// Solves a case: its motion and forces become the solution's.
Certificate solve_case(Case& c) {
  return solve({c.inverse_mass, c.motion, c.contacts});
}

double difference(const vector<Vec3>& u, const vector<Vec3>& v) {
  double most = 0;
  for (size_t i = 0; i < u.size(); ++i) most = std::max(most, (u[i] - v[i]).norm() / (1e-3 + u[i].norm()));
  return most;
}

/// The solution, certified, and against quadruple precision where that holds. Gives whether it does.
bool expect_exact(const Case& given) {
  Case c = given;
  const Certificate certificate = solve_case(c);
  EXPECT_TRUE(certificate.solved()) << c.name;
  EXPECT_LE(certificate.change, 1e-14) << c.name;  // measured: 1e-16 at most, mostly below 1e-24
  for (const ContactConstraint& contact : c.contacts) EXPECT_GE(contact.force, 0) << c.name;
  const Reference exact = reference(given.inverse_mass, given.motion, c.contacts);
  if (!exact.holds) return false;
  EXPECT_LE(exact.error(given.motion, c.motion), 1e-15) << c.name;  // measured: 2e-16
  return true;
}

/// A row of three along x: a wall, a light ball, a heavy one that comes in at 1 m/s.
TEST(ContactProblem, ALightBallBetweenAWallAndAHeavyOneStopsIt) {
  for (const double light : {1.0, 1e-4, 1e-9, 1e-14}) {
    const vector<double> inverse_mass{1 / light, 1};
    vector<Vec3> u{{0.3, 0, 0}, {-1, 0, 0}};
    vector<ContactConstraint> contacts{{0, fixed, {-1, 0, 0}}, {0, 1, {1, 0, 0}}};
    EXPECT_TRUE(solve({inverse_mass, u, contacts}).solved());
    EXPECT_LT(std::abs(u[0].x()), 1e-30) << light;  // m/s; measured: 0
    EXPECT_LT(std::abs(u[1].x()), 1e-30) << light;
    EXPECT_NEAR(contacts[1].force, 1, 1e-15) << light;
    EXPECT_NEAR(contacts[0].force, 1 - 0.3 * light, 1e-15) << light;
  }
}

TEST(ContactProblem, WhatPartsKeepsItsBits) {
  const vector<double> inverse_mass{1, 2, 0.1};
  vector<Vec3> u{{0.5, 0.1, 0}, {1, 3, 0.7}, {0.1, 1e-3, 7}};
  const vector<Vec3> before = u;
  vector<ContactConstraint> contacts{{0, 1, {1, 0, 0}}, {0, fixed, {-1, 0, 0}}};
  EXPECT_TRUE(solve({inverse_mass, u, contacts}).solved());
  EXPECT_EQ(u, before);
  EXPECT_EQ(contacts[0].force, 0);
}

/// The k-th contact of a stack carries all bodies above it.
TEST(ContactProblem, AStackBearsItsWeight) {
  for (const int n : {1, 2, 10, 100, 1000}) {
    Case c = loaded("stack", stack(n), Load::gravity, 0);
    EXPECT_TRUE(solve_case(c).solved()) << n;
    for (const Vec3& u : c.motion) EXPECT_LT(u.norm(), 1e-25) << n;
    for (size_t k = 0; k < c.contacts.size(); ++k) {
      const double above = static_cast<double>(n) - c.contacts[k].a - (c.contacts[k].b == fixed ? 0 : 1);
      EXPECT_NEAR(c.contacts[k].force, 9.81 * above, 1e-12 * above) << n;
    }
  }
}

/// The first ball of a free row strikes: all go on with their common momentum.
TEST(ContactProblem, AStruckRowGoesOnWithItsMomentum) {
  for (const int n : {2, 9, 60, 300}) {
    Case c = loaded("row", row(n), Load::gravity, 0);
    std::erase_if(c.contacts, [](const ContactConstraint& contact) { return contact.b == fixed; });
    ranges::fill(c.motion, Vec3::Zero());
    c.motion[0] = Vec3(1, 0, 0);
    EXPECT_TRUE(solve_case(c).solved());
    for (const Vec3& u : c.motion) EXPECT_NEAR(u.x(), 1.0 / n, 1e-16) << n;
  }
}

TEST(ContactProblem, SmallProblemsAreExactWhateverTheMasses) {
  int held = 0, all = 0;
  for (const Load load : loads)
    for (const double decades : {0.0, 3.0, 6.0, 9.0, 12.0}) {
      for (const int n : {2, 3, 10, 30}) {
        held += expect_exact(loaded("row of " + to_string(n), row(n), load, decades));
        held += expect_exact(loaded("stack of " + to_string(n), stack(n), load, decades));
      }

      held += expect_exact(loaded("lattice of 4", lattice(1), load, decades));
      held += expect_exact(loaded("lattice of 32", lattice(2), load, decades));
      held += expect_exact(loaded("packing of 12", packing(12, 3), load, decades));
      held += expect_exact(loaded("packing of 40", packing(40, 5), load, decades));
      all += 12;
    }
  EXPECT_GT(held, all * 3 / 4);  // measured: 164 of 180; elsewhere forces share a load among too many contacts
}

TEST(ContactProblem, WedgesAndNearCopiesAreExact) {
  for (int k = 2; k <= 12; ++k) {
    const double angle = pow(10.0, -k);
    expect_exact(wedge(angle, false));
    if (k <= 7) expect_exact(wedge(angle, true));
    expect_exact(with_copies(loaded("packing of 12", packing(12, 4), Load::push, 3), angle));
    expect_exact(with_copies(loaded("lattice of 4", lattice(1), Load::push, 0), angle));
    expect_exact(with_copies(loaded("stack of 10", stack(10), Load::push, 0), angle));
  }
}

/// A ball that the two walls of a wedge close in on at 1 m/s slips out at 1 / sin(angle).
TEST(ContactProblem, ABallIsSqueezedOutOfAWedge) {
  for (int k = 1; k <= 10; ++k) {
    const double angle = pow(10.0, -k), c = std::cos(angle), s = std::sin(angle);
    const vector<double> inverse_mass{1};
    vector<Vec3> u{Vec3::Zero()};
    vector<ContactConstraint> contacts{{0, fixed, {c, 0, -s}, 1}, {0, fixed, {-c, 0, -s}, 1}};
    EXPECT_TRUE(solve({inverse_mass, u, contacts}).solved());
    EXPECT_NEAR(u[0].z(), 1 / s, 1e-15 / s) << angle;
    EXPECT_NEAR(u[0].x(), 0, 1e-15) << angle;
  }
}

/// Either method replaces the other where that fails. Both find the same motion.
TEST(ContactProblem, BothMethodsFindTheSameMotion) {
  for (const Load load : loads)
    for (const double decades : {0.0, 3.0, 6.0})
      for (const Balls& balls : {stack(50), lattice(2), packing(60, 7)}) {
        const Case c = loaded("", balls, load, decades);

        ContactIsland island;
        island.inverse_mass = c.inverse_mass;
        island.free = c.motion;
        for (const ContactConstraint& contact : c.contacts) {
          ContactIsland::Row& r = island.rows.emplace_back();
          r.a = contact.a;
          r.b = contact.b;
          r.normal = contact.normal;
        }

        island.scale();

        ContactSolution one, other;
        DualActiveSet method;
        EXPECT_TRUE(method.solve(island, one).judgement.within_slack);
        EXPECT_TRUE(ContactInteriorPoint(island).solve(other).within_slack);

        for (size_t i = 0; i < one.motion.size(); ++i)
          EXPECT_NEAR(one.motion[i].hi, other.motion[i].hi, 1e-14);  // of a greatest of 1; measured: 1e-16
      }
}

/// Powers of two in mass, length and time.
TEST(ContactProblem, OtherUnitsGiveTheSameBits) {
  SLOW_WITH_SANITIZERS();
  for (const Load load : loads)
    for (const Balls& balls : {row(20), lattice(2), packing(60, 9)})
      for (const double decades : {0.0, 6.0}) {
        Case p = loaded("", balls, load, decades), q = p;
        for (double& w : q.inverse_mass) w *= 0x1p-5;
        for (Vec3& u : q.motion) u *= 0x1p7;
        EXPECT_EQ(solve_case(p).change, solve_case(q).change);
        for (size_t i = 0; i < p.motion.size(); ++i) EXPECT_EQ(p.motion[i] * 0x1p7, q.motion[i]);
        for (size_t k = 0; k < p.contacts.size(); ++k) EXPECT_EQ(p.contacts[k].force * 0x1p12, q.contacts[k].force);
      }
}

/// Contacts and bodies in another order; and another island beside them changes no bit.
TEST(ContactProblem, OrderAndOtherIslandsDoNotMatter) {
  const Case given = loaded("", packing(30, 2), Load::push, 3);
  Case p = given, reversed = given, beside = given;
  ranges::reverse(reversed.contacts);

  const auto n = static_cast<uint32_t>(given.motion.size());
  // The other island: the same, far heavier and faster.
  for (size_t i = 0; i < n; ++i) {
    beside.inverse_mass.push_back(1e9 * given.inverse_mass[i]);
    beside.motion.push_back(1e9 * given.motion[i]);
  }
  for (ContactConstraint c : given.contacts) {
    c.a += n;
    if (c.b != fixed) c.b += n;
    beside.contacts.push_back(c);
  }

  solve_case(p);
  solve_case(reversed);
  solve_case(beside);

  EXPECT_LE(difference(p.motion, reversed.motion), 1e-15);  // measured: 0
  for (size_t i = 0; i < n; ++i) EXPECT_EQ(p.motion[i], beside.motion[i]);
}

/// One contact is removed and restored, by a solver that keeps its factors: the motion is the same.
TEST(ContactProblem, AWarmStartFindsTheSame) {
  for (const Load load : loads)
    for (const double decades : {0.0, 6.0}) {
      const Case given = loaded("", packing(40, 6), load, decades);

      ContactSolver solver;
      Case first = given;
      EXPECT_TRUE(solver.solve({first.inverse_mass, first.motion, first.contacts}).solved());

      for (size_t away = 0; away < given.contacts.size(); away += 11) {
        Case without = given;
        without.contacts.erase(without.contacts.begin() + static_cast<ptrdiff_t>(away));

        Case cold = without, again = given;
        EXPECT_TRUE(solver.solve({without.inverse_mass, without.motion, without.contacts}).solved());
        solve_case(cold);
        EXPECT_LE(difference(cold.motion, without.motion), 1e-14);  // measured: 2e-16

        EXPECT_TRUE(solver.solve({again.inverse_mass, again.motion, again.contacts}).solved());
        EXPECT_LE(difference(first.motion, again.motion), 1e-14);
      }
    }
}

// One method keeps factors, the other does not. Factors of earlier problems must not be used.
TEST(ContactProblem, AWarmStartAfterProblemsOfOtherSizesFindsTheSame) {
  SLOW_WITH_SANITIZERS();
  for (const Load load : loads) {
    ContactSolver solver;
    for (const int balls : {40, 300, 300, 12, 300, 40}) {
      Case cold = loaded("", packing(balls, 6), load, 3), warm = cold;
      EXPECT_TRUE(solve_case(cold).solved());
      EXPECT_TRUE(solver.solve({warm.inverse_mass, warm.motion, warm.contacts}).solved());
      EXPECT_LE(difference(cold.motion, warm.motion), 1e-14) << balls;
    }
  }
}

/// A rod between two balls: they turn about their centre and keep their distance, which takes a pull.
TEST(ContactProblem, BilateralContactsPullToo) {
  const vector<double> inverse_mass{1, 0.5};
  vector<Vec3> a{{0, 0, 0}, {0, 0, 0}};
  vector<ContactConstraint> contacts{{0, 1, {1, 0, 0}, -3}};
  contacts[0].bilateral = true;
  EXPECT_TRUE(solve({inverse_mass, a, contacts}).solved());
  EXPECT_NEAR(a[0].x(), 2, 1e-15);
  EXPECT_NEAR(a[1].x(), -1, 1e-15);
  EXPECT_NEAR(contacts[0].force, -2, 1e-15);
}

/// With every contact bilateral, the motion is the orthogonal projection, also where contacts are redundant.
TEST(ContactProblem, BilateralContactsMayBeRedundant) {
  Case c = loaded("", lattice(2), Load::impact, 3);
  for (ContactConstraint& contact : c.contacts) contact.bilateral = true;
  EXPECT_TRUE(solve_case(c).solved());
  for (const Vec3& u : c.motion) EXPECT_LT(u.norm(), 1e-20);  // a box full of them cannot move
}

/// Two walls that close in on a ball.
TEST(ContactProblem, InfeasibleContactsAreReported) {
  const vector<double> inverse_mass{1};
  vector<Vec3> u{{0.2, 0, 0}};
  vector<ContactConstraint> contacts{{0, fixed, {1, 0, 0}, 1}, {0, fixed, {-1, 0, 0}, 1}};
  const Certificate certificate = solve({inverse_mass, u, contacts});
  EXPECT_EQ(certificate.verdict, Verdict::infeasible);
  EXPECT_GT(certificate.change, 0.1);
}

TEST(ContactProblem, NothingAtAllIsSolved) {
  vector<Vec3> u{Vec3::Zero()};
  const vector<double> inverse_mass{1};
  vector<ContactConstraint> contacts{{0, fixed, {1, 0, 0}, 0, 0, 7}};
  EXPECT_TRUE(solve({inverse_mass, u, {}}).solved());
  EXPECT_TRUE(solve({inverse_mass, u, contacts}).solved());
  EXPECT_EQ(contacts[0].force, 0);
  EXPECT_EQ(u[0], Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace carom
