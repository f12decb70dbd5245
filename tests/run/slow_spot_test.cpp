// Films that slow down, and films with sound, of whole runs.
#include "run/slow_spot.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "engine/engine.h"
#include "export/film_file.h"
#include "export/flights_file.h"
#include "export/picture_streams.h"
#include "files/folders.h"
#include "run/former_run.h"
#include "run/run_scene.h"
#include "run/run_testing.h"
#include "std.h"

namespace carom {
namespace {

// Red meets blue at 0.75 s, and blue meets green at 1.5 s, both at 4 m/s.
const string three =
    "scene: 1\ngravity: [0, 0, 0]\nsimulate: {duration: 3}\ndefaults: {ball: {mass: 1, radius: 0.1}}\n"
    "balls:\n  red: {position: [0, 0, 0], velocity: [4, 0, 0]}\n  blue: {position: [3.2, 0, 0]}\n"
    "  green: {position: [6.4, 0, 0]}\n  lone: {position: [0, 9, 0]}\n";

string with_film(const string& film, const string& more = "") {
  return three + more + "output: {collisions: true, video: {fps: 20, size: [32, 18], " + film + "}}\n";
}

optional<Slowdown> found(const string& film) {
  const RunPlace place;
  const Scene scene = place.scene(with_film(film));
  return find_slowdown(
      scene, [&] { return make_simulator(scene, {.collisions = true, .paths = true}); }, [] {});
}

/// Whether a slowdown is found there.
bool is_at(double time, int halvings, const optional<Slowdown>& slow) {
  return slow && std::abs(slow->time - time) < 1e-15 && slow->halvings == halvings;
}

TEST(Slowdown, IsAtTheFirstCollisionOfTheTimeShown) {
  // At 4 m/s bodies close by 1 m in 0.25 s, 10 radii, to which 8 is nearest.
  EXPECT_TRUE(is_at(0.75, 3, found("slow: auto")));
  EXPECT_TRUE(is_at(0.75, 3, found("slow: red")));
  EXPECT_TRUE(is_at(1.5, 3, found("slow: green")));
  EXPECT_TRUE(is_at(1.5, 3, found("slow: auto, from: 1")));
  EXPECT_TRUE(is_at(0.75, 1, found("slow: auto, speed: 0.25")));
  EXPECT_FALSE(found("slow: lone"));
  EXPECT_FALSE(found("slow: auto, from: 2"));
  EXPECT_FALSE(found("slow: auto, until: 0.5"));
}

uint64_t film_pictures(const string& folder) {
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  return film_facts(find_film_tools(), {opened.get(), folder}, "animation.mp4").frames;
}

string film_bytes(const string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void run_into(const string& folder, const Scene& scene, const RunSettings& settings = {}) {
  run_scene({&scene, folder}, choose_engine(scene), settings, {[] {}, [](const RunProgress&) {}});
}

TEST(SlowFilm, IsAsLongAsThePageSays) {
  const RunPlace place;
  for (const auto& [film, length] : vector<pair<string, double>>{
           {"slow: auto", 3 + 1.744},
           {"slow: auto, speed: 0.5", 6 + 1.209},
           {"slow: none", 3},
           {"slow: lone", 3},
       }) {
    const Scene scene = place.scene(with_film(film, "camera: {eye: [3, 0, 9], target: [3, 0, 0]}\n"));
    run_into(place / "run", scene);
    EXPECT_EQ(film_pictures(place / "run"), uint64_t(floor(20 * length)) + 1) << film;
  }
}

TEST(SlowFilm, IsSimulatedOnceAndTheSameFromFlights) {
  const RunPlace place;
  // A camera that frames the motion, and one that stands.
  for (const string& camera : {string(), string("camera: {eye: [3, 0, 9], target: [3, 0, 0]}\n")}) {
    const Scene scene = place.scene(with_film("slow: green, sound: true", camera + "caption: true\nflash: true\n"));
    int made = 0;
    RunSettings settings;
    settings.simulator = [&made](const Scene& of, Recording recording, const StepChoice& steps) {
      ++made;
      return make_simulator(of, std::move(recording), steps);
    };
    run_into(place / "run", scene, settings);
    EXPECT_EQ(made, 1);

    LoadOptions options;
    SceneFile file(place / "run/scene.yaml", options);
    const FormerRun former = read_former_run(place / "run", file, [](const FormerRun&, string_view) { return false; });
    ASSERT_TRUE(former.has_flights_with_collisions(scene));
    RunSettings again;
    again.replay = [&former](const Scene& of) { return former.replay(of); };
    again.former = &former.manifest;
    run_into(place / "drawn", scene, again);
    EXPECT_TRUE(film_bytes(place / "run/animation.mp4") == film_bytes(place / "drawn/animation.mp4"));
  }
}

TEST(SlowFilm, EndsWithARunThatStops) {
  const RunPlace place;
  const Scene scene = place.scene(
      "scene: 1\ngravity: [0, 0, 0]\nsimulate: {duration: 30, stop: [{collisions: 1}]}\n"
      "balls:\n  red: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [4, 0, 0]}\n"
      "  blue: {mass: 1, radius: 0.1, position: [8.2, 0, 0]}\n"
      "output: {video: {fps: 20, size: [32, 18], slow: auto, sound: true}}\n");
  run_into(place / "run", scene);
  // 2 s and the first half of the slowdown.
  EXPECT_EQ(film_pictures(place / "run"), uint64_t(floor(20 * (2 + 1.744 / 2))) + 1);
}

TEST(FlightsWithSound, HaveTheImpulses) {
  const RunPlace place;
  const string camera = "camera: {eye: [3, 0, 9], target: [3, 0, 0]}\n";
  const Scene scene = place.scene(with_film("sound: true", camera)),
              silent = place.scene(with_film("slow: auto", camera));
  run_into(place / "sound", scene);
  run_into(place / "silent", silent);

  const Descriptor folder = open_folder(AT_FDCWD, place / "sound", true);
  const auto reader = make_shared<FlightsReader>(folder.get(), "", scene);
  vector<double> impulses;
  for (Recorded recorded; reader->next(recorded);)
    if (recorded.kind == Recorded::Kind::collision) impulses.push_back(recorded.collision.impulse);
  EXPECT_EQ(impulses, (vector<double>{4, 4}));

  LoadOptions options;
  SceneFile file(place / "silent/scene.yaml", options);
  const FormerRun former = read_former_run(place / "silent", file, [](const FormerRun&, string_view) { return false; });
  EXPECT_TRUE(former.has_flights_with_collisions(silent));
  EXPECT_FALSE(former.has_flights_with_collisions(scene));
}

}  // namespace
}  // namespace carom
