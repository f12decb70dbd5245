// Groups whose balls come from a CSV file, and balls that are moved apart at the start.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string scene_of_table = start + "groups:\n  g: {table: heap.csv, ball: {density: 1000, radius: 0.1}}\n";

Scene load_table(const string& table, const string& text = scene_of_table, const LoadOptions& options = {}) {
  write_file(table, "heap.csv");
  return load_text(text, options);
}

Parts table_errors(const string& table, const string& text = scene_of_table, const string& set = "") {
  write_file(table, "heap.csv");
  return in_parts(set.empty() ? errors_of(text) : errors_with(text, set));
}

double mass_of_ball(double radius) {
  return 1000 * 4.0 / 3 * 3.14159265358979324 * radius * radius * radius;
}

TEST(Tables, GiveEachBallWhatTheirColumnsHaveInAnyOrder) {
  const Scene scene = load_table(
      "\xEF\xBB\xBF"
      "id,z_m,\"x_m\", y_m ,mass_kg,radius_m,vx_m_per_s,vz_m_per_s,vy_m_per_s,note\r\n"
      "1,3,1,2,5,0.2,0.1,0.3,0.2,\"a, b\"\r\n"
      "\r\n"
      "2,-1e-3,1.0e+00,.5,6,0.3,0,0,-2,\r\n");
  ASSERT_EQ(scene.world.body_count(), 2u);
  EXPECT_EQ(scene.initial.position, (vector<Vec3>{{1, 2, 3}, {1, 0.5, -1e-3}}));
  EXPECT_EQ(scene.initial.velocity, (vector<Vec3>{{0.1, 0.2, 0.3}, {0, -2, 0}}));
  EXPECT_EQ(scene.world.radius, (vector<double>{0.2, 0.3}));
  EXPECT_EQ(scene.world.mass, (vector<double>{5, 6}));
  EXPECT_EQ(scene.made_from.tables.size(), 1u);

  // The resolved scene has the numbers, and needs no file.
  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(again.initial.position, scene.initial.position);
  EXPECT_EQ(again.world.mass, scene.world.mass);
  EXPECT_EQ(again.world.radius, scene.world.radius);
}

TEST(Tables, LeaveTheRestToTheBall) {
  const Scene scene = load_table("x_m,y_m,z_m\n0,0,0\n1,0,0\n");
  EXPECT_EQ(scene.world.radius, (vector<double>{0.1, 0.1}));
  EXPECT_DOUBLE_EQ(scene.world.mass[1], mass_of_ball(0.1));
  EXPECT_EQ(scene.initial.velocity[1], Vec3(0, 0, 0));
  EXPECT_DOUBLE_EQ(load_table("x_m,y_m,z_m,radius_m\n0,0,0,0.2\n1,0,0,0.3\n").world.mass[1], mass_of_ball(0.3));

  // The velocity of the group, of the ball, and of the table, which comes first.
  const string with_velocity =
      start + "groups: {g: {table: heap.csv, velocity: [0, 1, 0], ball: {mass: 1, radius: 0.1}}}\n";
  EXPECT_EQ(load_table("x_m,y_m,z_m\n0,0,0\n", with_velocity).initial.velocity[0], Vec3(0, 1, 0));
  EXPECT_EQ(
      load_table("x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n0,0,0,1,2,3\n", with_velocity).initial.velocity[0],
      Vec3(1, 2, 3));
  const string ball_velocity =
      start + "groups: {g: {table: heap.csv, ball: {mass: 1, radius: 0.1, velocity: [3, 1, 0]}}}\n";
  EXPECT_EQ(load_table("x_m,y_m,z_m\n0,0,0\n", ball_velocity).initial.velocity[0], Vec3(3, 1, 0));

  // With all columns a ball needs nothing.
  const string bare = start + "groups: {g: {table: heap.csv}}\n";
  EXPECT_EQ(load_table("x_m,y_m,z_m,radius_m,mass_kg\n0,0,0,0.2,3\n", bare).world.mass[0], 3);
  EXPECT_EQ(
      table_errors("x_m,y_m,z_m,mass_kg\n0,0,0,3\n", bare),
      (Parts{{"3:10 g", "`ball` has no `radius`", "expected `radius`: a number above 0 in m, or a map of keys"}}));
}

TEST(Tables, StandInDefaultsAndInRepeatedGroups) {
  const Scene scene = load_table("x_m,y_m,z_m\n0,0,0\n",
                                 start +
                                     "defaults: {group: {table: heap.csv, ball: {mass: 1, radius: 0.1}}}\n"
                                     "groups:\n  a: {}\n  b: {count: 1, in: {min: [5, 5, 5], max: [6, 6, 6]}}\n");
  EXPECT_EQ(scene.world.body_count(), 2u);
  EXPECT_EQ(scene.initial.position[0], Vec3(0, 0, 0));
  EXPECT_GT(scene.initial.position[1].x(), 5);
}

TEST(Tables, KeepRadiiAndMassesWhereAFormerRunGivesThePlaces) {
  LoadOptions options;
  options.former_state = [](const string&, optional<double>) {
    return FormerState{{"g.0", "g.1"}, {2, {{7, 0, 0}, {8, 0, 0}}, {{0, 1, 0}, {0, 2, 0}}}};
  };
  const Scene scene = load_table("x_m,y_m,z_m,radius_m,mass_kg\n0,0,0,0.2,3\n1,0,0,0.3,4\n",
                                 scene_of_table + "start: {run: first}\n", options);
  EXPECT_EQ(scene.initial.position, (vector<Vec3>{{7, 0, 0}, {8, 0, 0}}));
  EXPECT_EQ(scene.initial.velocity[1], Vec3(0, 2, 0));
  EXPECT_EQ(scene.world.radius, (vector<double>{0.2, 0.3}));
  EXPECT_EQ(scene.world.mass, (vector<double>{3, 4}));
}

TEST(Tables, ThatAreWrongNameTheLineTheColumnAndTheRemedy) {
  EXPECT_EQ(table_errors("x_m,y_m,z_m,radius_m\n1,2,3,x\n1,2\n,1,2,0.1\n1,2,\"1.5 m\",-1\n5,5,1e40,1\n"),
            (Parts{{"2:7 x", "`x` is not a number in the column `radius_m`", "expected a number above 0 in m"},
                   {"3:1 1,2", "this line has 2 cells, and the first line has 4",
                    "expected a cell for each column; the decimal point is a point: 1.5, not 1,5"},
                   {"4:1 ,", "`x_m` has no value", "expected a number in m"},
                   {"5:6 1.5 m", "`1.5 m` carries a unit in the column `z_m`", "`z_m` is always in m: write 1.5"},
                   {"5:13 -1", "`radius_m` is -1", "expected a number above 0 in m"},
                   {"6:5 1e40", "`z_m` is 1e40", "a run takes numbers from -1e+30 to 1e+30 m"}}));

  // The first line.
  EXPECT_EQ(table_errors("x;y;z\n"), (Parts{{"1:1 x;y;z", "the table has no column `x_m`",
                                             "columns are separated by commas, and the decimal point is a point"}}));
  EXPECT_EQ(table_errors("x_m,y_m,zm\n"),
            (Parts{{"1:1 x_m,y_m,zm", "the table has no column `z_m`", "expected this name in place of `zm`"}}));
  EXPECT_EQ(
      table_errors("x_m,y_m,z_m,vx_m_per_s\n"),
      (Parts{{"1:1 x_m,y_m,z_m,vx_m_per_s", "the table has no column `vy_m_per_s`",
              "expected the columns x_m, y_m, z_m, and where present vx_m_per_s, vy_m_per_s, vz_m_per_s, radius_m, "
              "mass_kg"}}));

  EXPECT_EQ(table_errors("x_m,y_m,z_m,x_m\n"),
            (Parts{{"1:13 x_m", "the table has the column `x_m` twice", "remove one of them"}}));
  for (const char* empty : {"", "\n\n", "x_m,y_m,z_m\n"})
    EXPECT_EQ(std::get<1>(table_errors(empty).at(0)), "the table has no balls");

  // The message begins with the file of the table.
  write_file("x_m,y_m,z_m\n1,2,x\n", "heap.csv");
  EXPECT_TRUE(errors_of(scene_of_table).starts_with("heap.csv:2:5: error: `x` is not a number"));
}

TEST(Tables, OverlapsPointAtTheirLines) {
  EXPECT_EQ(table_errors("x_m,y_m,z_m\n0,0,0\n0.15,0,0\n"),
            (Parts{{"3:1 0.15", "`g.1` overlaps `g.0` by 0.05 m at the start",
                    "expected bodies apart, or just touching\n`overlap: push` of a group moves apart what overlaps by "
                    "less than 0.001 of the smaller radius"}}));
}

TEST(Tables, StandInPlaceOfTheKeysThatPlaceBalls) {
  const string table = "x_m,y_m,z_m\n0,0,0\n";
  for (const string key : {"count: 1", "arrange: lattice", "speed: 1", "in: {radius: 1}"}) {
    const Parts errors =
        table_errors(table, start + "groups: {g: {table: heap.csv, " + key + ", ball: {mass: 1, radius: 0.1}}}\n");
    ASSERT_EQ(errors.size(), 1u) << key;
    EXPECT_EQ(std::get<1>(errors[0]), fmt::format("group `g` has both `table` and `{}`", key.substr(0, key.find(':'))));
  }
  // A setting takes the place of the keys that exclude it.
  EXPECT_EQ(table_errors(table, scene_of_table, "groups.g.count=1").size(), 1u);
  EXPECT_EQ(std::get<1>(table_errors(table, scene_of_table, "groups.g.table=none.csv").at(0)),
            "there is no file `none.csv`");
  EXPECT_EQ(marked_errors(start + "groups: {g: {table: [1], ball: {mass: 1, radius: 1}}}\n"),
            (Marked{{"[", "`table` is a list"}}));
  EXPECT_EQ(marked_errors(start + "groups: {g: {table: heap.csv, overlap: pull, ball: {mass: 1, radius: 1}}}\n").size(),
            2u);
}

/// A ball on a floor, one that overlaps it by 1e-4 of a radius, and one beside that.
const string pushed_scene = start +
                            "groups:\n  g: {table: heap.csv, overlap: push, ball: {mass: 1, radius: 1}}\n"
                            "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";

/// The deepest overlap of any two balls (m).
double deepest(const Scene& scene) {
  double deepest = -infinity;
  for (Entity i = 0; i < scene.world.body_count(); ++i)
    for (Entity j = 0; j < i; ++j)
      deepest = max(deepest, scene.world.radius[i] + scene.world.radius[j] -
                                 (scene.initial.position[i] - scene.initial.position[j]).norm());
  return deepest;
}

TEST(Push, ShareTheWayOfTwoBallsAndSaysHowFar) {
  const Scene scene = load_table("x_m,y_m,z_m\n0,5,0\n1.9998,5,0\n9,5,0\n", pushed_scene);
  // Each by half of the overlap and of a gap of 1e-6 of the radius.
  EXPECT_NEAR(scene.initial.position[0].x(), -0.0001005, 1e-12);
  EXPECT_NEAR(scene.initial.position[1].x(), 1.9999005, 1e-12);
  EXPECT_EQ(scene.initial.position[2], Vec3(9, 5, 0));
  ASSERT_EQ(scene.made_from.notes.size(), 1u);
  EXPECT_TRUE(scene.made_from.notes[0].starts_with("overlap: push moved 2 balls of g, the furthest by 0.000101 m: g."));

  // The scene that resolves it is pushed in the same way.
  EXPECT_EQ(load_text(scene.resolved).initial.position, scene.initial.position);
  EXPECT_TRUE(load_table("x_m,y_m,z_m\n0,5,0\n2,5,0\n", pushed_scene).made_from.notes.empty());
}

TEST(Push, MovesAwayFromWhatStays) {
  const Scene scene = load_table("x_m,y_m,z_m\n0,0.9999,0\n", pushed_scene);
  EXPECT_NEAR(scene.initial.position[0].y(), 1.000001, 1e-12);
  const Scene beside =
      load_table("x_m,y_m,z_m\n0,5,0\n", pushed_scene +
                                             "balls: {still: {mass: 1, radius: 1, position: [1.9995, 5, 0]}}\n"
                                             "obstacles: {post: {box: [1, 1, 1], position: [0, 3.5005, 0]}}\n");
  EXPECT_EQ(beside.initial.position[1], Vec3(1.9995, 5, 0));
  EXPECT_LT(deepest(beside), 0);
  EXPECT_GT(beside.initial.position[0].y(), 5.0005);
}

TEST(Push, RefusesADeeperOverlapAndWhatHasNoRoom) {
  EXPECT_EQ(std::get<1>(table_errors("x_m,y_m,z_m\n0,5,0\n1.9989,5,0\n0,9,0\n1.9999,9,0\n", pushed_scene).at(0)),
            "`g.1` overlaps `g.0` by 0.0011 m at the start");
  EXPECT_EQ(load_table("x_m,y_m,z_m\n0,5,0\n1.9991,5,0\n", pushed_scene).world.body_count(), 2u);

  // Between two floors a ball has no room.
  const string between = pushed_scene + "walls: {lid: {center: [0, 1.9995, 0], normal: [0, 1, 0], size: [9, 9]}}\n";
  EXPECT_EQ(table_errors("x_m,y_m,z_m\n0,0.99975,0\n", between),
            (Parts{{"2:1 0", "`g.0` and `floor` cannot be pushed apart: they still overlap by 0.00025 m",
                    "expected room between what `overlap: push` moves apart, or smaller radii"}}));
}

TEST(Push, OfAWholeHeapEndsWithoutOverlapWhateverTheOrderOfItsLines) {
  // A cubic heap of 8 x 8 x 8 balls on a floor, each overlapping its neighbours by 4e-4 of a radius.
  vector<string> lines;
  for (int i = 0; i < 512; ++i)
    lines.push_back(
        fmt::format("{:.6f},{:.6f},{:.6f}", 1.9996 * (i % 8), 0.9998 + 1.9996 * (i / 8 % 8), 1.9996 * (i / 64)));
  string forward = "x_m,y_m,z_m\n", backward = forward;
  for (size_t i = 0; i < lines.size(); ++i) {
    forward += lines[i] + "\n";
    backward += lines[lines.size() - 1 - i] + "\n";
  }

  const Scene one = load_table(forward, pushed_scene), other = load_table(backward, pushed_scene);
  EXPECT_LT(deepest(one), 1e-14);
  double apart = 0;
  for (Entity i = 0; i < 512; ++i) {
    EXPECT_GE(one.initial.position[i].y(), 1);
    apart = max(apart, (one.initial.position[i] - other.initial.position[511 - i]).norm());
  }
  EXPECT_LT(apart, 1e-12);
}

}  // namespace
}  // namespace carom
