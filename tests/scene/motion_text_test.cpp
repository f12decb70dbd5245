// motion_text: the same text means the same motion; outputs are not in it.
#include "scene/motion_text.h"

#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

const string both = R"(scene: 1
title: Two
simulate: {duration: 2}
balls:
  red: {mass: 1, radius: 0.5, position: [0, 1, 0], impulse: [1, 0, 0], color: crimson}
bodies:
  crate: {mass: 2, box: [1, 1, 1], position: [3, 1, 0]}
planes:
  floor: {point: [0, 0, 0], normal: [0, 1, 0]}
walls:
  side: {center: [5, 1, 0], normal: [1, 0, 0], size: [2, 2]}
obstacles:
  post: {radius: 0.25, position: [8, 1, 0]}
forces:
  - {uniform: [0, 0, 1], on: [red], until: 1}
  - {spring: {anchor: [0, 4, 0], stiffness: 3, rest_length: 1}}
camera: {eye: [0, 3, -9], target: [0, 0, 0]}
)";

string text_with(const string& set) {
  LoadOptions options;
  if (!set.empty()) options.set = {set};
  return motion_text(load_text(both, options));
}

TEST(MotionText, LeavesOutPicturesAndOtherOutputs) {
  for (const char* set : {"title=Other", "camera.eye.x=1", "camera.fov=20", "background=black", "balls.red.color=blue",
                          "planes.floor.visible=false", "output.frames.fps=7", "output.collisions=true", "seed=5",
                          "walls.side.color=white", "obstacles.post.visible=false"})
    EXPECT_EQ(text_with(set), text_with("")) << set;
}

TEST(MotionText, IsAsNumbersAreNotAsTheyAreWritten) {
  EXPECT_EQ(text_with("balls.red.mass=1.00"), text_with(""));
  EXPECT_EQ(text_with("balls.red.position=[0.0, 1e0, 0]"), text_with(""));
  EXPECT_EQ(text_with("simulate.engine=stepped"), text_with(""));  // what auto takes under a spring with a rest length
}

/// Settings that change the motion, each in another way.
const vector<const char*> of_the_motion = {"simulate.duration=3",
                                           "simulate.step=0.01",
                                           "simulate.tolerance=0.01",
                                           "simulate.rest_speed=0.1",
                                           "simulate.contact.quality=fast",
                                           "simulate.max_collisions=9",
                                           "simulate.integrator=euler",
                                           "gravity=[0, -9, 0]",
                                           "restitution.default=0.5",
                                           "restitution.combine=minimum",
                                           "balls.red.mass=3",
                                           "balls.red.radius=0.4",
                                           "balls.red.position.x=0.1",
                                           "balls.red.velocity=[0, 0, 1]",
                                           "balls.red.impulse.x=2",
                                           "balls.red.restitution=0.25",
                                           "bodies.crate.box=[1, 1, 0.5]",
                                           "planes.floor.point.y=-1",
                                           "planes.floor.normal=[1, 9, 0]",
                                           "planes.floor.restitution=0.7",
                                           "walls.side.center.x=6",
                                           "walls.side.size=[2, 3]",
                                           "walls.side.up=[0, 0, 1]",
                                           "obstacles.post.position.x=9",
                                           "obstacles.post.radius=0.3",
                                           "obstacles.post.restitution=0.1"};

TEST(MotionText, ChangesWithWhateverChangesTheMotion) {
  vector<string> texts = {text_with("")};
  for (const char* set : of_the_motion) texts.push_back(text_with(set));

  for (const auto& [from, to] : {pair("until: 1", "until: 1.5"), pair("[0, 0, 1]", "[0, 0, 2]"),
                                 pair("on: [red]", "on: [crate]"), pair("stiffness: 3", "stiffness: 4")}) {
    string other = both;
    other.replace(other.find(from), string_view(from).size(), to);
    texts.push_back(motion_text(load_text(other)));
  }

  for (size_t i = 0; i < texts.size(); ++i)
    for (size_t k = 0; k < i; ++k) EXPECT_NE(texts[i], texts[k]) << i << ", " << k;
}

TEST(MotionText, OfAGroupFollowsTheSeed) {
  const string gas = start +
                     "groups:\n  gas: {count: 9, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [2, 2, "
                     "2]}, speed: 1}\n";
  LoadOptions other;
  other.seed = 7;
  EXPECT_EQ(motion_text(load_text(gas)), motion_text(load_text(gas)));
  EXPECT_NE(motion_text(load_text(gas)), motion_text(load_text(gas, other)));
}

}  // namespace
}  // namespace carom
