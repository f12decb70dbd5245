// Places bodies, obstacles and walls in the camera's frame. Things outside the picture stay, since they may cast
// shadows into it.
#include "render/things.h"

#include "physics/body_now.h"
#include "render/lighting.h"
#include "render/surfaces.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

raster::SolidKind kind_of(Shape shape) {
  switch (shape) {
    case Shape::sphere:
      break;
    case Shape::cylinder:
      return raster::SolidKind::cylinder;
    case Shape::box:
      return raster::SolidKind::box;
  }
  return raster::SolidKind::ball;
}

/// Whether the point d from its centre is in the volume or on its surface, which holds() of world_region.h leaves out.
bool reaches(const Volume& volume, const Vec3& d) {
  const bool in_box = (d.cwiseAbs().array() <= volume.half.array()).all();
  switch (volume.shape) {
    case Shape::sphere:
      return d.squaredNorm() <= volume.half.x() * volume.half.x();
    case Shape::cylinder:
      return in_box && hypot(d.x(), d.z()) <= volume.half.x();
    case Shape::box:
      break;
  }
  return in_box;
}

/// Of a thing that hides what happens.
constexpr double faded_opacity = 0.25;

}  // namespace

Things::Things(const Scene& scene) : scene_(scene), thickness_(scene) {
  const size_t bodies = scene.world.body_count();
  looks_.resize(bodies);
  for (const BodyRange& range : scene.roster.bodies) {
    const Look look = look_of(range.color, range.mesh, range.surface);
    for (size_t i = range.first; i < range.first + size_t{range.count} && i < bodies; ++i) {
      looks_[i] = look;
      if (look.mesh) looks_[i].mesh->scale = look.mesh->scale_for(scene.world.radius[i]);
    }
  }

  for (uint32_t i = 0; i < scene.world.obstacles.size(); ++i) {
    const FixedLook& name = look_of_obstacle(scene, i);
    if (!name.visible) continue;
    obstacles_.push_back(i);
    looks_.push_back(look_of(name.color, name.mesh, name.surface));
  }

  for (size_t i = 0; i < scene.world.walls.size(); ++i)
    wall_finishes_.push_back(finish_of(look_of_fixed(scene, scene.world.planes.size() + i).surface));
}

uint32_t Things::finish_of(const Surface& surface) {
  const raster::SurfaceLight light = surface_light(surface, Finish::plastic);
  const auto place = ranges::find(finishes_, light) - finishes_.begin();
  if (size_t(place) == finishes_.size()) finishes_.push_back(light);
  return uint32_t(place);
}

Look Things::look_of(const Color& color, const optional<MeshUse>& mesh, const Surface& surface) {
  Look look{linear(color), mesh, 0, {}, finish_of(surface)};
  if (mesh) {
    const DrawnFile file{mesh->file, mesh->turn, mesh->own_colors};
    look.file = size_t(ranges::find(files_, file) - files_.begin());
    if (look.file == files_.size()) files_.push_back(file);
  }
  return look;
}

void Things::add(const Vec3& position, const Volume& volume, double radius, const Look& look, bool mesh, const Eye& eye,
                 raster::Shot& shot) {
  raster::Solid solid;
  const Vec3 center = eye.point(position);
  solid.center = floats(center);
  solid.radius = float(radius);
  solid.half = floats(volume.half);
  solid.kind = kind_of(volume.shape);
  solid.color = look.color;
  solid.finish = look.finish;

  double around = radius;
  if (mesh) {
    around = max(radius, look.size.radius);
    solid.radius = float(around);
    raster::MeshShadow shadow;
    shadow.volume = solid.kind;
    shadow.middle = floats(eye.point(position + look.size.middle));

    if (look.size.half_shadow > 0) shadow.outline = int32_t(look.file), shadow.reach = float(look.size.half_shadow);
    solid.kind = raster::SolidKind::mesh;
    solid.part = uint32_t(shot.meshes.size());
    shot.meshes.push_back(shadow);
  }

  // A thing around the eye would show only its own inside.
  const double distance2 = center.squaredNorm();
  const bool inside = reaches(volume, eye.camera.eye - position);
  solid.shadow_only = inside || !eye.may_see(center, around);

  // A thing smaller than a pixel is drawn as a ball of the same volume, which is the fainter the smaller it is.
  if (solid.kind != raster::SolidKind::ball && around * around < 0.25 * eye.pixel * eye.pixel * distance2) {
    solid.kind = raster::SolidKind::ball;
    solid.radius = float(std::cbrt(0.2387 * volume.size()));
  }

  if (solid.kind == raster::SolidKind::mesh && !solid.shadow_only)
    meshes_.push_back(
        {look.file, eye.point(position + look.size.middle), look.mesh->scale, int32_t(shot.solids.size())});
  shot.solids.push_back(solid);
}

/// Adds a part of a hollow obstacle: what is seen of it from within. A flat one faces `inward`.
void Things::add_shell(const Obstacle& obstacle, const Vec3& inward, const Look& look, const Eye& eye,
                       raster::Shot& shot) {
  Volume volume = obstacle.volume;
  Vec3 center = obstacle.center;
  const bool flat = obstacle.hollow == Hollow::none;
  if (flat) {
    // A thin plate behind the surface, so that it has two sides.
    const Vec3 thin = 0x1p-9 * volume.half.maxCoeff() * inward;
    center -= thin;
    volume.half += thin.cwiseAbs();
  }
  add(center, volume, volume.reach(), look, false, eye, shot);

  raster::Solid& solid = shot.solids.back();
  solid.shell = true;
  if (flat) {
    solid.shadow_only = solid.shadow_only || !(inward.dot(eye.camera.eye - obstacle.center) > 0);
    return;
  }
  solid.hollow = true;
  if (obstacle.hollow == Hollow::whole || obstacle.hollow == Hollow::lower_half ||
      obstacle.hollow == Hollow::upper_half)
    solid.shadow_only = !eye.may_see(eye.point(center), volume.reach());
  if (obstacle.hollow == Hollow::lower_half) solid.high = 0;
  if (obstacle.hollow == Hollow::upper_half) solid.low = 0;
  if (obstacle.hollow == Hollow::side) solid.low = -float(volume.half.y()), solid.high = float(volume.half.y());
}

void Things::take_mean(const Look& look, raster::Shot& shot) {
  if (!look.size.mean) return;
  raster::Float3& color = shot.solids.back().color;
  if (!meshes_.empty() && meshes_.back().solid == int32_t(shot.solids.size()) - 1) meshes_.back().plain = color;
  color = look.size.mean->with(color);
}

void Things::add_walls(const State& state, const Drawing& drawing, const Eye& eye, raster::Shot& shot) const {
  const World& world = scene_.world;
  for (size_t i = 0; i < world.walls.size(); ++i) {
    const FixedLook& name = look_of_fixed(scene_, world.planes.size() + i);
    if (!name.visible) continue;

    const Wall& wall = world.walls[i];
    const WallDepths depths = thickness_.of(i, state);
    const Vec3 center = wall.center + (depths.front - depths.back) / 2 * wall.normal;
    const double half_depth = (depths.front + depths.back) / 2;

    raster::Solid solid;
    solid.kind = raster::SolidKind::wall;
    solid.center = floats(eye.point(center));
    solid.radius = float(hypot(wall.half_width, wall.half_height, half_depth));
    solid.half = {float(wall.half_width), float(wall.half_height), float(half_depth)};

    solid.part = uint32_t(shot.walls.size());
    shot.walls.push_back(
        {floats(eye.direction(wall.right)), floats(eye.direction(wall.up)), floats(eye.direction(wall.normal))});

    solid.color = linear(name.color);
    solid.finish = wall_finishes_[i];
    const Vec3 way = eye.camera.eye - center;
    solid.shadow_only = std::abs(wall.normal.dot(way)) <= half_depth &&
                        std::abs(wall.right.dot(way)) <= wall.half_width &&
                        std::abs(wall.up.dot(way)) <= wall.half_height;
    shot.solids.push_back(solid);
    fade(drawing, world.planes.size() + i, shot);
  }
}

/// Lets the last solid be seen through, if it hides what happens.
void Things::fade(const Drawing& drawing, size_t fixed, raster::Shot& shot) const {
  if (std::binary_search(drawing.faded.begin(), drawing.faded.end(), fixed)) shot.solids.back().finish = faded_finish_;
}

void Things::add_halos(const Eye& eye, raster::Shot& shot) const {
  for (const raster::Solid& solid : shot.solids) {
    const float emission = finishes_[solid.finish].emission;
    if (emission == 0 || solid.shadow_only || !(solid.center[2] > solid.radius)) continue;
    const double per = 1 / (solid.center[2] * eye.pixel);
    raster::Halo& halo = shot.halos.emplace_back();
    halo.x = float(0.5 * eye.size.width + solid.center[0] * per);
    halo.y = float(0.5 * eye.size.height - solid.center[1] * per);
    halo.radius = float(solid.radius * per);
    halo.depth = 1 / (solid.center[2] - solid.radius);
    for (size_t i = 0; i < 3; ++i) halo.color[i] = emission * solid.color[i];
  }
}

void Things::place(const State& state, const Drawing& drawing, const Eye& eye, raster::Shot& shot) {
  shot.solids.clear(), shot.walls.clear(), shot.meshes.clear(), shot.halos.clear();
  meshes_.clear();

  const World& world = scene_.world;
  faded_finish_ = drawing.faded.empty() ? 0 : finish_of({Finish::plastic, faded_opacity});
  if (shot.finishes.size() != finishes_.size()) shot.finishes = finishes_;

  for (uint32_t i = 0; i < world.body_count(); ++i) {
    if (is_gone(state, i)) continue;
    const Volume volume = volume_now(world, state, i);
    const bool joint = volume != world.volume_of(i);

    add(state.position[i], volume, joint ? volume.reach() : world.radius[i], looks_[i],
        looks_[i].mesh.has_value() && !joint, eye, shot);
    if (!drawing.body_colors.empty()) shot.solids.back().color = linear(drawing.body_colors[i]);
    take_mean(looks_[i], shot);
    if (!drawing.glow.empty()) shot.solids.back().glow = drawing.glow[i];
  }

  size_t number = world.body_count();
  for (const uint32_t i : obstacles_) {
    const Obstacle& obstacle = world.obstacles[i];
    const Vec3& inward = look_of_obstacle(scene_, i).inward;
    if (obstacle.hollow != Hollow::none || !inward.isZero(0)) {
      add_shell(obstacle, inward, looks_[number++], eye, shot);
      fade(drawing, world.planes.size() + world.walls.size() + i, shot);
      continue;
    }

    add(obstacle.center, obstacle.volume, obstacle.volume.reach(), looks_[number], looks_[number].mesh.has_value(), eye,
        shot);
    take_mean(looks_[number], shot);
    fade(drawing, world.planes.size() + world.walls.size() + i, shot);
    ++number;
  }

  add_walls(state, drawing, eye, shot);
  if (any_of(finishes_, [](const raster::SurfaceLight& light) { return light.emission > 0; })) add_halos(eye, shot);
}

}  // namespace carom
