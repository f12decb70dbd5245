// Draws a picture in passes: a copy of the backdrop, shadows, solids that cover whole pixels, balls from back to front,
// and edges of solids. Everything that does not move is drawn once. A picture equal to the last one is not drawn again.
#include "render/renderer.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "render/backdrop.h"
#include "render/gl.h"
#include "render/mesh_shadows.h"
#include "render/shade.h"
#include "render/shapes.h"
#include "render/solids.h"
#include "render/spheres.h"
#include "render/things.h"
#include "scene/scene.h"

namespace carom {
namespace {

/// OSMesa returns unpainted pictures beyond this side, without an error.
constexpr int largest_side = 16384;

Size checked(Size size, int samples) {
  if (size.width < 1 || size.height < 1 || size.width > largest_side || size.height > largest_side)
    throw RenderError(fmt::format("a picture of {} x {} pixels cannot be drawn: each side can be 1 to {}", size.width,
                                  size.height, largest_side));
  if (samples < 1) throw RenderError(fmt::format("{} samples per pixel: there must be 1 or more", samples));
  return size;
}

}  // namespace

// Edges are smoothed by the computed coverage of a pixel, without sampling. Balls are drawn back to front and blend
// with what is behind them. One sample for each pixel gives hard edges. Any larger number gives smooth ones, finer than
// so many samples would be.
struct Renderer::Impl {
  Impl(const Scene& s, const Camera& camera, Size size, int samples)
      : scene(s),
        eye(camera, size),
        smooth(samples > 1),
        lighting(s, eye),
        surfaces(s, eye),
        things(s, eye),
        color(gl::make_texture(GL_SRGB8_ALPHA8, size.width, size.height)),
        depth(gl::make_texture(GL_DEPTH_COMPONENT32F, size.width, size.height)),
        framebuffer(gl::make_framebuffer(std::array{color.name()}, depth.name())) {
    if (!surfaces.rows().empty()) rows.fill(surfaces.rows());
    backdrop.emplace(scene, eye, lighting, surfaces, rows, smooth);
    const bool any_solids = things.any_solids();
    if (any_solids) shapes.emplace(things.files());
    if (!things.files().empty()) {
      if (!lighting.key_is_near()) mesh_shadows.emplace(*shapes, things.files().size(), eye, lighting);
      things.measure(*shapes, mesh_shadows.has_value());
    }
    const MeshShadows* meshes = mesh_shadows ? &*mesh_shadows : nullptr;
    if (!surfaces.all().empty() && things.any()) shade.emplace(eye, lighting, surfaces, meshes, any_solids);
    if (things.any()) spheres.emplace(eye, lighting, surfaces, meshes, any_solids, smooth);
    if (any_solids) solids.emplace(*shapes, eye, lighting, surfaces, meshes, smooth);
    image.width = size.width;
    image.height = size.height;
  }

  void copy_backdrop();
  void draw(const State& state);
  void read();

  const Scene& scene;
  const Eye eye;
  const bool smooth;
  // The members below need it.
  gl::Context context;
  const Lighting lighting;
  const Surfaces surfaces;
  Things things;
  gl::TexelBuffer rows;
  gl::Texture color, depth;
  gl::Framebuffer framebuffer;
  std::optional<Backdrop> backdrop;
  std::optional<Shapes> shapes;
  std::optional<MeshShadows> mesh_shadows;
  std::optional<Shade> shade;
  std::optional<Spheres> spheres;
  std::optional<Solids> solids;
  std::vector<std::uint8_t> rgba;
  Image image;
  std::uint64_t drawn = 0;
};

void Renderer::Impl::copy_backdrop() {
  const auto [width, height] = eye.size;
  gl::CopyImageSubData(backdrop->lit.name(), GL_TEXTURE_2D, 0, 0, 0, 0, color.name(), GL_TEXTURE_2D, 0, 0, 0, 0, width,
                       height, 1);
  gl::CopyImageSubData(backdrop->depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0, depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       width, height, 1);
}

void Renderer::Impl::draw(const State& state) {
  if (!things.place(state) && drawn > 0) return;
  ++drawn;
  if (solids) solids->prepare(things, *backdrop, rows);
  copy_backdrop();
  gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl::Viewport(0, 0, eye.size.width, eye.size.height);
  gl::Enable(GL_FRAMEBUFFER_SRGB);
  if (shade) shade->draw(things, *backdrop, rows);
  if (solids) solids->draw(Solids::Cover::whole);
  if (spheres) spheres->draw(things, *backdrop, rows);
  if (solids) solids->draw(Solids::Cover::part);
  read();
}

void Renderer::Impl::read() {
  const std::size_t pixels = static_cast<std::size_t>(eye.size.width) * static_cast<std::size_t>(eye.size.height);
  rgba.resize(4 * pixels);
  image.pixels.resize(3 * pixels);
  gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl::ReadPixels(0, 0, eye.size.width, eye.size.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl::check("reading the picture");
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = rgba[4 * i + c];
}

Renderer::Renderer(const Scene& scene, Size size, int samples)
    : scene_(scene),
      size_(checked(size, samples)),
      samples_(samples),
      camera_(camera_of(scene)),
      impl_(std::make_unique<Impl>(scene, camera_, size, samples)) {}

Renderer::~Renderer() {
  leave();
}

void Renderer::leave() {
  if (!impl_) return;
  try {
    impl_->context.make_current();
  } catch (const RenderError&) {
    // A context that cannot be used has nothing left to free.
  }
  drawn_ += impl_->drawn;
  impl_.reset();
}

const Image& Renderer::draw(const State& state) {
  Drawing drawing;
  drawing.camera = camera_of(scene_);
  return draw(state, drawing);
}

const Image& Renderer::draw(const State& state, const Drawing& drawing) {
  if (!(drawing.camera == camera_)) {
    leave();
    impl_ = std::make_unique<Impl>(scene_, drawing.camera, size_, samples_);
    camera_ = drawing.camera;
  }
  impl_->context.make_current();
  impl_->draw(state);
  return impl_->image;
}

std::uint64_t Renderer::drawn() const {
  return drawn_ + impl_->drawn;
}

}  // namespace carom
