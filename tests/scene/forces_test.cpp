// Forces, and the engines that support them.
#include "physics/world.h"
#include "scene/engines.h"
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
            (Parts{{"8:32 -1", "`from` is -1", "expected a number of at least 0 in s, or a map of keys"}}));
}

TEST(ForceErrors, OneKindEach) {
  EXPECT_EQ(in_parts(errors_of(things + "forces:\n  - {from: 2}\n")),
            (Parts{{"8:5 {",
                    "this entry of `forces` has no `uniform` and no `acceleration` and no `drag` and no `spring` and "
                    "no `attractor` and no `gravitation`",
                    "expected `uniform`: [x, y, z], three numbers in N\n"
                    "or `acceleration`: [x, y, z], three numbers in m/s^2\n"
                    "or `drag`: a map of keys\n"
                    "or `spring`: a map of keys\n"
                    "or `attractor`: a map of keys\n"
                    "or `gravitation`: a map of keys"}}));

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

  EXPECT_EQ(
      in_parts(errors_of(one + "forces: [{drag: {quadratic: 1}}]\nsimulate: {duration: 1, contact: merge}\n")),
      (Parts{{"4:34 merge",
              "`contact: merge` is for constant forces, linear drag, attractors and forces between bodies, not for "
              "quadratic `drag`",
              "expected `contact: bounce`"}}));
  EXPECT_TRUE(load_text(one + "simulate: {duration: 1, engine: stepped, contact: merge}\n").simulate.contact.merge);
  EXPECT_EQ(in_parts(errors_of(one + "simulate: {duration: 1, engine: stepped, integrator: rk4, contact: merge}\n")),
            (Parts{{"3:68 merge", "`integrator: rk4` has no `contact: merge`",
                    "expected `integrator: dop853`, or `engine: exact`"}}));
  EXPECT_EQ(load_text(one + "simulate: {duration: 1, engine: stepped, integrator: verlet}\n").simulate.integrator,
            Integrator::verlet);
}

TEST(Forces, BetweenBodiesStandBesideThoseOnEach) {
  const Scene scene = load_text(things +
                                "forces:\n"
                                "  - {spring: {from: blue, to: red, stiffness: 40, damping: 2}, from: 1, until: 2}\n"
                                "  - {spring: {from: gas.1, to: red, stiffness: 40, rest_length: 0}, visible: false}\n"
                                "  - {spring: {from: [5, 0, 2], to: blue, stiffness: 3}}\n"
                                "  - {repeat: 2, spring: {from: 'gas.{i}', to: 'gas.{i + 1}', stiffness: 7}}\n"
                                "  - {spring: {from: red, to: blue, stiffness: 0}}\n"
                                "  - {gravitation: {}}\n"
                                "  - {gravitation: {constant: 2, softening: 0.5}, on: [gas, red], until: 3}\n"
                                "  - {gravitation: {constant: 0}}\n");

  // Without a rest length it is the distance at time 0, also from a point.
  const vector<BodySpring>& springs = scene.world.springs;
  ASSERT_EQ(springs.size(), 4u);
  EXPECT_EQ(pair(springs[0].a, springs[0].b), pair(Entity{0}, Entity{1}));
  EXPECT_EQ(springs[0].rest_length, 5);
  EXPECT_EQ(springs[0].damping, 2);
  EXPECT_EQ(pair(springs[0].from, springs[0].until), pair(1.0, 2.0));
  EXPECT_EQ(springs[1].rest_length, 0);
  EXPECT_EQ(pair(springs[3].a, springs[3].b), pair(Entity{3}, Entity{4}));
  EXPECT_EQ(scene.overlay.hidden_body_springs, vector<size_t>{1});

  ASSERT_EQ(scene.world.forces.size(), 1u);
  EXPECT_TRUE(scene.world.forces[0].law == ForceLaw(Spring{Vec3(5, 0, 2), 3, 2, 0}));
  EXPECT_EQ(scene.world.forces[0].on, vector<Entity>{1});

  const vector<Gravitation>& all = scene.world.gravitations;
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].constant, 6.674e-11);
  EXPECT_TRUE(all[0].on.empty());
  EXPECT_EQ(all[1].on, (vector<Entity>{0, 2, 3, 4}));
  EXPECT_EQ(all[1].until, 3);
}

TEST(ForceErrors, OfTheEndsOfSprings) {
  const auto errors = [](const string& force) { return in_parts(errors_of(things + "forces:\n  - " + force + "\n")); };
  EXPECT_EQ(errors("spring: {from: red, to: red, stiffness: 1}"),
            (Parts{{"8:29 red", "both ends of the spring are `red`", "expected two bodies, or a point and a body"}}));
  EXPECT_EQ(errors("spring: {from: [0, 1, 0], to: [0, 0, 0], stiffness: 1}"),
            (Parts{{"8:35 [", "both ends of the spring are fixed points",
                    "expected a ball, a body or a member (gas.3) at one end at least"}}));
  EXPECT_EQ(errors("spring: {from: red, to: floor, stiffness: 1}"),
            (Parts{{"8:29 floor", "`floor` is a fixed thing: no spring is tied to it",
                    "expected a ball, a body or a member (gas.3); a fixed end is a point: `from: [x, y, z]`"}}));
  EXPECT_EQ(errors("spring: {from: red, to: gas, stiffness: 1}"),
            (Parts{{"8:29 gas", "`gas` has 3 bodies: a spring has one at each end",
                    "expected one of them, such as gas.0; for a spring to each `repeat`, and 'gas.{i}'"}}));

  EXPECT_EQ(errors("spring: {from: red, stiffness: 1}"),
            (Parts{{"8:14 from", "`spring` has `from` but no `to`",
                    "expected `to`: [x, y, z], three numbers in m, or a name"}}));
  EXPECT_EQ(errors("spring: {from: red, to: blue, anchor: [0, 0, 0], stiffness: 1}"),
            (Parts{{"8:35 anchor", "`spring` has both `from` and `anchor`", "remove one of them"}}));
  EXPECT_EQ(errors("{spring: {from: red, to: blue, stiffness: 1}, on: [red]}"),
            (Parts{{"8:55 [", "`on` beside `from` and `to`: the spring acts on its two ends",
                    "leave out `on`; a spring from a point to each of many bodies has an `anchor`"}}));
  EXPECT_EQ(errors("gravitation: {softening: -1}"),
            (Parts{{"8:30 -1", "`softening` is -1", "expected a number of at least 0 in m"}}));
}

TEST(Engines, OfFixedStepsRefuseForcesBetweenBodies) {
  const string forces = "forces: [{spring: {from: red, to: blue, stiffness: 1}}]\n";
  const string head = things.substr(0, things.find("simulate"));
  EXPECT_EQ(in_parts(errors_of(head + forces + "simulate: {duration: 1, engine: stepped, step: 0.1}\n")),
            (Parts{{"6:1 forces", "`integrator: rk4` has no springs between bodies",
                    "expected `integrator: dop853`, or `engine: exact`"}}));
  EXPECT_EQ(in_parts(errors_of(head + "forces: [{gravitation: {}}]\nsimulate: {duration: 1, engine: book}\n")),
            (Parts{{"6:1 forces", "`engine: book` has no forces other than gravity", "expected `engine: exact`"}}));
  EXPECT_EQ(engine_of(load_text(things + forces).world, {}), Engine::exact);
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
