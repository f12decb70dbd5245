#pragma once
// The camera of a scene's pictures at each instant.

#include "physics/state.h"
#include "render/camera.h"
#include "render/camera_path.h"
#include "render/camera_views.h"
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
  bool stands_still() const { return !path_ && !followed_ && orbit_ == 0; }

  /// Takes the views that frame the motion.
  void frame(CameraViews views);
  /// The walls and obstacles to be faded (CameraViews).
  const vector<uint32_t>& faded() const { return faded_; }
  /// The camera at the state's time. A parallel projection is seen from afar (parallel.h).
  Camera at(const State& state) const;

 private:
  const Scene& scene_;
  Size size_;
  Camera camera_;     // at time 0
  double orbit_ = 0;  // s, of a round; 0: it makes none
  vector<uint32_t> faded_;
  optional<CameraPath> path_;
  optional<Followed> followed_;
  Vec3 center_ = Vec3::Zero();  // m, of the followed bodies at time 0
};

}  // namespace carom
