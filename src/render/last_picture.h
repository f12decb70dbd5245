#pragma once
// All that a picture depends on, as of the last one.
#include <algorithm>
#include <vector>

#include "physics/state.h"
#include "render/drawing.h"

namespace carom {

inline bool same(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov == b.fov &&
         a.fov_horizontal == b.fov_horizontal && a.near == b.near && a.far == b.far;
}

inline bool same(const Color& a, const Color& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

inline bool same(const Stroke& a, const Stroke& b) {
  return a.from == b.from && a.to == b.to && a.from_radius == b.from_radius && a.to_radius == b.to_radius &&
         a.least_width == b.least_width && same(a.color, b.color) && a.from_opacity == b.from_opacity &&
         a.to_opacity == b.to_opacity;
}

template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return same(x, y); });
}

struct LastPicture {
  std::vector<Vec3> position;
  std::vector<Entity> part_of;  // empty: each body is its own
  std::vector<double> radius;
  std::vector<Volume> volume;
  Drawing drawing;

  bool is_of(const State& state, const Drawing& now) const {
    const auto same_volume = [](const Volume& a, const Volume& b) { return a.shape == b.shape && a.half == b.half; };
    return position == state.position && same_parts(state.part_of) && radius == state.radius &&
           std::equal(volume.begin(), volume.end(), state.volume.begin(), state.volume.end(), same_volume) &&
           same(drawing.camera, now.camera) && same(drawing.body_colors, now.body_colors) && drawing.glow == now.glow &&
           same(drawing.strokes, now.strokes);
  }
  bool same_parts(const std::vector<Entity>& now) const {
    for (std::size_t i = 0; i < std::max(part_of.size(), now.size()); ++i) {
      const auto of = [&](const std::vector<Entity>& parts) {
        return i < parts.size() ? parts[i] : static_cast<Entity>(i);
      };
      if (of(part_of) != of(now)) return false;
    }
    return true;
  }
  void take(const State& state, const Drawing& now) {
    position = state.position, part_of = state.part_of, radius = state.radius, volume = state.volume;
    drawing = now;
  }
};

}  // namespace carom
