#pragma once
// From the look of a scene and a State to pixels. One renderer is one off-screen OpenGL context with one picture size.
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "physics/state.h"
#include "render/drawing.h"
#include "render/image.h"
#include "scene/output.h"

namespace carom {

struct Scene;

/// Drawing cannot continue. The text is for the user.
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

  /// Draws the bodies of `state` and the still things, as `drawing` shows them. It draws nothing if all is as in the
  /// last picture. The picture is valid until the next draw.
  const Image& draw(const State& state, const Drawing& drawing);
  /// The same by the scene's camera of time 0.
  const Image& draw(const State& state);
  std::uint64_t drawn() const;  // pictures so far, repetitions of the last one excluded

 private:
  struct Impl;
  void leave();

  const Scene& scene_;
  Size size_;
  int samples_;
  Camera camera_;               // of impl_
  std::unique_ptr<Impl> impl_;  // made for each camera
  std::uint64_t drawn_ = 0;     // by those before impl_
};

}  // namespace carom
