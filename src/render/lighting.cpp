// The lights of a scene in the camera's frame. A matt surface that faces a light of intensity 1 has its own colour.
// Light does not weaken with distance.
#include "render/lighting.h"

#include "numerics/srgb.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

array<float, 3> linear(const Color& srgb) {
  const auto light = [](double c) { return float(light_of_srgb(clamp(c, 0.0, 1.0))); };
  return {light(srgb.r), light(srgb.g), light(srgb.b)};
}

KeyLight default_light(const CameraFrame& view) {
  Vec3 ahead = Vec3(view.forward.x(), 0, view.forward.z());
  if (!(ahead.norm() > 1e-3)) ahead = Vec3(view.up.x(), 0, view.up.z());
  ahead.normalize();
  const Vec3 right = Vec3(-ahead.z(), 0, ahead.x());
  return {(-0.55 * right + 1.0 * Vec3(0, 1, 0) - 0.45 * ahead).normalized(), {0.82F, 0.80F, 0.76F}};
}

void add_lights(const Scene& scene, const Eye& eye, raster::Shot& shot) {
  shot.lighting.lamps.clear();

  // A camera that moves leaves the lights as they are at time 0.
  const Camera at_start = camera_of(scene);
  for (const Light& light : scene.lights) {
    raster::Float3 radiance = linear(light.color);
    for (float& c : radiance) c *= float(light.intensity);

    const bool near = light.position.has_value();
    const Vec3 vector = near ? eye.point(*light.position) : Vec3(-eye.direction(light.direction->normalized()));
    shot.lighting.lamps.push_back({floats(vector), near, radiance});
    if (near && shot.lighting.lamps.size() == 1)
      shot.lighting.lamp_radius = float(softness * (at_start.target - *light.position).norm());
  }

  if (scene.lights.empty()) {
    const KeyLight light = default_light(view_of(at_start, eye.size));
    shot.lighting.lamps.push_back({floats(eye.direction(light.towards)), false, light.radiance});
  }

  shot.lighting.softness = float(softness);
  shot.lighting.ambient = scene.ambient ? linear(*scene.ambient) : raster::Float3{0.26F, 0.28F, 0.31F};
}

}  // namespace carom
