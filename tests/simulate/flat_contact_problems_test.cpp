// The contact problems of one body on flat surfaces.
#include "simulate/contact/flat_contact_problems.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(FlatContactProblems, TheNearestAllowedMotionIsChosen) {
  const FlatSurface up{Vec3::Unit(1)}, slope{Vec3(0.6, 0.8, 0)}, other{Vec3(-0.6, 0.8, 0)}, back{Vec3::Unit(2)};
  const Vec3 g(0, -10, -1);

  EXPECT_EQ(solve_flat_contacts(Vec3(1, 2, 3), vector{up}).u, Vec3(1, 2, 3));
  EXPECT_EQ(solve_flat_contacts(Vec3(1, 2, 3), vector{up}).active, 0u);
  EXPECT_EQ(solve_flat_contacts(g, vector{up}).u, Vec3(0, 0, -1));
  EXPECT_EQ(solve_flat_contacts(g, vector{up}).active, 1u);

  EXPECT_LT((solve_flat_contacts(g, vector{slope}).u - Vec3(4.8, -3.6, -1)).norm(), 1e-14);
  EXPECT_LT((solve_flat_contacts(g, vector{slope, other}).u - Vec3(0, 0, -1)).norm(), 1e-14);
  EXPECT_EQ(solve_flat_contacts(g, vector{slope, other}).active, 3u);
  EXPECT_EQ(solve_flat_contacts(g, vector{slope, other, back}).u, Vec3(0, 0, 0));
  EXPECT_EQ(solve_flat_contacts(g, vector{slope, other, back}).active, 7u);

  EXPECT_EQ(solve_flat_contacts(g, vector{FlatSurface{Vec3(1, 0, 0)}, up}).u, Vec3(0, 0, -1));
  EXPECT_EQ(solve_flat_contacts(g, vector{FlatSurface{Vec3(1, 0, 0)}, up}).active, 2u)
      << "a wall that nothing presses on is not active";
}

TEST(FlatContactProblems, KeptContactsLeaveWhatIsAlongAll) {
  const FlatSurface up{Vec3::Unit(1)}, slope{Vec3(0.6, 0.8, 0)}, back{Vec3::Unit(2)};
  const Vec3 u(1, 2, 3);
  EXPECT_EQ(keep_flat_contacts(u, {}).u, u);
  EXPECT_EQ(keep_flat_contacts(u, vector{up}).u, Vec3(1, 0, 3));
  EXPECT_EQ(keep_flat_contacts(-u, vector{up}).u, Vec3(-1, 0, -3)) << "whichever way it would part";
  EXPECT_LT((keep_flat_contacts(u, vector{up, slope}).u - Vec3(0, 0, 3)).norm(), 1e-15);
  EXPECT_EQ(keep_flat_contacts(u, vector{up, up}).u, Vec3(1, 0, 3)) << "the same twice";
  EXPECT_EQ(keep_flat_contacts(u, vector{up, slope, back}).u, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace carom
