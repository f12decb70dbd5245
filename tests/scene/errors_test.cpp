// Complete texts of errors, as printed.
#include <fmt/format.h>

#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

TEST(SceneErrors, MisspeltKeyNamesTheNearOne) {
  EXPECT_EQ(
      errors_of("scene: 1\nballs:\n  red: {mass: 10, raduis: 0.11, position: [0, 0, 0]}\nsimulate: {duration: 1}\n"),
      "scene.yaml:3:19: error: unknown key `raduis` in ball `red`\n"
      "   3 |   red: {mass: 10, raduis: 0.11, position: [0, 0, 0]}\n"
      "     |                   ^~~~~~\n"
      "     = did you mean `radius`?\n");
}

TEST(SceneErrors, KeyOfAnotherPlaceNamesWhereItBelongs) {
  EXPECT_EQ(
      errors_of("scene: 1\nsimulate: {duration: 1, far: 3}\n"),
      "scene.yaml:2:25: error: unknown key `far` in `simulate`\n"
      "   2 | simulate: {duration: 1, far: 3}\n"
      "     |                         ^~~\n"
      "     = `far` is a key of `camera`\n"
      "     = expected duration, stop, engine, step, as_printed, rest_speed, max_collisions, integrator, contact or "
      "tolerance\n");
}

TEST(SceneErrors, WrongTypeNamesTheExpectedOne) {
  EXPECT_EQ(
      in_parts(errors_of("scene: 1\nballs:\n  red: {mass: [1], radius: big, position: 7}\nsimulate: {duration: 1}\n")),
      (Parts{{"3:15 [", "`mass` is a list", "expected a number above 0 in kg"},
             {"3:28 big", "`big` is not a number", "expected a number above 0 in m"},
             {"3:43 7", "`position` is `7`", "expected [x, y, z], three numbers in m"}}));
}

TEST(SceneErrors, MissingValueStandsUnderTheThingThatLacksIt) {
  const string scene = "scene: 1\nballs:\n  red: {radius: 0.11}\n";
  EXPECT_EQ(in_parts(errors_of(scene + "simulate: {duration: }\n")),
            (Parts{{"3:3 red", "ball `red` has no `mass` and no `density`",
                    "expected `mass`: a number above 0 in kg\n"
                    "or `density`: a number above 0 in kg/m^3"},
                   {"3:3 red", "ball `red` has no `position`", "expected `position`: [x, y, z], three numbers in m"},
                   {"4:12 duration", "`duration` has no value", "expected a number of at least 0 in s"}}));

  // As it is printed: two errors of one line, the first with two remedies.
  EXPECT_EQ(errors_of(scene + "simulate: {duration: 1}\n"),
            "scene.yaml:3:3: error: ball `red` has no `mass` and no `density`\n"
            "   3 |   red: {radius: 0.11}\n"
            "     |   ^~~\n"
            "     = expected `mass`: a number above 0 in kg\n"
            "     = or `density`: a number above 0 in kg/m^3\n"
            "scene.yaml:3:3: error: ball `red` has no `position`\n"
            "   3 |   red: {radius: 0.11}\n"
            "     |   ^~~\n"
            "     = expected `position`: [x, y, z], three numbers in m\n");
}

TEST(SceneErrors, MissingColonIsReported) {
  EXPECT_EQ(in_parts(errors_of(
                "scene: 1\nballs:\n  red: {mass: 10, radius 0.1, position: [0, 0, 0]}\nsimulate: {duration: 1}\n")),
            (Parts{{"3:19 radius 0.1", "`radius 0.1` is a key without a value",
                    "did you mean `radius: 0.1`? A ':' and a space part key and value"}}));
}

TEST(SceneErrors, OverlapAtTheStartPointsAtTheLaterBall) {
  EXPECT_EQ(
      in_parts(errors_of("scene: 1\n"
                         "balls:\n"
                         "  red:  {mass: 1, radius: 0.5, position: [0, 0, 0]}\n"
                         "  blue: {mass: 1, radius: 0.5, position: [0.75, 0, 0]}\n"
                         "planes: {floor: {point: [0, -0.25, 0], normal: [0, 2, 0]}}\n"
                         "simulate: {duration: 1}\n")),
      (Parts{{"3:42 [", "`red` overlaps `floor` by 0.25 m at the start", "expected bodies apart, or just touching"},
             {"4:42 [", "`blue` overlaps `red` by 0.25 m at the start", "expected bodies apart, or just touching"},
             {"4:42 [", "`blue` overlaps `floor` by 0.25 m at the start", "expected bodies apart, or just touching"}}));
}

TEST(SceneErrors, MeshThatIsNotThereIsAnErrorOfItsOwn) {
  const string folder = test_folder();
  EXPECT_EQ(
      in_parts(errors_of("scene: 1\nballs:\n  pin: {mass: 1, radius: 1, position: [0, 0, 0], mesh: pin.stl}\nsimulate: "
                         "{duration: 1}\n")),
      (Parts{{"3:56 pin.stl", "there is no file `pin.stl`", "paths are relative to the folder of the scene"}}));
}

TEST(SceneErrors, MeshWhoseNameDiffersInCaseIsNamed) {
  write_file("", "Pin.STL");
  EXPECT_EQ(
      in_parts(errors_of("scene: 1\nballs:\n  pin: {mass: 1, radius: 1, position: [0, 0, 0], mesh: pin.stl}\nsimulate: "
                         "{duration: 1}\n")),
      (Parts{{"3:56 pin.stl", "there is no file `pin.stl`", "did you mean `Pin.STL`?"}}));
}

TEST(SceneErrors, DuplicateKeyHasTheLineOfTheFirst) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1}\nseed: 1\nseed: 2\n")),
            (Parts{{"4:1 seed", "`seed` is repeated", "it is in line 3 already"}}));
}

TEST(SceneErrors, MergeKeyAliasAnchorAndTagAreRefused) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nseed: &s 3\nsimulate: {<<: {a: 1}, duration: !!int 1, step: *s}\n")),
            (Parts{{"2:7 &s", "an anchor", "remove it: scenes have no anchors and aliases"},
                   {"3:12 <<", "`<<` merges maps in some YAML dialects, not in a scene",
                    "write the keys out, or use `defaults`"},
                   {"3:34 !!int", "a tag", "remove it: the key determines the type of its value"},
                   {"3:49 *s", "an alias", "expected the value itself: scenes have no anchors and aliases"}}));
}

TEST(SceneErrors, TabIsAnError) {
  EXPECT_EQ(errors_of("scene: 1\nsimulate:\n\tduration: 1\n"),
            "scene.yaml:3:1: error: a tab\n"
            "   3 |  duration: 1\n"
            "     | ^\n"
            "     = expected spaces: YAML does not allow tabs for indentation, and a scene has none at all\n");
}

TEST(SceneErrors, SecondDocumentIsAnError) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1}\n---\nscene: 1\n")),
            (Parts{{"3:1 -", "a second document begins here", "expected one scene a file"}}));
}

string duration_error(const string& value) {
  const Parts errors = in_parts(errors_of("scene: 1\nsimulate: {duration: " + value + "}\n"));
  EXPECT_EQ(errors.size(), 1u) << value;
  const auto& [marked, message, remedy] = errors.at(0);
  return message + " / " + remedy;
}

TEST(SceneErrors, EveryWayToMissANumberHasItsHint) {
  const string wanted = "expected a number of at least 0 in s";
  EXPECT_EQ(duration_error(".nan"), "`.nan` is not a finite number / " + wanted);
  EXPECT_EQ(duration_error("-.inf"), "`-.inf` is not a finite number / " + wanted);
  EXPECT_EQ(duration_error("2 s"), "`2 s` carries a unit / `duration` is always in s: write 2");
  EXPECT_EQ(duration_error("200ms"), "`200ms` carries a unit / `duration` is always in s: write the number alone");
  EXPECT_EQ(duration_error("'2'"), "`2` in quotes is text, not a number / without quotes: 2");
  EXPECT_EQ(duration_error("010"), "`010` has a leading zero / write 10");
  EXPECT_EQ(duration_error("-00.5"), "`-00.5` has a leading zero / write -0.5");
  EXPECT_EQ(duration_error("0x1F"), "`0x1F` is not a decimal number / " + wanted);
  EXPECT_EQ(duration_error("1_000"), "`1_000` is not a number / write 1000");

  // Beyond the range of doubles.
  EXPECT_EQ(duration_error("1e999"),
            "`1e999` is too large for a double / " + wanted + "; the largest is about 1.8e308");
  EXPECT_EQ(duration_error("1e-999"),
            "`1e-999` is too small for a double / " + wanted + "; the smallest is about 5e-324");

  EXPECT_EQ(duration_error("1/30"), "`1/30` is not a number / " + wanted);
  EXPECT_EQ(duration_error("two"), "`two` is not a number / " + wanted);
  EXPECT_EQ(duration_error("-1"), "`duration` is -1 / " + wanted);
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate:\n  duration: 1,5\n")),
            (Parts{{"3:13 1,5", "`1,5` has a comma", "the decimal point is a point: 1.5"}}));
}

TEST(SceneErrors, AStepIsGivenOrChosen) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1, engine: stepped, step: 1, tolerance: 2}\n")),
            (Parts{{"2:51 tolerance", "`simulate` has both `step` and `tolerance`", "remove one of them"}}));
}

TEST(SceneErrors, CaretStandsRightAfterCharactersOfSeveralBytesAndCells) {
  EXPECT_EQ(errors_of("scene: 1\ntitle: {\"\xC3\xA9\xE6\x97\xA5\xE6\x9C\xAC\": 1, b: }\nsimulate: {duration: x}\n"),
            "scene.yaml:2:8: error: `title` is a map of keys\n"
            "   2 | title: {\"\xC3\xA9\xE6\x97\xA5\xE6\x9C\xAC\": 1, b: }\n"
            "     |        ^\n"
            "     = expected a text\n"
            "scene.yaml:3:22: error: `x` is not a number\n"
            "   3 | simulate: {duration: x}\n"
            "     |                      ^\n"
            "     = expected a number of at least 0 in s\n");
  EXPECT_EQ(errors_of(start + "background: \"\xE6\x97\xA5\", sed: 1\n").substr(0, 16), "scene.yaml:3:16:");
  EXPECT_EQ(errors_of(start + "{\xE6\x97\xA5\xE6\x9C\xAC: 1}\n").substr(0, 15), "scene.yaml:3:1:");

  // Two characters of two cells each: 50 cells stand to the left of column 49.
  EXPECT_EQ(errors_of("{scene: 1, simulate: {duration: 1}, title: \xE6\x97\xA5\xE6\x9C\xAC\xC3\xA9, sed: 1}"),
            "scene.yaml:1:49: error: unknown key `sed` in the scene\n"
            "   1 | {scene: 1, simulate: {duration: 1}, title: \xE6\x97\xA5\xE6\x9C\xAC\xC3\xA9, sed: 1}\n"
            "     |                                                   ^~~\n"
            "     = did you mean `seed`?\n");
}

TEST(SceneErrors, LongLinesAreShownThroughAWindow) {
  const string many(300, 'x');
  EXPECT_EQ(errors_of(start + "title: {" + many + ": 1, b: *c, " + many + ": 2}\n"),
            "scene.yaml:3:317: error: an alias\n"
            "   3 | ..." +
                many.substr(0, 52) + ": 1, b: *c, " + many.substr(0, 36) + "...\n" + "     |    " + string(60, ' ') +
                "^\n"
                "     = expected the value itself: scenes have no anchors and aliases\n");
}

TEST(SceneErrors, AllErrorsOfAFileComeInItsOrder) {
  const string all = errors_of(
      "scene: 2\ntitel: x\nballs:\n  a: {mass: -1, radius: 1, position: [0, 0, 0]}\nsimulate: {duration: x}\n");
  const size_t first = all.find(":1:8: error: `scene` is 2"), second = all.find(":2:1: error: unknown key `titel`"),
               third = all.find(":4:13: error: `mass` is -1"), fourth = all.find(":5:22: error: `x` is not");
  EXPECT_TRUE(first < second && second < third && third < fourth && fourth != string::npos) << all;
}

TEST(SceneErrors, AtMostFiftyAreShown) {
  string text = start;
  for (int i = 0; i < 80; ++i) text += "unknown" + to_string(i) + "_key: 1\n";
  const string all = errors_of(text);
  EXPECT_TRUE(all.ends_with("and 30 more errors\n")) << all.substr(all.size() - 100);
}

TEST(SceneErrors, ManyOverlapsAreOneError) {
  // A packing of 27 balls whose distances a program rounded: 54 pairs overlap by 2e-7 of a radius, one by 1e-6 of it.
  string text = start + "defaults: {ball: {mass: 1, radius: 0.5}}\nballs:\n";
  for (int i = 0; i < 27; ++i)
    text += fmt::format("  p{}: {{position: [{:.7f}, {}, {}]}}\n", i, i % 3 * 0.9999999 - (i == 26 ? 4e-7 : 0),
                        i / 3 % 3 * 0.9999999, i / 9 * 0.9999999);

  EXPECT_EQ(errors_of(text),
            "scene.yaml:31:19: error: `p26` overlaps `p25` by 5e-07 m at the start, the deepest of 54 overlaps of 27 "
            "bodies\n"
            "  31 |   p26: {position: [1.9999994, 1.9999998, 1.9999998]}\n"
            "     |                   ^\n"
            "     = expected bodies apart, or just touching to 1e-09 of the smaller one\n"
            "     = radii smaller by 5e-07 of their size leave none\n");

  // With such radii the scene loads.
  text.replace(text.find("radius: 0.5"), 11, "radius: 0.49999975");
  EXPECT_EQ(errors_of(text), "");

  // Boxes have no radii. A heap in one place is counted, too.
  string boxes = start + "defaults: {body: {mass: 1, box: [1, 1, 1]}}\nbodies:\n";
  for (int i = 0; i < 6; ++i) boxes += fmt::format("  b{}: {{position: [{}, 0, 0]}}\n", i, i * 0.75);
  EXPECT_EQ(errors_of(boxes),
            "scene.yaml:6:18: error: `b1` overlaps `b0` by 0.25 m at the start, the deepest of 5 overlaps of 6 bodies\n"
            "   6 |   b1: {position: [0.75, 0, 0]}\n"
            "     |                  ^\n"
            "     = expected bodies apart, or just touching to 1e-09 of the smaller one\n");

  const string heap = errors_of(start + "balls: {b: {repeat: 100, mass: 1, radius: 1, position: [0, 0, 0]}}\n");
  EXPECT_NE(heap.find("`b.1` overlaps `b.0` by 2 m at the start, the deepest of 4950 overlaps of 100 bodies"),
            string::npos)
      << heap;
}

TEST(SceneErrors, ACharacterThatLooksLikeAnotherIsNamed) {
  EXPECT_EQ(errors_of("scene: 1\ngravity: [0, \u22129.81, 0]\nsimulate: {duration: 1}\n"),
            "scene.yaml:2:14: error: `\u22129.81` is not a number\n"
            "   2 | gravity: [0, \u22129.81, 0]\n"
            "     |              ^~~~~\n"
            "     = U+2212 is a minus sign: write `-`\n"
            "     = expected a number in m/s^2\n");

  const auto names = [](const string& text, const string& remedy) {
    const string errors = errors_of(text);
    EXPECT_NE(errors.find("     = " + remedy + "\n"), string::npos) << errors;
  };
  names(start + "gravity: [0, \u20139.81, 0]\n", "U+2013 is an en dash: write `-`");
  names(start + "gravity: [0, '= 3 \u2014 9.81', 0]\n", "U+2014 is an em dash: write `-`");
  names(start + "seed: 7\u00a0\n", "U+00A0 is a no-break space: write a plain space");
  names(start + "background: \u201cred\u201d\n", "U+201C is a curly quote: write `'`");
  names("scene: 1\nsimulate: {duration:\u202f1}\n", "U+202F is a narrow no-break space: write a plain space");

  // Where a text is right, the same characters are.
  EXPECT_EQ(errors_of(start + "title: 3\u00d72 balls \u2013 \u201cfast\u201d\n"), "");
}

TEST(SceneErrors, ANoBreakSpaceBetweenKeysIsThePlaceOfTheError) {
  EXPECT_EQ(errors_of("scene: 1\nsimulate:\n  duration:\u00a01\n  engine: exact\n"),
            "scene.yaml:3:12: error: this is no space to YAML\n"
            "   3 |   duration:\u00a01\n"
            "     |            ^\n"
            "     = U+00A0 is a no-break space: write a plain space\n");
  EXPECT_EQ(errors_of("scene: 1\nsimulate:\n\u00a0\u00a0engine: exact\n  duration: 1\n"),
            "scene.yaml:3:1: error: this is no space to YAML\n"
            "   3 | \u00a0\u00a0engine: exact\n"
            "     | ^\n"
            "     = U+00A0 is a no-break space: write a plain space\n");
}

TEST(SceneErrors, TheKeyThatIsProposedHasAPlainSpace) {
  EXPECT_EQ(errors_of("scene: 1\nsimulate: {duration:\u00a01}\n"),
            "scene.yaml:2:12: error: `duration:\u00a01` is a key without a value\n"
            "   2 | simulate: {duration:\u00a01}\n"
            "     |            ^~~~~~~~~~~\n"
            "     = U+00A0 is a no-break space: write a plain space\n"
            "     = did you mean `duration: 1`? A ':' and a space part key and value\n");
}

TEST(SceneErrors, AColourAfterANumberSignInBracketsNeedsQuotes) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nballs:\n  a: {mass: 1, color: #ff0000, radius: 1, position: [0, 0, 0]}\n"
                               "simulate: {duration: 1}\n")),
            (Parts{{"3:23 #ff0000", "`#ff0000` begins a comment, which hides the rest of the line",
                    "a colour that begins with # needs quotes: '#ff0000'"}}));
  EXPECT_NE(errors_of(start + "lights: {ambient: #333}\n").find("needs quotes: '#333'"), string::npos);
  // A comment in brackets is right.
  EXPECT_EQ(errors_of(start + "gravity: [0, # down\n  -9, 0]\n"), "");
  EXPECT_NE(errors_of(start + "balls: {a: {mass: 1} # heavy\n").find("this `{` is never closed"), string::npos);
}

TEST(SceneErrors, MassZeroPointsToFixedThings) {
  EXPECT_EQ(in_parts(errors_of(start + "balls:\n  a: {mass: 0, radius: 1, position: [0, 0, 0]}\n")),
            (Parts{{"4:13 0", "`mass` is 0",
                    "expected a number above 0 in kg\n"
                    "what no impact moves has no mass: it stands in `obstacles`, `planes` or `walls`"}}));
  for (const char* keys : {"density: 0.0", "mass: .inf", "mass: inf"})
    EXPECT_NE(errors_of(start + "bodies: {a: {box: [1, 1, 1], position: [0, 0, 0], " + keys + "}}\n").find("obstacles"),
              string::npos)
        << keys;
  EXPECT_EQ(errors_of(start + "balls: {a: {mass: -1, radius: 1, position: [0, 0, 0]}}\n").find("obstacles"),
            string::npos);
}

TEST(SceneErrors, ADecimalCommaIsOneError) {
  EXPECT_EQ(in_parts(errors_of(
                "scene: 1\nballs:\n  a: {mass: 1,5, radius: 1, position: [0, 0, 0]}\nsimulate: {duration: 1}\n")),
            (Parts{{"3:13 1,5", "`1,5` has a comma", "the decimal point is a point: 1.5"}}));
  EXPECT_NE(errors_of("scene: 1\nsimulate: {duration: -0,25e-3}\n").find("is a point: -0.25e-3"), string::npos);
  EXPECT_NE(errors_of("scene: 1\nsimulate: {duration: 1, 5}\n").find("unknown key `5`"), string::npos);
}

TEST(SceneErrors, WhatStandsInPlaceOfAListShowsTheList) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1, stop: rest}\n")),
            (Parts{{"2:31 rest", "`stop` is `rest`",
                    "expected a list of maps, or rest\n"
                    "a list of one is [rest]"}}));
  EXPECT_NE(errors_of(start + "arrows: velocity\n").find("a list of one is [velocity]"), string::npos);
  EXPECT_NE(errors_of(start + "trails: {on: red}\n").find("a list of one is [red]"), string::npos);
  EXPECT_NE(errors_of(start + "forces: {drag: {linear: 1}}\n").find("a list of one map is [{...}]"), string::npos);
  EXPECT_EQ(errors_of("scene: 1\nsimulate: {duration: 1, stop: never}\n").find("a list of one"), string::npos);
}

TEST(SceneErrors, AWordThatIsAbsentOnPurposeAnswersAsExplainDoes) {
  EXPECT_EQ(in_parts(errors_of(start + "planes:\n  floor: {point: [0, 0, 0], normal: [0, 1, 0], friction: 0.3}\n")),
            (Parts{{"4:48 friction", "unknown key `friction` in plane `floor`",
                    "There is none: contact forces are perpendicular to the surfaces, so bodies slide freely. Drag "
                    "slows bodies down everywhere; restitution takes energy at impacts.\n"
                    "see carom explain drag, carom explain restitution"}}));
  for (const char* key : {"dt", "time_step", "hinges", "periodic"})
    EXPECT_NE(errors_of(start + key + ": 1\n").find("see carom explain"), string::npos) << key;
}

TEST(SceneErrors, ANameThatIsNotThereIsAnsweredByThoseThatAre) {
  EXPECT_EQ(errors_of(start + "balls:\n  red: {mass: 1, radius: 1, position: [0, 0, 0]}\n"
                              "  row: {repeat: 3, mass: 1, radius: 1, position: [= 5 * i + 5, 0, 0]}\n"
                              "trails: {on: [cue]}\n"),
            "scene.yaml:6:15: error: nothing is named `cue`\n"
            "   6 | trails: {on: [cue]}\n"
            "     |               ^~~\n"
            "     = expected a ball, body, group or member (gas.3)\n"
            "     = there are `red` and `row`\n");

  EXPECT_EQ(errors_with(start + "balls: {red: {mass: 1, radius: 1, position: [0, 0, 0]}}\n", "balls.cue.mass=2"),
            "--set balls.cue.mass=2: error: there is no ball `cue`\n"
            "     | balls.cue.mass=2\n"
            "     |       ^~~\n"
            "     = there is `red`\n"
            "     = --set changes existing entries and adds none\n");
}

TEST(SceneErrors, ColourOnlyWhereRequested) {
  LoadOptions options;
  options.color = true;
  EXPECT_EQ(errors_of("scene: 1\nsimulate: {duration: x}\n").find('\x1b'), string::npos);
  EXPECT_NE(errors_of("scene: 1\nsimulate: {duration: x}\n", options).find("\x1b[1;31merror:\x1b[0m"), string::npos);
}

TEST(SceneErrors, SyntaxErrorsPointAtTheCause) {
  EXPECT_EQ(in_parts(errors_of("scene: 1\nballs: {a: {mass: 1\nsimulate: {duration: 1}\n")),
            (Parts{{"2:12 {", "this `{` is never closed", "expected `}` before the next key"}}));
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate:\n  duration 2\n  engine: exact\n")),
            (Parts{{"3:3 duration 2", "this line has no ':'", "expected `key: value`"}}));

  EXPECT_EQ(in_parts(errors_of("scene: 1\ntitle: Bowling: two balls\nsimulate: {duration: 1}\n")),
            (Parts{{"2:15 :", "a second ':' in this line",
                    "expected one `key: value` a line; text that holds ': ' needs quotes"}}));
  EXPECT_EQ(in_parts(errors_of("scene: 1\ntitle: \"no end\nsimulate: {duration: 1}\n")),
            (Parts{{"2:8 \"", "this `\"` is never closed", "expected `\"` before the next key"}}));

  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1 step: 2}\n")),
            (Parts{{"2:28 :", "a value ends and something else follows",
                    "expected ',' or the closing bracket; is a ',' missing?"}}));
}

}  // namespace
}  // namespace carom
