#include "run/still.h"

#include "export/picture_streams.h"
#include "overlay/history.h"
#include "run/picture_series.h"
#include "run/survey.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

Image draw_still(const Scene& scene, const string& run, double time, const function<unique_ptr<Simulator>()>& motion,
                 const function<void()>& stop_check) {
  const PictureStream stream = still_stream(scene, time);
  History history(scene, picture_needs(scene));
  PictureSeries series(scene, stream, history, run);

  // A camera that frames the motion has to see it first.
  if (series.camera().frames_motion()) {
    MovingCamera* const cameras[] = {&series.camera()};
    survey(cameras, *motion(), stop_check);
  }

  const auto simulator = motion();
  const auto record = [&] {
    history.record(simulator->collisions());
    history.record_paths(simulator->paths());
  };
  record();
  series.aim(time);

  const double piece = scene.simulate.duration / 1000;
  for (;;) {
    // States before that of the picture are needed for motion blur and trails.
    const double next = min({time, history.next_sample(), series.next_instant()});
    while (simulator->time() < next) {
      stop_check();
      const double soon = min(next, simulator->time() + piece);
      simulator->advance_to(soon > simulator->time() ? soon : next);
      record();
    }
    history.sample(simulator->state());
    if (next >= time) break;
    if (series.next_instant() <= next) series.expose(simulator->state());
  }
  return series.picture(simulator->state(), simulator->tally());
}

}  // namespace carom
