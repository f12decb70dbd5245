// A run replayed from its record of paths: the same states at any instant, bit for bit.
#include "run/replay.h"

#include <gtest/gtest.h>

#include <random>

#include "bench/state_hash.h"
#include "engine/engine.h"
#include "physics/world.h"
#include "run/record_queue.h"
#include "run/run_testing.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "simulate/exact.h"
#include "slow_with_sanitizers.h"
#include "std.h"
#include "stress/scene.h"

namespace carom {
namespace {

vector<string> scenes_again() {
  vector<string> names = scene_names();
  names.emplace_back("benchmark/gas_1000");
  ranges::sort(names);
  return names;
}

void carry_to(Simulator& simulator, double time) {
  while (simulator.time() < time) simulator.advance_to(time);
}

/// All pieces of a run, and its tally at the end.
struct Record {
  vector<PathPiece> pieces;
  Tally tally;
};

Record record(unique_ptr<Simulator> simulator, double duration) {
  Record all;
  const auto take = [&] { all.pieces.insert(all.pieces.end(), simulator->paths().begin(), simulator->paths().end()); };
  take();
  while (simulator->time() < duration) {
    simulator->advance_to(duration);
    take();
  }
  simulator->state();
  all.tally = simulator->tally();
  return all;
}

NextRecorded from(const vector<PathPiece>& pieces) {
  return [&pieces, next = size_t{0}](Recorded& recorded) mutable {
    if (next == pieces.size()) return false;
    recorded.piece = pieces[next++];
    return true;
  };
}

bool same_bits(const State& a, const State& b) {
  const auto same = [](const Volume& v, const Volume& w) { return v.shape == w.shape && v.half == w.half; };
  return hash_of(a) == hash_of(b) && a.time == b.time && a.mass == b.mass && a.radius == b.radius &&
         a.part_of == b.part_of && a.volume.size() == b.volume.size() &&
         std::equal(a.volume.begin(), a.volume.end(), b.volume.begin(), same);
}

/// At any instants, and where something happens, just before and just after: `simulator`, which records nothing, has
/// the states of the record.
void expect_same_states(const World& world, double duration, const Record& run, Simulator& simulator, int instants) {
  std::mt19937_64 random(1);
  vector<double> times = {0, duration};
  for (int k = 0; k < instants && !run.pieces.empty(); ++k) {
    times.push_back(duration * static_cast<double>(random() >> 11) * 0x1p-53);
    const double t = run.pieces[random() % run.pieces.size()].from;
    for (const double at : {std::nextafter(t, 0), t, std::nextafter(t, 2 * duration)})
      if (at <= duration) times.push_back(at);
  }
  // A run that stops has no states after its end.
  if (run.tally.end)
    for (double& t : times)
      if (t >= run.tally.end->time) t = duration;
  ranges::sort(times);
  Replay replay(world, from(run.pieces), run.tally);
  for (const double t : times) {
    carry_to(simulator, t);
    carry_to(replay, t);
    ASSERT_TRUE(same_bits(replay.state(), simulator.state())) << t;
  }
  EXPECT_EQ(hash_of(replay.state(), replay.tally()), hash_of(simulator.state(), simulator.tally()));
}

class EverySceneAgain : public ::testing::TestWithParam<string> {};

TEST_P(EverySceneAgain, HasTheSimulatorsStateAtAnyInstant) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "gas_1000", "brick_wall", "funnel", "pi_to_six_digits", "pile_at_rest",
                       "binary_stars", "hourglass", "lattice", "pour_into_bowl");
  const Scene scene = scene_in_short(GetParam());
  const Record run = record(make_simulator(scene, {.paths = true}), scene.simulate.duration);
  expect_same_states(scene.world, scene.simulate.duration, run, *make_simulator(scene), 500);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneAgain, ::testing::ValuesIn(scenes_again()), [](const auto& parameter) {
  string name = parameter.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

TEST(SceneAgain, HasTheStateAtTime0BeforeWhateverHappensThen) {
  const RunPlace place;
  for (const char* more : {"regions: {p: {radius: .4, position: [0, 0, 0], action: remove}}\nsimulate: {duration: 1}\n",
                           "simulate: {duration: 1, contact: merge}\nrestitution: 0\n", "simulate: {duration: 1}\n"}) {
    SCOPED_TRACE(more);
    const Scene scene = place.scene(string("scene: 1\nballs:\n"
                                           "  a: {mass: 1, radius: .1, position: [0, 0, 0], velocity: [1, 0, 0]}\n"
                                           "  b: {mass: 1, radius: .1, position: [.2, 0, 0]}\n") +
                                    more);
    const Record run = record(make_simulator(scene, {.paths = true}), scene.simulate.duration);
    expect_same_states(scene.world, scene.simulate.duration, run, *make_simulator(scene), 20);
  }
}

TEST(SceneAgain, KnowsEventsAsTheyComeThroughAQueue) {
  const Scene scene = scene_named("wrecking_ball");
  const auto simulator = make_simulator(scene, {.collisions = true, .paths = true});
  RecordQueue queue;
  queue.put(*simulator);
  for (int k = 1; k <= 50; ++k) {
    simulator->advance_to(0.05 * k);
    queue.put(*simulator);
  }
  queue.end(true);

  Replay replay(
      scene.world, [&queue](Recorded& recorded) { return queue.next(recorded); }, Tally{}, true);
  const auto same = make_simulator(scene);
  for (int k = 1; k <= 49; ++k) {
    carry_to(replay, 0.05 * k);
    carry_to(*same, 0.05 * k);
    ASSERT_TRUE(same_bits(replay.state(), same->state())) << k;
    EXPECT_EQ(replay.state().fired, same->state().fired) << k;
  }
  EXPECT_LT(replay.state().fired.at(0), 1.1);
}

TEST(SceneAgain, OfTheBookHasTheStateAfterTheCollisionThatEndsIt) {
  const RunPlace place;
  const Scene scene = place.scene(
      "scene: 1\nballs: {a: {mass: 1, radius: .1, position: [0, .5, 0], velocity: [1, 0, 0]}}\n"
      "planes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}}\nrestitution: .6\n"
      "simulate: {engine: book, step: .0013, duration: 1.2, stop: [{collisions: 2}]}\n");
  const Record run = record(make_simulator(scene, {.paths = true}), scene.simulate.duration);
  ASSERT_TRUE(run.tally.end);
  const double end = run.tally.end->time;
  expect_same_states(scene.world, scene.simulate.duration, run, *make_simulator(scene), 20);

  const auto simulator = make_simulator(scene);
  carry_to(*simulator, scene.simulate.duration);
  Replay replay(scene.world, from(run.pieces), run.tally);
  carry_to(replay, std::nextafter(end, 0));
  EXPECT_LT(replay.state().velocity[0].y(), 0);
  carry_to(replay, end);
  EXPECT_GT(replay.state().velocity[0].y(), 0);
  EXPECT_TRUE(same_bits(replay.state(), simulator->state()));
}

// Crowds, merges, forces in windows, cylinders and boxes: combinations that no scene of scenes/ has.
class RandomSceneAgain : public ::testing::TestWithParam<size_t> {};

TEST_P(RandomSceneAgain, HasTheSimulatorsStateAtAnyInstant) {
  SLOW_WITH_SANITIZERS("heaps");
  const size_t families = stress::family_names().size();
  for (uint64_t k = 0; k < 12; ++k) {
    stress::RandomScene scene = stress::make_scene(GetParam() + families * k);
    const auto simulator = make_exact_simulator(scene.world, scene.initial, scene.options);

    scene.options.record_paths = true;
    Record run;
    try {
      run = record(make_exact_simulator(scene.world, scene.initial, scene.options), scene.options.duration);
    } catch (const SimulationError&) {
      continue;  // a run without end has no record
    }

    SCOPED_TRACE("seed " + to_string(scene.seed));
    expect_same_states(scene.world, scene.options.duration, run, *simulator, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, RandomSceneAgain, ::testing::Range(size_t{0}, stress::family_names().size()),
                         [](const auto& family) { return string(stress::family_names()[family.param]); });

}  // namespace
}  // namespace carom
