#include "geometry/contact_time.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

double meet(const Vec3& d, const Vec3& w, const Vec3& a = Vec3::Zero(), double s = 1, double horizon = 1e9,
            bool left = false) {
  return sphere_contact_time({d, w, a, 2 * w.norm(), left}, s, horizon);
}

TEST(ImpactTime, GrazingPairsAreHitOrMissedByTheSignOfTheExactMissDistance) {
  // Impact parameter b = 1 - 2^-k hits, 1 + 2^-k misses, from 4 and from 1e4 away, as far as doubles resolve it.
  for (int k = 2; k <= 52; ++k)
    for (double far : {4.0, 1e4}) {
      const double inside = 1 - std::ldexp(1.0, -k), outside = 1 + std::ldexp(1.0, -k);
      const double t = meet({far, inside, 0}, {-1, 0, 0});
      EXPECT_LT(t, far) << "k = " << k;
      const double exact = far - sqrt((1 - inside) * (1 + inside));
      EXPECT_NEAR(t / exact, 1, 3e-16) << "k = " << k << " far = " << far;
      if (k < 52) {
        EXPECT_EQ(meet({far, outside, 0}, {-1, 0, 0}), never) << "k = " << k;
      }
    }
}

TEST(ImpactTime, SeparatingPairsNeverMeet) {
  EXPECT_EQ(meet({3, 0, 0}, {1, 0, 0}), never);
  EXPECT_EQ(meet({0.999999, 0, 0}, {1, 0, 0}), never) << "overlapping, but separating";
}

TEST(ImpactTime, TouchingAndApproachingIsNow) {
  EXPECT_EQ(meet({1, 0, 0}, {-1, 0, 0}), 0);
  EXPECT_EQ(meet({1 - 1e-16, 0, 0}, {-1e-3, 0, 0}), 0);
}

TEST(ImpactTime, AnApproachWithinTheRoundingOfItsVelocitiesIsNone) {
  EXPECT_EQ(sphere_contact_time({{1, 0, 0}, {-1e-16, 0, 0}, Vec3::Zero(), 2, false}, 1, 1e9), never);
  EXPECT_EQ(sphere_contact_time({{1, 0, 0}, {-1e-16, 0, 0}, Vec3::Zero(), 2e-16, false}, 1, 1e9), 0);
}

TEST(ImpactTime, UnequalAccelerationsMeetAtTheParabolasRoot) {
  // Down by 5 t^2 from 6 to 1: t = 1. Upwards first: 6 + 10 t - 5 t^2 = 1 at t = 1 + sqrt 2.
  EXPECT_NEAR(meet({0, 6, 0}, {0, 0, 0}, {0, -10, 0}), 1, 2e-16);
  EXPECT_NEAR(meet({0, 6, 0}, {0, 10, 0}, {0, -10, 0}), 1 + sqrt(2.0), 1e-15);
}

TEST(ImpactTime, JustSeparatedPairsMeetAgainAfterTheWholeHop) {
  for (double v = 1; v > 1e-9; v /= 10)
    EXPECT_NEAR(meet({0, 1, 0}, {0, v, 0}, {0, -10, 0}, 1, 1e9, true) / (v / 5), 1, 1e-15) << "v = " << v;
}

TEST(ImpactTime, JustSeparatedPairsThatApproachAgainMeetNow) {
  for (double pull : {-10.0, 10.0, 1000.0})
    EXPECT_EQ(meet({0, 1, 0}, {0, -1e-3, 0}, {0, pull, 0}, 1, 1e9, true), 0) << "pulled by " << pull;
}

TEST(PlaneContact, EveryBranchFollowsItsClosedForm) {
  EXPECT_EQ(plane_contact_time(3, -2, 0, 0, false, 10), 1.5);
  EXPECT_EQ(plane_contact_time(3, 2, 0, 0, false, 10), never);
  EXPECT_EQ(plane_contact_time(5, 0, -10, 0, false, 10), 1);
  EXPECT_EQ(plane_contact_time(15, 10, -10, 0, false, 10), 3);
  EXPECT_EQ(plane_contact_time(15, -10, -10, 0, false, 10), 1);
  EXPECT_EQ(plane_contact_time(3, -4, 2, 0, false, 10), 1) << "slowed, first of two crossings";
  EXPECT_EQ(plane_contact_time(5, -4, 2, 0, false, 10), never) << "turns back before it";
  EXPECT_EQ(plane_contact_time(1e-17, 8, -10, 0, true, 10), 1.6) << "just bounced: the gap is zero";
  EXPECT_EQ(plane_contact_time(-1e-17, -1, 0, 0, false, 10), 0) << "touching and approaching: now";
  EXPECT_EQ(plane_contact_time(-1e-17, -1e-17, 0, 1e-16, false, 10), never) << "an approach within rounding is none";
  EXPECT_EQ(plane_contact_time(0, 0, -1, 0, false, 10), 0) << "pressed on";
}

TEST(PlaneGap, IsExactWhereItCancels) {
  const Vec3 n = Vec3(1, 2, 2) / 3;
  EXPECT_EQ(plane_gap({0.1, 1.5, 0}, {0, 0.5, 0}, {0, 1, 0}, 1), 0);
  EXPECT_EQ(plane_gap(Vec3(0, 1 + 0x1p-52, 0), {0, 0, 0}, {0, 1, 0}, 1), 0x1p-52);
  EXPECT_NEAR(plane_gap(1e6 * Vec3(2, -1, 0) + 0.5 * n, 1e6 * Vec3(-2, 0, 1), n, 0.5), 0, 1e-9);
}

}  // namespace
}  // namespace carom
