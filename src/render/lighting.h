#pragma once
// The lights of a scene, or a key light from above left behind the camera. Values are in linear light; authored colours
// are sRGB.

#include "numerics/vec3.h"
#include "raster/shot.h"
#include "render/eye.h"
#include "scene/colors.h"
#include "scene/look.h"
#include "std.h"

namespace carom {

/// An authored colour in linear light (IEC 61966-2-1).
array<float, 3> linear(const Color& srgb);

struct KeyLight {
  Vec3 towards;              // unit, in the world's frame
  array<float, 3> radiance;  // linear
};
/// The light of a scene without lights: from above, left of and behind the camera, in the world's upright frame. The
/// sun then stays high for a steep camera.
KeyLight default_light(SceneLook look, const CameraFrame& view);

/// Tangent of half the angle under which the key light appears. It makes shadows soft.
inline constexpr double softness = 0.03;

/// How a surface reflects light. `otherwise`: the finish of one that has none.
raster::SurfaceLight surface_light(const Surface& surface, Finish otherwise);

/// Whether a thing hides most of what is behind it.
inline bool is_opaque(const Surface& surface) {
  return surface_light(surface, Finish::plastic).opacity >= 0.5F;
}

/// Fills the lamps of a shot, their softness and the ambient light. The first lamp is the key light, which casts
/// shadows. One with a position has the same apparent size from the camera's target.
/// A camera that moves leaves the lights as they are for `at_start`, the camera of time 0.
void add_lights(const Scene& scene, const Camera& at_start, const Eye& eye, raster::Shot& shot);

}  // namespace carom
