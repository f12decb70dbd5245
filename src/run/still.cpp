#include "run/still.h"

#include "export/picture_streams.h"
#include "run/shot.h"
#include "run/survey.h"
#include "scene/scene.h"

namespace carom {

Image draw_still(const Scene& scene, double time, const std::function<std::unique_ptr<Simulator>()>& motion,
                 const std::function<void()>& stop_check) {
  const PictureOutput model = sheet_model(scene.output);
  Shot shot(scene, model.size, model.samples);
  if (shot.camera.frames_motion()) {
    MovingCamera* const cameras[] = {&shot.camera};
    survey(cameras, *motion(), stop_check);
  }
  const auto simulator = motion();
  carry_to(*simulator, time, scene.simulate.duration, stop_check);
  return shot.draw(simulator->state());
}

}  // namespace carom
