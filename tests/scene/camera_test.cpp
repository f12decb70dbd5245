// The camera of a scene: still, framing the motion, going with bodies, on a path; and what no camera can be.
#include <gtest/gtest.h>

#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string bodies =
    "scene: 1\nsimulate: {duration: 2}\nplanes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
    "balls:\n  red: {mass: 3, radius: 0.1, position: [1, 1, 0]}\n  blue: {mass: 1, radius: 0.1, position: [-1, 1, 0]}\n"
    "groups: {gas: {count: 2, in: {min: [0, 3, 0], max: [1, 4, 1]}, ball: {mass: 1, radius: 0.1}}}\n";

CameraPlan plan_of(const string& camera) {
  return *load_text(bodies + "camera: " + camera + "\n").camera;
}

/// The first error's message; empty: there is none.
string error_of(const string& camera) {
  const Marked errors = marked_errors(bodies + "camera: " + camera + "\n");
  return errors.empty() ? "" : errors[0].second;
}

TEST(CameraPlan, FitOfTheMotionTakesAngleAndUp) {
  const CameraPlan plan = plan_of("{fit: motion, fov: 30, up: [0, 0, 1]}");
  EXPECT_TRUE(plan.fit);
  EXPECT_EQ(plan.fov, 30);
  EXPECT_EQ(plan.up, Vec3(0, 0, 1));
  EXPECT_FALSE(plan.follow);
  EXPECT_FALSE(plan_of("{eye: [0, 1, 9], target: [0, 0, 0]}").fit);
}

TEST(CameraPlan, FollowsABodyAGroupOrAMember) {
  const CameraPlan red = plan_of("{follow: red}");
  ASSERT_TRUE(red.follow);
  EXPECT_EQ(red.follow->first, 0u);
  EXPECT_EQ(red.follow->count, 1u);
  EXPECT_FALSE(red.follow->has_eye);
  EXPECT_EQ(red.target, Vec3(1, 1, 0)) << "the body's own centre";
  const CameraPlan gas = plan_of("{follow: gas, eye: [0, 0, 9], target: [0, 1, 0]}");
  EXPECT_EQ(gas.follow->first, 2u);
  EXPECT_EQ(gas.follow->count, 2u);
  EXPECT_TRUE(gas.follow->has_eye);
  EXPECT_EQ(gas.target, Vec3(0, 1, 0));
  EXPECT_EQ(plan_of("{follow: gas.1}").follow->first, 3u);
}

TEST(CameraPlan, KeyframesTakeTheCamerasAngle) {
  const CameraPlan plan = plan_of(
      "{fov: 30, path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}, {at: 2, eye: [5, 3, 0], target: [0, 1, 0], fov: "
      "20}]}");
  ASSERT_EQ(plan.path.size(), 2u);
  EXPECT_EQ(plan.path[0].fov, 30);
  EXPECT_EQ(plan.path[1].fov, 20);
  EXPECT_EQ(plan.path[1].at, 2);
  EXPECT_EQ(plan.path[1].eye, Vec3(5, 3, 0));
  EXPECT_EQ(plan.path[1].target, Vec3(0, 1, 0));
}

TEST(CameraPlan, ResolvedItIsTheSamePlan) {
  for (const char* camera :
       {"{fit: motion, fov: 30}", "{orbit: {period: 3}}", "{projection: orthographic}",
        "{fit: {on: [red, gas.1, floor]}, orbit: {period: 3}}", "{follow: red, projection: orthographic}",
        "{follow: red}", "{follow: red, eye: [0, 0, 9], near: 1}",
        "{path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}, {at: 1, eye: [0, 3, 4], target: [0, 0, 0]}]}"}) {
    const Scene scene = load_text(bodies + "camera: " + camera + "\n"), again = load_text(scene.resolved);
    EXPECT_EQ(again.resolved, scene.resolved);
    EXPECT_EQ(static_cast<const Camera&>(*again.camera), static_cast<const Camera&>(*scene.camera)) << camera;

    EXPECT_EQ(again.camera->fit, scene.camera->fit);
    EXPECT_EQ(again.camera->fit_on, scene.camera->fit_on);
    EXPECT_EQ(again.camera->orbit, scene.camera->orbit);
    EXPECT_EQ(again.camera->orthographic, scene.camera->orthographic);
    EXPECT_EQ(again.camera->follow.has_value(), scene.camera->follow.has_value());
    EXPECT_EQ(again.camera->path.size(), scene.camera->path.size());
  }
}

TEST(CameraPlan, ASettingReplacesTheKeysThatItExcludes) {
  LoadOptions options;
  options.set = {"camera.fit=motion"};
  EXPECT_TRUE(
      load_text(bodies + "camera: {eye: [0, 1, 9], target: [0, 0, 0], near: 1, fov: 20}\n", options).camera->fit);
  options.set = {"camera.path.1.eye.y=7"};
  const Scene scene = load_text(
      bodies +
          "camera: {path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}, {at: 1, eye: [0, 3, 4], target: [0, 0, 0]}]}\n",
      options);
  EXPECT_EQ(scene.camera->path[1].eye.y(), 7);
}

TEST(CameraPlan, ASettingTakesAwayTheKeysThatTheReplacedOnesNeed) {
  const string path =
      "camera: {near: 1, path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}, {at: 1, eye: [0, 3, 4], target: [0, 0, "
      "0]}]}\n";
  LoadOptions options;
  options.set = {"camera.follow=red"};
  // A resolved scene has near and far.
  for (const string& text : {bodies + path, load_text(bodies + path).resolved}) {
    const Scene scene = load_text(text, options);
    EXPECT_TRUE(scene.camera->follow && !scene.camera->follow->has_eye);
    EXPECT_EQ(scene.resolved.find("near:"), string::npos);
  }
  EXPECT_EQ(load_text(bodies + "camera: {eye: [0, 1, 9], target: [0, 0, 0], near: 2}\n", options).camera->near, 2);
  options.set = {"camera.eye=[0, 1, 9]", "camera.target=[0, 0, 0]"};
  EXPECT_EQ(load_text(bodies + path, options).camera->near, 1);
}

TEST(CameraPlan, FitsNamedThings) {
  EXPECT_TRUE(plan_of("{fit: motion}").fit_on.empty());
  const CameraPlan plan = plan_of("{fit: {on: [gas, red, floor]}}");
  EXPECT_TRUE(plan.fit);
  EXPECT_EQ(plan.fit_on, (vector<Entity>{0, 2, 3, 4}));
  EXPECT_EQ(plan_of("{fit: {on: [gas.1, gas]}}").fit_on, (vector<Entity>{2, 3}));
  EXPECT_EQ(error_of("{fit: {on: [rde]}}"), "nothing is named `rde`");
  EXPECT_EQ(error_of("{fit: {on: [gas.9]}}"), "the group `gas` has no member `9`");
  EXPECT_EQ(error_of("{fit: all}"), "`to` is `all`");
}

TEST(CameraPlan, AStringCannotBeFramed) {
  const Marked errors =
      marked_errors(bodies + "strings: {line: {from: [0, 9, 0], to: red}}\n" + "camera: {fit: {on: [line]}}\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].second, "`line` is a string: there is nothing to frame");
}

TEST(CameraPlan, GoesRoundAndProjectsInParallel) {
  const CameraPlan plan = plan_of("{eye: [0, 1, 9], target: [0, 0, 0], orbit: {period: 8}, projection: orthographic}");
  EXPECT_EQ(plan.orbit, 8);
  EXPECT_TRUE(plan.orthographic);
  EXPECT_EQ(plan_of("{fit: motion}").orbit, 0);
  EXPECT_FALSE(plan_of("{fit: motion, projection: perspective}").orthographic);
  EXPECT_EQ(error_of("{fit: motion, orbit: {period: 0}}"), "`period` is 0");
  EXPECT_EQ(error_of("{fit: motion, orbit: {}}"), "`orbit` has no `period`");
  EXPECT_EQ(error_of("{fit: motion, projection: flat}"), "`projection` is `flat`");
}

TEST(CameraErrors, KeysThatDoNotGoTogetherAreRefused) {
  for (const char* camera :
       {"{fit: motion, eye: [0, 1, 9]}", "{fit: motion, target: [0, 1, 9]}", "{fit: motion, near: 1}",
        "{fit: motion, follow: red}", "{orbit: {period: 1}, path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}]}",
        "{follow: red, path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}]}",
        "{eye: [0, 0, 1], target: [0, 0, 0], path: [{at: 0, eye: [0, 3, 5], target: [0, 0, 0]}]}"})
    EXPECT_NE(error_of(camera).find("`camera` has both "), string::npos) << camera << error_of(camera);
}

TEST(Camera, OfARoundOrAProjectionAloneFramesTheMotion) {
  for (const char* camera : {"{orbit: {period: 4}}", "{projection: orthographic, fov: 30}"})
    EXPECT_TRUE(frames_motion(load_text(start + "camera: " + camera + "\n"))) << camera;
}

TEST(CameraErrors, WithoutAPlaceItNamesTheWaysToOne) {
  EXPECT_EQ(in_parts(errors_of(start + "camera: {fov: 30}\n")),
            (Parts{{"3:1 camera",
                    "`camera` has no `eye` and no `fit` and no `path` and no `follow` and no `orbit` and no "
                    "`projection`",
                    "expected `eye`: [x, y, z], three numbers in m\n"
                    "or `fit`: a map of keys, or a value of `to`\n"
                    "or `path`: a list\n"
                    "or `follow`: a name\n"
                    "or `orbit`: a map of keys\n"
                    "or `projection`: perspective or orthographic"}}));

  EXPECT_EQ(error_of("{orbit: {period: 4}, target: [0, 0, 5]}"), "`camera` has `target` but no `eye`");
  EXPECT_EQ(errors_of(start + "camera: {near: 1}\n").find("`camera` has `near`"), string::npos);
  EXPECT_EQ(error_of("{eye: [0, 0, 5]}"), "`camera` has `eye` but no `target`");
}

TEST(CameraErrors, WhatCannotBeFollowedIsNamed) {
  EXPECT_EQ(error_of("{follow: floor}"), "`floor` is a fixed thing: there is nothing to follow");
  EXPECT_EQ(error_of("{follow: rde}"), "nothing is named `rde`");
  for (const string part :
       {"camera: {follow: zz}\n", "trails: {on: [zz]}\n", "forces: [{uniform: [1, 0, 0], on: [zz]}]\n"})
    EXPECT_NE(errors_of(bodies + part).find("     = expected a ball, body, group or member (gas.3)\n"), string::npos)
        << part;
  EXPECT_EQ(errors_of(bodies + "camera: {follow: flor}\n").find("did you mean"), string::npos);
  EXPECT_EQ(error_of("{follow: gas.2}"), "the group `gas` has no member `2`");
  EXPECT_EQ(error_of("{follow: red, near: 1}"), "`camera` has `near` but no `eye`");
  EXPECT_EQ(error_of("{follow: red, eye: [1, 1, 0]}"), "the camera's target is where its eye is");
}

TEST(CameraErrors, KeyframesAreInOrderAndHaveALineOfSight) {
  const auto path = [](const string& keys) { return error_of("{path: [" + keys + "]}"); };
  EXPECT_EQ(path(""), "`path` has no entries");
  EXPECT_EQ(path("{at: 1, eye: [0, 3, 5], target: [0, 0, 0]}, {at: 1, eye: [0, 3, 4], target: [0, 0, 0]}"),
            "1 s is not later than the keyframe before, at 1 s");
  EXPECT_EQ(path("{at: 1, eye: [0, 3, 5], target: [0, 3, 5]}"), "the camera's target is where its eye is");
  EXPECT_EQ(path("{at: 1, eye: [0, 3, 0], target: [0, 0, 0]}"), "the camera looks along its up direction");
  EXPECT_EQ(path("{at: -1, eye: [0, 3, 5], target: [0, 0, 0]}"), "`at` is -1");
}

TEST(CameraErrors, APathThatTurnsThePictureOverIsRefusedWhereItDoes) {
  // From the front to the back right over the target, and right through it.
  EXPECT_EQ(in_parts(errors_of(bodies + "camera:\n  path:\n    - {at: 0, eye: [0, 4, 4], target: [0, 0, 0]}\n"
                                        "    - {at: 2, eye: [0, 4, -4], target: [0, 0, 0]}\n")),
            (Parts{{"11:7 {", "on the way to this keyframe, at 1 s, the camera looks along its up direction",
                    "the picture would turn over: expected a keyframe between the two, beside that direction"}}));
  EXPECT_EQ(
      error_of("{path: [{at: 0, eye: [0, 0, 4], target: [0, 0, 0]}, {at: 1, eye: [0, 0, -4], target: [0, 0, 0]}]}"),
      "on the way to this keyframe, at 0.5 s, the camera looks along its up direction");
  EXPECT_EQ(error_of("{path: [{at: 0, eye: [0, 4, 4], target: [0, 0, 0]}, {at: 1, eye: [2, 4, 0], target: [0, 0, 0]}, "
                     "{at: 2, eye: [0, 4, -4], target: [0, 0, 0]}]}"),
            "");
}

}  // namespace
}  // namespace carom
