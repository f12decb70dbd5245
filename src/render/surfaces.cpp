// Planes, walls and the sides of boxes in the camera's frame, as rows for the shaders.
// Coordinates are computed in double precision, and only differences from the eye become floats.
#include "render/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/world.h"
#include "render/lighting.h"
#include "scene/scene.h"

namespace carom {
namespace {

const FixedName& name_of(const Scene& scene, std::size_t i) {
  static const FixedName unnamed{"", {0.8, 0.8, 0.8}, true};
  return i < scene.roster.fixed.size() ? scene.roster.fixed[i] : unnamed;
}

/// The sides of a box.
std::array<Wall, 6> sides_of(const Obstacle& box) {
  std::array<Wall, 6> sides;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto axis = static_cast<int>(i / 2);
    const Vec3 normal = (i % 2 ? 1 : -1) * Vec3::Unit(axis);
    const Vec3 up = axis == 1 ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
    const Vec3 right = up.cross(normal);
    const Vec3& half = box.volume.half;
    sides[i] = {box.center + half[axis] * normal, normal, right, up, half.dot(right.cwiseAbs()),
                half.dot(up.cwiseAbs()),          {}};
  }
  return sides;
}

/// Two directions along a plane. They are world axes where the plane has some, so that lines have round coordinates.
void pattern_axes(const Vec3& normal, Vec3& right, Vec3& up) {
  // For a level plane.
  Vec3 along(0, 0, -1);
  if (std::abs(normal.y()) < 0.999) along = Vec3(0, 1, 0);
  right = along.cross(normal).normalized();
  up = normal.cross(right);
}

}  // namespace

const FixedName& name_of_obstacle(const Scene& scene, std::size_t obstacle) {
  return name_of(scene, scene.world.planes.size() + scene.world.walls.size() + obstacle);
}

bool is_surface(const Scene& scene, std::size_t obstacle) {
  return scene.world.obstacles[obstacle].volume.shape == Shape::box && !name_of_obstacle(scene, obstacle).mesh;
}

Surfaces::Surfaces(const Scene& scene, const Eye& eye) {
  reach_ = (eye.camera.target - eye.camera.eye).norm();
  for (const Vec3& p : scene.initial.position) reach_ = std::max(reach_, (p - eye.camera.eye).norm());
  reach_ = std::clamp(reach_, 1e-6, 1e12);
  unit_ = std::pow(10, std::floor(std::log10(reach_ * eye.tan_x / 3)));

  for (std::size_t i = 0; i < scene.world.planes.size(); ++i) {
    const FixedName& name = name_of(scene, i);
    if (!name.visible) continue;
    const Plane& plane = scene.world.planes[i];
    Vec3 right, up;
    pattern_axes(plane.normal, right, up);
    Surface s;
    s.height = plane.normal.dot(eye.camera.eye - plane.point);
    s.normal = eye.direction(plane.normal);
    s.right = eye.direction(right);
    s.up = eye.direction(up);
    // The pattern repeats after two squares. Only this remainder of the eye's own coordinates has an effect, and only
    // this fits into a float.
    add_row(s, std::fmod(right.dot(eye.camera.eye), 2 * unit_), std::fmod(up.dot(eye.camera.eye), 2 * unit_),
            name.color);
    all_.push_back(s);
  }
  planes_ = all_.size();
  for (std::size_t i = 0; i < scene.world.walls.size(); ++i) {
    const FixedName& name = name_of(scene, scene.world.planes.size() + i);
    if (!name.visible) continue;
    add_wall(scene.world.walls[i], name, eye);
  }
  for (std::size_t i = 0; i < scene.world.obstacles.size(); ++i) {
    const FixedName& name = name_of_obstacle(scene, i);
    if (!name.visible || !is_surface(scene, i)) continue;
    for (const Wall& side : sides_of(scene.world.obstacles[i])) add_wall(side, name, eye);
  }
}

void Surfaces::add_wall(const Wall& wall, const FixedName& name, const Eye& eye) {
  const double height = wall.normal.dot(eye.camera.eye - wall.center);
  Surface s;
  s.wall = true;
  s.height = std::abs(height);
  s.normal = eye.direction(height < 0 ? Vec3(-wall.normal) : wall.normal);
  s.center = eye.point(wall.center);
  s.right = eye.direction(wall.right);
  s.up = eye.direction(wall.up);
  s.half_width = wall.half_width;
  s.half_height = wall.half_height;
  add_row(s, -s.right.dot(s.center), -s.up.dot(s.center), name.color);
  all_.push_back(s);
}

void Surfaces::add_row(const Surface& s, double right_offset, double up_offset, const Color& color) {
  const auto add = [&](const Vec3& v, double w) {
    for (int i = 0; i < 3; ++i) rows_.push_back(static_cast<float>(v[i]));
    rows_.push_back(static_cast<float>(w));
  };
  const auto c = linear(color);
  add(s.normal, s.height);
  add(s.right, right_offset);
  add(s.up, up_offset);
  add(Vec3(c[0], c[1], c[2]), 0);
  add(Vec3(s.half_width, s.half_height, 0), 0);
}

}  // namespace carom
