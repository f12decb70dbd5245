#pragma once
// All that a picture depends on, as of the last one.

#include "physics/state.h"
#include "render/drawing.h"
#include "std.h"

namespace carom {

struct LastPicture {
  vector<Vec3> position;
  vector<Entity> part_of;  // empty: each body is its own
  vector<double> radius;
  vector<Volume> volume;
  Drawing drawing;

  bool is_of(const State& state, const Drawing& now) const {
    return position == state.position && same_parts(state.part_of) && radius == state.radius &&
           volume == state.volume && drawing == now;
  }
  bool same_parts(const vector<Entity>& now) const {
    for (size_t i = 0; i < max(part_of.size(), now.size()); ++i) {
      const auto of = [&](const vector<Entity>& parts) { return i < parts.size() ? parts[i] : Entity(i); };
      if (of(part_of) != of(now)) return false;
    }
    return true;
  }
  void take(const State& state, Drawing now) {
    position = state.position, part_of = state.part_of, radius = state.radius, volume = state.volume;
    drawing = std::move(now);
  }
};

}  // namespace carom
