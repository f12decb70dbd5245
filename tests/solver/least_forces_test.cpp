// Forces that the motion leaves open, against an independent solver (tests/data/open_forces.json) and closed forms.
#include "solver/least_forces.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "paths.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {
namespace {

constexpr uint32_t immovable = ContactConstraint::fixed;

/// Bodies at rest under 10 m/s^2, with contacts.
struct Standing {
  vector<double> inverse_mass;  // 1/kg
  vector<ContactConstraint> contacts;

  /// The forces (N) by contact, as the solver gives them.
  vector<double> forces() const {
    vector<Vec3> a(inverse_mass.size(), Vec3(0, -10, 0));
    vector<ContactConstraint> solved = contacts;
    EXPECT_TRUE(solve({inverse_mass, a, solved, true}).solved());
    vector<double> all;
    for (const ContactConstraint& c : solved) all.push_back(c.force);
    return all;
  }
};

Standing standing_of(const nlohmann::json& entry) {
  Standing standing;
  for (const double mass : entry["mass"]) standing.inverse_mass.push_back(1 / mass);
  for (const auto& c : entry["contacts"]) {
    const int b = c[1];
    standing.contacts.push_back(
        {c[0].get<uint32_t>(), b < 0 ? immovable : static_cast<uint32_t>(b), Vec3(c[2], c[3], c[4])});
  }
  return standing;
}

/// The same with other numbers of bodies and contacts. Contact k of it is contact which[k] of the given one.
Standing renumbered(const Standing& given, uint64_t seed, vector<size_t>& which) {
  std::mt19937_64 draw(seed);
  const auto shuffle = [&](auto& list) {
    for (size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[draw() % k]);
  };
  vector<uint32_t> number(given.inverse_mass.size());
  std::iota(number.begin(), number.end(), 0u);
  shuffle(number);
  which.resize(given.contacts.size());
  std::iota(which.begin(), which.end(), size_t{0});
  shuffle(which);

  Standing other = given;
  for (size_t i = 0; i < number.size(); ++i) other.inverse_mass[number[i]] = given.inverse_mass[i];
  for (size_t k = 0; k < which.size(); ++k) {
    ContactConstraint c = given.contacts[which[k]];
    c.a = number[c.a];
    if (c.b != immovable) {
      c.b = number[c.b];
      std::swap(c.a, c.b);
      c.normal = -c.normal;
    }
    other.contacts[k] = c;
  }
  return other;
}

TEST(LeastForces, AreThoseOfAnIndependentSolverInAnyOrder) {
  const auto all = nlohmann::json::parse(std::ifstream(DATA_DIR "/open_forces.json"));
  EXPECT_EQ(all.size(), 13u);
  for (const auto& entry : all) {
    const Standing standing = standing_of(entry);
    const vector<double> expected = entry["force"];
    const double greatest = *ranges::max_element(expected);

    for (uint64_t seed = 0; seed < 4; ++seed) {
      vector<size_t> which;
      const vector<double> forces = renumbered(standing, seed, which).forces();
      for (size_t k = 0; k < which.size(); ++k)
        EXPECT_NEAR(forces[k], expected[which[k]], 1e-11 * greatest) << entry["name"] << ' ' << seed << ' ' << k;
    }
  }
}

TEST(LeastForces, OfASlabAreTheSameOnAllItsLegs) {
  for (const int legs : {2, 3, 4, 25, 64}) {
    Standing slab{{1.0 / 8}, {}};
    for (int k = 0; k < legs; ++k) slab.contacts.push_back({0, immovable, Vec3(0, -1, 0)});
    for (const double force : slab.forces()) EXPECT_NEAR(force, 80.0 / legs, 1e-14 * 80) << legs;
  }
}

/// A slab on so many balls, which stand on the floor.
TEST(LeastForces, OfASlabOnBallsAreTheSameOnAll) {
  for (const uint32_t balls : {25u, 64u, 400u}) {
    Standing slab{{1.0 / 8}, {}};
    for (uint32_t k = 1; k <= balls; ++k) {
      slab.inverse_mass.push_back(1);
      slab.contacts.push_back({0, k, Vec3(0, -1, 0)});
      slab.contacts.push_back({k, immovable, Vec3(0, -1, 0)});
    }

    const vector<double> forces = slab.forces();
    for (uint32_t k = 0; k < balls; ++k) {
      EXPECT_NEAR(forces[2 * k], 80.0 / balls, 1e-12) << balls;
      EXPECT_NEAR(forces[2 * k + 1], 80.0 / balls + 10, 1e-12) << balls;
    }
  }
}

/// Forces that are off by a thousandth, of contacts of which some bear nothing.
TEST(LeastForces, CorrectedOnesLeaveNoMotion) {
  const auto all = nlohmann::json::parse(std::ifstream(DATA_DIR "/open_forces.json"));
  for (const auto& entry : all) {
    Standing standing = standing_of(entry);
    const vector<double> expected = entry["force"];
    for (size_t k = 0; k < expected.size(); ++k)
      standing.contacts[k].force = expected[k] * (k % 2 == 0 ? 1.001 : 0.999);
    vector<Vec3> a(standing.inverse_mass.size(), Vec3(0, -10, 0));
    correct_hold({standing.inverse_mass, a, standing.contacts});

    const double greatest = *ranges::max_element(expected);
    for (const Vec3& left : a) EXPECT_LT(left.norm(), 1e-11) << entry["name"];
    for (size_t k = 0; k < expected.size(); ++k) {
      EXPECT_GE(standing.contacts[k].force, 0);
      EXPECT_NEAR(standing.contacts[k].force, expected[k], 0.01 * greatest) << entry["name"];
    }
  }
}

/// A wall that only touches does not press.
TEST(LeastForces, OfWhatOnlyTouchesAreZero) {
  Standing box{{1}, {}};
  for (int k = 0; k < 3; ++k) box.contacts.push_back({0, immovable, Vec3(0, -1, 0)});
  for (const double side : {-1.0, 1.0}) box.contacts.push_back({0, immovable, Vec3(side, 0, 0)});
  const vector<double> forces = box.forces();
  EXPECT_EQ(forces[3], 0);
  EXPECT_EQ(forces[4], 0);
  EXPECT_NEAR(forces[0], 10.0 / 3, 1e-14);
}

}  // namespace
}  // namespace carom
