// Directions around a body: which of them hold it.
#include "numerics/vanishing_sum.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

using Places = vector<size_t>;

constexpr double tolerance = 1e-12;

TEST(VanishingSum, IsTheFewestDirectionsThatOpposeOneAnother) {
  const Vec3 up(0, 1, 0), down(0, -1, 0), left(-1, 0, 0), right(1, 0, 0);
  const Vec3 slanted(sqrt(0.5), sqrt(0.5), 0), lower(-0.6, -0.8, 0);
  EXPECT_EQ(vanishing_sum(vector{up, left, down}, 0, tolerance), (Places{0, 2}));
  EXPECT_EQ(vanishing_sum(vector{up, left, down}, 2, tolerance), (Places{0, 2}));
  EXPECT_EQ(vanishing_sum(vector{up, left, down}, 1, tolerance), Places{});
  // A ball between a floor, a wall and what presses it into their corner.
  EXPECT_EQ(vanishing_sum(vector{slanted, down, left, up}, 0, tolerance), (Places{0, 1, 2}));
  EXPECT_EQ(vanishing_sum(vector{down, lower, right}, 0, tolerance), Places{}) << "none of them points upwards";
  EXPECT_EQ(vanishing_sum(vector{up}, 0, tolerance), Places{});
}

TEST(VanishingSum, NeedsFourDirectionsInSpace) {
  // The corners of a regular tetrahedron, and a direction that no three of them oppose.
  const double a = 1 / sqrt(3.0);
  const vector<Vec3> corners = {{a, a, a}, {0.6, 0.8, 0}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
  for (const size_t first : {0, 2, 3, 4})
    EXPECT_EQ(vanishing_sum(corners, first, tolerance), (Places{0, 2, 3, 4})) << first;
}

}  // namespace
}  // namespace carom
