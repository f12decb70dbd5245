#pragma once
// The camera that frames a motion: from the front, slightly from above, as near as the bodies allow.
#include "physics/state.h"
#include "render/camera.h"
#include "render/motion_view.h"
#include "scene/scene.h"

namespace carom {

/// Collects a motion instant by instant, and frames it. motion_view.h has what is in view.
class CameraFit {
 public:
  /// `scene` must outlive this object. `size`: of the pictures.
  CameraFit(const Scene& scene, Size size);

  /// Takes the next instant in order.
  void add(const State& state);
  /// For the instants so far.
  Camera camera() const;

 private:
  Camera lens_;
  MotionView motion_;  // from low, and from higher up
};

}  // namespace carom
