// --set path=value.
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
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
  EXPECT_EQ(in_parts(errors_with(two, "forces.0.visible=false")),
            (Parts{{"--set:8 0", "`forces` has no entry `0`", "it has none: set all of `forces`"}}));
  const string forces = two + "forces: [{uniform: [1, 0, 0]}]\n";
  EXPECT_NE(errors_with(forces, "forces.1.from=1").find("     = its only entry is 0\n"), string::npos);
  for (const string set : {"walls.w.center.x=1", "camera.path.0.at=1", "trails.on.0=red"}) {
    const string errors = errors_with(two, set);
    EXPECT_EQ(errors.find("error: "), errors.rfind("error: ")) << errors;
  }
}

TEST(Settings, ErrorsPointIntoTheOption) {
  EXPECT_EQ(in_parts(errors_with(two, "balls.red.position.z=abc")),
            (Parts{{"--set:22 abc", "`abc` is not a number", "expected a number in m"}}));
  EXPECT_EQ(in_parts(errors_with(two, "balls.rde.mass=3")),
            (Parts{{"--set:7 rde", "there is no ball `rde`", "did you mean `red`?"}}));

  EXPECT_EQ(in_parts(errors_with(two, "simulate.durration=3")),
            (Parts{{"--set:10 durration", "unknown key `durration` in `simulate`", "did you mean `duration`?"}}));
  EXPECT_EQ(in_parts(errors_with(two, "balls.red.position.w=3")),
            (Parts{{"--set:20 w", "`position` has no `w`", "expected x, y or z"}}));

  EXPECT_EQ(in_parts(errors_with(two, "simulate.duration.x=3")),
            (Parts{{"--set:19 x", "`duration` has no parts", "end the path before it"}}));
  EXPECT_EQ(
      in_parts(errors_with(two, "simulate.duration")),
      (Parts{{"--set:1 simulate.duration", "this sets nothing", "expected path=value, such as simulate.duration=2"}}));

  EXPECT_EQ(in_parts(errors_with(two, "simulate.duration=-2")),
            (Parts{{"--set:19 -2", "`duration` is -2", "expected a number of at least 0 in s"}}));
}

TEST(Settings, OverlapMadeByAnOptionPointsAtIt) {
  EXPECT_EQ(in_parts(errors_with(two, "balls.blue.position.x=0.1")),
            (Parts{{"--set:23 0.1", "`blue` overlaps `red` by 0.1 m at the start",
                    "expected bodies apart, or just touching"}}));
}

}  // namespace
}  // namespace carom
