// Writes what is due at an instant, then draws what is due. Between the instants of the timeline there are those of a
// picture with motion blur, and those of states for trails.
// The state is computed only if something is due.
#include "run/stage.h"

#include "files/folder_writer.h"
#include "overlay/title_card.h"
#include "render/camera.h"
#include "render/glb.h"
#include "render/still_things.h"
#include "run/stopwatch.h"
#include "scene/film_layout.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// The scene, if the font of its pictures is there.
const Scene& with_font(const Scene& scene) {
  if (scene.output.pictures()) check_font(scene);
  return scene;
}

}  // namespace

TableSink::TableSink(OutputPart& part, Measuring& measuring) : part_(part), measuring_(measuring) {
  more_ = part_.timeline().advance();
}

void TableSink::record(const Simulator& simulator) {
  const Stopwatch stopwatch(export_s_);
  part_.record(simulator.collisions());
  part_.record_crossings(simulator.crossings());
  part_.record_paths(simulator.paths());
  measuring_.record(simulator.collisions(), simulator.crossings());
}

void TableSink::sample(const Sample& at) {
  if (part_.needs_state()) {
    const State& state = at.state();
    const Stopwatch stopwatch(export_s_);
    part_.sample(state, needs_contacts() ? at.simulator.contacts() : span<const ContactForce>{});
  }
  more_ = part_.timeline().advance();
}

DrawingSink::DrawingSink(const Scene& scene, Exports& exports, const string& run, MovingCamera& of_model,
                         function<void()> stop_check)
    : scene_(scene),
      exports_(exports),
      of_model_(of_model),
      stop_check_(std::move(stop_check)),
      history_(scene, overlay_needs(scene)) {
  for (const PictureStream& stream : exports.pictures()) series_.emplace_back(scene, stream, history_, run);
  more_ = part().timeline().advance();
  aim();
}

void DrawingSink::aim() {
  for (size_t i = 0; i < series_.size(); ++i)
    series_[i].aim(part().timeline().next(exports_.pictures()[i].timeline_stream));
}

bool DrawingSink::is_picture_due(size_t stream) {
  return part().timeline().due(exports_.pictures()[stream].timeline_stream).has_value();
}

double DrawingSink::time() {
  double next = min(part().timeline().time(), history_.next_sample());
  for (const PictureSeries& series : series_) next = min(next, series.next_instant());
  return next;
}

void DrawingSink::end_at(double time) {
  exports_.end_drawings_at(time);
  aim();
}

void DrawingSink::record(const Simulator& simulator) {
  exports_.record_drawings(simulator.collisions(), simulator.paths());
  history_.record(simulator.collisions());
  history_.record_paths(simulator.paths());
}

bool DrawingSink::needs_state(double time) {
  const auto is_due = [&](const PictureStream& stream) {
    return part().timeline().due(stream.timeline_stream).has_value();
  };
  return (part().timeline().time() <= time && (part().needs_state() || any_of(exports_.pictures(), is_due))) ||
         history_.next_sample() <= time ||
         any_of(series_, [&](const PictureSeries& series) { return series.next_instant() <= time; });
}

vector<MovingCamera*> DrawingSink::cameras() {
  vector<MovingCamera*> cameras;
  for (PictureSeries& series : series_) cameras.push_back(&series.camera());
  if (scene_.output.gltf) cameras.push_back(&of_model_);
  return cameras;
}

vector<FilmChart*> DrawingSink::charts() {
  vector<FilmChart*> charts;
  for (PictureSeries& series : series_)
    if (FilmChart* chart = series.chart()) charts.push_back(chart);
  return charts;
}

void DrawingSink::sample(const Sample& at) {
  const double time = at.simulator.time();
  const bool on_timeline = part().timeline().time() <= time;

  if (needs_state(time)) {
    const State& state = at.state();
    history_.sample(state);
    if (on_timeline && part().needs_state()) {
      const Stopwatch stopwatch(export_s_);
      part().sample(state);
    }

    for (size_t i = 0; i < series_.size(); ++i) {
      if (on_timeline && is_picture_due(i))
        draw(i, at);
      else if (series_[i].next_instant() <= time)
        expose(i, state);
    }
  }

  if (!on_timeline) return;
  more_ = part().timeline().advance();
  aim();
}

void DrawingSink::expose(size_t stream, const State& state) {
  stop_check_();
  const Stopwatch stopwatch(render_s_);
  series_[stream].expose(state);
}

void DrawingSink::draw(size_t stream, const Sample& at) {
  stop_check_();
  const Image* image = nullptr;
  {
    const Stopwatch stopwatch(render_s_);
    image = &series_[stream].picture(at.state(), at.simulator.tally());
  }
  if (exports_.begins_with_title(stream)) begin_with_title(*image);
  const Stopwatch stopwatch(export_s_);
  exports_.picture(stream, *image, series_[stream].is_repeated());
}

void DrawingSink::begin_with_title(const Image& first) {
  const Stopwatch stopwatch(render_s_);
  const VideoOutput& video = *scene_.output.video;
  TitleCard card(scene_.title, first);
  for (int64_t left = title_pictures(video); left > 0; --left)
    exports_.title_picture(card.picture(double(left) / video.fps));
}

Stage::Stage(const Show& show, Durability durability, vector<Measure> measures, function<string()> request)
    : scene(with_font(*show.scene)),
      run(name_of_folder(show.folder)),
      of_model(scene, picture_size(scene.output)),
      measuring(scene, std::move(measures)),
      exports(scene, show.folder, durability,
              {[](const Scene& of, const Extent& seen) { return still_things(of, seen, false); }, glb,
               [this](const State& state) { return of_model.at(state); }},
              show.renewed, std::move(request)),
      tables(exports.tables(), measuring) {
  loaded.load_s = show.load_s;
  loaded.origin = show.origin;
}

void Stage::begin_drawings(function<void()> stop_check) {
  exports.begin_drawings();
  drawings.emplace(scene, exports, run, of_model, std::move(stop_check));
}

RunFacts Stage::facts() const {
  RunFacts facts = loaded;
  facts.export_s = tables.export_s();
  if (!drawings) return facts;
  facts.render_s = drawings->render_s();
  facts.export_s += drawings->export_s();
  return facts;
}

}  // namespace carom
