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

KeyLight default_light(SceneLook look, const CameraFrame& view) {
  Vec3 ahead = Vec3(view.forward.x(), 0, view.forward.z());
  if (!(ahead.norm() > 1e-3)) ahead = Vec3(view.up.x(), 0, view.up.z());
  ahead.normalize();
  const Vec3 right = Vec3(-ahead.z(), 0, ahead.x());
  raster::Float3 radiance = linear(from_rgb(style_of(look).key));
  for (float& c : radiance) c *= float(style_of(look).key_strength);
  return {(-0.55 * right + 1.0 * Vec3(0, 1, 0) - 0.45 * ahead).normalized(), radiance};
}

raster::SurfaceLight surface_light(const Surface& surface, Finish otherwise) {
  const Finish finish = surface.finish.value_or(otherwise);
  raster::SurfaceLight light;
  switch (finish) {
    case Finish::matte:
      light = {.matt = 1, .least_mirror = 0, .most_mirror = 0, .glint = 0};
      break;
    case Finish::plastic:
      break;

    case Finish::metal:
      light = {.matt = 0.15F, .least_mirror = 0.8F, .most_mirror = 0.95F, .glint = 0.9F, .tint = 1};
      break;
    case Finish::glass:
      light = {.matt = 0.5F, .least_mirror = 0.04F, .most_mirror = 1, .glint = 1, .opacity = 0.2F};
      break;
    case Finish::glow:
      light = {.matt = 0.2F, .glint = 0, .emission = 1};
      break;
  }

  if (surface.opacity) light.opacity = float(*surface.opacity);
  return light;
}

void add_lights(const Scene& scene, const Camera& at_start, const Eye& eye, raster::Shot& shot) {
  const LookStyle& style = style_of(scene.look);
  shot.lighting.lamps.clear();

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
    const KeyLight light = default_light(scene.look, view_of(at_start, eye.size));
    shot.lighting.lamps.push_back({floats(eye.direction(light.towards)), false, light.radiance});
  }

  shot.lighting.softness = float(softness);
  shot.lighting.ambient = linear(scene.ambient.value_or(from_rgb(style.ambient)));
  shot.lighting.rim = float(style.rim);
  shot.lighting.flat = float(style.flat);
}

}  // namespace carom
