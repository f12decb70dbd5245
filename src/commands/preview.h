#pragma once
// What a scene's camera sees at time 0.

#include "physics/entity.h"
#include "std.h"

namespace carom {

class MovingCamera;

struct CameraPreview {
  string plus_x;                // where +x points in the picture: "right", "left", "up", "down", "away", "toward"
  double fov_x = 0, fov_y = 0;  // degrees, full angles
  string kind;                  // "still", "fit", "follow" or "path"
  bool moves = false;           // whether it is not the same at all times, as far as is known
  // m, the picture's size at the target of a parallel projection; none: of a perspective, or not known
  optional<array<double, 2>> parallel;
  // Bodies wholly outside the picture at time 0; none: not known.
  optional<vector<Entity>> out_of_view;
};

/// `known`: whether the place of a camera that frames the motion is known. Its direction always is.
CameraPreview preview_camera(const MovingCamera& camera, bool known);

}  // namespace carom
