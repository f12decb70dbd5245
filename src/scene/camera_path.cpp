#include "scene/camera_path.h"

namespace carom {
namespace {

template <typename Value>
MonotoneCubic curve(const std::vector<Keyframe>& keys, const Value& value) {
  std::vector<double> at, values;
  for (const Keyframe& key : keys) {
    at.push_back(key.at);
    values.push_back(value(key));
  }
  return {std::move(at), std::move(values)};
}

std::vector<MonotoneCubic> curves(const std::vector<Keyframe>& keys, Vec3 Keyframe::*point) {
  std::vector<MonotoneCubic> all;
  for (int axis = 0; axis < 3; ++axis)
    all.push_back(curve(keys, [&](const Keyframe& key) { return (key.*point)[axis]; }));
  return all;
}

Vec3 point_at(const std::vector<MonotoneCubic>& curves, double time) {
  return Vec3(curves[0](time), curves[1](time), curves[2](time));
}

}  // namespace

CameraPath::CameraPath(const std::vector<Keyframe>& keys)
    : eye_(curves(keys, &Keyframe::eye)),
      target_(curves(keys, &Keyframe::target)),
      fov_(curve(keys, [](const Keyframe& key) { return key.fov; })) {}

Keyframe CameraPath::at(double time) const {
  return {time, point_at(eye_, time), point_at(target_, time), fov_(time)};
}

std::array<std::array<double, 4>, 3> CameraPath::sight(std::size_t i) const {
  std::array<std::array<double, 4>, 3> sight{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<double, 4> eye = eye_[axis].piece(i), target = target_[axis].piece(i);
    for (std::size_t power = 0; power < 4; ++power) sight[axis][power] = target[power] - eye[power];
  }
  return sight;
}

}  // namespace carom
