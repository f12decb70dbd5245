// The tightest volumes: closed forms, degenerate clouds, and spheres known by construction.
#include "geometry/fit.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

constexpr double eps = 0x1p-52;

double noise(uint64_t& seed) {  // -1 to 1
  seed = seed * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(seed >> 11U) * 0x1p-52 - 1;
}

Vec3 direction(uint64_t& seed) {
  while (true) {
    const double x = noise(seed), y = noise(seed), z = noise(seed);
    const Vec3 v(x, y, z);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

bool holds(const Fit& fit, const Vec3& p) {
  const Vec3 d = p - fit.center;
  const Vec3& half = fit.volume.half;
  switch (fit.volume.shape) {
    case Shape::sphere:
      return d.norm() <= half.x();
    case Shape::cylinder:
      return hypot(d.x(), d.z()) <= half.x() && std::abs(d.y()) <= half.y();
    case Shape::box:
      break;
  }
  return (d.cwiseAbs().array() <= half.array()).all();
}

void expect_holds(const Fit& fit, const vector<Vec3>& points) {
  for (const Vec3& p : points) ASSERT_TRUE(holds(fit, p)) << p.transpose();
}

string error_of(Shape shape, const vector<Vec3>& points) {
  try {
    tightest(shape, points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(TightestSphere, OfACubesCornersIsItsCircumsphere) {
  vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 3 : 1, i & 2 ? 3 : 1, i & 4 ? 3 : 1);
  const Fit fit = tightest(Shape::sphere, points);
  EXPECT_NEAR(fit.volume.half.x(), sqrt(3.0), 8 * eps);  // measured: 5
  EXPECT_LT((fit.center - Vec3(2, 2, 2)).norm(), 4 * eps);
  expect_holds(fit, points);
}

TEST(TightestSphere, OfAnObtuseTriangleStandsOnItsLongestSide) {
  const vector<Vec3> points{{-1, 0, 0}, {1, 0, 0}, {0.3, 0.4, 0.1}};
  EXPECT_NEAR(tightest(Shape::sphere, points).volume.half.x(), 1, 2 * eps);
}

TEST(TightestSphere, OfAnAcuteTriangleIsItsCircumcircle) {
  // Sides 13, 14, 15: area 84, circumradius 13 * 14 * 15 / (4 * 84).
  const vector<Vec3> points{{0, 0, 7}, {14, 0, 7}, {5, 12, 7}};
  const Fit fit = tightest(Shape::sphere, points);
  EXPECT_NEAR(fit.volume.half.x(), 8.125, 16 * eps);
  EXPECT_LT((fit.center - Vec3(7, 4.125, 7)).norm(), 16 * eps);
}

// A sphere is the smallest around points on it if its centre lies between them: around any hull of the centre.
TEST(TightestSphere, IsFoundWhateverItsSupportAndHowCloudedItIs) {
  uint64_t seed = 3;
  double worst = 0, worst_center = 0;
  for (int round = 0; round < 2000; ++round) {
    const Vec3 center = std::ldexp(1.0, round % 21 - 10) * Vec3(noise(seed), noise(seed), noise(seed));
    const double radius = std::ldexp(1.0 + 0.5 * noise(seed), round % 31 - 15);

    vector<Vec3> on;
    const int support = 2 + round % 3;
    for (int i = 0; i + 1 < support; ++i) on.push_back(direction(seed));
    Vec3 against = Vec3::Zero();
    if (support == 2) against = -on[0];
    if (support == 3) against = -(on[0] + (0.6 + 0.4 * noise(seed)) * on[1]).normalized();
    if (support == 4)
      against = -(on[0] + (0.6 + 0.4 * noise(seed)) * on[1] + (0.6 + 0.4 * noise(seed)) * on[2]).normalized();
    on.push_back(against);

    vector<Vec3> points;
    for (int i = 0; i < round % 50; ++i) points.push_back(center + 0.999 * radius * direction(seed));
    for (const Vec3& v : on)
      points.insert(points.begin() + round % (static_cast<int>(points.size()) + 1), center + radius * v);

    const Fit fit = tightest(Shape::sphere, points);
    expect_holds(fit, points);
    // A point itself is rounded in its coordinates.
    const double scale = radius + 2 * center.norm();
    worst = std::max(worst, std::abs(fit.volume.half.x() - radius) / scale);
    worst_center = std::max(worst_center, (fit.center - center).norm() / scale);
  }

  EXPECT_LT(worst, 8 * eps);       // measured: 5.02 eps
  EXPECT_LT(worst_center, 1e-12);  // measured: 3.6e-13, where the support is nearly one-sided
}

TEST(TightestSphere, OfManyPointsOnOneSphereOrCircleOrLineIsThatOne) {
  uint64_t seed = 5;
  for (const Vec3& stretch : {Vec3(1, 1, 1), Vec3(1, 0, 1), Vec3(1, 0, 0)}) {
    vector<Vec3> points;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 v = direction(seed).cwiseProduct(stretch);
      points.push_back(v.norm() > 0 ? Vec3(v.normalized()) : v);
      points.push_back(points.back());  // twice
    }

    const Fit fit = tightest(Shape::sphere, points);
    EXPECT_NEAR(fit.volume.half.x(), 1, 8 * eps);
    EXPECT_LT(fit.center.norm(), 4 * eps);  // measured: 0.8 eps
    expect_holds(fit, points);
  }
}

TEST(TightestSphere, OfNearlyFlatAndNearlyStraightCloudsIsNoLargerThanNeeded) {
  uint64_t seed = 9;
  for (const double thin : {1e-3, 1e-8, 1e-15, 1e-30, 1e-200}) {
    vector<Vec3> disc, line;
    for (int i = 0; i < 1000; ++i) {
      const double angle = noise(seed) * M_PI;
      disc.emplace_back(std::cos(angle), thin * noise(seed), std::sin(angle));
      line.emplace_back(noise(seed), thin * noise(seed), thin * noise(seed));
    }

    disc.insert(disc.end(), {{1, 0, 0}, {-1, 0, 0}});
    line.insert(line.end(), {{1, 0, 0}, {-1, 0, 0}});

    for (const auto& points : {disc, line}) {
      const Fit fit = tightest(Shape::sphere, points);
      EXPECT_GE(fit.volume.half.x(), 1);
      EXPECT_LE(fit.volume.half.x(), sqrt(1 + thin * thin) + 8 * eps) << thin;
      expect_holds(fit, points);
    }
  }
}

TEST(Tightest, ScaledByPowersOfTwoHasTheSameBits) {
  uint64_t seed = 11;
  vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back(Vec3(noise(seed), 2 * noise(seed), noise(seed)));

  for (const Shape shape : {Shape::sphere, Shape::cylinder, Shape::box}) {
    const Fit one = tightest(shape, points);
    for (const int power : {-600, -40, 7, 600}) {
      vector<Vec3> scaled;
      for (const Vec3& p : points) scaled.push_back(std::ldexp(1.0, power) * p);
      const Fit fit = tightest(shape, scaled);
      EXPECT_EQ(fit.volume.half, Vec3(std::ldexp(1.0, power) * one.volume.half));
      EXPECT_EQ(fit.center, Vec3(std::ldexp(1.0, power) * one.center));
    }
  }
}

TEST(TightestCylinder, HasTheSmallestCircleSeenFromAboveAndTheWholeHeight) {
  // From above the triangle 13, 14, 15, at different heights.
  const vector<Vec3> points{{0, -1, 0}, {14, 5, 0}, {5, 2, 12}, {7, 3, 4}};
  const Fit fit = tightest(Shape::cylinder, points);
  EXPECT_EQ(fit.volume.shape, Shape::cylinder);
  EXPECT_NEAR(fit.volume.half.x(), 8.125, 16 * eps);
  EXPECT_EQ(fit.volume.half.z(), fit.volume.half.x());
  EXPECT_EQ(fit.volume.half.y(), 3);
  EXPECT_LT((fit.center - Vec3(7, 2, 4.125)).norm(), 16 * eps);
  expect_holds(fit, points);
}

TEST(TightestBox, SpansTheExtremes) {
  const vector<Vec3> points{{0, -1, 3}, {14, 5, 0}, {5, 2, 12}};
  const Fit fit = tightest(Shape::box, points);
  EXPECT_EQ(fit.volume.half, Vec3(7, 3, 6));
  EXPECT_EQ(fit.center, Vec3(7, 2, 6));
}

TEST(Tightest, HoldsEveryPointOfAnyCloud) {
  uint64_t seed = 13;
  for (int round = 0; round < 300; ++round) {
    const Vec3 far = std::ldexp(1.0, round % 40) * Vec3(noise(seed), noise(seed), noise(seed));
    vector<Vec3> points;
    for (int i = 0; i < 3 + round; ++i) points.push_back(far + Vec3(noise(seed), noise(seed), noise(seed)));
    for (const Shape shape : {Shape::sphere, Shape::cylinder, Shape::box})
      expect_holds(tightest(shape, points), points);
  }
}

TEST(Tightest, ReportsErrorsOfItsPoints) {
  EXPECT_EQ(error_of(Shape::sphere, {}), "there are no points to fit a volume around");
  EXPECT_EQ(error_of(Shape::box, {{0, 0, 0}, {1, std::nan(""), 1}}), "a point is not finite");
  EXPECT_EQ(error_of(Shape::sphere, {{-1e308, 0, 0}, {1e308, 1, 1}}), "the points are too far apart");
  EXPECT_EQ(error_of(Shape::sphere, {{1, 2, 3}}), "all points are in one place: a volume around them has no size");

  EXPECT_EQ(error_of(Shape::box, {{1, 2, 3}, {1, 2, 3}}),
            "all points are in one place: a volume around them has no size");
  EXPECT_EQ(error_of(Shape::box, {{0, 0, 0}, {1, 0, 1}}),
            "the points have no extent along y: a box around them has no thickness");
  EXPECT_EQ(error_of(Shape::cylinder, {{0, 0, 0}, {1, 0, 1}}),
            "the points have no extent along y: a cylinder around them has no thickness");
  EXPECT_EQ(error_of(Shape::cylinder, {{0, 0, 0}, {0, 1, 0}}),
            "the points have no extent along x and z: a cylinder around them has no radius");

  EXPECT_EQ(error_of(Shape::sphere, {{0, 0, 0}, {1, 0, 0}}), "");  // a flat cloud has a sphere
}

TEST(TightestSphere, OfAMillionPointsTakesAFewPasses) {
  uint64_t seed = 17;
  vector<Vec3> points;
  for (int i = 0; i < 1'000'000; ++i) points.push_back(direction(seed));
  EXPECT_NEAR(tightest(Shape::sphere, points).volume.half.x(), 1, 8 * eps);  // 0.02 s; a pass for each would be hours
}

}  // namespace
}  // namespace carom
