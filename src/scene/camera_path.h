#pragma once
// The views between the keyframes of a camera.
#include <array>
#include <vector>

#include "numerics/monotone_cubic.h"
#include "scene/scene.h"

namespace carom {

/// A smooth path: each coordinate of eye and target, and fov, is a monotone cubic between two keyframes. None leaves
/// the range of the two values. Before the first keyframe and after the last one the camera stands still.
class CameraPath {
 public:
  /// At least one, ascending in time.
  explicit CameraPath(const std::vector<Keyframe>& keys);

  Keyframe at(double time) const;  // s
  /// Target less eye (m) from keyframe i to the next: the polynomial of each coordinate in s, with s from 0 to 1.
  std::array<std::array<double, 4>, 3> sight(std::size_t i) const;

 private:
  std::vector<MonotoneCubic> eye_, target_;  // x, y, z
  MonotoneCubic fov_;
};

}  // namespace carom
