#pragma once
// Scenes made in code, and ways to measure pictures.

#include "render/camera.h"
#include "render/renderer.h"
#include "std.h"

namespace carom::test {

inline constexpr Color black{0, 0, 0}, white{1, 1, 1}, red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

inline Entity add_ball(Scene& scene, const Vec3& position, double radius, const Color& color) {
  const Entity e = scene.world.body_count();
  scene.world.mass.push_back(1);
  scene.world.radius.push_back(radius);
  scene.world.restitution.push_back(1);
  scene.initial.position.push_back(position);
  scene.initial.velocity.push_back(Vec3::Zero());
  if (!scene.world.volume.empty()) scene.world.volume.push_back(Volume::sphere(radius));
  scene.roster.bodies.push_back({"b" + to_string(e), e, 1, false, color});
  return e;
}

/// A body with any volume; from the first one on all bodies have theirs.
inline Entity add_body(Scene& scene, const Vec3& position, const Volume& volume, const Color& color) {
  if (scene.world.volume.empty())
    for (const double radius : scene.world.radius) scene.world.volume.push_back(Volume::sphere(radius));
  const Entity e = add_ball(scene, position, volume.reach(), color);
  scene.world.volume.resize(e);
  scene.world.volume.push_back(volume);
  return e;
}

/// After all planes and walls.
inline void add_obstacle(Scene& scene, const Vec3& center, const Volume& volume, const Color& color,
                         bool visible = true) {
  scene.world.obstacles.push_back({center, volume, {}});
  scene.roster.fixed.push_back({"o" + to_string(scene.world.obstacles.size()), color, visible});
}

inline void add_plane(Scene& scene, const Vec3& point, const Vec3& normal, const Color& color, bool visible = true) {
  scene.world.planes.push_back({point, normal.normalized(), {}});
  scene.roster.fixed.insert(scene.roster.fixed.begin() + static_cast<ptrdiff_t>(scene.world.planes.size() - 1),
                            {"p" + to_string(scene.world.planes.size()), color, visible});
}

inline void add_wall(Scene& scene, const Vec3& center, const Vec3& normal, const Vec3& up, double width, double height,
                     const Color& color) {
  const Vec3 n = normal.normalized(), right = up.cross(n).normalized();
  scene.world.walls.push_back({center, n, right, n.cross(right), width / 2, height / 2, {}});
  scene.roster.fixed.push_back({"w" + to_string(scene.world.walls.size()), color, true});
}

/// The six inward planes of a room.
inline void add_room(Scene& scene, const Vec3& min, const Vec3& max, const Color& color) {
  for (int axis = 0; axis < 3; ++axis) {
    add_plane(scene, min, Vec3::Unit(axis), color);
    add_plane(scene, max, -Vec3::Unit(axis), color);
  }
}

/// The same numbers on every machine, 0 to 1.
inline double noise(uint64_t& seed) {
  seed = seed * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(seed >> 11U) * 0x1p-53;
}

/// The chapter's two bowling balls on a floor.
inline Scene bowling_balls() {
  Scene scene;
  add_ball(scene, Vec3(-0.25, 0, 0.025), 0.11, {0.863, 0.078, 0.235});
  add_ball(scene, Vec3(0.25, 0, -0.025), 0.11, {0.255, 0.412, 0.882});
  add_plane(scene, Vec3(0, -0.11, 0), Vec3(0, 1, 0), {0.824, 0.706, 0.549});
  Camera camera;
  camera.eye = Vec3(0, 3, -5);
  camera.target = Vec3::Zero();
  camera.near = 1;
  camera.far = 100;
  scene.camera = camera;
  return scene;
}

inline Scene gas(int balls, double room = 5, double radius = 0.2) {
  Scene scene;
  uint64_t seed = 7;
  const auto spread = [&] { return (2 * noise(seed) - 1) * (room - radius); };
  const Color palette[] = {{0.90, 0.30, 0.26}, {0.20, 0.55, 0.85}, {0.95, 0.75, 0.25}, {0.35, 0.70, 0.45}};
  for (int i = 0; i < balls; ++i) {
    const double x = spread(), y = spread(), z = spread();
    add_ball(scene, Vec3(x, y, z), radius, palette[i % 4]);
  }
  add_room(scene, Vec3::Constant(-room), Vec3::Constant(room), {0.82, 0.80, 0.76});
  return scene;
}

inline double grey(const Image& image, int x, int y) {
  const uint8_t* p = image.row(y) + 3 * x;
  return (p[0] + p[1] + p[2]) / 3.0;
}

/// Light without shade: what is drawn is its own colour, so that coverage can be measured.
inline Scene flat_scene(const Vec3& eye, const Vec3& target, double fov = 45) {
  Scene scene;
  scene.background.color = Color{0, 0, 0};
  scene.ambient = Color{1, 1, 1};
  scene.lights.push_back({"none", Vec3(0, -1, 0), {}, {0, 0, 0}, 0});
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.fov = fov;
  scene.camera = camera;
  return scene;
}

/// Binary PPM: what any viewer can turn into a PNG.
bool write_ppm(const Image& image, const string& path);

}  // namespace carom::test
