#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "render/backdrop.h"
#include "render/gl.h"
#include "render/shade.h"
#include "render/spheres.h"

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

// Edges are smoothed by how much of a pixel they cover, computed, not sampled: balls drawn back to front blend with
// what is behind them. One sample a pixel asks for hard edges; any more for smooth ones, finer than so many samples
// would be.
struct Renderer::Impl {
  Impl(const Scene& s, Size size, int samples)
      : scene(s),
        eye(camera_of(s), checked(size, samples)),
        smooth(samples > 1),
        lighting(s, eye),
        surfaces(s, eye),
        color(gl::make_texture(GL_SRGB8_ALPHA8, size.width, size.height)),
        depth(gl::make_texture(GL_DEPTH_COMPONENT32F, size.width, size.height)),
        framebuffer(gl::make_framebuffer(std::array{color.name()}, depth.name())) {
    if (!surfaces.rows().empty()) rows.fill(surfaces.rows());
    backdrop.emplace(scene, eye, lighting, surfaces, rows, smooth);
    if (!surfaces.all().empty() && scene.world.body_count() > 0) shade.emplace(eye, lighting, surfaces);
    if (scene.world.body_count() > 0) spheres.emplace(scene, eye, lighting, surfaces, smooth);
    image.width = size.width;
    image.height = size.height;
  }

  void copy_backdrop();
  void place(const State& state);
  void read();

  const Scene& scene;
  const Eye eye;
  const bool smooth;
  gl::Context context;  // what stands below needs it
  const Lighting lighting;
  const Surfaces surfaces;
  gl::TexelBuffer rows;
  gl::Texture color, depth;
  gl::Framebuffer framebuffer;
  std::optional<Backdrop> backdrop;
  std::optional<Shade> shade;
  std::optional<Spheres> spheres;

  std::vector<Ball> balls;          // all, in the camera's frame
  std::vector<std::uint32_t> seen;  // those in the picture, back to front
  std::vector<std::uint8_t> rgba;
  Image image;
};

void Renderer::Impl::copy_backdrop() {
  const auto [width, height] = eye.size;
  glCopyImageSubData(backdrop->lit.name(), GL_TEXTURE_2D, 0, 0, 0, 0, color.name(), GL_TEXTURE_2D, 0, 0, 0, 0, width,
                     height, 1);
  glCopyImageSubData(backdrop->depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0, depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0, width,
                     height, 1);
}

void Renderer::Impl::place(const State& state) {
  const std::size_t count = scene.world.body_count();
  balls.resize(count);
  seen.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = scene.world.radius[i];
    balls[i] = {eye.point(state.position[i]), radius};
    // A ball around the eye would only be its own inside.
    if (balls[i].center.squaredNorm() > radius * radius && sees_sphere(eye.camera, eye.view, state.position[i], radius))
      seen.push_back(static_cast<std::uint32_t>(i));
  }
  // Of balls that do not overlap, one can only hide another of greater power |c|^2 - r^2 (the cells of a power diagram
  // are ordered so from any eye); the distance alone would put a small ball beside a large one on the wrong side.
  const auto power = [&](std::uint32_t i) {
    const double distance = balls[i].center.norm();
    return (distance - balls[i].radius) * (distance + balls[i].radius);
  };
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(seen.size());
  for (std::uint32_t i : seen) order.emplace_back(-power(i), i);
  std::sort(order.begin(), order.end());
  std::transform(order.begin(), order.end(), seen.begin(), [](const auto& o) { return o.second; });
}

void Renderer::Impl::read() {
  const std::size_t pixels = static_cast<std::size_t>(eye.size.width) * static_cast<std::size_t>(eye.size.height);
  rgba.resize(4 * pixels);
  image.pixels.resize(3 * pixels);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, eye.size.width, eye.size.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl::check("reading the picture");
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = rgba[4 * i + c];
}

Renderer::Renderer(const Scene& scene, Size size, int samples) : impl_(std::make_unique<Impl>(scene, size, samples)) {}

Renderer::~Renderer() {
  try {
    impl_->context.make_current();
  } catch (const RenderError&) {
    // Nothing is left to free in a context that cannot be used.
  }
}

const Image& Renderer::draw(const State& state) {
  impl_->context.make_current();
  impl_->place(state);
  impl_->copy_backdrop();
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer.name());
  glViewport(0, 0, impl_->eye.size.width, impl_->eye.size.height);
  glEnable(GL_FRAMEBUFFER_SRGB);
  if (impl_->shade) impl_->shade->draw(impl_->balls, *impl_->backdrop);
  if (impl_->spheres) impl_->spheres->draw(impl_->balls, impl_->seen, *impl_->backdrop, impl_->rows);
  impl_->read();
  return impl_->image;
}

}  // namespace carom
