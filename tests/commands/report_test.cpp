// Lines of a run's report that have no column in summary.csv.
#include "commands/report.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

RunResult result_with(uint64_t collapses, uint64_t merges) {
  RunResult result;
  Summary& s = result.summary;
  s.bodies = 5;
  s.resting = 3;
  s.body_body = 2;
  s.contact.collapses = collapses;
  s.contact.merges = merges;
  s.collisions = s.body_body + merges;
  s.first_collision = 0.5;
  s.last_collision = 1;
  return result;
}

string lines_of(const RunResult& result) {
  PlannedScene planned;
  planned.price.engine.engine = Engine::exact;
  Block block(Palette(false), 100);
  describe(block, planned, result);
  const size_t from = block.text().find("  collisions"), to = block.text().find("  energy");
  return block.text().substr(from, to - from);
}

TEST(Report, ReportsMergesAndClustersTakenIntoContact) {
  EXPECT_EQ(lines_of(result_with(0, 0)),
            "  collisions  2 (2 body-body, 0 body-fixed), first at 0.5 s, last at 1 s\n"
            "  contact     3 of 5 bodies in lasting contact at the end\n");
  EXPECT_EQ(lines_of(result_with(1, 4)),
            "  collisions  6 (2 body-body, 0 body-fixed, 4 merges), first at 0.5 s, last at 1 s\n"
            "  contact     3 of 5 bodies in lasting contact at the end; 1 cluster of accelerating collisions\n"
            "              turned into contact\n");
}

TEST(Report, ReportsWhyARunIsDoubtful) {
  RunResult result = result_with(0, 0);
  Block block(Palette(false), 100);
  describe(block, result.summary.warnings);
  EXPECT_EQ(block.text(), "");
  describe(block, {{"energy", "the method made 2 J"}, {"step", "too long"}});
  EXPECT_EQ(block.text(), "  doubtful    the method made 2 J\n  doubtful    too long\n");
  EXPECT_EQ(warnings_json({{"step", "too long"}}).dump(), R"([{"code":"step","text":"too long"}])");
}

TEST(Report, ReportsTheImpactsThatContactHasReplaced) {
  RunResult result = result_with(0, 0);
  EXPECT_EQ(lines_of(result).find("absorbed"), string::npos);
  result.summary.contact.taken_up = {3, 0.25, 0.5};
  EXPECT_NE(lines_of(result).find("  absorbed    3 impacts by lasting contact, at 0.25 m/s at most, 0.5 J of"),
            string::npos);
}

TEST(Report, ReportsWhatRigidBodiesLeaveOpen) {
  RunResult result = result_with(0, 0);
  EXPECT_EQ(lines_of(result).find("at once"), string::npos);

  result.summary.contact.shared = {2, 1, 0, 0, 0.3, 0, 1, 2};
  result.summary.contact.first_shared = "`cue` with `up` and `low` at 0.3 s";
  EXPECT_NE(lines_of(result).find(
                "  at once     rigid bodies leave 2 instants open with several impacts on a body, first `cue` with\n"
                "              `up` and `low` at 0.3 s; at 1 they come from both sides at one speed, where the\n"
                "              slightest difference decides\n"),
            string::npos)
      << lines_of(result);

  result.summary.contact.shared = {0, 0, 1, 0.5};
  EXPECT_NE(lines_of(result).find("  no room     bodies could not rebound at 1 instant, and absorbed 0.5 J\n"),
            string::npos)
      << lines_of(result);
}

TEST(Report, JsonHasThemBesideTheSummary) {
  EXPECT_EQ(contact_json(result_with(2, 1).summary).dump(),
            R"({"resting":3,"clusters_taken_into_contact":2,"merges":1,"impacts_taken_up":{"impacts":0,)"
            R"("fastest_m_per_s":0.0,"energy_J":0.0},"impacts_at_once":{"instants":0,"ties":0,"first":"",)"
            R"("without_room":0,"absorbed_J":0.0}})");
}

}  // namespace
}  // namespace carom
