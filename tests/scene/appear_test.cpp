// Bodies that come later, as a scene has them.
#include "physics/body_now.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

const string later =
    "scene: 1\nsimulate: {duration: 2}\ndefaults: {ball: {mass: 1, radius: 0.1}}\n"
    "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";

TEST(Appear, OfBallsBodiesAndGroupsIsInTheWorldAndTheyAreOutOfTheStart) {
  const Scene scene =
      load_text(later +
                "balls: {a: {position: [0, 1, 0]}, b: {position: [0, 1, 0], appear: 0.5}}\n"
                "bodies: {crate: {mass: 2, box: [1, 1, 1], position: [0, 1, 0], appear: 1}}\n"
                "groups: {gas: {count: 2, appear: 0.25, in: {min: [-1, 0, -1], max: [1, 2, 1]}, ball: {}}}\n");
  ASSERT_EQ(scene.world.appears.size(), 5u);
  EXPECT_FALSE(scene.world.comes_later(0));
  EXPECT_EQ(scene.world.appears[1], 0.5);
  EXPECT_EQ(scene.world.appears[2], 1);
  EXPECT_EQ(scene.world.appears[4], 0.25);
  for (Entity i = 0; i < 5; ++i) EXPECT_EQ(is_removed(scene.initial, i), i > 0);
  EXPECT_EQ(mass_now(scene.world, scene.initial, 2), 0);

  // 0 is the start.
  EXPECT_TRUE(load_text(later + "balls: {a: {position: [0, 1, 0], appear: 0}}\n").world.appears.empty());
}

TEST(Appear, ARateMakesTheBallsThatAreDueBeforeTheEnd) {
  const auto count = [](const string& keys) {
    return load_text(later + "groups: {rain: {" + keys + ", in: {min: [-1, 3, -1], max: [1, 4, 1]}, ball: {}}}\n")
        .world.body_count();
  };
  EXPECT_EQ(count("rate: 50"), 100u);
  EXPECT_EQ(count("rate: 50, from: 0.5, until: 1"), 25u);
  EXPECT_EQ(count("rate: 50, from: 0.5, until: 9"), 75u);
  EXPECT_EQ(count("rate: 3, until: 1.01"), 4u);
  EXPECT_EQ(count("rate: 10, until: 0.3"), 3u);
  EXPECT_EQ(count("rate: 10, from: 3"), 0u);

  const Scene scene = load_text(
      later + "groups: {rain: {rate: 4, from: 1, in: {min: [-1, 3, -1], max: [1, 4, 2]}, ball: {}, speed: 1}}\n");
  ASSERT_EQ(scene.world.pours.size(), 1u);
  EXPECT_EQ(scene.world.pours[0].center, Vec3(0, 3.5, 0.5));
  EXPECT_LT((scene.world.pours[0].within.half - Vec3(1, 0.5, 1.5)).norm(), 1e-15);
  EXPECT_EQ(scene.world.appears[3], 1.75);
}

TEST(Appear, ErrorsHavePlaceAndRemedy) {
  EXPECT_EQ(errors_of(later + "balls: {a: {position: [0, 1, 0], appear: -1}}\n"),
            "scene.yaml:5:42: error: `appear` is -1\n"
            "   5 | balls: {a: {position: [0, 1, 0], appear: -1}}\n"
            "     |                                          ^~\n"
            "     = expected a number of at least 0 in s\n");

  // In what stands.
  EXPECT_NE(errors_of(later + "balls: {a: {position: [0, 0.05, 0], appear: 1}}\n").find("`a` overlaps `floor`"),
            string::npos);

  // A string needs both of its ends.
  EXPECT_NE(errors_of(later + "balls: {a: {position: [0, 1, 0], appear: 1}}\n"
                              "strings: {s: {from: [0, 2, 0], to: a}}\n")
                .find("`s` is tied to `a`, which appears at 1 s"),
            string::npos);

  // So does a force between bodies.
  const string two = later + "balls: {a: {position: [0, 1, 0], appear: 1}, b: {position: [0, 3, 0]}}\n";
  EXPECT_EQ(errors_of(two + "forces: [{spring: {from: b, to: a, stiffness: 1}}]\n"),
            "scene.yaml:6:26: error: the force is on `a`, which appears at 1 s\n"
            "   6 | forces: [{spring: {from: b, to: a, stiffness: 1}}]\n"
            "     |                          ^\n"
            "     = expected bodies that are there from the start; name them in `on`, or as ends\n");
  EXPECT_NE(errors_of(two + "forces: [{gravitation: {constant: 1}}]\n").find("6:10: error: the force is on `a`"),
            string::npos);
  EXPECT_EQ(errors_of(two + "forces: [{spring: {anchor: [0, 2, 0], stiffness: 1}}]\n"), "");

  // Keys of groups.
  const auto group = [](const string& keys) {
    return errors_of(later + "groups: {rain: {ball: {}, " + keys + ", in: {min: [0, 3, 0], max: [1, 4, 1]}}}\n");
  };
  EXPECT_NE(group("rate: 0").find("`rate` is 0"), string::npos);
  EXPECT_NE(group("rate: 5, count: 3").find("`count`"), string::npos);
  EXPECT_NE(group("rate: 5, appear: 3").find("`appear`"), string::npos);
  EXPECT_NE(group("rate: 5, arrange: lattice").find("`arrange`"), string::npos);
  EXPECT_NE(group("count: 5, from: 3").find("`rate`"), string::npos);
  EXPECT_NE(group("from: 3").find("`count`"), string::npos);

  const string wide = "groups: {rain: {ball: {radius: 0.6}, rate: 5, in: {min: [0, 3, 0], max: [1, 4, 1]}}}\n";
  EXPECT_NE(errors_of(later + wide).find("does not fit into the space of `rain`"), string::npos);
}

TEST(Appear, BudgetsCountBallsThatCome) {
  LoadOptions options;
  options.budget.bodies = 50;
  EXPECT_NE(errors_of(later + "groups: {rain: {rate: 1e9, in: {min: [0, 3, 0], max: [1, 4, 1]}, ball: {}}}\n", options)
                .find("the limit is 50"),
            string::npos);
}

}  // namespace
}  // namespace carom
