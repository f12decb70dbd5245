#pragma once
// The camera as numbers: its direction and its field of view. It needs no OpenGL, so that `check` can use it too.
#include "physics/state.h"
#include "scene/scene.h"

namespace carom {

/// The scene's camera. Without one, it is a camera that sees all bodies at time 0 and the fixed things near them.
Camera camera_of(const Scene& scene);

/// The size of the frames. Without frames it is that of the film, and without a film the default.
Size picture_size(const Output& output);

/// The camera's right-handed frame and its angles.
struct CameraFrame {
  Vec3 right, up, forward;  // unit; right = forward x up
  double fov_x, fov_y;      // degrees, full angles
};
CameraFrame view_of(const Camera& camera, Size size);

/// Whether any part of a sphere is inside the picture (the view frustum, near and far included).
bool is_sphere_in_view(const Camera& camera, const CameraFrame& view, const Vec3& center, double radius);

}  // namespace carom
