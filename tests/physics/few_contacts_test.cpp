// Few contacts, solved to rounding: against what is known, and against conjugate gradients.
#include "physics/few_contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom {
namespace {

constexpr std::uint32_t fixed = PressedPair::none;

/// A row of three along x: a wall, a light ball, a heavy one that comes in at 1 m/s.
TEST(FewContacts, ALightBallBetweenAWallAndAHeavyOneStopsIt) {
  for (const double light : {1.0, 1e-4, 1e-9, 1e-14}) {
    const std::vector<double> inverse_mass{1 / light, 1};
    std::vector<Vec3> u{{0.3, 0, 0}, {-1, 0, 0}};
    std::vector<PressedPair> pairs{{0, fixed, {-1, 0, 0}}, {0, 1, {1, 0, 0}}};
    EXPECT_TRUE(press_few_apart(inverse_mass, u, pairs));
    EXPECT_LT(std::abs(u[0].x()), 1e-15) << light;  // m/s; measured: 1e-30
    EXPECT_LT(std::abs(u[1].x()), 1e-15) << light;
    EXPECT_NEAR(pairs[1].force, 1, 1e-15) << light;
    EXPECT_NEAR(pairs[0].force, 1 - 0.3 * light, 1e-15) << light;
  }
}

TEST(FewContacts, WhatPartsIsLeftAlone) {
  const std::vector<double> inverse_mass{1, 2};
  std::vector<Vec3> u{{0.5, 0, 0}, {1, 3, 0}};
  const std::vector<Vec3> before = u;
  std::vector<PressedPair> pairs{{0, 1, {1, 0, 0}}, {0, fixed, {-1, 0, 0}}};
  EXPECT_TRUE(press_few_apart(inverse_mass, u, pairs));
  EXPECT_EQ(u, before);
  EXPECT_EQ(pairs[0].force, 0);
}

/// Pairs of bodies in a row and of each with the floor, in directions and with masses from a fixed rule.
struct Crowd {
  std::vector<double> inverse_mass;
  std::vector<Vec3> u;
  std::vector<PressedPair> pairs;
};

Crowd crowd(std::uint32_t seed) {
  Crowd c;
  std::uint32_t state = seed * 2654435761u + 1;
  const auto draw = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 0x1p23 - 1;
  };
  for (std::uint32_t i = 0; i < 8; ++i) {
    c.inverse_mass.push_back(1.5 + draw());
    c.u.emplace_back(draw(), draw(), draw());
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    c.pairs.push_back({i, fixed, Vec3(0.2 * draw(), -1, 0.2 * draw()).normalized(), 0.1 * draw()});
    if (i > 0) c.pairs.push_back({i - 1, i, Vec3(1, 0.5 * draw(), 0.5 * draw()).normalized(), 0.1 * draw()});
  }
  return c;
}

TEST(FewContacts, AgreeWithConjugateGradients) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    Crowd p = crowd(seed), q = p;
    for (PressedPair& pair : q.pairs) pair.slack = 1e-15;
    EXPECT_TRUE(press_few_apart(p.inverse_mass, p.u, p.pairs));
    press_apart(q.inverse_mass, q.u, q.pairs, 10000);
    for (std::size_t i = 0; i < p.u.size(); ++i) EXPECT_LT((p.u[i] - q.u[i]).norm(), 1e-13) << seed;
    for (std::size_t c = 0; c < p.pairs.size(); ++c) {
      const PressedPair& pair = p.pairs[c];
      const Vec3 w = (pair.b == fixed ? Vec3(Vec3::Zero()) : p.u[pair.b]) - p.u[pair.a];
      const double excess = pair.normal.dot(w) - pair.target;
      EXPECT_GE(pair.force, 0);
      EXPECT_GT(excess, -1e-15) << seed;
      EXPECT_LT(pair.force * excess, 1e-15) << seed;
    }
  }
}

TEST(FewContacts, ScalingByPowersOfTwoKeepsTheBits) {
  Crowd p = crowd(7), q = p;
  for (double& w : q.inverse_mass) w *= 0x1p-5;
  for (Vec3& u : q.u) u *= 0x1p7;
  for (PressedPair& pair : q.pairs) pair.target *= 0x1p7;
  press_few_apart(p.inverse_mass, p.u, p.pairs);
  press_few_apart(q.inverse_mass, q.u, q.pairs);
  for (std::size_t i = 0; i < p.u.size(); ++i) EXPECT_EQ(p.u[i] * 0x1p7, q.u[i]);
  for (std::size_t c = 0; c < p.pairs.size(); ++c) EXPECT_EQ(p.pairs[c].force * 0x1p12, q.pairs[c].force);
}

}  // namespace
}  // namespace carom
