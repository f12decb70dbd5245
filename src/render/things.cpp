// Places bodies and obstacles in the camera's frame, and sorts them into balls and solids. Things outside the picture
// stay as occluders only. Comparison with the last picture shows whether anything has changed, so that an equal picture
// is not drawn.
#include "render/things.h"

#include <algorithm>
#include <cmath>

#include "physics/world.h"
#include "render/lighting.h"
#include "render/mesh_shadows.h"
#include "render/surfaces.h"
#include "scene/scene.h"

namespace carom {

Things::Things(const Scene& scene, const Eye& eye) : scene_(scene), eye_(eye) {
  const std::size_t bodies = scene.world.body_count();
  looks_.resize(bodies);
  for (const BodyRange& range : scene.roster.bodies) {
    const Look look = look_of(range.color, range.mesh);
    for (std::size_t i = range.first; i < range.first + std::size_t{range.count} && i < bodies; ++i) looks_[i] = look;
  }
  for (const Volume& volume : scene.world.volume) any_solids_ = any_solids_ || volume.shape != Shape::sphere;
  for (std::uint32_t i = 0; i < scene.world.obstacles.size(); ++i) {
    const FixedName& name = name_of_obstacle(scene, i);
    if (!name.visible || is_surface(scene, i)) continue;
    obstacles_.push_back(i);
    looks_.push_back(look_of(name.color, name.mesh));
    any_solids_ = any_solids_ || scene.world.obstacles[i].volume.shape != Shape::sphere;
  }
  any_solids_ = any_solids_ || !files_.empty();
}

Look Things::look_of(const Color& color, const std::optional<MeshUse>& mesh) {
  Look look{linear(color), mesh};
  if (mesh) {
    look.file = static_cast<std::size_t>(std::find(files_.begin(), files_.end(), mesh->file) - files_.begin());
    if (look.file == files_.size()) files_.push_back(mesh->file);
  }
  return look;
}

void Things::measure(const Shapes& shapes, bool outlines) {
  for (Look& look : looks_) {
    if (!look.mesh) continue;
    const double scale = look.mesh->scale;
    look.mesh_radius = scale * shapes.radius(look.file, look.mesh->center);
    look.mesh_middle = scale * (shapes.middle(Shapes::file(look.file)) - look.mesh->center);
    look.outline_reach = outlines ? scale * MeshShadows::reach(shapes, look.file) : 0;
  }
}

void Things::add(const Vec3& position, const Volume& volume, double radius, std::uint32_t look, bool mesh) {
  Thing thing{eye_.point(position), radius, volume.shape, volume.half, look, mesh, Vec3::Zero()};
  if (mesh) {
    thing.radius = std::max(radius, looks_[look].mesh_radius);
    thing.mesh_middle = eye_.point(position + looks_[look].mesh_middle);
  }
  // A thing around the eye would show only its own inside.
  const double distance2 = thing.center.squaredNorm();
  const bool ball = volume.shape == Shape::sphere && !mesh;
  const Vec3 eye = (eye_.camera.eye - position).cwiseAbs();
  const bool around = ball ? distance2 <= radius * radius : (eye.array() <= volume.half.array()).all();
  if (around || !is_sphere_in_view(eye_.camera, eye_.view, position, thing.radius)) {
    keep(thing);
    return;
  }
  // A thing smaller than a pixel is drawn as a ball, which is the fainter the smaller it is.
  const bool tiny = !ball && thing.radius * thing.radius < 0.25 * eye_.pixel * eye_.pixel * distance2;
  if (tiny) thing.radius = std::cbrt(0.2387 * volume.size());
  (ball || tiny ? balls_ : solids_).push_back(keep(thing));
}

/// Stores the thing. Returns its number.
std::uint32_t Things::keep(const Thing& thing) {
  if (placed_ == all_.size()) {
    all_.push_back(thing);
    differs_ = true;
  } else if (!(all_[placed_] == thing)) {
    all_[placed_] = thing;
    differs_ = true;
  }
  return placed_++;
}

bool Things::place(const State& state) {
  placed_ = 0;
  differs_ = false;
  balls_.clear();
  solids_.clear();
  const World& world = scene_.world;
  for (std::uint32_t i = 0; i < world.body_count(); ++i) {
    if (!state.part_of.empty() && state.part_of[i] != i) continue;
    Volume volume = world.volume.empty() ? Volume::sphere(world.radius[i]) : world.volume[i];
    double radius = world.radius[i];
    bool mesh = looks_[i].mesh.has_value();
    if (!state.volume.empty() && (state.volume[i].shape != volume.shape || state.volume[i].half != volume.half)) {
      // This is a joint body.
      volume = state.volume[i];
      radius = volume.reach();
      mesh = false;
    }
    add(state.position[i], volume, radius, i, mesh);
  }
  std::uint32_t look = world.body_count();
  for (const std::uint32_t i : obstacles_) {
    const Obstacle& obstacle = world.obstacles[i];
    add(obstacle.center, obstacle.volume, obstacle.volume.reach(), look, looks_[look].mesh.has_value());
    ++look;
  }
  if (placed_ < all_.size()) {
    all_.erase(all_.begin() + placed_, all_.end());
    differs_ = true;
  }
  sort_balls();
  return differs_;
}

void Things::sort_balls() {
  // Of balls that do not overlap, a ball can only hide another of greater power |c|^2 - r^2. The cells of a power
  // diagram have this order from any eye. The distance alone would put a small ball beside a large one on the wrong
  // side.
  order_.clear();
  for (const std::uint32_t i : balls_) {
    const double distance = all_[i].center.norm();
    order_.emplace_back(-(distance - all_[i].radius) * (distance + all_[i].radius), i);
  }
  std::sort(order_.begin(), order_.end());
  std::transform(order_.begin(), order_.end(), balls_.begin(), [](const auto& o) { return o.second; });
}

}  // namespace carom
