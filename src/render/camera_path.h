#pragma once
// The views between the keyframes of a camera.

#include "numerics/monotone_cubic.h"
#include "numerics/monotone_path.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// A smooth path: no coordinate of eye and target, nor fov, leaves the range of two neighbouring keyframes. Before the
/// first keyframe and after the last one the camera stands still.
class CameraPath {
 public:
  /// At least one, ascending in time.
  explicit CameraPath(const vector<Keyframe>& keys);

  Keyframe at(double time) const { return {time, eye_(time), target_(time), fov_(time)}; }  // s

 private:
  MonotonePath eye_, target_;
  MonotoneCubic fov_;
};

}  // namespace carom
