// Whole runs of scenes whose pictures show more than bodies: what is recorded, at which instants, and the same results.
#include <fcntl.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "engine/engine.h"
#include "export/film_file.h"
#include "overlay/history.h"
#include "overlay/inscription.h"
#include "overlay/title_card.h"
#include "run/picture_series.h"
#include "run/run_scene.h"
#include "scene/scenes_in_text.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {
namespace {

const string bouncing =
    "scene: 1\ntitle: A ball\nsimulate: {duration: 2}\n"
    "balls: {red: {mass: 1, radius: 0.1, position: [0, 1.1, 0], velocity: [0.5, 0, 0], restitution: 0.8}}\n"
    "camera: {eye: [0.5, 1, 4], target: [0.5, 0.6, 0]}\n";
const string floor_plane = "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n";

void carry(Simulator& simulator, History& history, double time) {
  while (simulator.time() < time) {
    simulator.advance_to(time);
    history.record(simulator.collisions());
    history.record_paths(simulator.paths());
  }
}

/// The history of a run until `time`, which ends with a state.
void play(const Scene& scene, History& history, double time) {
  const OverlayNeeds needs = overlay_needs(scene);
  const auto simulator = make_simulator(scene, {needs.collisions, needs.paths});
  history.record_paths(simulator->paths());
  for (double next = 0; next < time; next = std::min(history.next_sample(), time)) {
    carry(*simulator, history, next);
    history.sample(simulator->state());
  }
  carry(*simulator, history, time);
  history.sample(simulator->state());
}

/// The greatest distance (m) between a track and the simulator's own positions.
double worst_error(const Scene& scene, const History& history, double from, double until) {
  const auto simulator = make_simulator(scene);
  double worst = 0;
  for (int i = 0; i <= 400; ++i) {
    const double time = from + i * (until - from) / 400;
    while (simulator->time() < time) simulator->advance_to(time);
    double nearest = infinity;
    for (const TrackPiece& piece : history.tracks()->of(0))
      if (piece.from <= time && time <= piece.until)
        nearest = std::min(nearest, (piece.position(time) - simulator->state().position[0]).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(Tracks, OfRecordedPathsAreThePositionsOfTheRun) {
  const Scene scene = load_text(bouncing + floor_plane + "trails: {seconds: 1.5}\noutput: {frames: true}\n");
  ASSERT_TRUE(overlay_needs(scene).paths);
  History history(scene, picture_needs(scene));
  play(scene, history, 2);
  EXPECT_LT(worst_error(scene, history, 0.5, 2), 1e-15);
}

TEST(Tracks, OfOtherEnginesAndForcesAreThePositionsOfTheRunToAQuarterPixel) {
  for (const string& more :
       {string("forces: [{drag: {linear: 0.5}}]\n"), string("forces: [{drag: {quadratic: 0.5}}]\n"),
        string("forces: [{spring: {anchor: [0, 2, 0], stiffness: 30, damping: 1}}]\n")}) {
    const Scene scene = load_text(bouncing + floor_plane + more + "trails: {seconds: 1.5}\noutput: {frames: true}\n");
    ASSERT_TRUE(overlay_needs(scene).states);
    History history(scene, picture_needs(scene));
    play(scene, history, 2);
    // A pixel of 1280 x 720 is 4.6 mm at 4 m.
    EXPECT_LT(worst_error(scene, history, 0.5, 2), 0.0011) << more;  // 1.4e-5
  }
}

TEST(Needs, AreNoneWithoutPictures) {
  const string all = "trails: true\nflash: true\ncaption: \"{collisions}\"\n";
  const OverlayNeeds none = overlay_needs(load_text(bouncing + all));
  EXPECT_FALSE(none.collisions || none.collision_counts || none.paths || none.states);
  const OverlayNeeds some = overlay_needs(load_text(bouncing + all + "output: {sheet: true}\n"));
  EXPECT_TRUE(some.collisions && some.collision_counts && some.paths && !some.states);
}

string read(const string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs a scene into a folder of the test.
string run_of(const string& text, const string& name) {
  const string folder = test_folder() + "/" + name;
  Scene scene = load_scene(write_file(text, name + ".yaml"));
  const RunWatch watch{[] {}, [](const RunProgress&) {}};
  RunSettings settings;
  settings.durability = Durability::deferred;
  run_scene({&scene, folder}, choose_engine(scene), settings, watch);
  return folder;
}

TEST(Run, WithAnOverlayHasTheTablesOfARunWithoutIt) {
  const string output = "output: {trajectory: true, collisions: true, frames: {fps: 3, size: [64, 36], samples: 1}}\n";
  for (const string& more : {string(), string("forces: [{drag: {quadratic: 0.5}}]\n")}) {
    const string plain = run_of(bouncing + floor_plane + more + output, "plain");
    const string shown =
        run_of(bouncing + floor_plane + more + output +
                   "trails: true\nflash: true\narrows: [force]\nshutter: 1\ncaption: \"{collisions}, {time} s\"\n",
               "shown");
    for (const char* table : {"/trajectory.csv", "/collisions.csv", "/summary.csv"})
      EXPECT_EQ(read(plain + table), read(shown + table)) << table << more;
    EXPECT_NE(read(plain + "/frames/frame_00003.png"), read(shown + "/frames/frame_00003.png"));
    std::filesystem::remove_all(test_folder());
  }
}

/// Draws the pictures of one stream at some times as Stage does, and returns the states that were asked for.
struct Taken {
  vector<double> instants;
  vector<Image> pictures;
};
Taken pictures_of(const Scene& scene, const vector<double>& times, double interval) {
  History history(scene, picture_needs(scene));
  const auto simulator = make_simulator(scene);
  PictureSeries series(scene, {{320, 180}, 4, 0, interval, 2}, history, "here");
  Taken taken;

  for (const double time : times) {
    series.aim(time);
    while (series.next_instant() < time) {
      taken.instants.push_back(series.next_instant());
      carry(*simulator, history, series.next_instant());
      series.expose(simulator->state());
    }

    carry(*simulator, history, time);
    taken.pictures.push_back(series.picture(simulator->state(), simulator->tally()));
  }
  return taken;
}

const string across =
    "scene: 1\nsimulate: {duration: 2}\ngravity: [0, 0, 0]\n"
    "balls: {red: {mass: 1, radius: 0.2, position: [-1, 0, 0], velocity: [2, 0, 0], color: white}}\n"
    "camera: {eye: [0, 0, 4], target: [0, 0, 0]}\nbackground: black\noutput: {frames: true}\n";

TEST(Shutter, OfABallThatMovesTakesAnInstantForEachPixel) {
  const Taken taken = pictures_of(load_text(across + "shutter: 0.5\n"), {0, 0.2, 0.4}, 0.2);
  // 2 m/s x 0.1 s are 0.2 m; at 4 m a picture is 3.3 m high, so that this is 10.9 pixels: 11 instants, from the opening
  // to the picture's own time.
  ASSERT_EQ(taken.instants.size(), 22u);
  EXPECT_DOUBLE_EQ(taken.instants[0], 0.1);
  EXPECT_DOUBLE_EQ(taken.instants[1], 0.1 + 0.1 / 11);
  EXPECT_DOUBLE_EQ(taken.instants[10], 0.2 - 0.1 / 11);
  EXPECT_DOUBLE_EQ(taken.instants[11], 0.3);
}

TEST(Shutter, BlursAlongTheMotionUntilThePicturesTime) {
  const Image sharp = pictures_of(load_text(across), {0.4}, 0.2).pictures[0];
  const Image blurred = pictures_of(load_text(across + "shutter: 0.5\n"), {0.4}, 0.2).pictures[0];
  const auto ends = [](const Image& image) {
    pair<int, int> found{image.width, -1};
    for (int x = 0; x < image.width; ++x)
      if (image.row(90)[3 * x] > 8) found = {std::min(found.first, x), std::max(found.second, x)};
    return found;
  };
  // It has come from the left by 10.9 pixels. Its right end is that of the picture's time.
  EXPECT_NEAR(ends(sharp).first - ends(blurred).first, 10, 1.5);
  EXPECT_NEAR(ends(sharp).second - ends(blurred).second, 0, 1);
}

TEST(Shutter, OfAStillSceneDrawsItOnce) {
  string still = across;
  still.replace(still.find("[2, 0, 0]"), 9, "[0, 0, 0]");
  const Taken taken = pictures_of(load_text(still + "shutter: 1\n"), {0, 0.2, 0.4}, 0.2);
  EXPECT_EQ(taken.instants.size(), 2u);  // the openings
}

TEST(Caption, HasTheExactTimeAndCountOfItsPicture) {
  const Scene scene =
      load_text(bouncing + floor_plane + "caption: \"{time} s, {collisions} in {run}\"\noutput: {frames: true}\n");
  // The ball of 0.8 falls 1 m: impacts at sqrt(2 / g) = 0.4516 s, then after 0.8 x 0.9032 s and 0.64 x 0.9032 s.
  const pair<double, string> expected[] = {{0.45, "0.45 s, 0 in here"},
                                           {0.46, "0.46 s, 1 in here"},
                                           {1.1725, "1.17 s, 1 in here"},
                                           {1.18, "1.18 s, 2 in here"}};
  for (const auto& [time, text] : expected) {
    const Image picture = pictures_of(scene, {time}, 0.1).pictures[0];
    Scene plain = load_text(bouncing + floor_plane + "output: {frames: true}\n");
    Image written = pictures_of(plain, {time}, 0.1).pictures[0];
    plain.overlay.caption = text;
    Inscription(plain, {320, 180}).write({}, written);
    EXPECT_TRUE(picture.pixels == written.pixels) << text;
  }
}

/// The number of pictures in a film, and its length in s.
pair<uint64_t, double> film_of(const string& folder, const string& name) {
  const Descriptor directory(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const FilmFacts facts = film_facts(find_film_tools(), {directory.get(), folder}, name);
  return {facts.frames, double(facts.frames * facts.per) / double(facts.rate)};
}

TEST(TitleCard, AddsTwoSecondsToAFilm) {
  const auto film = [&](const string& keys, const string& name) {
    const string folder = run_of(
        bouncing + floor_plane + "output: {video: {size: [64, 36], samples: 1, " + keys + ", file: " + name + "}}\n",
        name);
    const auto found = film_of(folder, name);
    std::filesystem::remove_all(test_folder());
    return found;
  };

  for (const string name : {"a.mp4", "a.gif"}) {
    const string gif_rate = "fps: 20, until: 1";
    EXPECT_EQ(film(gif_rate, name).first, 21u) << name;
    EXPECT_EQ(film(gif_rate + ", title: true", name), (pair<uint64_t, double>(61, 3.05))) << name;
  }

  // Rounded to whole pictures, and at least one.
  EXPECT_EQ(film("fps: 12.7, until: 0, title: true", "a.mp4").first, 1u + 25);
  EXPECT_EQ(film("fps: 0.2, until: 0, title: true", "a.mp4").first, 1u + 1);
}

TEST(TitleCard, FadesIntoTheFirstPicture) {
  const Scene scene = load_text(bouncing + floor_plane + "output: {frames: true}\n");
  const Image first = pictures_of(scene, {0}, 0.1).pictures[0];
  TitleCard card("A ball", first);
  const auto light = [](const Image& image) { return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0); };

  const double whole = light(first);
  const Image full = card.picture(2);
  EXPECT_EQ(card.picture(0.4).pixels, full.pixels);
  EXPECT_LT(light(full), 0.5 * whole);

  double before = light(full);
  for (int i = 11; i >= 0; --i) {
    const double now = light(card.picture(i / 30.0));
    EXPECT_GT(now, before);
    EXPECT_LT(now - before, 0.13 * whole);  // 0.11 at most: no jump
    before = now;
  }
  EXPECT_EQ(card.picture(0).pixels, first.pixels);

  // Whole lines of white in the middle, at equal distances from the sides.
  int left = first.width, right = -1;
  for (int y = 60; y < 120; ++y)
    for (int x = 0; x < first.width; ++x)
      if (full.row(y)[3 * x] == 255) left = std::min(left, x), right = std::max(right, x);
  EXPECT_NEAR(left + right, first.width - 1, 3);
}

TEST(TitleCard, BreaksALongTitleIntoEvenLines) {
  const Image ground{640, 360, vector<uint8_t>(size_t{640} * 360 * 3, 90)};
  TitleCard card("A title of so many words that it has to be broken into lines, of which none is much longer", ground);
  const Image& full = card.picture(2);
  int rows = 0;
  bool before = false;

  for (int y = 0; y < 360; ++y) {
    bool letters = false;
    for (int x = 0; x < 640; ++x) {
      letters = letters || full.row(y)[3 * x] > 200;
      EXPECT_FALSE((x < 40 || x > 600) && full.row(y)[3 * x] > 200);
    }
    rows += letters && !before;
    before = letters;
  }
  EXPECT_GE(rows, 3);
}

}  // namespace
}  // namespace carom
