#include "render/parallel.h"

#include <numbers>

#include "std.h"

namespace carom {
namespace {

/// The distance `factor` times, and the same picture at the target.
Camera moved(Camera camera, double factor) {
  const Vec3 way = camera.eye - camera.target;
  const double shift = (factor - 1) * way.norm(), half = camera.fov * std::numbers::pi / 360;
  camera.eye = camera.target + factor * way;
  camera.fov = std::atan(std::tan(half) / factor) * 360 / std::numbers::pi;
  camera.near += shift;
  camera.far += shift;
  return camera;
}

}  // namespace

Camera from_afar(Camera camera) {
  return moved(std::move(camera), times_farther);
}

Camera from_near(Camera camera) {
  return moved(std::move(camera), 1 / times_farther);
}

}  // namespace carom
