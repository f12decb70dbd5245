// Positions at the instants of pictures are all that the pictures show, so that the way between them needs no search
// for extremes. The instants are those that the scene requests, whatever --only leaves: the same picture is the same in
// each run of a scene.
#include "run/survey.h"

#include <algorithm>
#include <vector>

#include "export/picture_streams.h"
#include "export/timeline.h"
#include "render/camera_fit.h"

namespace carom {
namespace {

/// One camera in the making.
struct Framing {
  MovingCamera* camera;
  CameraFit fit;
  std::vector<int> streams;  // of the timeline
};

}  // namespace

void carry_to(Simulator& simulator, double time, double duration, const std::function<void()>& stop_check) {
  const double piece = duration / 1000;
  while (simulator.time() < time) {
    stop_check();
    const double next = std::min(time, simulator.time() + piece);
    simulator.advance_to(next > simulator.time() ? next : time);
  }
}

void survey(std::span<MovingCamera* const> cameras, Simulator& simulator, const std::function<void()>& stop_check) {
  std::vector<Framing> framings;
  for (MovingCamera* camera : cameras)
    if (camera->frames_motion()) framings.push_back({camera, CameraFit(camera->scene(), camera->size()), {}});
  if (framings.empty()) return;
  const double duration = framings.front().camera->scene().simulate.duration;
  Timeline timeline(duration);
  double end = 0;
  for (Framing& framing : framings)
    for (const Ticks& ticks : shown_instants(framing.camera->scene())) {
      framing.streams.push_back(timeline.add(ticks));
      if (ticks.count() > 0) end = std::max(end, ticks.at(ticks.last()));
    }
  try {
    while (timeline.advance() && timeline.time() <= end) {
      carry_to(simulator, timeline.time(), duration, stop_check);
      for (Framing& framing : framings) {
        const auto is_due = [&](int stream) { return timeline.due(stream).has_value(); };
        if (std::any_of(framing.streams.begin(), framing.streams.end(), is_due)) framing.fit.add(simulator.state());
      }
    }
  } catch (const SimulationError&) {
    // The run comes to the same instant, and reports it.
  }
  for (Framing& framing : framings) framing.camera->frame(framing.fit.camera());
}

}  // namespace carom
