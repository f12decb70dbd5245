#pragma once
// What the lines of one picture are made from.

#include "overlay/body_colors.h"
#include "overlay/history.h"
#include "physics/body_now.h"
#include "render/eye.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

struct Moment {
  const Scene& scene;
  const World& world;  // of the scene, with the times that events have set
  const State& state;
  const History& history;
  const BodyColors& colors;
  Eye eye;

  double pixel_at(const Vec3& x) const {  // m, the side of a pixel at a point in front of the camera
    return eye.pixel * max(eye.point(x).z(), eye.camera.near);
  }
  double radius_of(Entity body) const {  // m
    return radius_now(scene.world, state, body);
  }
  /// Whether a body is a part of another, and not seen.
  bool is_part(Entity body) const { return is_gone(state, body); }
};

}  // namespace carom
