#pragma once
// A sequence of pictures of a scene by one camera.
#include <cstdint>
#include <memory>

#include "render/moving_camera.h"
#include "render/renderer.h"

namespace carom {

class Shot {
 public:
  /// `scene` must outlive this object.
  Shot(const Scene& scene, Size size, int samples) : camera(scene, size), samples_(samples) {}

  /// Draws the next picture, valid until the one after it. Throws RenderError.
  const Image& draw(const State& state);
  std::uint64_t drawn() const { return renderer_ ? renderer_->drawn() : 0; }  // repetitions excluded

  MovingCamera camera;

 private:
  int samples_;
  /// Made at the first picture. A scene without pictures needs no renderer and reads no mesh.
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace carom
