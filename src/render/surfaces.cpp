// Planes in the camera's frame. Coordinates are computed in double precision, and only differences from the eye become
// floats.
#include "render/surfaces.h"

#include "physics/body_now.h"
#include "render/lighting.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// Two directions along a plane. They are world axes where the plane has some, so that lines have round coordinates.
void pattern_axes(const Vec3& normal, Vec3& right, Vec3& up) {
  // For a level plane.
  Vec3 along(0, 0, -1);
  if (std::abs(normal.y()) < 0.999) along = Vec3(0, 1, 0);
  right = along.cross(normal).normalized();
  up = normal.cross(right);
}

/// The largest of 1, 2, 5 times a power of ten that is not above x.
double round_below(double x) {
  const double power = pow(10, floor(std::log10(x)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= x * (1 + 1e-12)) return digit * power;
  return power;
}

/// The floor is the level plane below the eye that is nearest to it.
void find_floor(const Eye& eye, raster::Shot& shot) {
  const raster::Float3 up = floats(eye.direction(Vec3(0, 1, 0)));
  using raster::dot;
  shot.floor.present = false;

  for (const raster::Ground& g : shot.grounds) {
    if (g.height <= 0 || dot(g.normal, up) < 0.7F || (shot.floor.present && g.height >= shot.floor.height)) continue;

    shot.floor.present = true;
    shot.floor.normal = g.normal;
    shot.floor.height = g.height;
    shot.floor.color = g.color;

    // What it sends up.
    for (size_t i = 0; i < 3; ++i) {
      const auto sent = [&](const raster::Lamp& lamp) {
        return lamp.radiance[i] * (lamp.near ? 0.7F : max(dot(g.normal, lamp.vector), 0.0F));
      };
      float other = shot.lighting.ambient[i];
      for (size_t k = 1; k < shot.lighting.lamps.size(); ++k) other += sent(shot.lighting.lamps[k]);
      shot.floor.sky[i] = 0.9F * g.color[i] * other;
      shot.floor.key[i] = 0.9F * g.color[i] * sent(shot.lighting.lamps[0]);
    }
  }
}

/// What a colour in linear light becomes in the picture (toned() of light.inc).
float toned(float x) {
  constexpr float knee = 0.7F, w = 1 - knee;
  return x < knee ? x : 1 - w * w / (w + x - knee);
}

/// The backdrop of the look, and how light falls off towards it. A seamless one begins as a lone floor ends.
void add_backdrop(const Scene& scene, const Eye& eye, raster::Shot& shot) {
  const LookStyle& style = style_of(scene.look);
  raster::Pattern& pattern = shot.pattern;
  pattern.kind = raster::PatternKind(style.pattern);
  pattern.contrast = float(style.contrast);
  pattern.ink = linear(from_rgb(style.ink));
  pattern.spot = scene.lights.empty() ? float(style.spot) : 0;
  pattern.spot_reach = 0.6F * pattern.reach;

  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : scene.initial.position) middle += p / double(scene.initial.position.size());
  pattern.middle = floats(eye.point(middle));

  shot.backdrop.above = linear(from_rgb(style.above));
  shot.backdrop.horizon = linear(from_rgb(style.horizon));
  shot.backdrop.below = linear(from_rgb(style.below));
  shot.edges = {float(style.outline * max(1.0, eye.size.height / 720.0)), linear(from_rgb(style.ink))};
  if (!style.seamless || !shot.floor.present || shot.grounds.size() > 1) return;

  for (size_t i = 0; i < 3; ++i) {
    float light = shot.lighting.ambient[i];
    for (const raster::Lamp& lamp : shot.lighting.lamps)
      light += lamp.radiance[i] * (lamp.near ? 0.0F : max(raster::dot(shot.floor.normal, lamp.vector), 0.0F));
    const float color = shot.floor.color[i] * (1 - pattern.spot), seen = toned(color * light);
    shot.backdrop.horizon[i] = seen + shot.lighting.flat * (color - seen);
  }
}

}  // namespace

double pattern_unit(const Scene& scene, Size size) {
  const Eye eye(camera_of(scene), size);
  const double distance = max((eye.camera.target - eye.camera.eye).norm(), 1e-6);
  const double width = 2 * distance * eye.tan_x;
  return round_below(clamp(8 * median_radius(scene.world), width / 12, width / 2));
}

const FixedLook& look_of_fixed(const Scene& scene, size_t fixed) {
  static const FixedLook unnamed{"", {0.8, 0.8, 0.8}, true};
  return fixed < scene.roster.fixed.size() ? scene.roster.fixed[fixed] : unnamed;
}

const FixedLook& look_of_obstacle(const Scene& scene, size_t obstacle) {
  return look_of_fixed(scene, scene.world.planes.size() + scene.world.walls.size() + obstacle);
}

void add_surfaces(const Scene& scene, const Eye& eye, raster::Shot& shot) {
  double reach = (eye.camera.target - eye.camera.eye).norm();
  for (const Vec3& p : scene.initial.position) reach = max(reach, (p - eye.camera.eye).norm());
  reach = clamp(reach, 1e-6, 1e12);
  shot.pattern.reach = float(reach);
  const double unit = double{shot.pattern.unit};

  shot.grounds.clear();
  for (size_t i = 0; i < scene.world.planes.size(); ++i) {
    const FixedLook& name = look_of_fixed(scene, i);
    if (!name.visible) continue;
    const Plane& plane = scene.world.planes[i];

    Vec3 right, up;
    pattern_axes(plane.normal, right, up);
    raster::Ground g{};
    g.normal = floats(eye.direction(plane.normal));
    g.height = float(plane.normal.dot(eye.camera.eye - plane.point));
    g.right = floats(eye.direction(right)), g.up = floats(eye.direction(up));

    // The pattern repeats after two squares. Only this remainder of the eye's own coordinates has an effect, and only
    // this fits into a float.
    g.right_offset = float(std::fmod(right.dot(eye.camera.eye), 2 * unit));
    g.up_offset = float(std::fmod(up.dot(eye.camera.eye), 2 * unit));
    g.color = linear(name.color);
    const raster::SurfaceLight light = surface_light(name.surface, Finish::matte);
    g.opacity = light.opacity;
    g.matt = light.matt, g.emission = light.emission;
    g.least_mirror = light.least_mirror, g.most_mirror = light.most_mirror, g.tint = light.tint;
    shot.grounds.push_back(g);
  }

  for (raster::Ground& g : shot.grounds) g.corners = shot.grounds.size() > 1;
  find_floor(eye, shot);
  add_backdrop(scene, eye, shot);
}

}  // namespace carom
