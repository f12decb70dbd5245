// Contact to within its slack: the distance of such solutions from the exact ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "solver/contact_cases.h"
#include "solver/contact_island.h"
#include "solver/contact_projected_gradients.h"

namespace carom {
namespace {

using namespace contact_cases;

/// Rows, stacks, lattices and packings of every load. The contacts' slack is this share of the greatest free motion,
/// and forces are guessed at random.
std::vector<Case> cases(double slack) {
  std::vector<Case> all;
  for (const Load load : loads)
    for (const double decades : {0.0, 3.0})
      for (const Balls& balls :
           {row(12), stack(8), stack(40), lattice(2), lattice(3), packing(60, 1), packing(150, 2)}) {
        Case c = loaded(std::to_string(balls.center.size()), balls, load, decades);
        double most = 0;
        for (const Vec3& u : c.motion) most = std::max(most, u.norm());
        Draw draw(3);
        for (ContactConstraint& contact : c.contacts) {
          contact.slack = slack * most;
          contact.force = std::max(0.0, draw(-1, 1)) * most;
        }
        all.push_back(std::move(c));
      }
  return all;
}

Certificate solve_to(ContactAccuracy accuracy, Case& c) {
  return solve({c.inverse_mass, c.motion, c.contacts, accuracy});
}

/// By how much more than its slack a contact falls short, or presses while it parts, relative to the slack.
double beyond_slack(const Case& c) {
  double most = 0;
  for (const ContactConstraint& p : c.contacts) {
    const Vec3 b = p.b == fixed ? Vec3(Vec3::Zero()) : c.motion[p.b];
    const double w = p.normal.dot(b - c.motion[p.a]) - p.target;
    most = std::max(most, -w / p.slack);
  }
  return most;
}

double energy(const Case& c, const std::vector<Vec3>& motion) {
  double sum = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) sum += 0.5 / c.inverse_mass[k] * motion[k].squaredNorm();
  return sum;
}

TEST(ContactAccuracy, EveryContactIsWithinItsSlack) {
  for (const double slack : {1e-2, 1e-4, 1e-8, 1e-12})
    for (Case& c : cases(slack)) {
      const Certificate certificate = solve_to(ContactAccuracy::contacts, c);
      EXPECT_TRUE(certificate.solved()) << c.name;
      EXPECT_LE(beyond_slack(c), 1 + 1e-15 / slack) << c.name << ", slack " << slack;
      for (const ContactConstraint& p : c.contacts) EXPECT_GE(p.force, 0) << c.name;
    }
}

/// Error of M (motion - free) against the forces, relative to the greatest of both.
double unbalanced(const Case& given, const Case& c) {
  std::vector<Vec3> lacking;
  double most = 0, scale = 0;
  for (std::size_t k = 0; k < c.motion.size(); ++k) {
    lacking.push_back((c.motion[k] - given.motion[k]) / c.inverse_mass[k]);
    scale = std::max(scale, (given.motion[k] / c.inverse_mass[k]).norm());
  }
  for (const ContactConstraint& p : c.contacts) {
    lacking[p.a] += p.force * p.normal;
    if (p.b != fixed) lacking[p.b] -= p.force * p.normal;
    scale = std::max(scale, p.force);
  }
  for (const Vec3& f : lacking) most = std::max(most, f.norm());
  return most / scale;
}

TEST(ContactAccuracy, TheMotionIsWhatTheForcesMakeOfIt) {
  for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy})
    for (const double slack : {10.0, 1.0, 1e-1, 1e-3})
      for (Case& c : cases(slack)) {
        const Case given = c;
        EXPECT_TRUE(solve_to(accuracy, c).solved()) << c.name;
        EXPECT_LE(unbalanced(given, c), 1e-12) << c.name << ", slack " << slack;
      }
}

/// The energy of the motion's error, relative to that of contacts off by their slack.
TEST(ContactAccuracy, EnergyIsRightToThatOfTheSlack) {
  double most = 0;
  for (const double slack : {1e-2, 1e-3, 1e-4, 1e-6})
    for (Case& c : cases(slack)) {
      Case exact = c;
      EXPECT_TRUE(solve_to(ContactAccuracy::rounding, exact).solved()) << c.name;
      EXPECT_TRUE(solve_to(ContactAccuracy::energy, c).solved()) << c.name;
      std::vector<Vec3> off = c.motion;
      for (std::size_t k = 0; k < off.size(); ++k) off[k] -= exact.motion[k];
      double of_slack = 0;
      for (const ContactConstraint& p : c.contacts)
        of_slack += 0.5 * p.slack * p.slack / (c.inverse_mass[p.a] + (p.b == fixed ? 0 : c.inverse_mass[p.b]));
      const double share = energy(c, off) / of_slack;
      EXPECT_LT(share, 32) << c.name << ", slack " << slack;
      most = std::max(most, share);
    }
  std::printf("at most %.3g of the slack's\n", most);
}

TEST(ContactAccuracy, NoEnergyIsMadeHoweverBadTheGuess) {
  for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy})
    for (const double slack : {1e-1, 1e-3})
      for (Case& c : cases(slack)) {
        const double before = energy(c, c.motion);
        solve_to(accuracy, c);
        EXPECT_LE(energy(c, c.motion), before * (1 + 1e-14)) << c.name;
      }
}

TEST(ContactAccuracy, OtherUnitsGiveTheSameBits) {
  const double mass = 0x1p-7, length = 0x1p21;
  for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy, ContactAccuracy::rounding})
    for (Case& c : cases(1e-4)) {
      Case other = c;
      for (double& w : other.inverse_mass) w /= mass;
      for (Vec3& u : other.motion) u *= length;
      for (ContactConstraint& p : other.contacts) {
        p.slack *= length;
        p.force *= mass * length;
      }
      solve_to(accuracy, c);
      solve_to(accuracy, other);
      for (std::size_t k = 0; k < c.motion.size(); ++k)
        ASSERT_EQ(Vec3(length * c.motion[k]), other.motion[k]) << c.name << ", body " << k;
      for (std::size_t k = 0; k < c.contacts.size(); ++k)
        ASSERT_EQ(mass * length * c.contacts[k].force, other.contacts[k].force) << c.name << ", contact " << k;
    }
}

/// Two cases side by side without contact: neither changes the other's bits.
TEST(ContactAccuracy, OtherIslandsDoNotMatter) {
  for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy}) {
    std::vector<Case> all = cases(1e-3);
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
      Case one = all[k], both = all[k];
      const Case& company = all[k + 1];
      const auto n = static_cast<std::uint32_t>(one.motion.size());
      both.inverse_mass.insert(both.inverse_mass.end(), company.inverse_mass.begin(), company.inverse_mass.end());
      both.motion.insert(both.motion.end(), company.motion.begin(), company.motion.end());
      for (ContactConstraint p : company.contacts) {
        p.a += n;
        if (p.b != fixed) p.b += n;
        both.contacts.push_back(p);
      }
      solve_to(accuracy, one);
      solve_to(accuracy, both);
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(one.motion[i], both.motion[i]) << one.name << ", body " << i;
    }
  }
}

TEST(ContactAccuracy, ContactsThatCannotPartAreInfeasible) {
  const std::vector<double> inverse_mass{1};
  std::vector<Vec3> u{{0, 0, 0}};
  std::vector<ContactConstraint> contacts{{0, fixed, {1, 0, 0}, 0.1, 1e-3}, {0, fixed, {-1, 0, 0}, 0.1, 1e-3}};
  for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy})
    EXPECT_EQ(solve({inverse_mass, u, contacts, accuracy}).verdict, Certificate::Verdict::infeasible);
}

/// Rows of 1 to 6 balls between two fixed things that are to part from all: they press against one another, and no
/// force moves them.
TEST(ContactAccuracy, RowsThatArePinchedAreInfeasibleAndThenExact) {
  Draw draw(11);
  for (int run = 0; run < 300; ++run) {
    const auto n = static_cast<std::uint32_t>(draw(1, 7));
    std::vector<double> inverse_mass;
    std::vector<Vec3> free;
    for (std::uint32_t k = 0; k < n; ++k) {
      inverse_mass.push_back(draw(0.5, 2));
      free.push_back(draw.direction());
    }
    const Vec3 along = draw.direction();
    std::vector<ContactConstraint> contacts{{0, fixed, along, 0.01, 1e-3}, {n - 1, fixed, -along, 0.01, 1e-3}};
    for (std::uint32_t k = 0; k + 1 < n; ++k) contacts.push_back({k + 1, k, along, 0.01, 1e-3});
    std::vector<Vec3> u = free, exact = free;
    EXPECT_FALSE(solve({inverse_mass, u, contacts, ContactAccuracy::contacts}).solved());
    for (ContactConstraint& c : contacts) c.target = c.force = 0;
    u = free;
    EXPECT_TRUE(solve({inverse_mass, u, contacts, ContactAccuracy::contacts}).solved());
    EXPECT_TRUE(solve({inverse_mass, exact, contacts}).solved());
    for (std::uint32_t k = 0; k < n; ++k) EXPECT_LT((u[k] - exact[k]).norm(), 3e-3);  // m/s; measured: 1.1e-3
  }
}

/// A ball between two walls, with a far too large guess of both forces.
TEST(ContactAccuracy, GuessesThatDoNothingAreNone) {
  Draw draw(12);
  for (int run = 0; run < 300; ++run) {
    const std::vector<double> inverse_mass{1};
    const Vec3 free = draw.direction(), along = draw.direction();
    const double guess = std::pow(10, draw(0, 18));
    for (const ContactAccuracy accuracy : {ContactAccuracy::contacts, ContactAccuracy::energy}) {
      std::vector<ContactConstraint> contacts{{0, fixed, along, 0, 1e-3, guess}, {0, fixed, -along, 0, 1e-3, guess}};
      std::vector<Vec3> u{free};
      EXPECT_TRUE(solve({inverse_mass, u, contacts, accuracy}).solved());
      EXPECT_LT((u[0] - (free - along.dot(free) * along)).norm(), 3e-3);  // m/s; measured: 6e-4
    }
  }
}

/// A ball on a pebble on the floor: the pebble's contact is as accurate as the ball's.
TEST(ContactAccuracy, EnergyOfHeavyBodiesDoesNotPayForLightOnes) {
  for (const double ratio : {1e1, 1e3, 1e6}) {
    const std::vector<double> inverse_mass{1 / ratio, 1 / ratio, 1};
    std::vector<Vec3> u(3, Vec3(0, -1, 0));
    std::vector<ContactConstraint> contacts{{0, fixed, {0, -1, 0}, 0, 1e-2, 0},
                                            {0, 1, {1, 0, 0}, 0, 1e-2, 0},
                                            {1, 2, {0, -1, 0}, 0, 1e-2, 0},
                                            {2, fixed, {0, -1, 0}, 0, 1e-2, 0}};
    EXPECT_TRUE(solve({inverse_mass, u, contacts, ContactAccuracy::energy}).solved());
    for (const Vec3& v : u) EXPECT_LT(v.norm(), 0.03) << ratio;  // m/s; measured: 2e-10
  }
}

TEST(ContactAccuracy, WhatIsNoNumberIsNotSolved) {
  const std::vector<double> inverse_mass{1, 1};
  for (const ContactAccuracy accuracy :
       {ContactAccuracy::rounding, ContactAccuracy::contacts, ContactAccuracy::energy}) {
    std::vector<Vec3> u{{std::nan(""), 0, 0}, {1, 0, 0}};
    std::vector<ContactConstraint> contacts{{0, 1, {1, 0, 0}, 0.1, 1e-3}, {0, 1, {0, 1, 0}, 0.1, 1e-3}};
    EXPECT_FALSE(solve({inverse_mass, u, contacts, accuracy}).solved());
    EXPECT_FALSE(solve({inverse_mass, u, {contacts.data(), 1}, accuracy}).solved());
  }
}

ContactIsland island_of(const Case& c) {
  ContactIsland island;
  island.inverse_mass = c.inverse_mass;
  island.free = c.motion;
  for (const ContactConstraint& p : c.contacts) {
    ContactIsland::Row row;
    row.a = p.a;
    row.b = p.b;
    row.normal = p.normal;
    row.slack = p.slack;
    island.rows.push_back(row);
  }
  island.scale();
  return island;
}

TEST(ContactIsland, ReachIsTheWayFromOneRowToTheFarthest) {
  EXPECT_EQ(island_of(loaded("", stack(1), Load::gravity, 0)).reach(), 0u);
  EXPECT_EQ(island_of(loaded("", stack(20), Load::gravity, 0)).reach(), 19u);
  EXPECT_EQ(island_of(loaded("", stack(200), Load::gravity, 0)).reach(), 199u);
}

TEST(ContactProjectedGradients, GoOnFromWhereTheirCostHasStoppedThem) {
  Case c = loaded("", packing(60, 1), Load::gravity, 0);
  for (ContactConstraint& p : c.contacts) p.slack = 1e-9;
  const ContactIsland island = island_of(c);
  ContactProjectedGradients at_once, by_parts;
  ContactSolution one, other;
  at_once.start(island);
  by_parts.start(island);
  double cost = 0;  // ns
  int parts = 1;
  for (; !by_parts.run(ContactAccuracy::contacts, cost += 2e4); ++parts) ASSERT_LT(parts, 1000);
  EXPECT_GT(parts, 2);
  ASSERT_TRUE(at_once.run(ContactAccuracy::contacts, 1e12));
  EXPECT_EQ(at_once.finish(one), by_parts.finish(other));
  for (std::size_t k = 0; k < one.motion.size(); ++k) EXPECT_EQ(one.motion[k].value(), other.motion[k].value());
}

}  // namespace
}  // namespace carom
