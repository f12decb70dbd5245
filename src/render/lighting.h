#pragma once
// The lights of a scene, or a key light from above left behind the camera. Values are in linear light; authored colours
// are sRGB.
#include <array>
#include <string>
#include <vector>

#include "numerics/vec3.h"
#include "render/eye.h"
#include "render/gl.h"
#include "scene/colors.h"

namespace carom {

/// An authored colour in linear light (IEC 61966-2-1).
std::array<float, 3> linear(const Color& srgb);

struct KeyLight {
  Vec3 towards;                   // unit, in the world's frame
  std::array<float, 3> radiance;  // linear
};
/// The light of a scene without lights: from above, left of and behind the camera, in the world's upright frame. The
/// sun then stays high for a steep camera.
KeyLight default_light(const CameraFrame& view);

class Lighting {
 public:
  /// Throws RenderError if there are more lights than can be drawn.
  Lighting(const Scene& scene, const Eye& eye);

  /// The GLSL text of the lights and of functions on them (lighting.cpp), for a fragment shader in the camera's frame.
  const std::string& shader() const { return shader_; }
  void set(const gl::Program& program) const;  // the program must be in use

  bool key_is_near() const { return lights_[0].near; }
  const Vec3& key() const { return lights_[0].vector; }

  /// Tangent of half the angle under which the key light appears. It makes shadows soft.
  static constexpr double softness = 0.02;
  /// The radius (m) of a key light that has a position. It has the same apparent size from the camera's target.
  double lamp_radius() const { return lamp_radius_; }

 private:
  struct Source {
    bool near;    // has a position; otherwise it is infinitely far
    Vec3 vector;  // camera frame: the position (m), or the unit direction towards the light
    std::array<float, 3> radiance;
  };
  std::vector<Source> lights_;  // the first one is the key light, which casts shadows
  double lamp_radius_ = 0;
  std::array<float, 3> ambient_;
  std::array<Vec3, 3> axes_;  // the world's axes in the camera's frame
  std::string shader_;
};

}  // namespace carom
