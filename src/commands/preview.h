#pragma once
// What can be told of a scene before it is run: its first collision, and what its camera sees.
#include <optional>
#include <string>
#include <vector>

#include "physics/collision.h"
#include "scene/scene.h"

namespace carom {

struct FirstCollision {
  std::optional<Collision> collision;  // none: none before the duration
  std::string trouble;                 // why it is not known; empty: it is
};

/// By the exact simulator, whatever engine the scene names, no further than to the first collision.
FirstCollision predict_first_collision(const Scene& scene);

struct CameraPreview {
  std::string plus_x;               // where +x points in the picture: "right", "left", "up", "down", "away", "toward"
  double fov_x = 0, fov_y = 0;      // degrees, full angles
  std::vector<Entity> out_of_view;  // bodies no part of which is in the picture at time 0
};

/// Of the scene's camera, or of the one that a picture without camera would be taken with.
CameraPreview preview_camera(const Scene& scene);

}  // namespace carom
