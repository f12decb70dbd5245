#pragma once
// The camera of a scene's pictures at each instant.

#include "physics/state.h"
#include "render/camera.h"
#include "render/camera_path.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// Of pictures of one size. One that frames the motion needs the motion first: frames_motion(), camera_fit.h, frame().
class MovingCamera {
 public:
  /// `scene` must outlive this object.
  MovingCamera(const Scene& scene, Size size);

  const Scene& scene() const { return scene_; }
  Size size() const { return size_; }
  bool frames_motion() const { return carom::frames_motion(scene_); }
  bool stands_still() const { return !path_ && !followed_; }

  /// Takes the camera that frames the motion.
  void frame(const Camera& fitted) { camera_ = fitted; }
  /// The camera at the state's time.
  Camera at(const State& state) const;

 private:
  const Scene& scene_;
  Size size_;
  Camera camera_;  // at time 0
  optional<CameraPath> path_;
  optional<Followed> followed_;
  Vec3 center_ = Vec3::Zero();  // m, of the followed bodies at time 0
};

}  // namespace carom
