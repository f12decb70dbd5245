// --set path=value.
#include "physics/world.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

const string two = R"(scene: 1
defaults: {ball: {mass: 1, radius: 0.1, velocity: [0, 2, 0]}}
balls:
  red: {position: [0, 0, 0]}
  blue: {position: [1, 0, 0], velocity: [1, 1, 1]}
simulate: {duration: 1}
camera: {eye: [0, 3, -5], target: [0, 0, 0]}
)";

Scene with_settings(const vector<string>& set) {
  LoadOptions options;
  options.set = set;
  return load_text(two, options);
}

TEST(Settings, ReachValuesPartsOfVectorsAndDefaults) {
  const Scene scene =
      with_settings({"balls.red.position.z=-0.5", "restitution.default=0.5", "defaults.ball.mass=3",
                     "simulate.duration=4", "camera.fov=30", "output.frames.fps=12", "gravity.y=0", "title=Two words"});
  EXPECT_EQ(scene.initial.position[0], Vec3(0, 0, -0.5));
  EXPECT_EQ(scene.world.restitution[1], 0.5);
  EXPECT_EQ(scene.world.mass[0], 3);
  EXPECT_EQ(scene.simulate.duration, 4);
  EXPECT_EQ(scene.camera->fov, 30);
  EXPECT_EQ(scene.output.frames->fps, 12);
  EXPECT_EQ(scene.world.gravity, Vec3(0, 0, 0));
  EXPECT_EQ(scene.title, "Two words");
}

TEST(Settings, PartOfAMissingVectorStartsFromItsDefault) {
  const Scene scene = with_settings({"balls.red.velocity.x=7"});
  EXPECT_EQ(scene.initial.velocity[0], Vec3(7, 2, 0));
  EXPECT_EQ(scene.initial.velocity[1], Vec3(1, 1, 1));
}

TEST(Settings, LaterOnesOverruleEarlierOnes) {
  EXPECT_EQ(with_settings({"simulate.duration=2", "simulate.duration=3"}).simulate.duration, 3);
}

TEST(Settings, DensityReplacesMass) {
  EXPECT_LT(with_settings({"balls.red.mass=2", "balls.red.density=1"}).world.mass[0], 0.01);
}

TEST(Settings, AVolumeReplacesTheOneThereWas) {
  LoadOptions options;
  options.set = {"bodies.a.radius=2", "bodies.b.box.y=4", "forces.0.uniform.x=3", "forces.0.from=0.5"};
  const Scene scene = load_text(
      "scene: 1\n"
      "bodies:\n"
      "  a: {mass: 1, box: [1, 1, 1], position: [0, 0, 0]}\n"
      "  b: {mass: 1, box: [1, 1, 1], position: [9, 0, 0]}\n"
      "forces: [{uniform: [1, 0, 0]}]\n"
      "simulate: {duration: 1}\n",
      options);

  EXPECT_EQ(scene.world.volume[0].shape, Shape::sphere);
  EXPECT_EQ(scene.world.volume[1].half, Vec3(0.5, 2, 0.5));
  EXPECT_TRUE(scene.world.forces[0].law == ForceLaw(UniformForce{Vec3(3, 0, 0)}));
  EXPECT_EQ(scene.world.forces[0].from, 0.5);
}

TEST(Settings, ColoursNeedNoQuotes) {
  EXPECT_EQ(with_settings({"balls.red.color=#ff0000"}).roster.bodies[0].color.r, 1);
}

TEST(Settings, SeedOptionOverrulesTheFile) {
  LoadOptions options;
  options.seed = 9;
  options.set = {"seed=4"};
  const Scene scene = load_text(two, options);
  EXPECT_EQ(scene.seed, 9u);
  EXPECT_NE(scene.resolved.find("\nseed: 9\n"), string::npos);
}

TEST(Settings, OfWhatTheSceneLacksAreOneErrorEach) {
  EXPECT_EQ(errors_with(two, "forces.0.visible=false"),
            "--set forces.0.visible=false: error: `forces` has no entry `0`\n"
            "     | forces.0.visible=false\n"
            "     |        ^\n"
            "     = it has none: set all of `forces`\n");
  const string forces = two + "forces: [{uniform: [1, 0, 0]}]\n";
  EXPECT_NE(errors_with(forces, "forces.1.from=1").find("     = its only entry is 0\n"), string::npos);
  for (const string set : {"walls.w.center.x=1", "camera.path.0.at=1", "trails.on.0=red"}) {
    const string errors = errors_with(two, set);
    EXPECT_EQ(errors.find("error: "), errors.rfind("error: ")) << errors;
  }
}

TEST(Settings, ErrorsPointIntoTheOption) {
  EXPECT_EQ(errors_with(two, "balls.red.position.z=abc"),
            "--set balls.red.position.z=abc: error: `abc` is not a number\n"
            "     | balls.red.position.z=abc\n"
            "     |                      ^~~\n"
            "     = expected a number in m\n");
  EXPECT_EQ(errors_with(two, "balls.rde.mass=3"),
            "--set balls.rde.mass=3: error: there is no ball `rde`\n"
            "     | balls.rde.mass=3\n"
            "     |       ^~~\n"
            "     = did you mean `red`?\n");

  EXPECT_EQ(errors_with(two, "simulate.durration=3"),
            "--set simulate.durration=3: error: unknown key `durration` in `simulate`\n"
            "     | simulate.durration=3\n"
            "     |          ^~~~~~~~~\n"
            "     = did you mean `duration`?\n");
  EXPECT_EQ(errors_with(two, "balls.red.position.w=3"),
            "--set balls.red.position.w=3: error: `position` has no `w`\n"
            "     | balls.red.position.w=3\n"
            "     |                    ^\n"
            "     = expected x, y or z\n");

  EXPECT_EQ(errors_with(two, "simulate.duration.x=3"),
            "--set simulate.duration.x=3: error: `duration` has no parts\n"
            "     | simulate.duration.x=3\n"
            "     |                   ^\n"
            "     = end the path before it\n");
  EXPECT_EQ(errors_with(two, "simulate.duration"),
            "--set simulate.duration: error: this sets nothing\n"
            "     | simulate.duration\n"
            "     | ^~~~~~~~~~~~~~~~~\n"
            "     = expected path=value, such as simulate.duration=2\n");

  EXPECT_EQ(errors_with(two, "simulate.duration=-2"),
            "--set simulate.duration=-2: error: `duration` is -2\n"
            "     | simulate.duration=-2\n"
            "     |                   ^~\n"
            "     = expected a number of at least 0 in s\n");
}

TEST(Settings, OverlapMadeByAnOptionPointsAtIt) {
  EXPECT_EQ(errors_with(two, "balls.blue.position.x=0.1"),
            "--set balls.blue.position.x=0.1: error: `blue` overlaps `red` by 0.1 m at the start\n"
            "     | balls.blue.position.x=0.1\n"
            "     |                       ^~~\n"
            "     = expected bodies apart, or just touching\n");
}

}  // namespace
}  // namespace carom
