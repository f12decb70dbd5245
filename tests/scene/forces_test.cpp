// Forces, and the engines that support them.
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string things =
    "scene: 1\n"
    "balls: {red: {mass: 1, radius: 1, position: [0, 0, 0]}, blue: {mass: 1, radius: 1, position: [5, 0, 0]}}\n"
    "groups: {gas: {count: 3, ball: {mass: 1, radius: 0.1}, in: {min: [9, 0, 0], max: [10, 1, 1]}},\n"
    "         none: {count: 0, ball: {mass: 1, radius: 0.1}, in: {min: [9, 0, 0], max: [10, 1, 1]}}}\n"
    "planes: {floor: {point: [0, -3, 0], normal: [0, 1, 0]}}\n"
    "simulate: {duration: 1}\n";

TEST(Forces, ActOnAllOrOnThoseNamedFromTimeToTime) {
  const Scene scene = load_text(things +
                                "forces:\n"
                                "  - {uniform: [1, 0, 0]}\n"
                                "  - {acceleration: [0, 0, 2], on: [gas, red, gas.1], from: 0.5, until: 1.5}\n"
                                "  - {uniform: [0, 3, 0], on: [gas.2]}\n");

  ASSERT_EQ(scene.world.forces.size(), 3u);
  const Force &all = scene.world.forces[0], &gust = scene.world.forces[1];
  EXPECT_TRUE(all.law == ForceLaw(UniformForce{Vec3(1, 0, 0)}));
  EXPECT_EQ(all.from, 0);
  EXPECT_EQ(all.until, infinity);
  EXPECT_TRUE(all.on.empty());
  EXPECT_TRUE(gust.law == ForceLaw(UniformAcceleration{Vec3(0, 0, 2)}));
  EXPECT_EQ(gust.from, 0.5);
  EXPECT_EQ(gust.until, 1.5);
  EXPECT_EQ(gust.on, (vector<Entity>{0, 2, 3, 4}));
  EXPECT_EQ(scene.world.forces[2].on, (vector<Entity>{4}));
}

TEST(Forces, OnAGroupWithoutMembersActOnNobody) {
  EXPECT_TRUE(load_text(things + "forces: [{uniform: [1, 0, 0], on: [none]}]\n").world.forces.empty());
}

TEST(ForceErrors, NamesThatMeanNothingOrNothingThatMoves) {
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {uniform: [1, 0, 0], on: [rde, floor, gas.3, pot]}\n")),
            (Parts{{"8:31 rde", "nothing is named `rde`", "did you mean `red`?"},
                   {"8:36 floor", "`floor` is a fixed thing: no force acts on it",
                    "expected balls, bodies, groups or members (gas.3)"},
                   {"8:43 gas.3", "the group `gas` has no member `3`", "expected gas.0 to gas.2"},
                   {"8:50 pot", "nothing is named `pot`",
                    "expected a ball, body, group or member (gas.3)\n"
                    "there are `red`, `blue`, `gas` and `none`"}}));

  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {uniform: [1, 0, 0], on: []}\n")),
            (Parts{{"8:30 [", "`on` has 0 entries", "expected a list of names, such as [red, gas.3]"}}));
}

TEST(ForceErrors, UntilComesAfterFrom) {
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {uniform: [1, 0, 0], from: 2, until: 2}\n")),
            (Parts{{"8:42 2", "`until` is 2 but `from` is 2", "expected from < until"}}));
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {uniform: [1, 0, 0], from: -1}\n")),
            (Parts{{"8:32 -1", "`from` is -1", "expected a number of at least 0 in s"}}));
}

TEST(ForceErrors, OneKindEach) {
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {from: 2}\n")),
            (Parts{{"8:5 {",
                    "this entry of `forces` has no `uniform` and no `acceleration` and no `drag` and no `spring` and "
                    "no `attractor`",
                    "expected `uniform`: [x, y, z], three numbers in N\n"
                    "or `acceleration`: [x, y, z], three numbers in m/s^2\n"
                    "or `drag`: a map of keys\n"
                    "or `spring`: a map of keys\n"
                    "or `attractor`: a map of keys"}}));

  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {uniform: [1, 0, 0], acceleration: [1, 0, 0]}\n")),
            (Parts{{"8:26 acceleration", "this entry of `forces` has both `uniform` and `acceleration`",
                    "remove one of them"}}));
}

TEST(Forces, OfEveryKindHaveTheirFigures) {
  const Scene scene =
      load_text(things +
                "forces:\n"
                "  - {drag: {linear: 0.5, quadratic: 0.25, wind: [1, 2, 3]}, from: 1}\n"
                "  - {spring: {anchor: [1, 0, 0], stiffness: 40, rest_length: 0.5, damping: 2}, on: [red]}\n"
                "  - {spring: {anchor: [0, 0, 0], stiffness: 4}}\n"
                "  - {attractor: {center: [0, 9, 0], strength: -3, softening: 0.1}}\n");

  ASSERT_EQ(scene.world.forces.size(), 4u);
  EXPECT_TRUE(scene.world.forces[0].law == ForceLaw(Drag{0.5, 0.25, Vec3(1, 2, 3)}));
  EXPECT_EQ(scene.world.forces[0].from, 1);
  EXPECT_TRUE(scene.world.forces[1].law == ForceLaw(Spring{Vec3(1, 0, 0), 40, 0.5, 2}));
  EXPECT_EQ(scene.world.forces[1].on, (vector<Entity>{0}));
  EXPECT_TRUE(scene.world.forces[2].law == ForceLaw(Spring{Vec3::Zero(), 4, 0, 0}));
  EXPECT_TRUE(scene.world.forces[3].law == ForceLaw(Attractor{Vec3(0, 9, 0), -3, 0.1}));
}

TEST(Forces, ThatDoNothingAreLeftOut) {
  EXPECT_TRUE(load_text(things + "forces:\n"
                                 "  - {uniform: [0, 0, 0]}\n"
                                 "  - {drag: {linear: 0}}\n"
                                 "  - {spring: {anchor: [1, 0, 0], stiffness: 0}}\n"
                                 "  - {attractor: {center: [0, 9, 0], strength: 0}}\n")
                  .world.forces.empty());
}

TEST(ForceErrors, OfWhatTheyAreMadeOf) {
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {drag: {wind: [1, 0, 0]}}\n")),
            (Parts{{"8:6 drag", "`drag` has no `linear` and no `quadratic`",
                    "expected `linear` (kg/s), `quadratic` (kg/m) or both"}}));
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {spring: {anchor: [1, 0, 0], stiffness: -1}}\n")),
            (Parts{{"8:45 -1", "`stiffness` is -1", "expected a number of at least 0 in N/m"}}));

  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {attractor: {center: [1, 0, 0]}}\n")),
            (Parts{{"8:6 attractor", "`attractor` has no `strength`", "expected `strength`: a number in m^3/s^2"}}));
}

TEST(Engines, HaveTheForcesThatTheyCanFollow) {
  const string one = "scene: 1\nballs: {a: {mass: 1, radius: 1, position: [0, 0, 0]}}\n";
  EXPECT_EQ(in_parts(errors_of(one + "forces: [{drag: {quadratic: 1}}]\nsimulate: {duration: 1, engine: exact}\n")),
            (Parts{{"4:33 exact", "under quadratic `drag` paths have no closed form, which `engine: exact` follows",
                    "expected `engine: stepped`, or `auto`"}}));
  EXPECT_EQ(load_text(one + "forces: [{drag: {linear: 1}}]\nsimulate: {duration: 1, engine: exact}\n").simulate.engine,
            Engine::exact);
  EXPECT_TRUE(load_text(one + "forces: [{drag: {linear: 1}}]\nsimulate: {duration: 1, contact: merge}\n")
                  .simulate.contact.merge);

  EXPECT_EQ(in_parts(errors_of(one + "forces: [{drag: {quadratic: 1}}]\nsimulate: {duration: 1, contact: merge}\n")),
            (Parts{{"4:34 merge", "`contact: merge` is for parabolas and linear drag, not for `drag`",
                    "expected `contact: bounce`"}}));
  EXPECT_EQ(in_parts(errors_of(one + "simulate: {duration: 1, engine: stepped, contact: merge}\n")),
            (Parts{{"3:51 merge", "`engine: stepped` has no `contact: merge`", "expected `contact: bounce`"}}));
  EXPECT_EQ(load_text(one + "simulate: {duration: 1, engine: stepped, integrator: verlet}\n").simulate.integrator,
            Integrator::verlet);
}

TEST(BookEngine, RefusesWhatTheChaptersListingsDoNotHave) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\n"
                               "bodies: {a: {mass: 1, box: [1, 1, 1], position: [0, 0, 0]}}\n"
                               "obstacles: {o: {radius: 1, position: [9, 0, 0]}}\n"
                               "forces: [{uniform: [1, 0, 0]}]\n"
                               "simulate: {duration: 1, engine: book, contact: merge}\n")),
            (Parts{{"3:1 obstacles", "`engine: book` has no obstacles", "expected `engine: exact`"},
                   {"4:1 forces", "`engine: book` has no forces other than gravity", "expected `engine: exact`"},
                   {"5:33 book", "`engine: book` has no cylinders and boxes: its bodies are spheres",
                    "expected `engine: exact`"},
                   {"5:48 merge", "`engine: book` has no `contact: merge`", "expected `engine: exact`"}}));
}

TEST(Requests, ContactsAndMerging) {
  const Scene scene = load_text("scene: 1\nsimulate: {duration: 1, contact: merge}\noutput: {contacts: true}\n");
  EXPECT_TRUE(scene.simulate.contact.merge);
  ASSERT_TRUE(scene.output.contacts);
  EXPECT_EQ(scene.output.contacts->every, 1.0 / 30);
  EXPECT_FALSE(load_text(start).output.contacts);
  EXPECT_EQ(load_text(start + "output: {contacts: {every: 0.5}}\n").output.contacts->every, 0.5);
}

TEST(Requests, PicturesEndWithTheScene) {
  const Scene scene = load_text(start + "output: {frames: {until: 5}, video: {until: 0.5}}\n");
  EXPECT_EQ(scene.output.frames->until, 1);
  EXPECT_EQ(scene.output.video->until, 0.5);
}

}  // namespace
}  // namespace carom
