// A camera that follows has the very displacement of the bodies' centre of mass. The body thus stays at one point of
// the picture, also at a bounce, where the camera turns as sharply as the body does. A smoothed path would let the body
// slip out of place, most of all at the bounces. The centre of a group moves on smoothly when its members collide.
#include "render/moving_camera.h"

#include "physics/center_of_mass.h"
#include "render/camera_fit.h"
#include "render/frustum.h"
#include "render/parallel.h"

namespace carom {
namespace {

/// Without an eye, the free view around each followed body, in its own radii.
constexpr double room_around = 8;

/// The camera of time 0 that has the followed bodies in view, and some room around them.
void find_eye(Camera& camera, const Scene& scene, const Followed& followed, Size size) {
  const Frustum frustum(camera, size, slight_elevation);
  Frustum::Reach reach;
  for (Entity body = followed.first; body < followed.first + followed.count; ++body)
    frustum.add(reach, scene.initial.position[body], room_around * scene.world.radius[body]);
  const double distance = frustum.distance(reach, camera.target);
  camera.eye = camera.target - distance * frustum.view().forward;
  camera.near = distance / 1000;
  camera.far = distance * 1000;
}

}  // namespace

MovingCamera::MovingCamera(const Scene& scene, Size size) : scene_(scene), size_(size) {
  if (!scene.camera) return;
  camera_ = *scene.camera;
  orbit_ = scene.camera->orbit;
  if (!scene.camera->path.empty()) path_.emplace(scene.camera->path);
  followed_ = scene.camera->follow;
  if (!followed_) return;
  center_ = center_of_mass(scene.world, followed_->first, followed_->count, scene.initial.position);
  if (!followed_->has_eye) find_eye(camera_, scene, *followed_, size);
}

void MovingCamera::frame(CameraViews views) {
  camera_ = views.camera;
  path_.reset();
  if (!views.path.empty()) path_.emplace(views.path);
  faded_ = std::move(views.faded);
}

Camera MovingCamera::at(const State& state) const {
  Camera camera = camera_;

  if (path_) {
    const Keyframe view = path_->at(state.time);
    camera.eye = view.eye;
    camera.target = view.target;
    camera.fov = view.fov;
  }

  if (followed_) {
    const Vec3 way = center_of_mass(scene_.world, followed_->first, followed_->count, state.position) - center_;
    camera.eye += way;
    camera.target += way;
  }

  if (orbit_ > 0) camera = turned(camera, 360 * state.time / orbit_);
  // A framed motion has been seen from afar.
  const bool parallel = scene_.camera && scene_.camera->orthographic && !frames_motion();
  return parallel ? from_afar(camera) : camera;
}

Camera camera_of(const Scene& scene) {
  MovingCamera camera(scene, picture_size(scene.output));
  if (camera.frames_motion()) {
    CameraFit fit(scene, camera.size());
    fit.add(scene.initial);
    camera.frame(fit.views());
  }
  return camera.at(scene.initial);
}

}  // namespace carom
