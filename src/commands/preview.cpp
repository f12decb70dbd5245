// Tests the initial bodies against the camera's frustum. No picture is drawn, so check needs no OpenGL.
#include "commands/preview.h"

#include <algorithm>
#include <cmath>

#include "physics/world.h"
#include "render/camera.h"
#include "scene/scene.h"

namespace carom {

namespace {

// The picture's axis closest to +x; away or toward only if +x has no length in the picture.
std::string direction_of_plus_x(const CameraFrame& view) {
  const double right = view.right.x(), up = view.up.x();
  if (std::max(std::abs(right), std::abs(up)) < 1e-9) return view.forward.x() > 0 ? "away" : "toward";
  if (std::abs(right) >= std::abs(up)) return right > 0 ? "right" : "left";
  return up > 0 ? "up" : "down";
}

}  // namespace

CameraPreview preview_camera(const Scene& scene) {
  const Camera camera = camera_of(scene);
  const CameraFrame view = view_of(camera, picture_size(scene.output));
  CameraPreview preview;
  preview.plus_x = direction_of_plus_x(view);
  preview.fov_x = view.fov_x;
  preview.fov_y = view.fov_y;
  for (Entity body = 0; body < scene.world.body_count(); ++body) {
    if (!is_sphere_in_view(camera, view, scene.initial.position[body], scene.world.radius[body])) {
      preview.out_of_view.push_back(body);
    }
  }
  return preview;
}

}  // namespace carom
