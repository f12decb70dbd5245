// Events in place of times, as a scene has them.
#include "physics/world_now.h"
#include "scene/motion_text.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

const string eventful =
    "scene: 1\nsimulate: {duration: 2}\ndefaults: {ball: {mass: 1, radius: 0.1}}\n"
    "balls: {red: {position: [0, 1, 0]}, row: {repeat: 3, position: ['= 3 + i', 1, 0]}}\n"
    "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
    "regions: {gate: {radius: 1, position: [9, 0, 0]}, pits: {repeat: 2, radius: 1, position: ['= 20 + 5 * i', 0, "
    "0]}}\n";

TEST(Events, OfForcesSetTheirEnds) {
  const Scene scene = load_text(eventful +
                                "forces:\n  - {uniform: [0, 0, 0]}\n"
                                "  - {uniform: [1, 0, 0], from: {region: gate}, until: {region: gate, after: 0.5}}\n"
                                "  - {spring: {from: red, to: row.0, stiffness: 1}, until: {collision: [red, row]}}\n"
                                "  - {spring: {from: [0, 3, 0], to: red, stiffness: 1}, from: {collision: floor}}\n"
                                "  - {gravitation: {constant: 1}, from: 0.5, until: {collision: [red]}}\n");

  const World& world = scene.world;
  ASSERT_EQ(world.triggers.all.size(), 4u);
  EXPECT_EQ(world.triggers.all[0], (Trigger{.regions = EntityRange{0, 1}}));
  EXPECT_EQ(world.triggers.all[1], (Trigger{.a = {0, 1}, .b = {1, 3}}));
  EXPECT_EQ(world.triggers.all[2], (Trigger{.a = {4, 1}, .b = {0, no_entity}}));
  EXPECT_EQ(world.triggers.all[3], (Trigger{.a = {0, 1}, .b = {0, no_entity}}));
  EXPECT_EQ(scene.roster.events, (vector<string>{"{region: gate}", "{collision: [red, row]}", "{collision: [floor]}",
                                                 "{collision: [red]}"}));

  // The force without effect is none of the world's.
  ASSERT_EQ(world.forces.size(), 2u);
  EXPECT_EQ(world.forces[0].from, not_yet);
  EXPECT_EQ(world.forces[0].until, not_yet);
  EXPECT_EQ(world.forces[1].from, not_yet);
  EXPECT_EQ(world.forces[1].until, infinity);
  EXPECT_EQ(world.springs[0].until, not_yet);
  EXPECT_EQ(world.gravitations[0].from, 0.5);

  World set = world;
  set_off(set, array{1.0, 0.25, 2.0, not_yet});
  EXPECT_EQ(set.forces[0].from, 1);
  EXPECT_EQ(set.forces[0].until, 1.5);
  EXPECT_EQ(set.forces[1].from, 2);
  EXPECT_EQ(set.springs[0].until, 0.25);
  EXPECT_EQ(set.gravitations[0].until, not_yet);
}

TEST(Events, OfMotionsAndStringsSetTheirs) {
  const Scene scene = load_text(eventful +
                                "room: {min: [-40, -40, -40], max: [40, 40, 40]}\n"
                                "obstacles:\n  tube: {inside: true, cylinder: {radius: 1, height: 1}, position: [0, 9, "
                                "0], motion: [{from: {region: pits}, velocity: [0, 1, 0]}]}\n"
                                "strings:\n  line: {from: [0, 3, 0], to: red, until: {collision: line, after: 1}}\n  "
                                "thread: {from: [0, 4, 0], to: red, until: 0.75}\n");
  const World& world = scene.world;
  ASSERT_EQ(world.triggers.all.size(), 2u);
  EXPECT_EQ(world.triggers.all[0], (Trigger{.regions = EntityRange{1, 2}}));
  EXPECT_EQ(world.triggers.all[1].a, (EntityRange{world.string_number(0), 1}));
  EXPECT_EQ(world.strings[0].until, not_yet);
  EXPECT_EQ(world.strings[1].until, 0.75);

  // All parts of the tube.
  const auto moving =
      ranges::count_if(world.triggers.ends, [](const TriggeredEnd& end) { return end.of == TriggeredEnd::Of::motion; });
  EXPECT_EQ(moving, 3);
  World set = world;
  set_off(set, array{1.0, 0.5});
  EXPECT_EQ(set.strings[0].until, 1.5);
  for (const TriggeredEnd& end : world.triggers.ends) {
    if (end.of != TriggeredEnd::Of::motion) continue;
    EXPECT_EQ(fixed_velocity(set, set.body_count() + end.index, {1.5, 0}), Vec3(0, 1, 0));
  }
}

TEST(Events, AreAPartOfTheMotionsText) {
  const auto text = [](const string& when) {
    return motion_text(load_text(eventful + "forces: [{uniform: [1, 0, 0], from: " + when + "}]\n"));
  };
  set<string> all;
  for (const char* when : {"0.5", "{region: gate}", "{region: pits.0}", "{region: gate, after: 1}", "{collision: red}",
                           "{collision: [red, floor]}", "{collision: floor}"})
    EXPECT_TRUE(all.insert(text(when)).second) << when;
  EXPECT_EQ(text("{collision: red}"), text("{collision: [red], after: 0}"));
}

TEST(Events, ErrorsHavePlaceAndRemedy) {
  const auto error = [](const string& when) {
    return errors_of(eventful + "forces: [{uniform: [1, 0, 0], " + when + "}]\n");
  };

  // Names.
  EXPECT_EQ(error("from: {region: gat}"),
            "scene.yaml:7:46: error: no region is named `gat`\n"
            "   7 | forces: [{uniform: [1, 0, 0], from: {region: gat}}]\n"
            "     |                                              ^~~\n"
            "     = did you mean `gate`?\n");
  EXPECT_NE(error("from: {collision: [red, rad]}").find("error: nothing is named `rad`"), string::npos);
  EXPECT_EQ(error("until: {collision: [red, red]}"),
            "scene.yaml:7:50: error: `red` does not meet itself\n"
            "   7 | forces: [{uniform: [1, 0, 0], until: {collision: [red, red]}}]\n"
            "     |                                                  ^\n"
            "     = expected two names, or one\n");

  EXPECT_NE(error("until: {collision: [floor, floor]}").find("are fixed things or strings, which never meet"),
            string::npos);
  EXPECT_NE(error("until: {collision: [red, floor, row]}").find("`collision` has 3 entries"), string::npos);
  EXPECT_NE(error("until: {collision: []}").find("`collision` has 0 entries"), string::npos);
  EXPECT_NE(error("from: {after: 1}").find("has no `region` and no `collision`"), string::npos);
  EXPECT_NE(error("from: {region: gate, collision: red}").find("`region` and `collision`"), string::npos);
  EXPECT_NE(error("from: {region: gate, after: -1}").find("`after` is -1"), string::npos);
  EXPECT_NE(error("from: gate").find("expected a number"), string::npos);

  // Ends against each other.
  EXPECT_EQ(error("from: {region: gate, after: 1}, until: {region: gate, after: 1}"),
            "scene.yaml:7:70: error: `until` is 1 s after the event but `from` is 1 s after the event\n"
            "   7 | forces: [{uniform: [1, 0, 0], from: {region: gate, after: 1}, until: {region: gate, after: 1}}]\n"
            "     |                                                                      ^\n"
            "     = expected from < until\n");
  EXPECT_EQ(error("from: {region: gate, after: 1}, until: {collision: red}"), "");
  EXPECT_EQ(error("from: 1, until: {collision: red}"), "");

  // Windows that repeat, and those that overlap.
  const auto motion = [](const string& windows) {
    return errors_of(eventful + "walls: {w: {center: [-9, 0, 0], normal: [1, 0, 0], size: [1, 1], motion: " + windows +
                     "}}\n");
  };
  EXPECT_NE(motion("{every: 2, windows: [{from: {region: gate}, until: 1, velocity: [1, 0, 0]}]}")
                .find("the windows repeat, but an event happens once"),
            string::npos);
  EXPECT_NE(motion("[{from: {region: gate}, velocity: [1, 0, 0]}, {from: 1, velocity: [1, 0, 0]}, {from: 2, until: 3, "
                   "velocity: [0, 1, 0]}]")
                .find("the one before it never ends"),
            string::npos);
  EXPECT_EQ(motion("[{from: {region: gate}, velocity: [1, 0, 0]}, {from: 1, until: 2, velocity: [1, 0, 0]}]"), "");
}

}  // namespace
}  // namespace carom
