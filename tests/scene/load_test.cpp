// The meaning of scene files.

#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string page_example = R"(# yaml-language-server: $schema=scene.schema.json
scene: 1                                  # kind of file and format version
title: Two bowling balls meet near the origin
gravity: [0, 0, 0]                        # m/s^2; default [0, -9.80665, 0]
restitution: {combine: average}           # how two bodies' coefficients make the pair's
defaults:
  ball: {mass: 10, radius: 0.11, restitution: 0.9}
balls:
  red:  {position: [-1, 0,  0.025], velocity: [ 2, 0, 0], color: crimson}
  blue: {position: [ 1, 0, -0.025], velocity: [-2, 0, 0], color: royalblue}
planes:
  lane: {point: [0, -0.11, 0], normal: [0, 1, 0], color: tan}
simulate: {duration: 2, engine: exact}
camera: {eye: [0, 3, -5], target: [0, 0, 0], fov: 45}
output:
  trajectory: {every: 0.01}
  collisions: true
  energy: {every: 0.01}
  frames: {fps: 30, size: [1280, 720]}
  video: true
)";

TEST(LoadScene, FormatPageExampleIsReadWhole) {
  const Scene scene = load_text(page_example);
  EXPECT_EQ(scene.title, "Two bowling balls meet near the origin");
  EXPECT_EQ(scene.seed, 0u);
  EXPECT_EQ(scene.world.gravity, Vec3(0, 0, 0));
  EXPECT_EQ(scene.world.mass, (vector<double>{10, 10}));
  EXPECT_EQ(scene.world.radius, (vector<double>{0.11, 0.11}));
  EXPECT_EQ(scene.world.restitution, (vector<double>{0.9, 0.9}));
  EXPECT_TRUE(scene.world.impulse.empty());
  EXPECT_EQ(scene.initial.position[0], Vec3(-1, 0, 0.025));
  EXPECT_EQ(scene.initial.velocity[1], Vec3(-2, 0, 0));
  EXPECT_EQ(scene.world.planes.size(), 1u);
  EXPECT_FALSE(scene.world.planes[0].restitution);

  EXPECT_EQ(scene.roster.name(0), "red");
  EXPECT_EQ(scene.roster.name(1), "blue");
  EXPECT_EQ(scene.roster.name(2), "lane");
  EXPECT_EQ(scene.roster.bodies[0].color.r, 220 / 255.0);  // crimson is #dc143c

  EXPECT_EQ(scene.simulate.engine, Engine::exact);
  EXPECT_EQ(scene.simulate.duration, 2);
  ASSERT_TRUE(scene.camera);
  EXPECT_EQ(scene.camera->eye, Vec3(0, 3, -5));
  ASSERT_TRUE(scene.output.trajectory && scene.output.energy && scene.output.frames && scene.output.video);
  EXPECT_EQ(scene.output.trajectory->every, 0.01);
  EXPECT_TRUE(scene.output.collisions);
  EXPECT_EQ(scene.output.video->size.width, 1280);
  EXPECT_FALSE(scene.output.sheet);
}

TEST(LoadScene, WithoutOutputThereAreTablesAndNoPictures) {
  const Scene scene = load_text(start);
  ASSERT_TRUE(scene.output.trajectory && scene.output.energy);
  EXPECT_EQ(scene.output.trajectory->every, 1.0 / 30);
  EXPECT_EQ(scene.output.energy->every, 1.0 / 30);
  EXPECT_TRUE(scene.output.collisions);
  EXPECT_FALSE(scene.output.pictures());
}

TEST(LoadScene, WithOutputThereIsOnlyWhatItNames) {
  const Scene scene = load_text(start + "output: {energy: true, frames: false}\n");
  EXPECT_TRUE(scene.output.energy);
  EXPECT_FALSE(scene.output.trajectory || scene.output.collisions || scene.output.pictures());
}

TEST(LoadScene, VideoTakesRateSizeAndSamplesFromFramesAndNoWindow) {
  const Scene scene = load_text(
      start + "output: {frames: {fps: 24, size: [320, 200], samples: 8, from: 0.2, until: 0.5}, video: {fps: 12}}\n");
  EXPECT_EQ(scene.output.video->fps, 12);
  EXPECT_EQ(scene.output.video->size.width, 320);
  EXPECT_EQ(scene.output.video->samples, 8);
  EXPECT_EQ(scene.output.video->from, 0);
  EXPECT_EQ(scene.output.video->until, nullopt);
}

TEST(LoadScene, SizesHaveNames) {
  for (const auto& [name, size] : vector<pair<string, Size>>{{"720p", {1280, 720}},
                                                             {"1080p", {1920, 1080}},
                                                             {"4k", {3840, 2160}},
                                                             {"square", {1080, 1080}},
                                                             {"\"4k\"", {3840, 2160}}}) {
    const Scene scene =
        load_text(start + "output: {frames: {size: " + name + "}, video: true, sheet: {size: " + name + "}}\n");
    EXPECT_EQ(scene.output.frames->size, size) << name;
    EXPECT_EQ(scene.output.video->size, size) << name;
    EXPECT_EQ(scene.output.sheet->size, size) << name;
  }

  EXPECT_EQ(load_text(start + "output: {sheet: true}\n").output.sheet->size, nullopt);
  EXPECT_EQ(
      in_parts(errors_of(start + "output: {frames: {size: 1080}}\n")),
      (Parts{
          {"3:25 1080", "`size` is `1080`",
           "did you mean `1080p`?\n"
           "expected [width, height], two whole numbers from 16 to 16384 in pixels, or 720p, 1080p, 4k or square"}}));
}

TEST(LoadScene, ASheetThatCannotBeMadeNeedsAnotherSize) {
  EXPECT_EQ(in_parts(errors_of(start + "output: {sheet: {size: [64, 64]}}\n")),
            (Parts{{"3:24 [", "a contact sheet of 4 x 3 pictures in 64 x 64 pixels: each would have 6 x 10",
                    "expected a `size` of at least [168, 128], or fewer columns or rows"}}));
  EXPECT_EQ(errors_of(start + "output: {sheet: {size: [168, 128]}}\n"), "");
  EXPECT_EQ(in_parts(errors_of(start + "output: {frames: {size: [16, 16384]}, sheet: true}\n")),
            (Parts{{"3:46 true", "a contact sheet of 4 x 3 pictures would have 1920 x 1443872 pixels",
                    "expected a `size` of the sheet, such as [1920, 1080]: without one, its pictures have the shape of "
                    "16 x 16384"}}));

  EXPECT_EQ(errors_of(start + "output: {frames: {size: [16, 16384]}, sheet: {size: [1920, 1080]}}\n"), "");
  EXPECT_NE(errors_of(start + "output: {sheet: {size: [16384, 16384]}}\n").find("at most 100000000 pixels in all"),
            string::npos);
}

TEST(LoadScene, TheEndOfAFilmsNameIsItsFormat) {
  EXPECT_EQ(
      in_parts(errors_of(start + "output: {video: {file: x.avi}}\n")),
      (Parts{{"3:24 x.avi", "`x.avi` is not a name for a video",
              "expected a plain file name that ends in .mp4, .gif or .webp, such as animation.mp4, without folders"}}));
  for (const char* file : {"x.mp4", "x.gif", "x.webp"})
    EXPECT_EQ(load_text(start + "output: {video: {file: " + file + "}}\n").output.video->file, file);
}

TEST(LoadScene, AGifHasARateThatItCanKeep) {
  EXPECT_EQ(load_text(start + "output: {video: {file: x.gif}}\n").output.video->fps, 25);
  EXPECT_EQ(load_text(start + "output: {video: {file: x.mp4}}\n").output.video->fps, 30);

  for (const char* fps : {"50", "25", "20", "12.5", "10", "33.333333333333336", "1", "0.01"})
    EXPECT_EQ(errors_of(start + "output: {video: {file: x.gif, fps: " + fps + "}}\n"), "") << fps;
  for (const char* fps : {"100", "60", "30", "24", "29.97", "33.3"})
    EXPECT_NE(errors_of(start + "output: {video: {file: x.gif, fps: " + fps + "}}\n").find("a GIF cannot show"),
              string::npos)
        << fps;

  EXPECT_EQ(in_parts(errors_of(start + "output: {video: {file: x.gif, fps: 30}}\n")),
            (Parts{{"3:36 30", "a GIF cannot show 30 pictures a second",
                    "expected 50, 25, 20, 12.5, 10 or another 100/n: a GIF shows each picture for whole hundredths of "
                    "a second, at least 2"}}));

  for (const string fps : {"foo", "100/3"}) {
    const string errors = errors_of(start + "output: {video: {file: x.gif, fps: " + fps + "}}\n");
    EXPECT_NE(errors.find("error: `" + fps + "` "), string::npos);
    EXPECT_EQ(errors.find("a GIF cannot show"), string::npos);
  }
}

TEST(LoadScene, AGifWithoutARateOfItsOwnHasTheHighestUpToThatOfFrames) {
  for (const auto& [frames, film] : {pair{30, 25.}, {60, 50.}, {25, 25.}, {24, 20.}, {1000, 50.}, {12, 100. / 9}}) {
    const Scene scene = load_text(start + "output: {frames: {fps: " + to_string(frames) + "}, video: {file: x.gif}}\n");
    EXPECT_EQ(scene.output.video->fps, film);
    EXPECT_EQ(scene.output.frames->fps, frames);
    EXPECT_EQ(load_text(scene.resolved).output.video->fps, film);
  }
}

TEST(LoadScene, ASettingThatMakesAGifOfAFilmWithARateNamesTheOtherSetting) {
  const string text = start + "output: {video: {fps: 30}}\n", file = "output.video.file=x.gif";
  EXPECT_EQ(in_parts(errors_with(text, file)),
            (Parts{{"3:23 30", "a GIF cannot show 30 pictures a second",
                    "expected --set output.video.fps=25, or another 100/n: a GIF shows each picture for whole "
                    "hundredths of a second, at least 2"}}));
  LoadOptions options;
  options.set = {file, "output.video.fps=25"};
  EXPECT_EQ(errors_of(text, options), "");
}

TEST(LoadScene, AFilmHasASizeAndARateThatItsFormatCanHold) {
  const auto error = [](const string& video) { return errors_of(start + "output: {video: {" + video + "}}\n"); };
  EXPECT_EQ(in_parts(error("size: [16384, 16384]")), (Parts{{"3:24 [", "an MP4 of 16384 x 16384 pixels",
                                                             "expected fewer pixels, such as [16384, 16128]: ffmpeg "
                                                             "takes (width + 128) x (height + 128) up to 268435455"}}));
  EXPECT_EQ(error("size: [16384, 16128]"), "");
  EXPECT_NE(error("size: [16384, 16130]"), "");

  EXPECT_EQ(in_parts(error("file: x.webp, size: [16384, 1024]")),
            (Parts{{"3:38 [", "a WebP of 16384 x 1024 pixels",
                    "expected at most 16382 pixels a side, the limit of this format, or a `file` ending in .mp4"}}));
  EXPECT_EQ(error("file: x.webp, size: [16382, 1024]"), "");
  EXPECT_EQ(in_parts(error("file: x.webp, fps: 1001")),
            (Parts{{"3:37 1001", "a WebP of 1001 pictures a second",
                    "expected a number from 0.00006 to 1000: a WebP shows a picture for 1 to 16777215 thousandths of a "
                    "second"}}));
  EXPECT_EQ(error("file: x.webp, fps: 1000"), "");
  EXPECT_EQ(error("file: x.webp, fps: 6e-5"), "");

  EXPECT_EQ(in_parts(error("fps: 1e-9")), (Parts{{"3:23 1e-9", "an MP4 of 1e-09 pictures a second",
                                                  "expected a number from 0.00001 to 1000000: an MP4 shows a picture "
                                                  "for a millionth of a second to 100000 s"}}));
  EXPECT_EQ(error("fps: 1e-5"), "");
}

TEST(LoadScene, FramesAndVideoTakeRateSizeAndSamplesFromEachOther) {
  const Output film =
      load_text(start + "output: {video: {fps: 60, size: [64, 64], samples: 8, from: 0.5}, frames: {samples: 2}}\n")
          .output;
  EXPECT_EQ(*film.frames, (FramesOutput{60, {64, 64}, 2, 0, {}}));
  const Output frames = load_text(start + "output: {frames: {fps: 60, until: 0.5}, video: {size: [64, 64]}}\n").output;
  EXPECT_EQ(*frames.frames, (FramesOutput{60, {64, 64}, 4, 0, 0.5}));
  EXPECT_EQ(frames.video->fps, 60);
  EXPECT_EQ(frames.video->until, nullopt);
  EXPECT_EQ(load_text(start + "output: {frames: true, video: {file: x.gif}}\n").output.frames->fps, 25);
  EXPECT_EQ(load_text(start + "output: {frames: true}\n").output.frames->fps, 30);
}

TEST(LoadScene, DensityMakesTheMass) {
  // A steel ball: 7850 kg/m^3, 2 cm across. 4/3 pi r^3 rho = 0.0328820...
  const Scene scene = load_text(start + "balls: {a: {density: 7850, radius: 0.01, position: [0, 0, 0]}}\n");
  EXPECT_NEAR(scene.world.mass[0], 7850 * 4 / 3.0 * M_PI * 1e-6, 1e-17);
}

TEST(LoadScene, OwnDensityHidesTheDefaultMassAndTheOtherWayRound) {
  const Scene scene = load_text(
      start +
      "defaults: {ball: {mass: 5, radius: 1}}\n"
      "balls: {a: {density: 3, position: [0, 0, 0]}, b: {position: [3, 0, 0]}, c: {radius: 2, position: [9, 0, 0]}}\n");
  EXPECT_DOUBLE_EQ(scene.world.mass[0], 4 * M_PI);
  EXPECT_EQ(scene.world.mass[1], 5);
  EXPECT_EQ(scene.world.radius[2], 2);
  EXPECT_NE(errors_of(start + "balls: {a: {mass: 1, density: 3, radius: 1, position: [0, 0, 0]}}\n")
                .find("ball `a` has both `mass` and `density`"),
            string::npos);
}

TEST(LoadScene, BodiesStandInTheOrderOfTheFile) {
  const Scene scene = load_text(start +
                                "defaults: {ball: {mass: 1, radius: 0.1}}\n"
                                "groups: {gas: {count: 3, ball: {}, in: {min: [5, 5, 5], max: [6, 6, 6]}}}\n"
                                "balls: {a: {position: [0, 0, 0]}}\n");
  EXPECT_EQ(scene.world.body_count(), 4u);
  EXPECT_EQ(scene.roster.name(0), "gas.0");
  EXPECT_EQ(scene.roster.name(2), "gas.2");
  EXPECT_EQ(scene.roster.name(3), "a");
  EXPECT_EQ(scene.roster.range_of(1).name, "gas");
  EXPECT_EQ(scene.roster.range_of(3).name, "a");
}

TEST(LoadScene, EmptyGroupsNameNoBody) {
  const Scene scene = load_text(start +
                                "defaults: {ball: {mass: 1, radius: 0.1}}\n"
                                "groups: {none: {count: 0, ball: {}, in: {min: [5, 5, 5], max: [6, 6, 6]}}, one: "
                                "{count: 1, ball: {}, in: {min: [5, 5, 5], max: [6, 6, 6]}}}\n");
  EXPECT_EQ(scene.world.body_count(), 1u);
  EXPECT_EQ(scene.roster.name(0), "one.0");
}

TEST(LoadScene, RoomMakesSixInwardPlanesAmongThePlanesInFileOrder) {
  const string room = "room: {min: [-1, -2, -3], max: [1, 2, 3], restitution: 0.5}\n";
  const string planes = "planes: {floor: {point: [0, -9, 0], normal: [0, 3, 0]}}\n";
  const string walls = "walls: {net: {center: [0, 0, 0], normal: [1, 0, 0], size: [2, 1]}}\n";
  const Scene scene = load_text(start + walls + room + planes);
  const char* names[] = {"room.x_min", "room.x_max", "room.y_min", "room.y_max",
                         "room.z_min", "room.z_max", "floor",      "net"};

  ASSERT_EQ(scene.roster.fixed.size(), 8u);
  for (Entity i = 0; i < 8; ++i) EXPECT_EQ(scene.roster.name(i), names[i]);
  EXPECT_EQ(scene.world.planes[2].normal, Vec3(0, 1, 0));
  EXPECT_EQ(scene.world.planes[2].point.y(), -2);
  EXPECT_EQ(scene.world.planes[5].normal, Vec3(0, 0, -1));
  EXPECT_EQ(scene.world.planes[5].point.z(), 3);
  EXPECT_EQ(scene.world.planes[5].restitution, 0.5);
  EXPECT_EQ(scene.world.planes[6].normal, Vec3(0, 1, 0));
  EXPECT_EQ(load_text(start + planes + room).roster.name(0), "floor");
}

TEST(LoadScene, WallFramesAreRightHanded) {
  const Scene scene = load_text(start +
                                "walls:\n"
                                "  upright: {center: [0, 0, 0], normal: [0, 0, 2], size: [2, 1]}\n"
                                "  level: {center: [0, 0, 0], normal: [0, 1, 0], size: [2, 1]}\n"
                                "  tilted: {center: [0, 0, 0], normal: [1, 1, 0.5], size: [2, 1], up: [0.3, 1, 0]}\n");

  EXPECT_EQ(scene.world.walls[0].up, Vec3(0, 1, 0));
  EXPECT_EQ(scene.world.walls[0].right, Vec3(1, 0, 0));
  EXPECT_EQ(scene.world.walls[0].half_width, 1);
  EXPECT_EQ(scene.world.walls[0].half_height, 0.5);
  EXPECT_EQ(scene.world.walls[1].up, Vec3(0, 0, 1));

  for (const Wall& wall : scene.world.walls) {
    EXPECT_LT((wall.right.cross(wall.up) - wall.normal).norm(), 3e-16);  // measured: 1.2e-16
    EXPECT_LT(std::fabs(wall.up.dot(wall.normal)), 3e-16);
    EXPECT_NEAR(wall.up.norm(), 1, 3e-16);
  }

  EXPECT_NE(errors_of(start + "walls: {a: {center: [0, 0, 0], normal: [0, 1, 0], size: [1, 1], up: [0, -2, 0]}}\n")
                .find("up is parallel to the normal"),
            string::npos);
}

TEST(LoadScene, NormalsOfAnyLengthBecomeUnit) {
  const Scene scene = load_text(start +
                                "planes: {a: {point: [0, 0, 0], normal: [3e-200, 4e-200, 0]}, b: {point: [0, 0, 0], "
                                "normal: [3e200, 0, 4e200]}}\n");
  EXPECT_LT((scene.world.planes[0].normal - Vec3(0.6, 0.8, 0)).norm(), 2e-16);
  EXPECT_LT((scene.world.planes[1].normal - Vec3(0.6, 0, 0.8)).norm(), 2e-16);
  EXPECT_NE(errors_of(start + "planes: {a: {point: [0, 0, 0], normal: [0, 0, -0.0]}}\n").find("`normal` has no length"),
            string::npos);
}

TEST(LoadScene, PairsNameBodiesGroupsMembersAndFixedThings) {
  const string things = start +
                        "defaults: {ball: {mass: 1, radius: 0.1}}\n"
                        "balls: {a: {position: [0, 0, 0]}}\n"
                        "groups: {gas: {count: 5, ball: {}, in: {min: [5, 5, 5], max: [6, 6, 6]}}}\n"
                        "room: {min: [-9, -9, -9], max: [9, 9, 9]}\n";

  const Scene scene =
      load_text(things +
                "restitution: {default: 0.8, combine: mass_weighted, pairs: [{between: [a, gas], value: 0.1}, "
                "{between: [gas.3, room.y_min], value: 2}, {between: [gas, room], value: 0}]}\n");
  EXPECT_EQ(scene.world.combine, Combine::mass_weighted);
  EXPECT_EQ(scene.world.restitution[4], 0.8);
  ASSERT_EQ(scene.world.pairs.size(), 3u);
  EXPECT_EQ(scene.world.pairs[0].b_first, 1u);
  EXPECT_EQ(scene.world.pairs[0].b_count, 5u);
  EXPECT_EQ(scene.world.pairs[1].a_first, 4u);
  EXPECT_EQ(scene.world.pairs[1].a_count, 1u);
  EXPECT_EQ(scene.world.pairs[1].b_first, 8u);
  EXPECT_EQ(scene.world.pairs[2].b_first, 6u);
  EXPECT_EQ(scene.world.pairs[2].b_count, 6u);

  // none: they pass through each other.
  const Scene passing = load_text(things + "restitution: {pairs: [{between: [a, room], value: none}]}\n");
  EXPECT_FALSE(passing.world.pairs.front().value);

  // Names that are not there, and things that never meet.
  const string wrong = errors_of(things +
                                 "restitution: {pairs: [{between: [a, gsa], value: 1}, {between: [gas.5, room], "
                                 "value: 1}, {between: [room, room], value: 1}, {between: [a, a], value: 1}]}\n");
  EXPECT_NE(wrong.find("nothing is named `gsa`"), string::npos);
  EXPECT_NE(wrong.find("did you mean `gas`?"), string::npos);
  EXPECT_NE(wrong.find("expected gas.0 to gas.4"), string::npos);
  EXPECT_NE(wrong.find("`room` and `room` are fixed things, which never meet"), string::npos);
  EXPECT_NE(wrong.find("`a` does not meet itself"), string::npos);
}

TEST(LoadScene, NamesAreUniqueAcrossKinds) {
  const string ball = "balls: {room: {mass: 1, radius: 1, position: [0, 0, 0]}}\n";
  EXPECT_EQ(errors_of(start + ball), "");
  EXPECT_NE(errors_of(start + ball + "room: {min: [-2, -2, -2], max: [2, 2, 2]}\n")
                .find(":4:1: error: the name `room` is taken"),
            string::npos);
  EXPECT_NE(errors_of(start + ball + "planes: {room: {point: [-5, 0, 0], normal: [1, 0, 0]}}\n")
                .find(":4:10: error: the name `room` is taken"),
            string::npos);
}

TEST(LoadScene, ImpulsesAreKeptOnlyIfThereAreAny) {
  const Scene scene = load_text(start +
                                "balls: {a: {mass: 1, radius: 1, position: [0, 0, 0]}, b: {mass: 1, radius: 1, "
                                "position: [3, 0, 0], impulse: [0, 2, 0]}}\n");
  ASSERT_EQ(scene.world.impulse.size(), 2u);
  EXPECT_EQ(scene.world.impulse[0], Vec3(0, 0, 0));
  EXPECT_EQ(scene.world.impulse[1], Vec3(0, 2, 0));
}

TEST(LoadScene, BookHasItsStep) {
  EXPECT_EQ(load_text("scene: 1\nsimulate: {duration: 1, engine: book, as_printed: true}\n").simulate.step, 1.0 / 60);
  EXPECT_FALSE(load_text(start).simulate.step);
  EXPECT_NE(
      errors_of("scene: 1\nsimulate: {duration: 1, as_printed: true}\n").find("`as_printed` needs `engine: book`"),
      string::npos);
}

TEST(LoadScene, ColoursComeByNameHexAndNumbers) {
  const Scene scene = load_text(start +
                                "background: '#08f'\nlights: {sun: {direction: [0, -1, 0], color: [1, 0.5, 0]}, lamp: "
                                "{position: [0, 3, 0], color: RebeccaPurple}, ambient: '#102030'}\n");
  EXPECT_EQ(scene.background.color->g, 0x88 / 255.0);
  EXPECT_EQ(scene.background.color->b, 1);
  EXPECT_EQ(scene.lights[0].color.g, 0.5);
  EXPECT_FALSE(scene.lights[0].position);
  EXPECT_EQ(scene.lights[1].color.r, 0x66 / 255.0);
  EXPECT_EQ(scene.ambient->b, 0x30 / 255.0);
}

TEST(LoadScene, TouchingByRoundingIsNoOverlap) {
  // 0.1 + 0.2 > 0.3 in doubles; a cradle's balls at multiples of 0.2 m with radius 0.1.
  string text = start + "defaults: {ball: {mass: 1, radius: 0.1}}\nballs:\n";
  for (int i = 0; i < 9; ++i)
    text += "  b" + to_string(i) + ": {position: [" + to_string(i * 2 / 10) + "." + to_string(i * 2 % 10) +
            ", 0.1, 1000.3]}\n";
  EXPECT_EQ(errors_of(text + "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"), "");
  EXPECT_NE(errors_of(start + "balls: {a: {mass: 1, radius: 0.1, position: [0, 0, 0]}, b: {mass: 1, radius: 0.1, "
                              "position: [0.199999999, 0, 0]}}\n")
                .find("`b` overlaps `a` by 1e-09 m"),
            string::npos);
}

TEST(LoadScene, OverlapsAreFoundBetweenVeryUnequalBalls) {
  string text = start + "balls:\n  big: {mass: 1, radius: 1000, position: [0, 0, 0]}\n";
  EXPECT_EQ(errors_of(text + "  dust: {mass: 1, radius: 1e-6, position: [1000.000001, 0, 0]}\n"), "");
  EXPECT_NE(errors_of(text + "  dust: {mass: 1, radius: 1e-6, position: [0, 999.999, 0]}\n")
                .find("`dust` overlaps `big` by 0.001001 m"),
            string::npos);
}

TEST(LoadScene, BallsBehindAPlaneAndInAWallAreRefused) {
  const string ball = "balls: {a: {mass: 1, radius: 0.5, position: [0, 0, 0]}}\n";
  EXPECT_NE(errors_of(start + ball + "planes: {floor: {point: [0, 3, 0], normal: [0, 1, 0]}}\n")
                .find("`a` is behind `floor` at the start"),
            string::npos);
  EXPECT_NE(errors_of(start + ball + "walls: {w: {center: [0, 0, 0.4], normal: [0, 0, 1], size: [1, 1]}}\n")
                .find("`a` overlaps `w` by 0.1 m"),
            string::npos);
  EXPECT_EQ(errors_of(start + ball + "walls: {w: {center: [0, 2, 0], normal: [0, 0, 1], size: [1, 1]}}\n"), "");
}

TEST(LoadScene, BudgetIsCheckedBeforeAnythingIsMade) {
  const string gas =
      "groups: {gas: {count: 1e12, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [1, 1, 1]}}}\n";
  EXPECT_EQ(in_parts(errors_of(start + gas)),
            (Parts{{"3:23 1e12", "the scene has more than 4000000000 bodies; the limit is 2000000",
                    "expected a smaller `count`, or --force if this machine has the memory"}}));
  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1e6}\noutput: {frames: {fps: 60}}\n")),
            (Parts{{"3:24 60", "the run would write 60000001 pictures; the limit is 100000",
                    "expected a lower `fps` or a shorter duration, or --force to allow it"}}));

  EXPECT_EQ(in_parts(errors_of("scene: 1\nsimulate: {duration: 1e6}\nballs: {a: {mass: 1, radius: 1, position: [0, 0, "
                               "0]}}\noutput: {trajectory: {every: 1e-3}}\n")),
            (Parts{{"4:30 1e-3", "the run would write 1000000001 rows of trajectory.csv; the limit is 200000000",
                    "expected a longer `every`, a shorter duration or fewer bodies, or --force to allow it"}}));

  LoadOptions force;
  force.budget.enforced = false;
  EXPECT_EQ(errors_of("scene: 1\nsimulate: {duration: 1e6}\noutput: {frames: {fps: 60}}\n", force), "");
  EXPECT_NE(errors_of(start + gas, force).find("the limit is 4000000000"), string::npos);
}

TEST(LoadScene, TheBudgetOfPicturesFollowsTheSpeedOfTheFilm) {
  // 1 s of motion: 101 pictures a second of film, slowed down a thousandfold.
  EXPECT_EQ(errors_of(start + "output: {video: {fps: 100, speed: 0.001001}}\n"), "");
  EXPECT_NE(errors_of(start + "output: {video: {fps: 100, speed: 0.001}}\n").find("would write 100001 pictures"),
            string::npos);
  EXPECT_EQ(errors_of(start + "output: {video: {fps: 1e6, speed: 100}}\n"), "");
}

TEST(LoadScene, PicturesHaveLimits) {
  EXPECT_NE(errors_of(start + "output: {video: {size: [17, 20]}}\n").find("an even whole number from 16 to 16384"),
            string::npos);
  EXPECT_NE(errors_of(start + "output: {frames: {size: [17, 20]}, video: true}\n").find("an even width and height"),
            string::npos);
  EXPECT_NE(errors_of(start + "output: {frames: {size: [8, 20000]}}\n").find("from 16 to 16384"), string::npos);
  EXPECT_NE(errors_of(start + "output: {frames: {samples: 3}}\n").find("expected 1, 2, 4 or 8"), string::npos);

  // Of windows, of the speed and of rows.
  EXPECT_NE(errors_of(start + "output: {frames: {from: 2}}\n").find("`from` is 2 but the scene ends at 1 s"),
            string::npos);
  EXPECT_NE(errors_of(start + "output: {sheet: {from: 2}}\n").find("`from` is 2 but the scene ends at 1 s"),
            string::npos);
  EXPECT_NE(errors_of(start + "output: {sheet: {from: 0.5, until: 0.25}}\n").find("`until` is 0.25 but `from` is 0.5"),
            string::npos);
  EXPECT_NE(errors_of(start + "output: {video: {speed: 0}}\n").find("`speed` is 0"), string::npos);
  EXPECT_NE(errors_of(start + "output: {sheet: {rows: 0}}\n").find("`rows` is 0"), string::npos);

  for (const char* file : {"../x.mp4", ".mp4", "-x.mp4", ".x.mp4", "x.avi", "a/b.mp4", "\"\"", "\"a\\nb.mp4\""}) {
    EXPECT_NE(errors_of(start + "output: {video: {file: " + file + "}}\n"), "") << file;
  }
}

TEST(LoadScene, CamerasThatShowNothingAreRefused) {
  EXPECT_NE(errors_of(start + "camera: {eye: [0, 0, 0], target: [0, 0, 0]}\n")
                .find("the camera's target is where its eye is"),
            string::npos);
  EXPECT_NE(errors_of(start + "camera: {eye: [0, 5, 0], target: [0, 0, 0]}\n")
                .find("the camera looks along its up direction"),
            string::npos);
  EXPECT_NE(errors_of(start + "camera: {eye: [0, 5, 1], target: [0, 0, 0], near: 2, far: 1}\n")
                .find("far (1) is not beyond near (2)"),
            string::npos);
  EXPECT_NE(errors_of(start + "camera: {eye: [0, 5, 1], target: [0, 0, 0], fov: 180}\n").find("between 0 and 180"),
            string::npos);
}

TEST(LoadScene, WindowsFilesAreFine) {
  EXPECT_EQ(load_text("\xEF\xBB\xBFscene: 1\r\ntitle: 'x y'\r\nsimulate: {duration: 1}\r\n").title, "x y");
  EXPECT_EQ(errors_of("\xEF\xBB\xBFscene: 1\r\nsimulate: {duration: x}\r\n").substr(0, 16), "scene.yaml:2:22:");
}

}  // namespace
}  // namespace carom
