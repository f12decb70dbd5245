// Whatever is done for one folder is guarded, so that an error of one of many pictures does not end the others' run.
#include "run/stages.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include "files/manifest.h"
#include "physics/archive.h"
#include "run/slow_spot.h"
#include "run/warnings.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return uint64_t(usage.ru_maxrss) * 1024;
}

/// Whether something that the scene requests is spread over the whole run, which may end early.
bool needs_end(const Scene& scene) {
  const auto whole = [](const Output& output) { return output.charts() || (output.sheet && !output.sheet->until); };
  return may_stop(scene) && (whole(scene.output) || whole(scene.requested));
}

/// What tells runs apart.
string request_of(const Scene& scene, const vector<Measure>& measures) {
  string text = scene.resolved + outputs_text(scene.output);
  for (const Measure& measure : measures) text += measure.name + "\n";

  // They may come from another run, and from meshes.
  State state = scene.initial;
  World world = scene.world;
  StateWriter read;
  read(state.position, state.velocity, world.radius, world.volume);
  for (Obstacle& obstacle : world.obstacles) read(obstacle.center, obstacle.volume);
  return text + read.take();
}

}  // namespace

bool draws_after_motion(const Scene& scene) {
  return may_stop(scene) || frames_motion(scene) || slows_down(scene) ||
         (scene.output.video && scene.output.video->chart);
}

Stages::Stages(span<const Show> shows, const RunSettings& settings, function<void()> stop_check)
    : shows_(shows.begin(), shows.end()),
      settings_(settings),
      stop_check_(std::move(stop_check)),
      stages_(shows.size()),
      failures_(shows.size()) {
  for (size_t i = 0; i < shows_.size(); ++i) guarded(i, [&] { open(i); });
}

bool Stages::may_last() const {
  return shows_.size() == 1 && shows_.front().renewed == nullptr && !settings_.replay && settings_.checkpoint_s > 0;
}

Stage* Stages::lasting() {
  return may_last() ? stages_.front().get() : nullptr;
}

/// Opens the folder of a show. What its pictures wait for becomes known later.
void Stages::open(size_t i) {
  Show& show = shows_[i];
  check_flights(*show.scene);
  if (needs_end(*show.scene) || slows_down(*show.scene)) show.scene = &awaiting_.emplace_back(*show.scene);
  const vector<Measure> measures = measures_of(*show.scene);
  function<string()> request;
  if (may_last()) request = [&scene = *show.scene, measures] { return request_of(scene, measures); };
  stages_[i] = make_unique<Stage>(show, settings_.durability, measures, request);
}

/// The measures of a scene and those of the settings, unless a former run has them.
vector<Measure> Stages::measures_of(const Scene& scene) const {
  if (settings_.former != nullptr) return {};
  vector<Measure> measures = own_measures(scene);
  measures.insert(measures.end(), settings_.measures.begin(), settings_.measures.end());
  return measures;
}

bool Stages::has_failed(size_t i) {
  const std::lock_guard lock(failing_);
  return failures_[i] != nullptr;
}

void Stages::guarded(size_t i, const function<void()>& work) {
  if (has_failed(i)) return;
  try {
    work();
  } catch (const std::exception&) {
    // ffmpeg also receives a Ctrl-C and ends first. What looks like a write error is then the interrupt.
    stop_check_();
    if (shows_.size() == 1) throw;
    const std::lock_guard lock(failing_);
    failures_[i] = std::current_exception();
  }
}

void Stages::each(const function<void(Stage&)>& work) {
  for (size_t i = 0; i < stages_.size(); ++i) guarded(i, [&] { work(*stages_[i]); });
}

vector<Stages::Standing> Stages::standing() {
  vector<Standing> standing;
  for (size_t i = 0; i < stages_.size(); ++i)
    if (!has_failed(i)) standing.push_back({stages_[i].get(), i});
  return standing;
}

Recording Stages::recording() const {
  Recording recording;
  for (const auto& stage : stages_) {
    if (!stage) continue;
    const Scene& scene = stage->scene;
    const bool paths = scene.output.flights || stage->exports.draws();
    recording.paths = recording.paths || paths;
    recording.collisions = recording.collisions || scene.output.needs_collisions() ||
                           stage->measuring.needs_collisions() || (paths && drawings_show_collisions(scene));

    // What the measures of all scenes need, in the order of the scenes.
    const vector<WatchedQuantity>& watched = stage->measuring.watched();
    recording.watch.insert(recording.watch.end(), watched.begin(), watched.end());
    const vector<WatchedImpulse>& impulses = stage->measuring.impulses();
    recording.impulses.insert(recording.impulses.end(), impulses.begin(), impulses.end());
  }
  return recording;
}

bool Stages::have_drawings() {
  return any_of(standing(), [](const Standing& each) { return each.stage->exports.draws(); });
}

bool Stages::draw_after_motion() const {
  return any_of(shows_, [](const Show& show) { return draws_after_motion(*show.scene); });
}

void Stages::take_motion(const optional<RunEnd>& end, const function<unique_ptr<Simulator>()>& motion) {
  for (Scene& scene : awaiting_) {
    if (end && end->time < scene.simulate.duration) scene.known.ends_at = end->time;
    if (slows_down(scene) && have_drawings()) scene.known.slows_at = find_slowdown(scene, motion, stop_check_);
  }
}

void Stages::begin_drawings() {
  each([&](Stage& stage) {
    if (stage.exports.draws() && !stage.drawings) stage.begin_drawings(stop_check_);
  });
}

uint64_t Stages::pictures() const {
  uint64_t pictures = 0;
  for (const auto& stage : stages_)
    if (stage) pictures += stage->exports.frames();
  return pictures;
}

uint64_t Stages::planned_pictures() const {
  uint64_t pictures = 0;
  for (const auto& stage : stages_)
    if (stage) pictures += stage->exports.planned_frames();
  return pictures;
}

vector<RunResult> Stages::finish(const Simulated& done) {
  vector<RunResult> results(shows_.size());
  for (size_t i = 0; i < shows_.size(); ++i) {
    guarded(i, [&] { finish(i, done, results[i]); });
    results[i].failure = failures_[i];
  }
  return results;
}

void Stages::finish(size_t i, const Simulated& done, RunResult& result) {
  Stage& stage = *stages_[i];
  const State& end = done.simulator->state();
  const Tally& tally = done.simulator->tally();
  result.engine = done.engine;
  result.summary = account_of(stage.scene, done.engine, done.start, end, tally);
  result.summary.warnings = settings_.former != nullptr
                                ? settings_.former->warnings
                                : warnings_of(stage.scene, done.engine, end, result.summary, tally);
  result.summary.status = result.summary.warnings.empty() ? "done" : "doubtful";
  result.summary.frames = stage.exports.frames();

  result.facts = stage.facts();
  result.facts.simulate_s = done.simulate_s;
  result.facts.peak_memory = peak_memory();
  result.facts.left_out = stage.exports.left_out();
  result.facts.tables = stage.exports.table_sizes();
  take_measures(i, done, result);
  stage.exports.finish(result.summary, result.facts);
}

void Stages::take_measures(size_t i, const Simulated& done, RunResult& result) const {
  const Stage& stage = *stages_[i];

  if (const Manifest* former = settings_.former; former != nullptr) {
    if (result.summary.collisions != former->collisions)
      throw ExportError(
          fmt::format("the motion differs: {} collisions, not {}", result.summary.collisions, former->collisions));
    result.facts.measures = former->measures;
  } else {
    // Those of this scene follow those of the scenes before it.
    size_t first = 0, first_impulse = 0;
    for (size_t k = 0; k < i; ++k) {
      if (!stages_[k]) continue;
      first += stages_[k]->measuring.watched().size();
      first_impulse += stages_[k]->measuring.impulses().size();
    }

    const vector<Extremes> all = done.simulator->extremes();
    const vector<double> impulses = done.simulator->impulses();
    result.facts.measures = stage.measuring.values(
        {done.simulator->state(), result.summary, span(all).subspan(first, stage.measuring.watched().size()),
         span(impulses).subspan(first_impulse, stage.measuring.impulses().size())});
  }

  for (const OwnMeasure& own : stage.scene.measures.own)
    for (const Measured& measured : result.facts.measures)
      if (measured.name == own.name) result.summary.measures.push_back(measured);
}

}  // namespace carom
