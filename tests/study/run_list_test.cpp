// Folders to runs with ids of their own, and two runs side by side.
#include "study/run_list.h"

#include <gtest/gtest.h>

#include "compare/comparison_testing.h"
#include "study/run_difference.h"

namespace carom {
namespace {

using testing::Place;
using testing::two_balls;

/// The message of folders that hold no run.
string no_runs(const vector<string>& folders) {
  try {
    list_runs(folders);
  } catch (const ExportError& error) {
    return error.what();
  }
  return "";
}

vector<string> ids(const vector<ListedRun>& runs) {
  vector<string> all;
  for (const ListedRun& run : runs) all.push_back(run.id);
  return all;
}

TEST(ListedRuns, AreNamedByFoldersAndByMoreOfThePathWhereTwoAreEqual) {
  const Place place;
  for (const char* folder : {"a/run", "b/run", "c/other"}) place.run(two_balls, folder);
  const auto runs = list_runs({place / "a/run", place / "b/run", place / "c/other"});
  EXPECT_EQ(ids(runs), (vector<string>{"a/run", "b/run", "other"}));
  for (const ListedRun& run : runs) EXPECT_TRUE(run.done);
}

TEST(ListedRuns, NamedTwiceAreCounted) {
  const Place place;
  place.run(two_balls, "run");
  EXPECT_EQ(ids(list_runs({place / "run", place / "run"})), (vector<string>{"run", "run (2)"}));
}

TEST(ListedRuns, OfASweepAreInTheOrderOfTheirNumbers) {
  const Place place;
  for (const char* run : {"r10000", "r9999", "r0002"}) place.run(two_balls, string("sweep/runs/") + run);
  EXPECT_EQ(ids(list_runs({place / "sweep"})), (vector<string>{"r0002", "r9999", "r10000"}));
}

TEST(ListedRuns, MustBeWholeAndUnchanged) {
  const Place place;
  place.run(two_balls, "run");
  place.write("run/energy.csv", "changed");
  EXPECT_NE(no_runs({place / "run"}).find("energy.csv has changed since the run"), string::npos);
  EXPECT_NE(no_runs({place / "nowhere"}).find("there is no such folder"), string::npos);

  place.write("empty/notes.txt", "");
  EXPECT_NE(no_runs({place / "empty"}).find("it holds no whole run"), string::npos);
}

TEST(ListedRuns, ThatFailedAreNotDone) {
  const Place place;
  place.write("run/error.txt", "why");
  const auto runs = list_runs({place / "run"});
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_FALSE(runs[0].done);
}

TEST(Digest, DependsOnIdsAndManifests) {
  const Place place;
  place.run(two_balls, "a");
  place.run(two_balls, "b", {"balls.red.mass=11"});
  const auto a = list_runs({place / "a"}), b = list_runs({place / "b"});
  EXPECT_EQ(digest_of(a), digest_of(list_runs({place / "a"})));
  EXPECT_NE(digest_of(a), digest_of(b));
}

TEST(RunSet, FindsTheValuesInWhichScenesDiffer) {
  const Place place;
  place.run(two_balls, "a", {"title=First"});
  place.run(two_balls, "b", {"balls.red.mass=11"});
  const RunSet runs(list_runs({place / "a", place / "b"}));
  ASSERT_EQ(runs.parameters().size(), 1u);
  EXPECT_EQ(runs.parameters()[0].path, "balls.red.mass");
  EXPECT_EQ(runs.parameters()[0].unit, "kg");
  EXPECT_EQ(runs.run(1).values, (vector<string>{"11"}));
}

TEST(RunDifference, OfEqualRunsIsNone) {
  const Place place;
  place.run(two_balls, "a");
  place.run(two_balls, "b");
  const RunDifference difference = difference_of(place / "a", place / "b");
  EXPECT_TRUE(difference.equal());
  EXPECT_EQ(difference.collisions.same, 1u);
  EXPECT_EQ(difference.end->greatest, 0);
}

TEST(RunDifference, NamesTheFirstCollisionThatIsNotTheSame) {
  const Place place;
  place.run(two_balls, "a");
  place.run(two_balls, "b", {"balls.red.velocity=[4, 0, 0]"});
  const RunDifference difference = difference_of(place / "a", place / "b");
  EXPECT_TRUE(difference.collisions.part);
  EXPECT_EQ(difference.collisions.same, 0u);
  // The surfaces are 1.78 m apart, and approach at 4 and at 6 m/s.
  EXPECT_NEAR(difference.collisions.next_a->time, 1.78 / 4, 1e-12);
  EXPECT_NEAR(difference.collisions.next_b->time, 1.78 / 6, 1e-12);
}

TEST(RunDifference, TellsOutcomesFromCollisions) {
  const Place place;
  place.run(two_balls, "a");
  place.run(two_balls, "b", {"restitution.default=1"});
  const CollisionDifference collisions = difference_of(place / "a", place / "b").collisions;
  EXPECT_FALSE(collisions.part);
  EXPECT_EQ(collisions.outcome, optional<uint64_t>(0));
  EXPECT_EQ(collisions.column, "separation_speed_m_per_s");
  EXPECT_EQ(collisions.cell_a, "2");
  EXPECT_EQ(collisions.cell_b, "4");
}

TEST(RunDifference, OfPositionsIsTheGreatest) {
  const Place place;
  place.run(two_balls, "a", {"balls.blue.position=[9, 0, 0]"});
  place.run(two_balls, "b", {"balls.blue.position=[9, 3, 4]"});
  const RunDifference difference = difference_of(place / "a", place / "b");
  EXPECT_EQ(difference.end->bodies, 2u);
  EXPECT_EQ(difference.end->body, "blue");
  EXPECT_EQ(difference.end->greatest, 5);
}

TEST(RunDifference, NeedsCollisionsAndSaysWhichRunHasNoTrajectory) {
  const Place place;
  place.run(two_balls, "a");
  place.run(two_balls, "b", {"output.trajectory=false"});
  place.run(two_balls, "c", {"output.collisions=false"});
  EXPECT_EQ(difference_of(place / "a", place / "b").no_end, place / "b");
  EXPECT_THROW(difference_of(place / "a", place / "c"), ExportError);
}

}  // namespace
}  // namespace carom
