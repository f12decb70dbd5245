// Writes what is due at an instant, then draws what is due. Between the instants of the timeline there are those of a
// picture with motion blur, and those of states for trails.
// The state is computed only if something is due.
#include "run/stage.h"

#include <algorithm>

#include "files/open_folder.h"
#include "render/camera.h"
#include "render/glb.h"
#include "render/still_things.h"
#include "run/stopwatch.h"

namespace carom {
namespace {

/// The scene, if the font of its pictures is there.
const Scene& with_font(const Scene& scene) {
  if (scene.output.pictures()) check_font(scene);
  return scene;
}

}  // namespace

Stage::Stage(const Show& show, Durability durability, std::vector<Measure> measures)
    : scene(with_font(*show.scene)),
      measuring(scene, std::move(measures)),
      exports(scene, show.folder, durability,
              {[](const Scene& of, const Extent& seen) { return still_things(of, seen, false); }, glb,
               [this](const State& state) { return of_model_.at(state); }},
              show.renewed),
      history_(scene, overlay_needs(scene)),
      of_model_(scene, picture_size(scene.output)) {
  facts.load_s = show.load_s;
  facts.origin = show.origin;
  for (const PictureStream& stream : exports.pictures())
    series_.emplace_back(scene, stream, history_, name_of_folder(show.folder));
  more = exports.timeline().advance();
  aim();
}

void Stage::aim() {
  for (std::size_t i = 0; i < series_.size(); ++i)
    series_[i].aim(exports.timeline().next(exports.pictures()[i].timeline_stream));
}

bool Stage::is_picture_due(std::size_t stream) {
  return exports.timeline().due(exports.pictures()[stream].timeline_stream).has_value();
}

double Stage::time() {
  double next = std::min(exports.timeline().time(), history_.next_sample());
  for (const PictureSeries& series : series_) next = std::min(next, series.next_instant());
  return next;
}

void Stage::end_at(double time) {
  exports.end_at(time);
  aim();
}

void Stage::record(const Simulator& simulator) {
  const std::span<const Collision> collisions = simulator.collisions();
  const std::span<const PathPiece> paths = simulator.paths();
  exports.record(collisions);
  measuring.record(collisions, simulator.crossings());
  exports.record_crossings(simulator.crossings());
  exports.record_paths(paths);
  history_.record(collisions);
  history_.record_paths(paths);
}

bool Stage::needs_state(double time) {
  return (exports.timeline().time() <= time && exports.needs_state()) || history_.next_sample() <= time ||
         std::any_of(series_.begin(), series_.end(),
                     [&](const PictureSeries& series) { return series.next_instant() <= time; });
}

std::vector<MovingCamera*> Stage::cameras() {
  std::vector<MovingCamera*> cameras;
  for (PictureSeries& series : series_) cameras.push_back(&series.camera());
  if (scene.output.gltf) cameras.push_back(&of_model_);
  return cameras;
}

void Stage::sample(Simulator& simulator, const StageWatch& watch) {
  const double time = simulator.time();
  const bool on_timeline = exports.timeline().time() <= time;
  if (needs_state(time)) {
    const State& state = simulator.state();
    history_.sample(state);
    if (on_timeline && exports.needs_state()) {
      const Stopwatch stopwatch(facts.export_s);
      exports.sample(state, exports.needs_contacts() ? simulator.contacts() : std::span<const ContactForce>{});
    }
    for (std::size_t i = 0; i < series_.size(); ++i) {
      if (on_timeline && is_picture_due(i))
        draw(i, simulator, watch);
      else if (series_[i].next_instant() <= time)
        expose(i, state, watch);
    }
  }
  if (!on_timeline) return;
  more = exports.timeline().advance();
  aim();
}

void Stage::expose(std::size_t stream, const State& state, const StageWatch& watch) {
  watch.stop_check();
  const Stopwatch stopwatch(facts.render_s);
  series_[stream].expose(state);
}

void Stage::draw(std::size_t stream, Simulator& simulator, const StageWatch& watch) {
  watch.stop_check();
  const Image* image = nullptr;
  {
    const Stopwatch stopwatch(facts.render_s);
    image = &series_[stream].picture(simulator.state(), simulator.tally());
  }
  {
    const Stopwatch stopwatch(facts.export_s);
    exports.picture(stream, *image, series_[stream].is_repeated());
  }
  watch.report_progress();
}

}  // namespace carom
