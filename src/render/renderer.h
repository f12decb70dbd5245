#pragma once
// What a scene looks like + a State -> pixels. One renderer is one off-screen OpenGL context of one picture size.
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "physics/state.h"
#include "render/image.h"
#include "scene/output.h"

namespace carom {

struct Scene;

/// Drawing cannot go on. The text is for the user.
struct RenderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Renderer {
 public:
  /// `scene` must outlive the renderer. `samples` per pixel: 1, 2, 4 ... Throws RenderError.
  Renderer(const Scene& scene, Size size, int samples);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws the bodies of `state` and what stands still; nothing, where all is as in the last picture. The picture is
  /// valid until the next draw.
  const Image& draw(const State& state);
  std::uint64_t drawn() const;  // pictures so far, but for those that were the last one again

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
