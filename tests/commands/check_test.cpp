// carom check, by the real program.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "commands/program.h"
#include "paths.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {
namespace {

using Json = nlohmann::json;

const string camera = "camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: 45}\n";

TEST(Check, ReportsWhatARunWouldDo) {
  const Workplace here;
  here.write("balls.yaml", two_balls("camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: 45}\n"
                                     "output: {trajectory: {every: 0.1}, frames: {fps: 4, size: [720, 720]}}\n"));
  const Finished check = here.carom({"check", "balls.yaml"});
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(check.err, "");

  EXPECT_EQ(check.out.substr(0, check.out.find(", about ")),
            "balls: Two balls\n"
            "  bodies      2 bodies: red and blue\n"
            "  fixed       0 planes, 0 walls\n"
            "  engine      exact (auto: every path of this scene has a closed form), 1 s of motion\n"
            "  first hit   red and blue at 0.445 s, at (0, 0, 0) m, closing at 4 m/s\n"
            "  camera      +x points to the left of the picture; fields of view 45 x 45 degrees\n"
            "  unseen      no body at time 0\n"
            "  in and out  no body enters or leaves the picture\n"
            "  to come     5 pictures, 22 trajectory rows");
  EXPECT_TRUE(check.out.ends_with("\n  folder      output/balls: new\n")) << check.out;
  EXPECT_FALSE(here.has("output"));
}

TEST(Check, ReportsTheSideOfPlusX) {
  const Workplace here;
  here.write("balls.yaml", two_balls(camera));
  const auto plus_x = [&](const string& eye) {
    const Finished check = here.carom({"check", "balls.yaml", "--json", "--set", "camera.eye=" + eye});
    return Json::parse(check.out).at("scenes").at(0).at("camera").at("plus_x").get<string>();
  };
  EXPECT_EQ(plus_x("[0, 3, -5]"), "left");
  EXPECT_EQ(plus_x("[0, 3, 5]"), "right");
  EXPECT_EQ(plus_x("[5, 0, 0]"), "toward");
  EXPECT_EQ(plus_x("[-5, 0, 0]"), "away");
}

TEST(Check, GivesBothFieldsOfView) {
  const Workplace here;
  here.write("balls.yaml", two_balls(camera));
  const Json view = Json::parse(here.carom({"check", "balls.yaml", "--json"}).out).at("scenes").at(0).at("camera");
  // Without a picture's size it is 1280 x 720: 2 atan(16/9 tan(22.5 degrees)).
  EXPECT_NEAR(view.at("fov_x_degrees").get<double>(), 72.73435141004906, 1e-12);
  EXPECT_NEAR(view.at("fov_y_degrees").get<double>(), 45, 1e-13);
}

// From 10 m away, with a square picture of 90 degrees, a ball is visible while |x| < 10 + sqrt(2) r.
const string passing_ball =
    "scene: 1\ngravity: [0, 0, 0]\n"
    "balls:\n"
    "  passing: {mass: 1, radius: 0.1, position: [-12, 0, 0], velocity: [10, 0, 0]}\n"
    "  still: {mass: 1, radius: 0.1, position: [0, 5, 0]}\n"
    "simulate: {duration: 3}\n"
    "camera: {eye: [0, 0, 10], target: [0, 0, 0], fov: 90}\n";

/// What `check` says of the camera.
Json camera_seen(const Workplace& here, const string& scene) {
  return Json::parse(here.carom({"check", scene, "--json"}).out).at("scenes").at(0).at("camera");
}

TEST(Check, ReportsWhenABodyEntersThePictureAndLeavesIt) {
  const Workplace here;
  here.write("passing.yaml", passing_ball + "output: {frames: {fps: 100, size: [64, 64]}}\n");
  const Json seen = camera_seen(here, "passing.yaml");
  EXPECT_EQ(seen.at("out_of_view_names"), Json({"passing"}));
  // In at (12 - 10.1414...) / 10 = 0.18585... s, out at 2.21414... s: found at the next picture.
  EXPECT_EQ(seen.at("crossings_listed"), Json({{{"time_s", 0.19}, {"body", "passing"}, {"enters", true}},
                                               {{"time_s", 2.22}, {"body", "passing"}, {"enters", false}}}));
  EXPECT_EQ(seen.at("watched_until_s"), 3);
  const string out = here.carom({"check", "passing.yaml"}).out;
  EXPECT_NE(out.find("  in and out  passing enters at 0.19 s; passing leaves at 2.22 s\n"), string::npos) << out;
}

TEST(Check, ChecksTheInstantsOfThePictures) {
  const Workplace here;
  here.write("passing.yaml", passing_ball + "output: {frames: {fps: 10, size: [64, 64], from: 1}}\n");
  const auto crossings = [&](const string& until) {
    const Finished check = here.carom({"check", "passing.yaml", "--json", "--set", "output.frames.until=" + until});
    return Json::parse(check.out).at("scenes").at(0).at("camera").at("crossings_listed");
  };
  EXPECT_EQ(crossings("2"), Json::array());
  EXPECT_EQ(crossings("3"), Json({{{"time_s", 2.3}, {"body", "passing"}, {"enters", false}}}));
}

TEST(Check, WatchesTheInstantsOfAllPictures) {
  const Workplace here;
  here.write("passing.yaml", passing_ball +
                                 "output: {frames: {fps: 10, size: [64, 64], from: 1, until: 1}, "
                                 "video: {fps: 100, size: [64, 64]}}\n");
  const Json seen = camera_seen(here, "passing.yaml");
  EXPECT_EQ(seen.at("crossings_listed"), Json({{{"time_s", 0.19}, {"body", "passing"}, {"enters", true}},
                                               {{"time_s", 2.22}, {"body", "passing"}, {"enters", false}}}));
  EXPECT_EQ(seen.at("watched_every_s"), 0.01);
}

TEST(Check, WhatIsGoneDoesNotLeaveThePicture) {
  const Workplace here;
  here.write("removed.yaml", passing_ball +
                                 "regions: {hole: {radius: 1, position: [0, 0, 0], action: remove}}\n"
                                 "output: {frames: {fps: 100, size: [64, 64]}}\n");
  const Json seen = camera_seen(here, "removed.yaml");
  EXPECT_EQ(seen.at("crossings_listed"), Json({{{"time_s", 0.19}, {"body", "passing"}, {"enters", true}}}));
}

TEST(Check, OfACameraThatMovesWatchesItsOwnPictures) {
  const Workplace here;
  here.write("passing.yaml", passing_ball + "output: {frames: {fps: 10, size: [64, 64]}}\n");
  const auto checked = [&](const string& set) {
    const Json all = Json::parse(
        here.carom({"check", "passing.yaml", "--json", "--set", "balls.passing.radius=0.3", "--set", set}).out);
    return all.at("scenes").at(0).at("camera");
  };
  const auto text = [&](const string& set) { return here.carom({"check", "passing.yaml", "--set", set}).out; };
  // The still ball comes into view beside the passing one, and leaves again.
  const Json follow = checked("camera={follow: passing, eye: [-12, 0, 9], fov: 60}");
  EXPECT_EQ(follow.at("kind"), "follow");
  EXPECT_EQ(follow.at("out_of_view_names"), Json({"still"}));
  EXPECT_EQ(follow.at("crossings_listed").size(), 2u);
  EXPECT_EQ(follow.at("crossings_listed").at(0).at("body"), "still");
  EXPECT_NE(text("camera={follow: passing}").find("  camera      follows passing; +x points"), string::npos);

  const Json fit = checked("camera={fit: motion}");
  EXPECT_EQ(fit.at("kind"), "fit");
  EXPECT_EQ(fit.at("out_of_view"), 0);
  EXPECT_EQ(fit.at("crossings"), 0);
  EXPECT_NE(text("camera.fit=motion").find("  camera      frames the motion; +x points"), string::npos);

  // It turns away from the passing ball.
  const string path =
      "camera={path: [{at: 0, eye: [-12, 0, 9], target: [-12, 0, 0]}, {at: 1, eye: [-12, 0, 9], target: [-30, 0, 0]}]}";
  EXPECT_EQ(checked(path).at("kind"), "path");
  EXPECT_EQ(checked(path).at("out_of_view_names"), Json({"still"}));
  EXPECT_EQ(checked(path).at("crossings_listed").at(0).at("body"), "passing");
  EXPECT_NE(text(path).find("  camera      2 keyframes; +x points"), string::npos);
}

/// A ball that passes behind a post between 1.4 s and 1.6 s, as seen from (0, 0, 9).
const string behind_a_post =
    "scene: 1\ngravity: [0, 0, 0]\n"
    "balls: {ball: {mass: 1, radius: 0.1, position: [-1.5, 0, 0], velocity: [1, 0, 0]}}\n"
    "obstacles: {post: {box: [0.2, 3, 0.2], position: [0, 0, 1]}}\n"
    "simulate: {duration: 3}\n"
    "output: {frames: {fps: 10, size: [64, 64]}}\n";

TEST(Check, SaysWhatIsHiddenWhenAndBehindWhat) {
  const Workplace here;
  here.write("post.yaml", behind_a_post + "camera: {eye: [0, 0, 9], target: [0, 0, 0]}\n");
  const Json seen = camera_seen(here, "post.yaml");
  EXPECT_EQ(seen.at("hidings"), 1);
  const Json& hiding = seen.at("hidings_listed").at(0);
  EXPECT_EQ(hiding.at("body"), "ball");
  EXPECT_EQ(hiding.at("behind"), "post");
  EXPECT_NEAR(hiding.at("from_s").get<double>(), 1.5, 0.11);
  EXPECT_LE(hiding.at("from_s"), hiding.at("until_s"));
  EXPECT_NE(here.carom({"check", "post.yaml"}).out.find("  hidden      ball is behind post "), string::npos);

  // Glass hides nothing.
  EXPECT_NE(
      here.carom({"check", "post.yaml", "--set", "obstacles.post.finish=glass"}).out.find("no body in the picture"),
      string::npos);
}

TEST(Check, OfACameraThatFramesTheMotionNothingIsHidden) {
  const Workplace here;
  here.write("post.yaml", behind_a_post);
  const Json seen = camera_seen(here, "post.yaml");
  EXPECT_EQ(seen.at("hidings"), 0);
  EXPECT_EQ(seen.at("kind"), "fit");
  EXPECT_NE(here.carom({"check", "post.yaml"}).out.find("  hidden      no body in the picture"), string::npos);
}

TEST(Check, NamesTheKindOfCamera) {
  const Workplace here;
  here.write("post.yaml", behind_a_post);
  const auto text = [&](const string& camera) {
    return here.carom({"check", "post.yaml", "--set", "camera=" + camera}).out;
  };
  EXPECT_NE(text("{fit: {on: [ball]}, orbit: {period: 9}}").find("  camera      frames ball; goes round in 9 s; +x"),
            string::npos);
  EXPECT_NE(text("{eye: [0, 0, 9], target: [0, 0, 0], fov: 90, projection: orthographic}")
                .find("parallel projection of 18 x 18 m"),
            string::npos);
}

TEST(Check, ReportsBytesAndSecondsToCome) {
  const Workplace here;
  here.write("passing.yaml", passing_ball + "output: {frames: {fps: 10, size: [640, 360]}}\n");
  const auto seconds = [&](const string& set) {
    const Finished check = here.carom({"check", "passing.yaml", "--json", "--set", set});
    return Json::parse(check.out).at("scenes").at(0).at("seconds").get<double>();
  };
  const double few = seconds("output.frames.fps=10"), many = seconds("output.frames.fps=1000");
  EXPECT_GT(few, 0);
  EXPECT_GT(many, 20 * few);  // 3001 pictures beside 31
  const string out = here.carom({"check", "passing.yaml", "--set", "output.frames.fps=1000"}).out;
  EXPECT_NE(out.find(" and roughly "), string::npos) << out;
}

// Films of few bodies have 50 times fewer bytes than pictures. A constant for all films was 20 times too large.
TEST(Check, BytesAreThoseThatARunWrites) {
  const Workplace here;
  const auto holds = [&](const string& scene, const string& output) {
    const vector<string> words = {SCENES_DIR "/" + scene + ".yaml", "-o", scene, "--set", "output=" + output};
    vector<string> check = {"check", "--json"}, run = {"run", "-q", "--force"};
    check.insert(check.end(), words.begin(), words.end());
    run.insert(run.end(), words.begin(), words.end());
    const double expected = Json::parse(here.carom(check).out).at("scenes").at(0).at("bytes").get<double>();
    ASSERT_EQ(here.carom(run).code, 0);
    double written = 0;
    for (const auto& [name, bytes] : here.files(scene)) written += static_cast<double>(bytes.size());
    EXPECT_GT(expected / written, 0.5) << scene << " " << output;
    EXPECT_LT(expected / written, 2) << scene << " " << output;
  };

  // Measured: 1.16, 0.92, 0.78, 0.92, 0.88.
  holds("two_bowling_balls", "{frames: {fps: 5, size: [720, 720]}, video: true}");
  holds("two_bowling_balls", "{video: {fps: 25, size: [640, 360], file: x.gif}}");
  holds("two_bowling_balls", "{video: {fps: 30, size: [640, 360], file: x.webp}}");
  holds("billiard_break", "{video: {fps: 30, size: [640, 360]}}");
  holds("billiard_break", "{sheet: true}");
}

// A hundred thousand collisions are not simulated to preview the camera.
TEST(Check, EndsItsTrialSoon) {
  const Workplace here;
  here.write("gas.yaml",
             "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [0, 0, 0], max: [2, 2, 2]}\n"
             "groups: {gas: {count: 3000, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: [2, 2, 2]}, "
             "arrange: lattice, speed: 5}}\n"
             "simulate: {duration: 1000}\ncamera: {eye: [9, 1, 1], target: [1, 1, 1]}\noutput: {frames: {fps: 5}}\n");
  const auto start = std::chrono::steady_clock::now();
  const Json scene = Json::parse(here.carom({"check", "gas.yaml", "--json"}).out).at("scenes").at(0);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);  // measured: 0.3 s
  EXPECT_LT(scene.at("camera").at("watched_until_s"), 1000);
  EXPECT_NE(scene.at("first_collision"), nullptr);
  EXPECT_GT(scene.at("seconds"), 100);
}

TEST(Check, DoesNotGuessAtAMotionThatTakesLong) {
  const Workplace here;
  here.write("gas.yaml",
             "scene: 1\ngravity: [0, 0, 0]\nroom: {min: [0, 0, 0], max: [2, 2, 2]}\n"
             "groups: {gas: {count: 3000, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: [2, 2, 2]}, "
             "arrange: lattice, speed: 5}}\nsimulate: {duration: 1000}\noutput: {frames: {fps: 5}}\n");
  const Json seen = Json::parse(here.carom({"check", "gas.yaml", "--json"}).out).at("scenes").at(0).at("camera");
  EXPECT_EQ(seen.at("out_of_view"), nullptr);
  EXPECT_EQ(seen.at("plus_x"), "right");
  EXPECT_NE(here.carom({"check", "gas.yaml"})
                .out.find("  unseen      not known: the camera frames the motion, which takes longer to simulate\n"),
            string::npos);
}

TEST(Check, ReportsWhatWouldStopARun) {
  const Workplace here;
  here.write("bouncing.yaml",
             "scene: 1\nballs: {red: {mass: 1, radius: 0.1, position: [0, 1, 0], restitution: 0.9}}\n"
             "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
             "simulate: {duration: 9, max_collisions: 3}\n");
  const Finished check = here.carom({"check", "bouncing.yaml"}), run = here.carom({"run", "bouncing.yaml"});
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(run.code, 1);
  const size_t at = check.out.find("  trouble     a run would stop: ") + 32;
  const string why = check.out.substr(at, 20);
  EXPECT_NE(run.err.find(why), string::npos) << check.out << run.err;
}

TEST(Check, NamesWhatOverlapsAndHowDeep) {
  const Workplace here;
  here.write("deep.yaml",
             "scene: 1\nballs:\n  red: {mass: 1, radius: 1, position: [0, 0, 0]}\n"
             "  blue: {mass: 1, radius: 1, position: [1.5, 0, 0]}\nsimulate: {duration: 1}\n");
  const Finished check = here.carom({"check", "deep.yaml"});
  EXPECT_EQ(check.code, 2);
  EXPECT_NE(check.err.find("`blue` overlaps `red` by 0.5 m at the start"), string::npos) << check.err;
}

TEST(Check, NamesAtMostTenBodiesOutOfView) {
  const Workplace here;
  here.write(
      "behind.yaml",
      "scene: 1\ngroups: {gas: {count: 30, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 10], max: [2, 2, 12]}, "
      "arrange: lattice}}\n"
      "simulate: {duration: 1}\ncamera: {eye: [0, 0, 5], target: [0, 0, 0]}\n");

  const string out = here.carom({"check", "behind.yaml"}).out;
  EXPECT_NE(out.find("  bodies      30 bodies: gas (30)\n"), string::npos) << out;
  EXPECT_NE(
      out.find("  unseen      gas.0, gas.1, gas.2, gas.3, gas.4, gas.5, gas.6, gas.7, gas.8, gas.9 and 20 more at\n"
               "              time 0\n"),
      string::npos)
      << out;
}

TEST(Check, NamesSizesAndMassesThatMakeARunSlow) {
  const Workplace here;
  const string scene =
      "scene: 1\nballs:\n  bob: {mass: 1, radius: 1e-9, position: [1, 0, 0]}\n"
      "  joint: {mass: 1e-12, radius: 0.01, position: [0.5, 0, 0]}\n"
      "strings:\n  s: {from: [0, 0, 0], to: joint}\n  t: {from: joint, to: bob}\nsimulate: {duration: 1e-6}\n";
  here.write("chain.yaml", scene);

  const Finished check = here.carom({"check", "chain.yaml"});
  EXPECT_NE(check.out.find("  slow        the radius of bob is 2e-09 of the length of its string"), string::npos)
      << check.out;
  EXPECT_NE(check.out.find("the mass of joint is 1e-12 of the heaviest"), string::npos) << check.out;

  const Json json = Json::parse(here.carom({"check", "chain.yaml", "--json"}).out);
  EXPECT_TRUE(json.at("scenes").at(0).contains("slow"));

  const Finished fine =
      here.carom({"check", "chain.yaml", "--set", "balls.bob.radius=1e-6", "--set", "balls.joint.mass=1e-8"});
  EXPECT_EQ(fine.out.find("  slow "), string::npos) << fine.out;
}

TEST(Check, NamesABodyOfAnotherOrderOfSizeWithTheRemedy) {
  const Workplace here;
  here.write("part.obj", "v 0 0 0\nv 120 0 0\nv 0 120 0\nv 0 0 120\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  here.write("units.yaml",
             "scene: 1\nbodies:\n  part: {mass: 1, mesh: part.obj, fit: box, position: [0, 200, 0]}\n"
             "balls:\n  row: {repeat: 3, mass: 1, radius: 0.05, position: [= i, 0, 0]}\n"
             "  red: {mass: 1, radius: 0.06, position: [0, 3, 0]}\n"
             "simulate: {duration: 0.1}\n");

  const Finished check = here.carom({"check", "units.yaml"});
  EXPECT_NE(
      check.out.find("  size        part is 1,732 times larger than the rest: `mesh: {file: part.obj, scale: 0.001}` "
                     "makes\n              it 1,000 times smaller\n"),
      string::npos)
      << check.out;
  const Json json = Json::parse(here.carom({"check", "units.yaml", "--json"}).out);
  EXPECT_EQ(json.at("scenes").at(0).at("odd_sizes").size(), 1u);

  const Finished fine = here.carom({"check", "units.yaml", "--set", "bodies.part.mesh={file: part.obj, scale: 0.001}"});
  EXPECT_EQ(fine.code, 0) << fine.err;
  EXPECT_EQ(fine.out.find("  size "), string::npos) << fine.out;
  const Finished small = here.carom({"check", "units.yaml", "--set", "balls.red.radius=1e-5", "--set",
                                     "bodies.part.mesh={file: part.obj, scale: 0.001}"});
  EXPECT_NE(small.out.find("  size        red is 5,000 times smaller than the rest: lengths are in m\n"), string::npos)
      << small.out;
}

// No body ever meets another one, and a second of motion takes a minute.
TEST(Check, EndsItsSearchForACollisionAndEstimatesTheRun) {
  const Workplace here;
  here.write("bob.yaml",
             "scene: 1\nballs: {bob: {mass: 1, radius: 1e-9, position: [1, 0, 0]}}\n"
             "strings: {s: {from: [0, 0, 0], to: bob}}\nsimulate: {duration: 200}\n");
  const Finished check = here.carom({"check", "bob.yaml"});
  EXPECT_EQ(check.code, 0);
  EXPECT_NE(check.out.find("  first hit   not known: there is none until "), string::npos) << check.out;
  EXPECT_NE(check.out.find(" and roughly "), string::npos) << check.out;
}

TEST(Check, ReportsThatThereIsNoCollision) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished check = here.carom({"check", "balls.yaml", "--set", "simulate.duration=0.4"});
  EXPECT_NE(check.out.find("  first hit   none within 0.4 s\n"), string::npos) << check.out;
  const Finished json = here.carom({"check", "balls.yaml", "--json", "--set", "simulate.duration=0.4"});
  EXPECT_EQ(Json::parse(json.out).at("scenes").at(0).at("first_collision"), nullptr);
}

TEST(Check, FirstCollisionIsTheOneThatTheRunWrites) {
  const Workplace here;
  here.write(
      "gas.yaml",
      "scene: 1\n"
      "groups: {gas: {count: 50, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [2, 2, 2]}, speed: 1}}\n"
      "room: {min: [0, 0, 0], max: [2, 2, 2]}\n"
      "simulate: {duration: 5}\noutput: {collisions: true}\n");

  const Json check = Json::parse(here.carom({"check", "gas.yaml", "--json"}).out).at("scenes").at(0);
  const Json run = Json::parse(here.carom({"run", "gas.yaml", "--json"}).out).at("scenes").at(0);
  EXPECT_EQ(check.at("first_collision").at("time_s"), run.at("summary").at("first_collision_s"));

  const string table = here.read("output/gas/collisions.csv");
  const string names = "," + check.at("first_collision").at("kind").get<string>() + "," +
                       check.at("first_collision").at("a").get<string>() + "," +
                       check.at("first_collision").at("b").get<string>() + ",";
  const size_t row = table.find('\n') + 1;
  EXPECT_NE(table.substr(row, table.find('\n', row) - row).find(names), string::npos) << names;
}

TEST(Check, BookSceneGetsTheExactPrediction) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const Finished check = here.carom({"check", "balls.yaml", "--set", "simulate.engine=book"});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(
      check.out.find("  engine      book, 1 s of motion\n"
                     "  first hit   red and blue at 0.445 s, at (0, 0, 0) m, closing at 4 m/s (exact; the book engine\n"
                     "              detects it in a later frame)\n"),
      string::npos)
      << check.out;
}

TEST(Check, ReportsTheStateOfTheFolder) {
  const Workplace here;
  here.write("balls.yaml", two_balls());
  const auto folder = [&](const vector<string>& more) {
    vector<string> words = {"check", "balls.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    const string out = here.carom(words).out;
    const size_t at = out.find("  folder ");
    return at == string::npos ? out : out.substr(at);
  };

  EXPECT_EQ(folder({}), "  folder      output/balls: new\n");
  here.carom({"run", "balls.yaml"});
  EXPECT_EQ(folder({}), "  folder      output/balls: up to date\n");
  EXPECT_EQ(folder({"--only", "energy"}), "  folder      output/balls: up to date\n");
  EXPECT_EQ(folder({"--only", "sheet"}),
            "  folder      output/balls: holds more outputs of this scene: run needs --force or another -o\n");
  EXPECT_EQ(folder({"--set", "seed=3"}),
            "  folder      output/balls: holds another run, or files that no run wrote: run needs --force or\n"
            "              another -o\n");
}

TEST(Check, ShowsAllErrorsOfAllFilesAndTheRightScenes) {
  const Workplace here;
  here.write("one.yaml", two_balls("outptu: {}\ncamera: {eye: 3, target: [0, 0, 0]}\n"));
  here.write("two.yaml", two_balls());
  here.write("three.yaml", "scene: 2\n");
  const Finished check = here.carom({"check", "one.yaml", "two.yaml", "three.yaml"});
  EXPECT_EQ(check.code, 2);
  EXPECT_TRUE(check.out.starts_with("two: Two balls\n")) << check.out;
  EXPECT_NE(check.err.find("one.yaml:8:1: error: "), string::npos) << check.err;
  EXPECT_NE(check.err.find("one.yaml:9:15: error: "), string::npos) << check.err;
  EXPECT_NE(check.err.find("three.yaml:1:8: error: "), string::npos) << check.err;
  EXPECT_NE(check.err.find(" errors in 2 of 3 scenes\n"), string::npos) << check.err;
}

TEST(Check, QuietShowsOnlyWhatIsWrong) {
  const Workplace here;
  here.write("two.yaml", two_balls());
  const Finished right = here.carom({"check", "two.yaml", "-q"});
  EXPECT_EQ(right.code, 0);
  EXPECT_EQ(right.out + right.err, "");
  const Finished wrong = here.carom({"check", "two.yaml", "missing.yaml", "-q"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.out, "");
  EXPECT_NE(wrong.err.find("missing.yaml"), string::npos);
}

TEST(Check, ScenesBeyondTheBudgetAreRefusedUnlessForced) {
  const Workplace here;
  here.write("big.yaml", two_balls("output: {frames: {fps: 1000000, size: [64, 36]}}\n"));
  EXPECT_EQ(here.carom({"check", "big.yaml"}).code, 2);
  const Finished forced = here.carom({"check", "big.yaml", "--force"});
  EXPECT_EQ(forced.code, 0) << forced.err;
  EXPECT_NE(forced.out.find("1,000,001 pictures"), string::npos) << forced.out;
}

TEST(Check, ReportsVolumesObstaclesAndForces) {
  const Workplace here;
  here.write("things.yaml",
             "scene: 1\n"
             "balls: {red: {mass: 1, radius: 0.1, position: [0, 3, 0]}}\n"
             "bodies:\n"
             "  crate: {mass: 1, box: [1, 2, 3], position: [9, 1, 0]}\n"
             "  can: {mass: 1, cylinder: {radius: 0.25, height: 2}, position: [5, 1, 0]}\n"
             "obstacles: {post: {radius: 0.5, position: [-9, 1, 0]}}\n"
             "forces: [{uniform: [1, 0, 0], until: 1}]\n"
             "simulate: {duration: 0}\n");

  const Finished check = here.carom({"check", "things.yaml"});
  EXPECT_EQ(check.err, "");
  EXPECT_NE(check.out.find(
                "  bodies      3 bodies: red, crate and can\n"
                "  fixed       0 planes, 0 walls, 1 obstacle\n"
                "  volumes     crate a box of 1 x 2 x 3 m; can a cylinder of radius 0.25 m and height 2 m; post a\n"
                "              sphere of radius 0.5 m\n"
                "  forces      1 force in addition to gravity\n"),
            string::npos)
      << check.out;

  const string json = here.carom({"check", "things.yaml", "--json"}).out;
  EXPECT_NE(json.find("\"obstacles\": 1"), string::npos) << json;
  EXPECT_NE(json.find("\"crate\": {\n          \"box\": [\n            1.0,"), string::npos) << json;
}

}  // namespace
}  // namespace carom::testing
