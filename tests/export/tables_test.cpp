#include "export/tables.h"

#include <gtest/gtest.h>

#include "export/export_testing.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

string number(double value) {
  char text[number_size];
  return string(text, put_number(text, value));
}

TEST(Csv, NumbersAreTheShortestThatReadBack) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(1), "1");
  EXPECT_EQ(number(-2.5), "-2.5");
  EXPECT_EQ(number(1e-7), "1e-07");
  EXPECT_EQ(number(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(std::nan("")), "");
  EXPECT_EQ(number(infinity), "");
  EXPECT_EQ(number(-std::numeric_limits<double>::max()), "-1.7976931348623157e+308");  // the longest: number_size
  EXPECT_EQ(number(-std::numeric_limits<double>::denorm_min()), "-5e-324");
}

TEST(Csv, TextIsQuotedOnlyWhereItMustBe) {
  EXPECT_EQ(text_cell("two balls"), "two balls");
  EXPECT_EQ(text_cell(""), "");
  EXPECT_EQ(text_cell("red, blue"), "\"red, blue\"");
  EXPECT_EQ(text_cell("the \"cue\""), "\"the \"\"cue\"\"\"");
  EXPECT_EQ(text_cell("two\nlines"), "\"two\nlines\"");
}

TEST(Csv, TextThatASpreadsheetWouldRunIsMadeHarmless) {
  EXPECT_EQ(text_cell("=1+1"), "'=1+1");
  EXPECT_EQ(text_cell("+1"), "'+1");
  EXPECT_EQ(text_cell("-1"), "'-1");
  EXPECT_EQ(text_cell("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(text_cell("\t=1"), "'\t=1");
  EXPECT_EQ(text_cell("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(text_cell("=HYPERLINK(\"http://x\",\"y\")"), "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\"");
  EXPECT_EQ(text_cell("a=1"), "a=1");
}

TEST(Tables, TrajectoryIsByTimeThenBody) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.trajectory = TrajectoryOutput{0.15, false};
  scene.initial.velocity[3] = Vec3(-0.0, 1e-7, std::nan(""));
  run(scene, temp / "run");

  EXPECT_EQ(read(temp / "run/trajectory.csv"),
            "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n"
            "0,red,0,1,0,1,0,0\n"
            "0,blue,1,1,0,0,0,0\n"
            "0,gas.0,2,1,0,0,0,0\n"
            "0,gas.1,3,1,0,0,1e-07,\n"

            "0.15,red,0,1,0,1,0,0\n"
            "0.15,blue,1,1,0,0,0,0\n"
            "0.15,gas.0,2,1,0,0,0,0\n"
            "0.15,gas.1,3,1,0,0,1e-07,\n"

            "0.2,red,0,1,0,1,0,0\n"
            "0.2,blue,1,1,0,0,0,0\n"
            "0.2,gas.0,2,1,0,0,0,0\n"
            "0.2,gas.1,3,1,0,0,1e-07,\n");
}

TEST(Tables, AWideTrajectoryHasARowAnInstant) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.trajectory = TrajectoryOutput{0.2, true};
  scene.roster.bodies = {{"red", 0, 1, false, {}}, {"gas", 1, 1, true, {}}};
  scene.world.mass.resize(2);
  run(scene, temp / "run");
  EXPECT_EQ(read(temp / "run/trajectory.csv"),
            "time_s,red.x_m,red.y_m,red.z_m,red.vx_m_per_s,red.vy_m_per_s,red.vz_m_per_s,"
            "gas.0.x_m,gas.0.y_m,gas.0.z_m,gas.0.vx_m_per_s,gas.0.vy_m_per_s,gas.0.vz_m_per_s\n"
            "0,0,1,0,1,0,0,1,1,0,0,0,0\n"
            "0.2,0,1,0,1,0,0,1,1,0,0,0,0\n");
}

TEST(Tables, CollisionsNameBothBodies) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.collisions = true;

  {
    Exports exports(scene, temp / "run");
    const vector<Collision> first = {
        {0.1, CollisionKind::body_body, 0, 3, Vec3(1, 2, 3), Vec3(1, 0, 0), 2, 1, 0.5, 3, 0.25},
        {0.125, CollisionKind::body_fixed, 2, 4, Vec3(0, 0, 0), Vec3(0, -1, 0), 1, 1, 1, 2, -0.0}};
    const vector<Collision> second = {
        {0.15, CollisionKind::rest, 1, 4, Vec3(0, 0, 0), Vec3(0, -1, 0), 0, 0, std::nan(""), 0, 1e-9},
        {0.2, CollisionKind::merge, 0, 1, Vec3(0, 0, 0), Vec3(0, 0, 1), 1, 0, 0, 1, 1}};

    exports.tables().record(first);
    exports.tables().record({});
    exports.tables().record(second);
    play(scene, exports);
    exports.finish(some_summary(scene), {});
  }

  EXPECT_EQ(read(temp / "run/collisions.csv"),
            "time_s,kind,a,b,x_m,y_m,z_m,nx,ny,nz,approach_speed_m_per_s,separation_speed_m_per_s,restitution,"
            "impulse_N_s,energy_lost_J\n"
            "0.1,body-body,red,gas.1,1,2,3,1,0,0,2,1,0.5,3,0.25\n"
            "0.125,body-fixed,gas.0,floor,0,0,0,0,-1,0,1,1,1,2,0\n"
            "0.15,rest,blue,floor,0,0,0,0,-1,0,0,0,,0,1e-09\n"
            "0.2,merge,red,blue,0,0,0,0,0,1,1,0,0,1,1\n");
}

TEST(Tables, CollisionsNameStrings) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.collisions = true;
  scene.world.strings = {{0, no_entity, Vec3(0, 2, 0), 1, 0, false}};
  scene.roster.strings = {"line"};

  {
    Exports exports(scene, temp / "run");
    const Collision taut{0.1, CollisionKind::taut, 0, 5, Vec3(0, 1, 0), Vec3(0, 1, 0), 2, 0, 0, 3, 4};
    exports.tables().record({&taut, 1});
    play(scene, exports);
    exports.finish(some_summary(scene), {});
  }

  const string text = read(temp / "run/collisions.csv");
  EXPECT_EQ(text.substr(text.find('\n') + 1), "0.1,string,red,line,0,1,0,0,1,0,2,0,0,3,4\n");
}

TEST(Tables, BodiesThatHaveBecomePartOfAnotherHaveNoRows) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.simulate.duration = 0;
  scene.output.trajectory = TrajectoryOutput{1, false};
  scene.initial.part_of = {0, 1, 0, 3};
  run(scene, temp / "long");

  EXPECT_EQ(read(temp / "long/trajectory.csv"),
            "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n"
            "0,red,0,1,0,1,0,0\n"
            "0,blue,1,1,0,0,0,0\n"
            "0,gas.1,3,1,0,0,0,0\n");

  scene.output.trajectory->wide = true;
  run(scene, temp / "wide");
  const string wide = read(temp / "wide/trajectory.csv");
  EXPECT_EQ(wide.substr(wide.find('\n') + 1), "0,0,1,0,1,0,0,1,1,0,0,0,0,,,,,,,3,1,0,0,0,0\n");
}

TEST(Tables, ContactsAreARowAnInstantAndPair) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.contacts = ContactsOutput{0.15};
  run(scene, temp / "run", {{0, 4, 9.80665}, {1, 3, 0.5}});

  EXPECT_EQ(read(temp / "run/contacts.csv"),
            "time_s,a,b,force_N\n"
            "0,red,floor,9.80665\n"
            "0,blue,gas.1,0.5\n"
            "0.15,red,floor,9.80665\n"
            "0.15,blue,gas.1,0.5\n"
            "0.2,red,floor,9.80665\n"
            "0.2,blue,gas.1,0.5\n");
  EXPECT_FALSE(fs::exists(temp / "run/trajectory.csv"));
}

TEST(Tables, EnergyIsKineticPlusPotential) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.energy = EnergyOutput{0.2};
  run(scene, temp / "run");
  EXPECT_EQ(read(temp / "run/energy.csv"),
            "time_s,kinetic_J,potential_J,total_J,px_kg_m_per_s,py_kg_m_per_s,pz_kg_m_per_s\n"
            "0,1,50,51,2,0,0\n"
            "0.2,1,50,51,2,0,0\n");
}

TEST(Tables, TheSummaryIsOneRow) {
  TempFolder temp;
  Scene scene = small_scene();

  Summary summary;
  summary.run =
      "r\xff"
      "1";  // a file's stem need not be UTF-8, the table is
  summary.title = "=cmd|' /C calc'!A0, \"quoted\"";
  summary.engine = "exact";
  summary.status = "done";
  summary.duration = 0.2;

  summary.bodies = 4;
  summary.collisions = 3;
  summary.body_body = 2;
  summary.body_fixed = 1;
  summary.first_collision = std::nan("");
  summary.last_collision = 0.125;

  summary.energy.start = 51;
  summary.energy.end = 50;
  summary.energy.lost = 1;
  summary.energy.residual = -1e-17;
  summary.momentum_drift = 2;
  summary.max_overlap = 3e-17;
  summary.max_speed = 4;
  summary.resting = 5;
  summary.frames = 18446744073709551615ULL;

  summary.stepped_contact = 0.75;
  summary.energy.removed = 0.5;
  summary.ended_by = "region pocket";
  summary.contact.taken_up.energy = 0.25;
  summary.contact.made = 0.125;

  {
    Exports exports(scene, temp / "run");
    play(scene, exports);
    exports.finish(summary, {});
  }

  EXPECT_EQ(
      read(temp / "run/summary.csv"),
      "run,title,engine,status,duration_s,bodies,collisions,body_body,body_fixed,first_collision_s,"
      "last_collision_s,energy_start_J,energy_end_J,energy_lost_J,work_J,energy_residual_J,"
      "momentum_drift_kg_m_per_s,max_overlap_m,max_speed_m_per_s,resting,frames,stepped_contact_s,removed_J,ended_by,"
      "energy_absorbed_J,contact_made_J,appeared_J\n"
      "r\xEF\xBF\xBD"
      "1,\"'=cmd|' /C calc'!A0, \"\"quoted\"\"\",exact,done,0.2,4,3,2,1,,0.125,51,50,1,0,-1e-17,2,3e-17,4,5,"
      "18446744073709551615,0.75,0.5,region pocket,0.25,0.125,0\n");
}

TEST(Tables, AMillionBodiesTakeNoMemoryForTheirNames) {
  TempFolder temp;
  Scene scene = small_scene();
  const Entity count = 200'000;

  scene.world.mass.assign(count, 1);
  scene.initial.position.assign(count, Vec3(0, 0, 0));
  scene.initial.velocity.assign(count, Vec3(0, 0, 0));
  scene.roster.bodies = {{"gas", 0, count, true, {}}};
  scene.simulate.duration = 0;
  scene.output.trajectory = TrajectoryOutput{0.1, false};

  run(scene, temp / "run");
  const string text = read(temp / "run/trajectory.csv");
  EXPECT_EQ(ranges::count(text, '\n'), 200'001);
  EXPECT_TRUE(text.ends_with("\n0,gas.199999,0,0,0,0,0,0\n"));
}

TEST(Tables, HaveTheSeparatorAndTheDecimalMarkOfTheScene) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.title = "Small; 1,5";
  scene.output.trajectory = TrajectoryOutput{0.2, false};
  scene.output.energy = EnergyOutput{0.2};
  scene.output.tables.separator = TablesOutput::Separator::semicolon;
  scene.output.tables.decimal = TablesOutput::Decimal::comma;
  run(scene, temp / "run");

  EXPECT_TRUE(read(temp / "run/trajectory.csv")
                  .starts_with("time_s;body;x_m;y_m;z_m;vx_m_per_s;vy_m_per_s;vz_m_per_s\n"
                               "0;red;0;1;0;1;0;0\n"))
      << read(temp / "run/trajectory.csv");
  EXPECT_NE(read(temp / "run/trajectory.csv").find("\n0,2;gas.1;"), string::npos);
  EXPECT_TRUE(read(temp / "run/energy.csv").starts_with("time_s;kinetic_J;"));
  EXPECT_NE(read(temp / "run/summary.csv").find(";\"Small; 1,5\";"), string::npos);
  for (const char* table : {"trajectory.csv", "energy.csv"})
    EXPECT_EQ(read(temp / "run/" + table).find(','), read(temp / "run/" + table).find("0,2") + 1);
}

TEST(Tables, WideOnesHaveTheDialectToo) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.trajectory = TrajectoryOutput{0.2, true};
  scene.output.tables.separator = TablesOutput::Separator::tab;
  run(scene, temp / "run");
  const string table = read(temp / "run/trajectory.csv");
  EXPECT_TRUE(table.starts_with("time_s\tred.x_m\tred.y_m\t"));
  EXPECT_EQ(ranges::count(table, '\t'), 3 * 24);
  EXPECT_EQ(ranges::count(table, ','), 0);
}

}  // namespace
}  // namespace carom
