// What pictures show besides bodies: the keys, and the errors at their place.

#include "scene/caption.h"
#include "scene/color_scale.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string balls = start + "title: Two\nrestitution: {default: 0.75}\ndefaults: {ball: {mass: 2.50, radius: 0.1}}\n" +
                     "balls:\n  red: {position: [0, 1, -0.5], velocity: [3, 4, 0]}\n  blue: {position: [1, 3, 0]}\n";

string caption_of(const string& caption) {
  return load_text(balls + "caption: \"" + caption + "\"\n").overlay.caption;
}

string error_of(const string& caption) {
  return errors_of(balls + "caption: \"" + caption + "\"\n");
}

TEST(Caption, TrueIsTheTitleAndTheTime) {
  EXPECT_EQ(load_text(balls + "caption: true\n").overlay.caption, "{title}   {time} s");
  EXPECT_EQ(load_text(balls + "caption: false\n").overlay.caption, "");
  EXPECT_EQ(load_text(balls).overlay.caption, "");
  EXPECT_EQ(load_text(balls + "caption: 'true'\n").overlay.caption, "true");
}

TEST(Caption, HasTheValuesOfPathsIntoTheScene) {
  EXPECT_EQ(caption_of("e = {restitution.default}"), "e = 0.75");
  EXPECT_EQ(caption_of("{defaults.ball.mass} kg"), "2.5 kg");
  EXPECT_EQ(caption_of("{balls.red.mass} kg"), "2.5 kg");  // of the defaults
  EXPECT_EQ(caption_of("{balls.red.position.z}"), "-0.5");
  EXPECT_EQ(caption_of("{balls.red.position}"), "[0, 1, -0.5]");
  EXPECT_EQ(caption_of("{gravity.y}"), "-9.80665");  // of the format
  EXPECT_EQ(caption_of("{simulate.duration} s, {simulate.engine}"), "1 s, auto");
  EXPECT_EQ(load_text(start + "caption: \"{restitution.default}\"\n").overlay.caption, "1");
}

TEST(Caption, KeepsTheNamesThatARunFillsIn) {
  EXPECT_EQ(caption_of("{title} {time} {run} {collisions}"), "{title} {time} {run} {collisions}");
  const CaptionValues values{"T", "0.5", "r0001", "12"};
  EXPECT_EQ(caption_text("{title} at {time} s in {run}: {collisions}", values), "T at 0.5 s in r0001: 12");
  EXPECT_TRUE(has_name("{run}", "run"));
  EXPECT_FALSE(has_name("{{run}}", "run"));
}

TEST(Caption, HasTwoBracesForOne) {
  EXPECT_EQ(caption_text(caption_of("{{time}} = {time}, {{{simulate.duration}}}"), {"", "0.5", "", ""}),
            "{time} = 0.5, {1}");
}

TEST(Caption, EndsWithHowSlowTheFilmIs) {
  EXPECT_EQ(caption_text("{title}   {time} s", {"A ball", "0.5", "", "", "1/8 speed"}), "A ball   0.5 s   1/8 speed");
  EXPECT_EQ(caption_text("{slow}: {title}", {"A ball", "0.5", "", "", "1/8 speed"}), "1/8 speed: A ball");
  EXPECT_EQ(caption_text("", {"A ball", "0.5", "", "", "1/8 speed"}), "1/8 speed");
  EXPECT_EQ(caption_text("{title}", {"A ball", "0.5", "", "", ""}), "A ball");
}

TEST(Caption, OfTheResolvedSceneIsTheSame) {
  LoadOptions options;
  options.set = {"defaults.ball.mass=7", "caption=m = {defaults.ball.mass}, {time}"};
  const Scene scene = load_text(balls, options);
  EXPECT_EQ(scene.overlay.caption, "m = 7, {time}");
  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.overlay.caption, scene.overlay.caption);
  EXPECT_EQ(again.resolved, scene.resolved);
}

TEST(Caption, WithAnUnknownNameIsAnErrorAtItsPlace) {
  EXPECT_EQ(in_parts(error_of("t = {tme} s")),
            (Parts{{"9:15 {tme}", "unknown key `tme` in the scene",
                    "did you mean `time`?\n"
                    "expected {title}, {time}, {run}, {collisions}, {slow} or a path such as {restitution.default}"}}));
  EXPECT_NE(error_of("{balls.rde.mass}").find("there is no ball `rde`\n"), string::npos);
  EXPECT_NE(error_of("{balls.rde.mass}").find("did you mean `red`?"), string::npos);
  EXPECT_NE(error_of("{balls.red.mas}").find("unknown key `mas` in `ball`"), string::npos);
  EXPECT_NE(error_of("{balls.red}").find("`balls.red` holds several values"), string::npos);
  EXPECT_NE(error_of("{balls}").find("`balls` holds several values"), string::npos);
  EXPECT_NE(error_of("{camera.fov}").find("this scene has no `camera`"), string::npos);
  EXPECT_NE(error_of("{balls.red.color}").find("`color` has no value in this scene"), string::npos);
  EXPECT_NE(error_of("{balls.red.mass.x}").find("`mass` has no part `x`"), string::npos);

  EXPECT_EQ(in_parts(error_of("{foo}")),
            (Parts{{"9:11 {foo}", "unknown key `foo` in the scene",
                    "expected {title}, {time}, {run}, {collisions}, {slow} or a path such as {restitution.default}"}}));
  EXPECT_NE(error_of("{fps}").find("     = `fps` is a key of `frames`, `video` or `gltf`\n     = expected {title}"),
            string::npos);
  EXPECT_EQ(in_parts(error_of("{}")),
            (Parts{{"9:11 {}", "there is no name between the braces",
                    "expected {title}, {time}, {run}, {collisions}, {slow} or a path such as {restitution.default}"}}));
  EXPECT_NE(error_of("{time").find("scene.yaml:9:11: error: a brace is not closed\n"), string::npos);
}

TEST(Caption, WithABraceThatNothingOpensIsAnError) {
  EXPECT_EQ(in_parts(error_of("t = time} s")),
            (Parts{{"9:19 }", "a brace is not opened", "expected {name}, or }} for a brace"}}));
  EXPECT_NE(error_of("{time}}").find("scene.yaml:9:17: error: a brace is not opened\n"), string::npos);
  EXPECT_EQ(error_of("{time}}}"), "");
}

TEST(Caption, ThatBeginsWithABraceNeedsQuotes) {
  EXPECT_EQ(in_parts(errors_of(balls + "caption: {title}\n")),
            (Parts{{"9:10 {", "`caption` is a map of keys",
                    "expected true, false or a text\n"
                    "a text that begins with a brace needs quotes"}}));
  EXPECT_EQ(in_parts(errors_of(balls + "caption: {time} s of {collisions}\n")),
            (Parts{{"9:17 s", "text goes on after the closing bracket",
                    "a text that begins with a bracket or a brace needs quotes"}}));

  EXPECT_EQ(in_parts(errors_with(balls, "caption={time} s of {collisions}")),
            (Parts{{"--set:16 s", "text goes on after the closing bracket",
                    "a text that begins with a bracket or a brace needs quotes"}}));

  LoadOptions options;
  options.set = {"caption='{time} s of {collisions}'"};
  EXPECT_EQ(load_text(balls, options).overlay.caption, "{time} s of {collisions}");
}

TEST(Caption, FollowsPathsToForcesGroupsAndFilms) {
  const Scene scene = load_text(
      start +
      "forces: [{drag: {linear: 0.25}}]\noutput: {video: {fps: 24}, frames: {size: [64, 48]}}\n"
      "defaults: {ball: {radius: 0.1, mass: 3}}\n"
      "groups: {gas: {count: 2, in: {min: [0, 0, 0], max: [1, 1, 1]}, ball: {mass: 2}}}\n"
      "caption: '{forces.0.drag.linear} {groups.gas.ball.mass} {groups.gas.ball.radius} {groups.gas.in.max.x} "
      "{output.video.fps} {output.video.size.width}'\n");
  EXPECT_EQ(scene.overlay.caption, "0.25 2 0.1 1 24 64");
}

TEST(Trails, HaveDefaultsAndNames) {
  const Scene usual = load_text(balls + "trails: true\n");
  ASSERT_TRUE(usual.overlay.trails);
  EXPECT_EQ(usual.overlay.trails->seconds, 1);
  EXPECT_FALSE(usual.overlay.trails->width);
  EXPECT_TRUE(usual.overlay.trails->on.empty());
  EXPECT_FALSE(load_text(balls + "trails: false\n").overlay.trails);
  const Scene own = load_text(balls + "trails: {seconds: 0.25, width: 0.02, on: [blue]}\n");
  EXPECT_EQ(own.overlay.trails->seconds, 0.25);
  EXPECT_EQ(own.overlay.trails->width, 0.02);
  EXPECT_EQ(own.overlay.trails->on, vector<Entity>{1});
  EXPECT_NE(errors_of(balls + "trails: {on: [blu]}\n").find("nothing is named `blu`"), string::npos);
  EXPECT_NE(errors_of(balls + "trails: {on: [blu]}\n").find("did you mean `blue`?"), string::npos);
}

TEST(Trails, ThatWouldCoverThePictureAreRefused) {
  EXPECT_EQ(in_parts(errors_of(balls + "trails: {width: 1e9}\n")),
            (Parts{{"9:17 1e9", "trails of 1e+09 m are more than 1000 times as wide as the largest radius, 0.1 m",
                    "expected less: such a trail covers the picture"}}));
  EXPECT_EQ(errors_of(balls + "trails: {width: 100}\n"), "");
}

TEST(Arrows, AreOfVelocityAndForce) {
  const Scene both = load_text(balls + "arrows: [force, velocity]\n");
  EXPECT_TRUE(both.overlay.velocity_arrows && both.overlay.force_arrows);
  EXPECT_FALSE(load_text(balls + "arrows: [force]\n").overlay.velocity_arrows);
  const Scene momentum = load_text(balls + "arrows: [momentum]\n");
  EXPECT_TRUE(momentum.overlay.momentum_arrows && !momentum.overlay.velocity_arrows);
  EXPECT_NE(errors_of(balls + "arrows: [forces]\n").find("did you mean `force`?"), string::npos);
}

TEST(Names, InAListAreDistinct) {
  EXPECT_EQ(in_parts(errors_of(balls + "arrows: [velocity, velocity]\n")),
            (Parts{{"9:20 velocity", "`arrows` has `velocity` twice", "remove one of them"}}));
  EXPECT_NE(errors_of(balls + "trails: {on: [red, blue, red]}\n").find("`on` has `red` twice\n"), string::npos);
  EXPECT_NE(errors_of(balls + "forces: [{uniform: [1, 0, 0], on: [red, red]}]\n").find("`on` has `red` twice\n"),
            string::npos);
}

TEST(Shutter, IsAPartOfTheInterval) {
  EXPECT_EQ(load_text(balls + "shutter: 0.5\n").overlay.shutter, 0.5);
  EXPECT_EQ(load_text(balls).overlay.shutter, 0);
  EXPECT_NE(errors_of(balls + "shutter: 1.5\n").find("expected a number from 0 to 1"), string::npos);
}

TEST(Background, MayBeNoneInPicturesAlone) {
  const Scene none = load_text(balls + "background: none\noutput: {frames: true, sheet: true}\n");
  EXPECT_TRUE(none.background.transparent && !none.background.color);
  EXPECT_FALSE(load_text(balls + "background: white\n").background.transparent);
  EXPECT_EQ(in_parts(errors_of(balls + "background: none\noutput: {video: true}\n")),
            (Parts{{"10:17 true", "an MP4 has no transparency, and `background` is `none`",
                    "expected a `file` ending in .gif or .webp, `frames` or `sheet`, or a colour for `background`"}}));
  EXPECT_TRUE(load_text(none.resolved).background.transparent);
  EXPECT_EQ(errors_of(balls + "background: none\noutput: {video: {file: a.webp}}\n"), "");
}

TEST(Background, ThatIsNoColourMayBeMeantAsNone) {
  const auto remedy = [](const string& background) {
    const string errors = errors_of(balls + "background: " + background + "\n");
    const size_t from = errors.find("     = ");
    return from == string::npos ? errors : errors.substr(from + 7);
  };
  const string all = "expected none or a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1\n";
  for (const char* none : {"nine", "None", "transparent"}) EXPECT_EQ(remedy(none), "did you mean `none`?\n");
  EXPECT_EQ(remedy("bleu"), "did you mean `blue`?\n");
  for (const char* wrong : {"true", "false", "perhaps", "[]", "[1]", "[1, 1, 1, 1]", "{r: 1}"})
    EXPECT_EQ(remedy(wrong), all);
  EXPECT_EQ(remedy(""), all + "     = a colour that begins with # needs quotes\n");
  EXPECT_EQ(remedy("[1, 1, 2]"), "expected a number from 0 to 1\n");
}

TEST(Colours, OfAWrongNumberOfNumbersNeedThree) {
  EXPECT_EQ(in_parts(errors_of(balls + "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0], color: [1]}}\n")),
            (Parts{{"9:62 [", "`color` has 1 number",
                    "expected a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1"}}));
}

TEST(ColourBy, StandsWhereverAColourOfBodiesGoes) {
  const string by = "color: {by: speed, max: 9, map: cividis}";
  const Scene scene =
      load_text(start + "defaults: {ball: {mass: 1, radius: 0.1, " + by + "}}\n" +
                "balls: {red: {position: [0, 0, 0]}, gold: {position: [1, 0, 0], color: gold}}\n" +
                "bodies: {box: {mass: 1, box: [1, 1, 1], position: [5, 0, 0], " + by + "}}\n" +
                "groups: {gas: {count: 1, in: {min: [-5, 0, 0], max: [-4, 1, 1]}, ball: {" + by + "}}}\n");

  const Coloring expected{ColorQuantity::speed, nullopt, 9, ColorMap::cividis};
  EXPECT_EQ(scene.roster.bodies[0].coloring, expected);
  EXPECT_FALSE(scene.roster.bodies[1].coloring);
  EXPECT_EQ(scene.roster.bodies[1].color, parse_color("gold"));
  EXPECT_EQ(scene.roster.bodies[2].coloring, expected);
  EXPECT_EQ(scene.roster.bodies[3].coloring, expected);

  const Scene again = load_text(scene.resolved);
  EXPECT_EQ(again.roster.bodies[3].coloring, expected);
  EXPECT_EQ(again.resolved, scene.resolved);
}

TEST(ColourBy, IsSetInParts) {
  LoadOptions options;
  options.set = {"balls.red.color={by: mass}", "balls.red.color.map=magma", "balls.blue.color.by=group"};
  const Scene scene = load_text(balls, options);
  EXPECT_EQ(scene.roster.bodies[0].coloring->map, ColorMap::magma);
  EXPECT_EQ(scene.roster.bodies[1].coloring->by, ColorQuantity::group);
}

TEST(ColourBy, RefusesWrongQuantitiesMapsAndScales) {
  const auto errors = [](const string& coloring) {
    return errors_of(balls + "bodies: {box: {mass: 1, box: [1, 1, 1], position: [9, 0, 0], color: {" + coloring +
                     "}}}\n");
  };
  EXPECT_NE(errors("by: sped").find("did you mean `speed`?"), string::npos);
  EXPECT_NE(errors("map: magma").find("`color` has no `by`"), string::npos);
  EXPECT_NE(errors("by: mass, map: jet").find("expected viridis, cividis, magma, plasma or inferno"), string::npos);
  EXPECT_NE(errors("by: speed, min: 5, max: 3").find("the scale of colours ends at 3, and starts at 5\n"),
            string::npos);
  EXPECT_NE(errors("by: collisions, min: 50").find("expected min < max, both given"), string::npos);
  EXPECT_NE(errors("by: group, max: 3").find("`max` has no meaning for groups"), string::npos);
  EXPECT_EQ(errors("by: speed, min: -5, max: 3"), "");
}

ColorScale scale(const string& coloring, const string& more = "") {
  const Scene scene = load_text("scene: 1\nsimulate: {duration: 2}\ndefaults: {ball: {mass: 2, radius: 0.1, color: {" +
                                coloring + "}}}\n" + more);
  return scale_of(scene, *scene.roster.bodies[0].coloring);
}

TEST(ColourScale, OfSpeedEndsWithTheFastestStartOrFallRoundedUp) {
  const string still = "gravity: [0, 0, 0]\n", ball = "balls: {a: {position: [0, 2, 0], velocity: [3, 0, 0]";
  EXPECT_EQ(scale("by: speed", still + ball + "}}\n").max, 3);
  // 20 N s on 2 kg, across.
  EXPECT_EQ(scale("by: speed", still + ball + ", impulse: [0, 20, 0]}}\n").max, 12);  // sqrt(109) = 10.4
  // 2 m above a plane: sqrt(9 + 2 g 2) = 6.95.
  EXPECT_EQ(scale("by: speed", ball + "}}\nplanes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n").max, 8);
  // Nothing below: 2 s of falling, |(3, -2 g, 0)| = 19.8.
  EXPECT_EQ(scale("by: speed", ball + "}}\n").max, 20);
  // A string of 1.5 m from 1 m above ends it 0.5 m below: sqrt(9 + g) = 4.34. One that is cut does not.
  EXPECT_EQ(scale("by: speed", ball + "}}\nstrings: {s: {from: [0, 3, 0], to: a, length: 1.5}}\n").max, 5);
  EXPECT_EQ(scale("by: speed", ball + "}}\nstrings: {s: {from: [0, 3, 0], to: a, length: 1.5, until: 1}}\n").max, 20);
  // An obstacle with its lower side 1 m below: sqrt(9 + 2 g) = 5.35.
  EXPECT_EQ(scale("by: speed", ball + "}}\nobstacles: {o: {radius: 0.5, position: [0, 1.5, 9]}}\n").max, 6);
  EXPECT_EQ(scale("by: kinetic", still + ball + "}}\n").max, 10);  // 9 J
  EXPECT_EQ(scale("by: speed, min: 1, max: 2.5", still + ball + "}}\n").min, 1);
}

TEST(ColourScale, OfMassAndRadiusIsThatOfTheBodies) {
  const string two = "balls: {a: {position: [0, 0, 0]}, b: {position: [1, 0, 0], mass: 5, radius: 0.3}}\n";
  EXPECT_EQ(scale("by: mass", two).min, 2);
  EXPECT_EQ(scale("by: mass", two).max, 5);
  EXPECT_EQ(scale("by: radius", two).max, 0.3);
  const ColorScale equal = scale("by: mass", "balls: {a: {position: [0, 0, 0]}}\n");
  EXPECT_EQ(equal.min, 0);
  EXPECT_EQ(equal.max, 2);
  EXPECT_EQ(scale("by: collisions", two).max, 10);
  EXPECT_EQ(scale("by: mass", "balls: {a: {position: [0, 0, 0], mass: 7}, b: {position: [1, 0, 0], mass: 45}}\n").max,
            45);
}

TEST(ColourScale, OfMassAndRadiusIsRoundedToTwoDigits) {
  // The ball around the box has the radius sqrt(0.2^2 + 0.3^2 + 0.2^2) / 2 = 0.206155.
  const ColorScale radius = scale("by: radius",
                                  "balls: {a: {position: [0, 0, 0]}}\nbodies: {b: {mass: 1, box: [0.2, 0.3, 0.2], "
                                  "position: [1, 0, 0], color: {by: radius}}}\n");
  EXPECT_EQ(radius.min, 0.1);
  EXPECT_EQ(radius.max, 0.21);
  const ColorScale mass =
      scale("by: mass", "balls: {a: {position: [0, 0, 0], mass: 0.00123}, b: {position: [1, 0, 0], mass: 98765}}\n");
  EXPECT_EQ(mass.min, 0.0012);
  EXPECT_EQ(mass.max, 99000);
}

TEST(ColourScale, IsRoundedUpToFewDigits) {
  EXPECT_EQ(rounded_up(1), 1);
  EXPECT_EQ(rounded_up(1.01), 1.2);
  EXPECT_EQ(rounded_up(9), 10);
  EXPECT_EQ(rounded_up(8.01), 10);
  EXPECT_DOUBLE_EQ(rounded_up(0.0021), 0.0025);
  EXPECT_DOUBLE_EQ(rounded_up(1e-9), 1e-9);
  EXPECT_EQ(rounded_up(0), 1);
}

TEST(Springs, ThatAreNotVisibleAreKnownByTheirNumber) {
  const Scene scene = load_text(balls +
                                "forces:\n  - {drag: {linear: 0}}\n  - {uniform: [1, 0, 0]}\n"
                                "  - {spring: {anchor: [0, 0, 0], stiffness: 1}, visible: false}\n");
  EXPECT_EQ(scene.overlay.hidden_springs, vector<size_t>{1});  // drag without effect is no force
  EXPECT_NE(errors_of(balls + "forces: [{uniform: [1, 0, 0], visible: false}]\n").find("`visible` but no `spring`"),
            string::npos);
}

TEST(Labels, AreAListOrAMapWithNames) {
  const Scene list = load_text(balls + "labels: [momentum, speed]\n");
  ASSERT_TRUE(list.overlay.labels);
  EXPECT_TRUE(list.overlay.labels->speed && list.overlay.labels->momentum && !list.overlay.labels->name);
  EXPECT_TRUE(list.overlay.labels->on.empty());

  const Scene some = load_text(balls + "labels: {show: [name], on: [blue]}\n");
  EXPECT_EQ(some.overlay.labels->on, vector<Entity>{1});
  EXPECT_EQ(some.overlay.labels->count(), 1);
  EXPECT_EQ(load_text(some.resolved).overlay.labels->on, vector<Entity>{1});
  EXPECT_FALSE(load_text(balls).overlay.labels || load_text(balls).overlay.scale_bar);
  EXPECT_TRUE(load_text(load_text(balls + "scale_bar: true\n").resolved).overlay.scale_bar);

  EXPECT_NE(errors_of(balls + "labels: [sped]\n").find("did you mean `speed`?"), string::npos);
  EXPECT_NE(errors_of(balls + "labels: {on: [red]}\n").find("show"), string::npos);
  EXPECT_NE(errors_of(balls + "labels: {show: [speed], on: [blu]}\n").find("did you mean `blue`?"), string::npos);
  EXPECT_NE(errors_of(balls + "labels: true\n").find("labels"), string::npos);
}

TEST(Labels, OfMoreBodiesThanAPictureHoldsAreRefused) {
  const string gas = "groups: {gas: {count: 50, in: {min: [5, 5, 5], max: [9, 9, 9]}, ball: {mass: 1, radius: 0.1}}}\n";
  const string errors = errors_of(balls + gas + "labels: [speed]\noutput: {frames: true}\n");
  EXPECT_NE(errors.find("labels of 52 bodies do not fit into a picture of 1280 x 720 pixels"), string::npos) << errors;
  EXPECT_NE(errors.find("expected at most 41 bodies, such as `labels: {show: [speed], on: [red]}`"), string::npos);
  EXPECT_EQ(errors_of(balls + gas + "labels: {show: [speed], on: [red, gas.3]}\n"), "");
}

}  // namespace
}  // namespace carom
