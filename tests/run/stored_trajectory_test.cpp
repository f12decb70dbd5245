// trajectory.csv read back, in both layouts, and refused where it is not one of the scene's.
#include "run/stored_trajectory.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "run/run_testing.h"
#include "std.h"

namespace carom {
namespace {

const string two_balls = R"(scene: 1
balls:
  a: {mass: 1, radius: 0.1, position: [0, 0, 0]}
  b: {mass: 1, radius: 0.1, position: [1, 0, 0]}
simulate: {duration: 1}
)";

string columns_of(const string& body) {
  string text;
  for (const char* quantity : {"x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s"})
    text += "," + body + "." + quantity;
  return text;
}

const string wide_head = "time_s" + columns_of("a") + columns_of("b") + "\n";
const string long_head = "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";

/// "a 0 b 1 |": the bodies of each instant, with their x.
string motions_of(const string& table) {
  const RunPlace place;
  const Scene scene = place.scene(two_balls);
  Descriptor file(memfd_create("table", 0));
  EXPECT_EQ(::write(file.get(), table.data(), table.size()), static_cast<ssize_t>(table.size()));
  lseek(file.get(), 0, SEEK_SET);

  string text;
  StoredTrajectory trajectory(std::move(file), scene);
  while (trajectory.next()) {
    trajectory.read([&](Entity body, const vector<string_view>& row, size_t first) {
      text += scene.roster.name(body) + " " + string(row[first]) + " ";
    });
    text += "|";
  }
  return text;
}

TEST(StoredTrajectory, HasTheMotionsOfEachInstantInBothLayouts) {
  EXPECT_EQ(motions_of(wide_head + "0,1,0,0,0,0,0,2,0,0,0,0,0\n1,3,0,0,0,0,0,4,0,0,0,0,0\n"), "a 1 b 2 |a 3 b 4 |");
  EXPECT_EQ(motions_of(long_head + "0,a,1,0,0,0,0,0\n0,b,2,0,0,0,0,0\n1,b,4,0,0,0,0,0\n"), "a 1 b 2 |b 4 |");
}

TEST(StoredTrajectory, OfOtherBodiesIsRefused) {
  EXPECT_THROW(motions_of(long_head + "0,c,1,0,0,0,0,0\n"), ForeignRow);
  EXPECT_THROW(motions_of(long_head + "0,b,2,0,0,0,0,0\n0,a,1,0,0,0,0,0\n"), ForeignRow);
  EXPECT_THROW(motions_of(wide_head + "0,1,0,0,0,0,0\n"), ForeignRow);
}

TEST(StoredTrajectory, WideItHasEveryBody) {
  EXPECT_THROW(motions_of("time_s" + columns_of("a") + "\n0,1,0,0,0,0,0\n"), ForeignRow);
  EXPECT_THROW(motions_of("time_s" + columns_of("b") + "\n0,1,0,0,0,0,0\n"), ForeignRow);
}

}  // namespace
}  // namespace carom
