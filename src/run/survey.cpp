// Positions at the instants of pictures are all that the pictures show, so that the way between them needs no search
// for extremes. The instants are those that the scene requests, whatever --only leaves: the same picture is the same in
// each run of a scene.
#include "run/survey.h"

#include "export/picture_streams.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

double duration_of(span<MovingCamera* const> cameras) {
  return cameras.empty() ? 0 : cameras.front()->scene().simulate.duration;
}

}  // namespace

Framing::Framing(span<MovingCamera* const> cameras) : timeline_(duration_of(cameras)) {
  for (MovingCamera* camera : cameras) {
    if (!camera->frames_motion()) continue;
    Framed& framed = framed_.emplace_back(Framed{camera, CameraFit(camera->scene(), camera->size()), {}});
    for (const Ticks& ticks : shown_instants(camera->scene())) {
      framed.streams.push_back(timeline_.add(ticks));
      if (ticks.count() > 0) end_ = max(end_, ticks.at(ticks.last()));
    }
  }
  if (any()) advance();
}

void Framing::advance() {
  more_ = timeline_.advance() && timeline_.time() <= end_;
}

void Framing::sample(Simulator& simulator) {
  for (Framed& framed : framed_) {
    const auto is_due = [&](int stream) { return timeline_.due(stream).has_value(); };
    if (any_of(framed.streams, is_due)) framed.fit.add(simulator.state());
  }
  advance();
}

void Framing::finish() {
  for (Framed& framed : framed_) framed.camera->frame(framed.fit.camera());
}

Charting::Charting(span<FilmChart* const> charts)
    : charts_(charts.begin(), charts.end()), timeline_(charts.empty() ? 0 : charts.front()->scene().simulate.duration) {
  for (const FilmChart* chart : charts_) {
    const Ticks ticks = chart->instants();
    streams_.push_back(timeline_.add(ticks));
    end_ = max(end_, ticks.at(ticks.last()));
  }
  if (any()) advance();
}

void Charting::advance() {
  more_ = timeline_.advance() && timeline_.time() <= end_;
}

void Charting::sample(Simulator& simulator) {
  for (size_t i = 0; i < charts_.size(); ++i)
    if (timeline_.due(streams_[i])) charts_[i]->take(simulator.state());
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
