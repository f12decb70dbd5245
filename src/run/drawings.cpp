#include "run/drawings.h"

#include "run/record_queue.h"
#include "run/replay.h"
#include "run/stopwatch.h"
#include "run/survey.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The stages that draw.
vector<Stages::Standing> Drawings::drawn() {
  vector<Stages::Standing> standing = stages_.standing();
  std::erase_if(standing, [](const Stages::Standing& each) { return !each.stage->drawings; });
  return standing;
}

vector<MovingCamera*> Drawings::framing_cameras() {
  vector<MovingCamera*> framing;
  for (const Stages::Standing& each : drawn())
    for (MovingCamera* camera : each.stage->drawings->cameras())
      if (camera->frames_motion()) framing.push_back(camera);
  return framing;
}

vector<FilmChart*> Drawings::charts() {
  vector<FilmChart*> charts;
  for (const Stages::Standing& each : drawn())
    for (FilmChart* chart : each.stage->drawings->charts()) charts.push_back(chart);
  return charts;
}

void Drawings::prepare(const function<void()>& work) {
  double seconds = 0;
  {
    const Stopwatch stopwatch(seconds);
    work();
  }
  const vector<Stages::Standing> standing = drawn();
  for (const Stages::Standing& each : standing) each.stage->drawings->count(seconds / double(standing.size()));
}

void Drawings::follow(RecordQueue& queue) {
  const auto next = [&queue](Recorded& recorded) { return queue.next(recorded); };
  try {
    draw_all([&] { return make_unique<Replay>(scene_.world, next, Tally{}, true); });
  } catch (const RecordAbandoned&) {
    // The simulation has failed, and its error is the run's.
  } catch (...) {
    queue.leave();
    throw;
  }
  queue.leave();
}

void Drawings::draw(const MakeMotion& motion, bool surveyed) {
  const vector<MovingCamera*> cameras = framing_cameras();
  const vector<FilmChart*> its_charts = charts();
  if (!surveyed && !(cameras.empty() && its_charts.empty()))
    prepare([&] { survey(cameras, *motion(), stop_check_, its_charts); });
  draw_all(motion);
}

void Drawings::draw_all(const MakeMotion& motion) {
  const vector<Stages::Standing> standing = drawn();
  vector<MotionSink*> sinks;
  for (const Stages::Standing& each : standing) sinks.push_back(&*each.stage->drawings);

  const unique_ptr<Simulator> simulator = motion();
  const SinkGuard guard = [&](size_t sink, const function<void()>& work) {
    stages_.guarded(standing[sink].show, work);
  };
  carry_through(*simulator, sinks, scene_.simulate.duration, guard, {.stop_check = stop_check_});
}

void Drawings::end(const Tally& tally) {
  stages_.each([&tally](Stage& stage) {
    if (stage.drawings) stage.exports.drawings().end(tally);
  });
}

}  // namespace carom
