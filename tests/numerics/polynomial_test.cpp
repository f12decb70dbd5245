#include "numerics/polynomial.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

Polynomial from_roots(std::initializer_list<double> roots) {
  Polynomial p{{1}, 0};
  for (double r : roots) {
    Polynomial q{{}, p.degree + 1};
    for (int k = 0; k <= p.degree; ++k) {
      q.c[static_cast<size_t>(k + 1)] += p.c[static_cast<size_t>(k)];
      q.c[static_cast<size_t>(k)] -= r * p.c[static_cast<size_t>(k)];
    }
    p = q;
  }
  return p;
}

TEST(Roots, FourRootsAreAllFound) {
  const Roots roots = roots_between(from_roots({1, 2, 4, 8}), 0, 10);
  ASSERT_EQ(roots.count, 4);
  const double expected[] = {1, 2, 4, 8};
  for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(roots.at[k], expected[k], 4e-15 * expected[k]);
}

TEST(Roots, OnlyThoseInTheIntervalCount) {
  EXPECT_EQ(roots_between(from_roots({1, 2, 4, 8}), 1.5, 5).count, 2);
  EXPECT_EQ(roots_between(from_roots({1, 2, 4, 8}), 9, 50).count, 0);
}

TEST(Roots, TwoRootsAMillionthApartAreTwo) {
  const Roots roots = roots_between(from_roots({1, 1 + 1e-6, 3}), 0, 10);
  ASSERT_EQ(roots.count, 3);
  EXPECT_NEAR(roots.at[1] - roots.at[0], 1e-6, 2e-9);  // f is rounded by 1e-15, its slope is 2e-6
}

TEST(Roots, LeadingZerosLowerTheDegree) {
  const Roots roots = roots_between({{-6, 2, 0, 0, 0}, 4}, 0, 10);
  ASSERT_EQ(roots.count, 1);
  EXPECT_EQ(roots.at[0], 3);
  EXPECT_EQ(roots_between({{1, 0, 0, 0, 0}, 4}, 0, 10).count, 0);
}

TEST(FirstDescent, SkipsARiseThroughZero) {
  EXPECT_NEAR(first_descent(from_roots({1, 2, 3, 5}), 10), 1, 1e-15);        // + - + - +
  EXPECT_NEAR(first_descent({{-1, 2, -0.5}, 2}, 10), 2 + sqrt(2.0), 1e-15);  // rises at 0.59, falls at 3.41
}

TEST(FirstDescent, BelowZeroAndFallingIsNow) {
  EXPECT_EQ(first_descent({{-1e-17, -1}, 1}, 10), 0);
}

TEST(FirstDescent, BelowZeroAndRisingWaitsForTheTurningPoint) {
  EXPECT_EQ(first_descent({{-3, 2, -1}, 2}, 10), 1);  // greatest at t = 1, still below zero
}

TEST(FirstDescent, TouchingZeroFromAboveIsNone) {
  EXPECT_EQ(first_descent({{4, -4, 1}, 2}, 10), never);
}

TEST(FirstDescent, BeyondTheHorizonIsNever) {
  EXPECT_EQ(first_descent({{10, -1}, 1}, 9), never);
}

TEST(Descents, AreAllPiecesThatFallBelowZero) {
  Descents descents(from_roots({1, 2, 3, 5}), 10);
  Descents::Piece piece;
  ASSERT_TRUE(descents.next(piece));
  EXPECT_NEAR(piece.from, 1, 1e-15);
  EXPECT_GT(piece.to, 1);
  EXPECT_LT(piece.to, 2);
  ASSERT_TRUE(descents.next(piece));
  EXPECT_NEAR(piece.from, 3, 2e-14);
  EXPECT_FALSE(descents.next(piece));
}

TEST(Roots, OfAQuadraticAreExactWhereTheyAreClose) {
  // t^2 - 2 t + 1 - 2^-52 = (t - 1)^2 - 2^-52
  const Roots roots = roots_between({{1 - 0x1p-52, -2, 1}, 2}, 0, 10);
  ASSERT_EQ(roots.count, 2);
  EXPECT_EQ(roots.at[0], 1 - 0x1p-26);
  EXPECT_EQ(roots.at[1], 1 + 0x1p-26);
}

TEST(Roots, OfAQuadraticOfTinyNumbersAreFound) {
  EXPECT_EQ(roots_between({{0x1p-600, -0x1p-598, 0x1.8p-599}, 2}, 0, 10).count, 2);
}

}  // namespace
}  // namespace carom
