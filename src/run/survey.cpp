// The window of time is that of the pictures that the scene requests, whatever --only leaves: the same picture is the
// same in each run of a scene. The instants do not depend on how many pictures there are.
#include "run/survey.h"

#include "export/picture_streams.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// The time that a sheet alone is taken to last as a film.
constexpr double seconds_of_few = 10;

double duration_of(span<MovingCamera* const> cameras) {
  return cameras.empty() ? 0 : cameras.front()->scene().simulate.duration;
}

/// The part of a motion that pictures show.
struct ShownTime {
  double from = infinity, until = 0;  // s
  double pace = 1;                    // seconds of motion a second of film
};

ShownTime shown_time(const Scene& scene) {
  ShownTime shown;
  for (const Ticks& ticks : shown_instants(scene)) {
    if (ticks.count() < 1) continue;
    shown.from = min(shown.from, ticks.at(ticks.first()));
    shown.until = max(shown.until, ticks.at(ticks.last()));
  }
  shown.from = min(shown.from, shown.until);

  const Output& output = scene.requested.pictures() ? scene.requested : scene.output;
  if (output.video)
    shown.pace = output.video->speed;
  else if (shown.from < shown.until && !output.frames)
    // Few pictures are looked at for some time.
    shown.pace = (shown.until - shown.from) / seconds_of_few;
  return shown;
}

}  // namespace

int Surveying::add(const Ticks& ticks) {
  end_ = max(end_, ticks.at(ticks.last()));
  return timeline_.add(ticks);
}

void Surveying::advance() {
  more_ = timeline_.advance() && timeline_.time() <= end_;
}

Framing::Framing(span<MovingCamera* const> cameras) : Surveying(duration_of(cameras)) {
  for (MovingCamera* camera : cameras) {
    if (!camera->frames_motion()) continue;
    const Scene& scene = camera->scene();
    const auto same = ranges::find(framed_, &scene, &Framed::scene);
    if (same != framed_.end()) {
      same->cameras.push_back(camera);
      continue;
    }

    const ShownTime shown = shown_time(scene);
    const int64_t count = shown.from < shown.until ? worthwhile_instants(scene.world.body_count()) : 1;
    const int stream = add(Ticks::even(count, shown.from, shown.until));
    framed_.push_back({&scene, MotionSamples(scene), stream, {camera}});
  }
  if (any()) advance();
}

void Framing::record(const Simulator& simulator) {
  for (Framed& framed : framed_) framed.samples.strike(simulator.collisions());
}

void Framing::sample(const Sample& at) {
  for (Framed& framed : framed_)
    if (due(framed.stream)) framed.samples.add(at.state());
  advance();
}

void Framing::finish() {
  for (Framed& framed : framed_)
    for (MovingCamera* const camera : framed.cameras)
      camera->frame(frame_views(*framed.scene, framed.samples, camera->size(), shown_time(*framed.scene).pace));
}

Charting::Charting(span<FilmChart* const> charts)
    : Surveying(charts.empty() ? 0 : charts.front()->scene().simulate.duration), charts_(charts.begin(), charts.end()) {
  for (const FilmChart* chart : charts_) streams_.push_back(add(chart->instants()));
  if (any()) advance();
}

void Charting::sample(const Sample& at) {
  for (size_t i = 0; i < charts_.size(); ++i)
    if (due(streams_[i])) charts_[i]->take(at.state());
  advance();
}

void Charting::finish() {
  for (FilmChart* chart : charts_) chart->settle();
}

void survey(span<MovingCamera* const> cameras, Simulator& simulator, const function<void()>& stop_check,
            span<FilmChart* const> charts) {
  Framing framing(cameras);
  Charting charting(charts);
  MotionSink* const sinks[] = {&framing, &charting};
  const double duration = charts.empty() ? duration_of(cameras) : charts.front()->scene().simulate.duration;
  try {
    carry_through(simulator, sinks, duration, unguarded, {.stop_check = stop_check});
  } catch (const SimulationError&) {
    // The run comes to the same instant, and reports it.
  }
  framing.finish();
  charting.finish();
}

}  // namespace carom
