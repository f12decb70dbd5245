// The method of order 8 against motions in closed form.
#include "numerics/dormand_prince.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

/// x'' = -x, and x'' = x' turned by a quarter: a circle about the start and one beside it.
vector<Vec3> acceleration(const vector<Vec3>& x, const vector<Vec3>& v) {
  return {-x[0], Vec3(-v[1].y(), v[1].x(), 0)};
}

Vec3 position(size_t k, double t) {
  return k == 0 ? Vec3(std::cos(t), std::sin(t), 0) : Vec3(std::sin(t), 1 - std::cos(t), 0);
}

Vec3 velocity(size_t k, double t) {
  return k == 0 ? Vec3(-std::sin(t), std::cos(t), 0) : Vec3(std::cos(t), std::sin(t), 0);
}

DormandPrince circles() {
  const vector<Vec3> x{position(0, 0), position(1, 0)}, v{velocity(0, 0), velocity(1, 0)};
  return {x, v, acceleration(x, v)};
}

/// m: the greatest error of a step of h at the share s of it.
double error_at(double h, double s) {
  DormandPrince motion = circles();
  motion.step(h, acceleration, 1, 1);
  motion.interpolate(acceleration);
  double worst = 0;
  for (size_t k = 0; k < 2; ++k) {
    const double t = s * h;
    worst = std::max(worst, (motion.start(k) + motion.displacement(k, t) - position(k, t)).norm());
    worst = std::max(worst, (motion.velocity(k, t) - velocity(k, t)).norm());
  }
  return worst;
}

TEST(DormandPrince, IsOfOrderEight) {
  // A step's error falls by 2^9 when it is halved.
  EXPECT_NEAR(std::log2(error_at(2, 1) / error_at(1, 1)), 9, 0.5);
  EXPECT_LT(error_at(0.25, 1), 5e-13);  // measured: 2.5e-13
}

TEST(DormandPrince, IsOfOrderSevenInBetween) {
  for (const double s : {0.2, 0.5, 0.8}) EXPECT_NEAR(std::log2(error_at(2, s) / error_at(1, s)), 8, 0.7) << s;
}

TEST(DormandPrince, HasAllPointsWhereEachOfThemIs) {
  DormandPrince motion = circles();
  motion.step(0.5, acceleration, 1, 1);
  motion.interpolate(acceleration);
  vector<Vec3> x, v;
  motion.at(0.3, x, v);
  for (size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(x[k], motion.start(k) + motion.displacement(k, 0.3));
    EXPECT_EQ(v[k], motion.velocity(k, 0.3));
  }
}

TEST(DormandPrince, EstimatesItsErrorOnTheSafeSide) {
  for (const double h : {0.25, 0.5, 1.0, 2.0}) {
    DormandPrince motion = circles();
    EXPECT_GE(motion.step(h, acceleration, 1, 1), 0.3 * error_at(h, 1)) << h;
  }
}

TEST(DormandPrince, ChoosesLongerStepsWhereTheErrorIsSmall) {
  EXPECT_LT(DormandPrince::next_length(1, 2), 0.9);
  EXPECT_GT(DormandPrince::next_length(1, 1e-3), 1.5);
  EXPECT_EQ(DormandPrince::next_length(1, 0), 6);
  EXPECT_EQ(DormandPrince::next_length(1, std::nan("")), 0.2);
  // A motion without error in the estimate: parabolas.
  const vector<Vec3> x{Vec3::Zero()}, v{Vec3(1, 2, 3)}, a{Vec3(0, -10, 0)};
  DormandPrince fall(x, v, a);
  EXPECT_LT(fall.step(
                1, [&](const auto&, const auto&) { return a; }, 1, 1),
            1e-13);  // measured: 2e-14
}

TEST(DormandPrince, InOtherUnitsHasTheSameBits) {
  const double length = 0x1p20, time = 0x1p-7;
  DormandPrince motion = circles();
  const double error = motion.step(0.5, acceleration, 1, 1);
  const vector<Vec3> x{length * position(0, 0)}, v{length / time * velocity(0, 0)};
  const auto scaled = [&](const vector<Vec3>& at, const vector<Vec3>&) { return vector<Vec3>{-at[0] / (time * time)}; };
  DormandPrince other(x, v, scaled(x, v));
  EXPECT_LE(other.step(0.5 * time, scaled, length, length / time), error);
  motion.interpolate(acceleration);
  other.interpolate(scaled);
  EXPECT_EQ(other.displacement(0, 0.3 * time), length * motion.displacement(0, 0.3));
}

}  // namespace
}  // namespace carom
