#pragma once
// The camera that frames a motion: from the front, from above as little as possible, and as near as what happens
// allows.
#include "physics/state.h"
#include "render/camera.h"
#include "render/camera_views.h"
#include "render/motion_samples.h"
#include "scene/scene.h"

namespace carom {

/// Frames what happens in pictures of a size. `pace`: seconds of motion a second of film.
///
/// It stands still if bodies are then at least 4.5 % as high as the picture as they collide. Else it goes along, if
/// that shows them larger. Its path is the nearest to them that is as slow as a hand would be: in a second of film it
/// pans by at most the picture's height, and its distance changes by at most the factor e. It gets to these speeds in
/// half a second. If bodies are smaller than a fiftieth even so, the collisions around the middle of all impulses alone
/// are framed, as many as can be.
///
/// It looks from the lowest of some elevations from which no fixed thing hides what happens. If all do, these things
/// are to be faded. It is the same for any order of bodies.
CameraViews frame_views(const Scene& scene, const MotionSamples& samples, Size size, double pace);

/// Collects a motion instant by instant, and frames it.
class CameraFit {
 public:
  /// `scene` must outlive this object. `size`: of the pictures.
  CameraFit(const Scene& scene, Size size, double pace = 1)
      : scene_(scene), size_(size), pace_(pace), samples_(scene) {}

  /// Takes what happened since the last instant.
  void strike(span<const Collision> collisions) { samples_.strike(collisions); }
  /// Takes the next instant in order.
  void add(const State& state) { samples_.add(state); }
  /// For the instants so far.
  CameraViews views() const { return frame_views(scene_, samples_, size_, pace_); }

 private:
  const Scene& scene_;
  Size size_;
  double pace_;
  MotionSamples samples_;
};

}  // namespace carom
