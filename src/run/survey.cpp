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

void survey(span<MovingCamera* const> cameras, Simulator& simulator, const function<void()>& stop_check) {
  Framing framing(cameras);
  MotionSink* const sinks[] = {&framing};
  try {
    carry_through(simulator, sinks, duration_of(cameras), unguarded, {.stop_check = stop_check});
  } catch (const SimulationError&) {
    // The run comes to the same instant, and reports it.
  }
  framing.finish();
}

}  // namespace carom
