#pragma once
// The camera as numbers: its direction and its field of view. It needs no renderer, so that `check` can use it too.
#include "numerics/vec3.h"
#include "scene/scene.h"

namespace carom {

/// The scene's camera at time 0. One that frames the motion frames the bodies of time 0 alone, as far as is known here:
/// camera_fit.h takes the motion into account.
Camera camera_of(const Scene& scene);

/// The size of the frames. Without frames it is that of the film, and without a film the default.
Size picture_size(const Output& output);

/// The camera's right-handed frame and its angles.
struct CameraFrame {
  Vec3 right, up, forward;  // unit; right = forward x up
  double fov_x, fov_y;      // degrees, full angles
};
CameraFrame view_of(const Camera& camera, Size size);

/// The camera as it goes round its target by an angle (degrees) about `up`, counterclockwise from above.
Camera turned(const Camera& camera, double angle);

/// Whether any part of a sphere is inside the picture (the view frustum, near and far included).
bool is_sphere_in_view(const Camera& camera, const CameraFrame& view, const Vec3& center, double radius);

}  // namespace carom
