#pragma once
// The camera as numbers: which way it looks, what it sees. Needs no OpenGL, so that `check` can ask.
#include "physics/state.h"
#include "scene/scene.h"

namespace carom {

/// The scene's camera, or where it names none, one that sees all bodies at time 0 (and the fixed things near them).
Camera camera_of(const Scene& scene);

/// Of the frames, else of the film, else what is usual.
Size picture_size(const Output& output);

/// The camera's right-handed frame and its angles.
struct CameraFrame {
  Vec3 right, up, forward;  // unit; right = forward x up
  double fov_x, fov_y;      // degrees, full angles
};
CameraFrame view_of(const Camera& camera, Size size);

/// Whether any part of a sphere is inside the picture (the view frustum, near and far included).
bool sees_sphere(const Camera& camera, const CameraFrame& view, const Vec3& center, double radius);

}  // namespace carom
