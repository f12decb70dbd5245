#pragma once
// From the look of a scene and a State to pixels.
#include "physics/state.h"
#include "render/drawing.h"
#include "render/image.h"
#include "render/render_error.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

struct Scene;

class Renderer {
 public:
  /// `scene` must outlive the renderer. `samples` per pixel: 1 gives hard edges, any larger number smooth ones.
  /// Throws RenderError.
  Renderer(const Scene& scene, Size size, int samples);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws the bodies of `state`, the still things and the strokes. It draws nothing if all is as in the last picture.
  /// The picture is valid until the next draw.
  const Image& draw(const State& state, Drawing drawing);
  /// The same by the scene's camera (camera_of) and nothing besides.
  const Image& draw(const State& state);
  uint64_t drawn() const;  // pictures so far, repetitions of the last one excluded

 private:
  struct Impl;
  unique_ptr<Impl> impl_;
};

}  // namespace carom
