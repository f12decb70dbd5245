// An interrupted run that goes on has the bytes of one that was never interrupted.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "export/exports.h"
#include "run/run_scene.h"
#include "run/run_testing.h"
#include "run/stages.h"
#include "scene/engines.h"
#include "scene/output_kinds.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "stress/scene.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

struct Stopped {};

string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All that a run shows of itself, by name: its files, and the manifest without what no two runs have in common.
map<string, string> files_in(const string& folder) {
  map<string, string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder)] = bytes_of(entry.path());
  if (!files.contains("manifest.json")) return files;
  auto manifest = nlohmann::ordered_json::parse(files["manifest.json"]);
  manifest.erase("wall_times_s");
  manifest.erase("peak_memory_bytes");
  files["manifest.json"] = manifest.dump();
  return files;
}

/// How a run ends, and when.
enum class End { interrupt, power_cut };

/// A run in the folder `run` of a place, counted by the checks for an interrupt.
class RunByChecks {
 public:
  RunByChecks(const RunPlace& place, Scene scene) : place_(place), scene_(std::move(scene)) {
    settings_.durability = Durability::deferred;
  }

  /// The run until its end. Returns the number of checks.
  int whole() {
    go([](int) {});
    return checks_;
  }
  /// The run is kept at check `keeps`, goes on, and ends at check `ends` or later. Returns whether it came so far.
  bool stopped(int keeps, int ends, End end) {
    settings_.checkpoint_s = 1e9;
    bool cut = false;

    const auto at = [&](int check) {
      settings_.checkpoint_s = check >= keeps && !kept() ? 1e-9 : 1e9;
      if (check < ends || !kept() || cut) return;
      if (end == End::interrupt) throw Stopped();
      cut = copied();
    };

    try {
      go(at);
    } catch (const Stopped&) {
      return true;
    }

    if (!cut) return false;
    fs::remove_all(place_ / "run");
    fs::rename(place_ / "cut", place_ / "run");
    return true;
  }

  map<string, string> files() const { return files_in(place_ / "run"); }
  const vector<string>& remarks() const { return remarks_; }
  double begun_at() const { return begun_at_; }
  RunSettings& settings() { return settings_; }
  Scene& scene() { return scene_; }
  bool kept() const { return fs::exists(place_ / "run/.checkpoint.part"); }

 private:
  /// Copies the folder as a power cut would leave it. False: a file got its name meanwhile.
  bool copied() const {
    std::error_code error;
    fs::copy(place_ / "run", place_ / "cut", fs::copy_options::recursive, error);
    if (error) fs::remove_all(place_ / "cut");
    return !error;
  }

  void go(const function<void(int check)>& at) {
    checks_ = 0;
    begun_at_ = 0;
    remarks_.clear();
    const RunWatch watch{[&] {
                           if (std::this_thread::get_id() == thread_) at(checks_++);
                         },
                         [&](const RunProgress& progress) { begun_at_ = progress.begun_at; },
                         [&](const string& text) { remarks_.push_back(text); }};
    run_scene({&scene_, place_ / "run"}, choose_engine(scene_), settings_, watch);
  }

  const RunPlace& place_;
  Scene scene_;
  RunSettings settings_;
  const std::thread::id thread_ = std::this_thread::get_id();
  int checks_ = 0;
  double begun_at_ = 0;
  vector<string> remarks_;
};

/// Whether a run that ends in both ways, and then goes on, has the files of one that is never interrupted.
void expect_to_go_on(const Scene& scene, std::mt19937_64& random, bool is_kept = true) {
  const RunPlace undisturbed;
  RunByChecks plain(undisturbed, scene);
  const int checks = plain.whole();

  const map<string, string> right = plain.files();

  for (const End end : {End::interrupt, End::power_cut}) {
    const RunPlace place;
    RunByChecks run(place, scene);
    // Twice, so that a run that goes on is itself interrupted.
    for (int times = 0; times < 2; ++times) {
      const int keeps = static_cast<int>(random() % (checks / 2 + 1));
      const int ends = keeps + 1 + static_cast<int>(random() % (checks / 4 + 1));
      const bool stopped = run.stopped(keeps, ends, end);
      EXPECT_TRUE(stopped || !is_kept || times > 0);
      if (!stopped) break;
      EXPECT_EQ(run.kept(), is_kept);
    }

    run.settings().checkpoint_s = 60;
    run.whole();
    const map<string, string> files = run.files();
    for (const auto& [name, bytes] : right)
      EXPECT_TRUE(files.contains(name) && files.at(name) == bytes)
          << name << (end == End::interrupt ? " after an interrupt" : " after a power cut");
    EXPECT_EQ(files.size(), right.size());
  }
}

/// Small and few pictures in place of those of the scene.
Scene with_outputs(Scene scene, const vector<string>& outputs) {
  for (Output* output : {&scene.output, &scene.requested}) {
    *output = restricted(scene.requested, outputs);

    const PictureOutput small{2, {32, 18}, 1, 0, {}};
    if (output->frames) static_cast<PictureOutput&>(*output->frames) = small;
    if (output->gltf) output->gltf = GltfOutput{2};

    const double every = scene.simulate.duration / 20;
    if (output->trajectory) output->trajectory->every = every;
    if (output->contacts) output->contacts->every = every;
    if (output->energy) output->energy->every = every;
    if (output->vtk) output->vtk->every = every;
    if (output->xyz) output->xyz->every = every;
  }
  return scene;
}

class EverySceneGoesOn : public ::testing::TestWithParam<string> {};

TEST_P(EverySceneGoesOn, WithTheSameFiles) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "brick_wall", "funnel", "pile_at_rest", "piston", "binary_stars", "hourglass",
                       "lattice", "pour_into_bowl", "effusion", "opening_gate", "shaken_tray");
  Scene scene = scene_in_short(GetParam());
  std::mt19937_64 random(1);
  const bool has_flights = goes_along_parabolas(scene.world, scene.simulate);
  vector<string> tables = {"trajectory", "collisions", "energy", "contacts", "regions", "vtk", "xyz"};
  if (has_flights) tables.emplace_back("flights");
  expect_to_go_on(with_outputs(scene, tables), random);
  expect_to_go_on(with_outputs(scene, {"frames", "energy"}), random, draws_after_motion(scene));
  scene.camera.reset();
  expect_to_go_on(with_outputs(scene, {"frames", "gltf", "collisions"}), random);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneGoesOn, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

const string pile =
    "scene: 1\ngravity: [0, -9.81, 0]\nrestitution: 0.3\nroom: {min: [0, 0, 0], max: [1, 3, 1]}\n"
    "groups: {b: {count: 40, in: {min: [0, 0, 0], max: [1, 3, 1]}, ball: {mass: 1, radius: 0.1}}}\n"
    "regions: {low: {position: [0.5, 0.25, 0.5], box: [1, 0.5, 1]}}\n"
    "measures: {hits: 'hits(b.1)', top: 'max(groups.b.y_m)', low: 'regions.low.entries', inside: "
    "'regions.low.inside'}\n";
const string given_camera = "camera: {eye: [0, 1, 5], target: [0, 1, 0]}\n";

TEST(Resume, OfAPileWithAllOutputsHasTheSameFiles) {
  std::mt19937_64 random(2);
  const string outputs =
      "trajectory: {every: 0.02, layout: wide}, collisions: true, energy: {every: 0.05}, contacts: {every: 0.05}, "
      "regions: true, vtk: {every: 0.2}, xyz: {every: 0.2}, gltf: true, flights: true, "
      "frames: {fps: 4, size: [32, 18]}, sheet: {columns: 2, rows: 1, size: [96, 48]}}\n";
  const RunPlace place;
  for (const string& more : {string("simulate: {duration: 1}\noutput: {"),
                             "simulate: {duration: 2}\n" + given_camera + "output: {plots: true, report: true, ",
                             string("simulate: {duration: 9, stop: [{collisions: 150}]}\noutput: {")})
    expect_to_go_on(place.scene(pile + more + outputs), random);
}

TEST(Resume, OfTablesInOtherFormsHasTheSameFiles) {
  std::mt19937_64 random(5);
  const RunPlace place;
  for (const string tables : {"csv.gz", "xlsx", "{format: csv.gz, separator: \";\", decimal: \",\"}"})
    expect_to_go_on(
        place.scene(pile + "simulate: {duration: 1}\noutput: {trajectory: {every: 0.002}, collisions: true, " +
                    "energy: {every: 0.05}, contacts: {every: 0.01}, regions: true, tables: " + tables + "}\n"),
        random);
}

TEST(Resume, SimulatesNothingTwiceThatWasKept) {
  const RunPlace place;
  RunByChecks run(place, place.scene(pile + "simulate: {duration: 2}\noutput: {collisions: true}\n"));
  ASSERT_TRUE(run.stopped(600, 700, End::interrupt));
  run.settings().checkpoint_s = 60;
  run.whole();
  // Advances take a thousandth of the duration, and an interrupt keeps the run once more.
  EXPECT_NEAR(run.begun_at(), 2 * 0.7, 0.02);
}

TEST(Resume, DoesNotSettleStepsAgain) {
  const RunPlace place;
  RunByChecks run(place, place.scene("scene: 1\nballs: {b: {mass: 1, radius: 0.1, position: [0, 1, 0]}}\n"
                                     "simulate: {duration: 1, engine: stepped, tolerance: 1e-6}\n"
                                     "output: {trajectory: {every: 0.1}}\n"));

  int settled = 0;
  run.settings().simulator = [&](const Scene& of, Recording recording, const StepChoice& steps) {
    settled += steps.length || steps.error > 0 ? 1 : 0;
    return make_simulator(of, std::move(recording), steps);
  };

  const int checks = run.whole();
  const auto right = run.files();
  fs::remove_all(place / "run");
  ASSERT_TRUE(run.stopped(checks - 300, checks - 200, End::interrupt));

  run.settings().checkpoint_s = 60;
  EXPECT_LT(run.whole(), 400);
  EXPECT_EQ(settled, 3);
  EXPECT_EQ(run.files(), right);
}

/// A kept run in `run`, and what it will have in its end.
map<string, string> keep(RunByChecks& run) {
  run.whole();
  map<string, string> right = run.files();
  EXPECT_TRUE(run.stopped(300, 500, End::power_cut));
  run.settings().checkpoint_s = 60;
  return right;
}

TEST(Resume, OfDamagedFilesBeginsAnew) {
  const string text = pile + "simulate: {duration: 0.4}\noutput: {trajectory: {every: 0.01}, flights: true}\n";
  const auto damage = [](const string& path) {
    string bytes = bytes_of(path);
    bytes[3] ^= 1;
    std::ofstream(path, std::ios::binary) << bytes;
  };

  for (const string name : {".trajectory.csv.part", ".flights.bin.part", ".checkpoint.part"}) {
    for (const bool truncates : {false, true}) {
      const RunPlace place;
      RunByChecks run(place, place.scene(text));
      const auto right = keep(run);

      const string path = place / ("run/" + name);
      ASSERT_GT(fs::file_size(path), 0u) << name;
      truncates ? fs::resize_file(path, 3) : damage(path);

      run.whole();
      EXPECT_EQ(run.begun_at(), 0);
      EXPECT_EQ(run.files(), right) << name;
      EXPECT_EQ(run.remarks(),
                vector<string>{"begins anew: what the interrupted run in its folder has left is damaged"})
          << name;
    }
  }
}

TEST(Resume, IsOfTheSameRequestOnly) {
  const string text = pile + "output: {trajectory: {every: 0.01}, collisions: true}\n";
  const auto anew = [&](const function<void(RunByChecks&)>& change) {
    const RunPlace place;
    RunByChecks run(place, place.scene(text + "simulate: {duration: 1}\n"));
    keep(run);
    change(run);
    run.whole();
    const bool begins_anew = run.begun_at() == 0;
    EXPECT_EQ(run.remarks().at(0).starts_with("begins anew: "), begins_anew);
    return begins_anew && !run.kept();
  };

  EXPECT_FALSE(anew([](RunByChecks&) {}));
  EXPECT_TRUE(anew([](RunByChecks& run) { run.scene().output.collisions = false; }));
  EXPECT_TRUE(anew([](RunByChecks& run) { run.scene().resolved += "# other\n"; }));
  EXPECT_TRUE(anew([](RunByChecks& run) { run.scene().initial.position[3].x() += 1e-9; }));
  EXPECT_TRUE(anew([](RunByChecks& run) { run.settings().measures = {parse_measure("balls.b.1.x_m")}; }));
}

TEST(Resume, NeedsFlightsForPicturesByAGivenCamera) {
  const RunPlace place;
  const string text = pile + given_camera + "simulate: {duration: 1}\noutput: {frames: {fps: 4, size: [32, 18]}}\n";
  RunByChecks run(place, place.scene(text));
  run.scene().output.flights = false;
  EXPECT_FALSE(run.stopped(300, 500, End::interrupt));
  EXPECT_EQ(run.remarks(),
            vector<string>{"cannot go on after an interrupt: its pictures need flights among its outputs"});
}

TEST(Resume, WithoutAFileThatIsCompleteBeginsAnew) {
  const RunPlace place;
  RunByChecks run(place, place.scene(pile + "simulate: {duration: 1}\noutput: {vtk: {every: 0.05}}\n"));
  const auto right = keep(run);
  fs::remove(place / "run/vtk/bodies_00001.vtp");
  run.whole();
  EXPECT_EQ(run.begun_at(), 0);
  EXPECT_EQ(run.files(), right);
}

TEST(Resume, IsOfTheMeshThatTheRunBeganWith) {
  const RunPlace place;
  const auto write_mesh = [&](double height) {
    std::ofstream(place / "body.obj") << "v 0 0 0\nv 0.3 0 0\nv 0 0 0.3\nv 0 " << height
                                      << " 0\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
  };
  write_mesh(0.3);

  const string text =
      "scene: 1\nroom: {min: [0, 0, 0], max: [1, 1, 1]}\ngravity: [0, -9.81, 0]\nrestitution: 0.9\n"
      "bodies: {b: {mass: 1, mesh: body.obj, fit: box, position: [0.5, 0.5, 0.5], velocity: [1, 0, 0.7]}}\n"
      "simulate: {duration: 2}\noutput: {collisions: true}\n";

  RunByChecks run(place, place.scene(text));
  ASSERT_TRUE(run.stopped(300, 500, End::interrupt));
  RunByChecks edited(place, [&] {
    write_mesh(0.5);
    return place.scene(text);
  }());
  edited.whole();
  EXPECT_EQ(edited.begun_at(), 0);

  // Edited while it was simulated.
  write_mesh(0.3);

  const Scene before = place.scene(text);
  RunByChecks other(place, before);
  other.settings().simulator = [&](const Scene& of, Recording recording, const StepChoice& steps) {
    write_mesh(0.5);
    return make_simulator(of, std::move(recording), steps);
  };
  ASSERT_TRUE(other.stopped(300, 500, End::interrupt));

  RunByChecks after(place, place.scene(text));
  after.whole();
  EXPECT_EQ(after.begun_at(), 0);
}

TEST(Resume, IsTriedAgainAfterAnotherError) {
  const RunPlace place;
  RunByChecks run(place, place.scene(pile + "simulate: {duration: 1}\noutput: {collisions: true, flights: true}\n"));
  const auto right = keep(run);
  run.settings().simulator = [](const Scene&, const Recording&, const StepChoice&) -> unique_ptr<Simulator> {
    throw std::bad_alloc();
  };
  EXPECT_THROW(run.whole(), std::bad_alloc);
  run.settings().simulator = RunSettings{}.simulator;
  run.whole();
  EXPECT_GT(run.begun_at(), 0);
  EXPECT_EQ(run.files(), right);
}

TEST(Resume, WithoutRoomForATableIsAnErrorOfTheRun) {
  const RunPlace place;
  const Scene scene = place.scene(pile + "simulate: {duration: 1}\noutput: {energy: {every: 0.001}}\n");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  RunSettings settings;
  settings.checkpoint_s = 1e9;
  const auto without_room = [&, checks = 0]() mutable {
    // Two checks, for one may come before an advance.
    const bool is_due = ++checks / 2 == 150;
    settings.checkpoint_s = is_due ? 1e-9 : 1e9;
    const rlimit limit{is_due ? 1 : before.rlim_cur, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  EXPECT_THROW(
      run_scene({&scene, place / "run"}, choose_engine(scene), settings, {without_room, [](const RunProgress&) {}}),
      ExportError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_FALSE(fs::exists(place / "run"));
}

TEST(Resume, ThatBecomesImpossibleLeavesTheFilesOfTheRun) {
  const RunPlace place;
  const Scene scene = place.scene(pile + "simulate: {duration: 1}\noutput: {energy: {every: 0.1}}\n");
  Exports exports(scene, place / "run", Durability::deferred, {}, nullptr, [] { return "request"; });
  exports.keep({.time = 0.5});
  EXPECT_TRUE(fs::exists(place / "run/.checkpoint.part"));
  exports.forget();
  EXPECT_FALSE(fs::exists(place / "run/.checkpoint.part"));
  EXPECT_TRUE(fs::exists(place / "run/.energy.csv.part"));
}

TEST(Resume, OfARunThatFailsBeginsAnew) {
  const RunPlace place;
  RunByChecks run(place,
                  place.scene(pile + "simulate: {duration: 2, max_collisions: 300}\noutput: {collisions: true}\n"));
  EXPECT_THROW(run.stopped(1, 1'000'000, End::interrupt), SimulationError);
  EXPECT_FALSE(fs::exists(place / "run"));
}

TEST(Resume, IsNotPreparedByAShortRun) {
  const RunPlace place;
  const Scene scene = place.scene(pile + "simulate: {duration: 1}\noutput: {collisions: true}\n");
  const auto stop = [checks = 0]() mutable {
    if (++checks == 500) throw Stopped();
  };
  EXPECT_THROW(run_scene({&scene, place / "run"}, choose_engine(scene), {}, {stop, [](const RunProgress&) {}}),
               Stopped);
  EXPECT_FALSE(fs::exists(place / "run"));
}

TEST(Resume, OfRandomScenesHasTheSameFiles) {
  std::mt19937_64 random(3);
  int done = 0;

  for (uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const RunPlace place;

    const string text = stress::as_yaml(stress::make_scene(seed));
    try {
      const Scene scene = place.scene(text);
      expect_to_go_on(with_outputs(scene, {"trajectory", "collisions", "energy", "contacts", "flights"}), random);
      ++done;
    } catch (const SimulationError&) {
    }
  }
  EXPECT_GT(done, 25);
}

}  // namespace
}  // namespace carom
