#pragma once
// The thickness of walls in pictures. A wall is a rectangle that bodies may touch from both sides.

#include "physics/state.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// How far a wall extends from its rectangle (m), along its normal and against it.
struct WallDepths {
  double front, back;
};

/// A side before which bodies are at time 0 is as good as flat. A wall is thick to its other side, as far as no body
/// comes near from there.
class WallThickness {
 public:
  /// `scene` must outlive this object.
  explicit WallThickness(const Scene& scene);

  WallDepths of(size_t wall, const State& state) const;

 private:
  double depth(size_t wall, double side, const State& state) const;

  const Scene& scene_;
  double least_ = 0;            // m
  vector<array<bool, 2>> met_;  // by wall: whether bodies are before it, behind it
};

}  // namespace carom
