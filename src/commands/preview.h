#pragma once
// What a scene's camera sees at time 0.
#include <string>
#include <vector>

#include "physics/entity.h"

namespace carom {

struct Scene;

struct CameraPreview {
  std::string plus_x;               // where +x points in the picture: "right", "left", "up", "down", "away", "toward"
  double fov_x = 0, fov_y = 0;      // degrees, full angles
  std::vector<Entity> out_of_view;  // bodies wholly outside the picture at time 0
};

/// For the scene's camera, or the default camera if it has none.
CameraPreview preview_camera(const Scene& scene);

}  // namespace carom
