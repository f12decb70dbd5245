// Tests the initial bodies against the camera's frustum. No picture is drawn, so check needs no renderer.
#include "commands/preview.h"

#include "physics/world.h"
#include "render/eye.h"
#include "render/moving_camera.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

// The picture's axis closest to +x; away or toward only if +x has no length in the picture.
string direction_of_plus_x(const CameraFrame& view) {
  const double right = view.right.x(), up = view.up.x();
  if (max(std::abs(right), std::abs(up)) < 1e-9) return view.forward.x() > 0 ? "away" : "toward";
  if (std::abs(right) >= std::abs(up)) return right > 0 ? "right" : "left";
  return up > 0 ? "up" : "down";
}

string kind_of(const MovingCamera& camera) {
  if (camera.frames_motion()) return "fit";
  return camera.scene().camera->follow ? "follow" : camera.stands_still() ? "still" : "path";
}

}  // namespace

CameraPreview preview_camera(const MovingCamera& moving, bool known) {
  const Scene& scene = moving.scene();
  const Camera camera = moving.at(scene.initial);
  const CameraFrame view = view_of(camera, moving.size());

  CameraPreview preview;
  preview.plus_x = direction_of_plus_x(view);
  preview.fov_x = view.fov_x;
  preview.fov_y = view.fov_y;
  preview.kind = kind_of(moving);
  preview.moves = !moving.stands_still();
  if (!known) return preview;

  if (scene.camera && scene.camera->orthographic) {
    const Eye eye(camera, moving.size());
    const double twice = 2 * (camera.target - camera.eye).norm();
    preview.parallel = {twice * eye.tan_x, twice * eye.tan_y};
  }

  preview.out_of_view.emplace();
  for (Entity body = 0; body < scene.world.body_count(); ++body) {
    if (!is_sphere_in_view(camera, view, scene.initial.position[body], scene.world.radius[body]))
      preview.out_of_view->push_back(body);
  }
  return preview;
}

}  // namespace carom
