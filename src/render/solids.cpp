#include "render/solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "render/material.h"
#include "render/solid_shaders.h"

namespace carom {
namespace {

constexpr int tile_side = 128;  // pixels

float f(double x) {
  return static_cast<float>(x);
}

}  // namespace

Solids::Solids(const Shapes& shapes, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
               const MeshShadows* meshes, bool smooth)
    : eye_(eye),
      lighting_(lighting),
      surfaces_(surfaces),
      meshes_(meshes),
      fine_(smooth ? 4 : 1),
      shapes_(shapes),
      axes_{eye.direction(Vec3::Unit(0)), eye.direction(Vec3::Unit(1)), eye.direction(Vec3::Unit(2))},
      closed_points_({point_vertex_shader}, {"#define CLOSED\n", point_fragment_shader}),
      open_points_({point_vertex_shader}, {point_fragment_shader}),
      shade_({rectangle_vertex_shader},
             {fmt::format("#define SOLIDS\n#define FINE {}\n{}", fine_, surfaces.walls() ? "#define WALLS\n" : ""),
              meshes ? "#define MESHES\n" : "", lighting.shader(), meshes ? MeshShadows::shader() : "", material_shader,
              pixel_fragment_shader}),
      draw_({rectangle_vertex_shader}, {onto_fragment_shader}),
      rectangles_({4}) {
  const auto [width, height] = eye.size;
  const int across = std::min(tile_side, width) * fine_, down = std::min(tile_side, height) * fine_;
  what_ = gl::make_texture(GL_RG32UI, across, down);
  what_depth_ = gl::make_texture(GL_DEPTH_COMPONENT32F, across, down);
  color_ = gl::make_texture(GL_SRGB8_ALPHA8, width, height);
  color_depth_ = gl::make_texture(GL_R32F, width, height);
  point_buffer_ = gl::make_framebuffer(std::array{what_.name()}, what_depth_.name());
  color_buffer_ = gl::make_framebuffer(std::array{color_.name(), color_depth_.name()}, 0);
  for (int y = 0; y < height; y += tile_side)
    for (int x = 0; x < width; x += tile_side)
      tiles_.push_back({{x, y, std::min(x + tile_side, width), std::min(y + tile_side, height)}, {}, {}});

  std::array<float, 9> axes{};
  for (std::size_t i = 0; i < 9; ++i) axes[i] = f(axes_[i / 3][static_cast<int>(i % 3)]);
  for (const gl::Program* program : {&closed_points_, &open_points_, &shade_, &draw_}) {
    program->use();
    gl::UniformMatrix3fv(program->at("axes"), 1, GL_FALSE, axes.data());
    gl::Uniform2f(program->at("tangent"), f(eye.tan_x), f(eye.tan_y));
    gl::Uniform2f(program->at("picture"), f(width), f(height));
    gl::Uniform1f(program->at("near"), f(eye.camera.near));
  }
  shade_.use();
  lighting.set(shade_);
  if (meshes) meshes->set(shade_, 7);
  GLint unit = 0;
  for (const char* name : {"occluder_rows", "rows", "edges", "edge_depths", "looks", "what", "what_depth"})
    gl::Uniform1i(shade_.at(name), unit++);
  draw_.use();
  gl::Uniform1i(draw_.at("color"), 0);
  gl::Uniform1i(draw_.at("color_depth"), 1);
  gl::check("preparing to draw boxes, cylinders and meshes");
}

/// The pixels in which a box may show, given in the camera's frame: those of its corners, or all if it reaches before
/// the near plane.
Solids::Rect Solids::bounds_of(const Vec3& origin, const Vec3& half, bool& cut) const {
  const auto [width, height] = eye_.size;
  double left = width, right = 0, top = height, bottom = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p = origin;
    for (int k = 0; k < 3; ++k) p += (corner >> k & 1 ? 1 : -1) * half[k] * axes_[static_cast<std::size_t>(k)];
    cut = p.z() <= eye_.camera.near;
    if (cut) return {0, 0, width, height};
    const double x = width / 2.0 + p.x() / p.z() / eye_.pixel, y = height / 2.0 - p.y() / p.z() / eye_.pixel;
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
  const auto within = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {within(left - 1, width), within(top - 1, height), within(right + 2, width), within(bottom + 2, height)};
}

Solids::Placed Solids::place(const Things& things, const Thing& thing, std::size_t number) const {
  Vec3 origin = thing.center, scale = thing.half;
  const bool large = thing.half.x() > Shapes::small_up_to * eye_.pixel * (thing.center.z() - thing.radius);
  std::size_t shape = thing.shape == Shape::box ? Shapes::box : large ? Shapes::large_cylinder : Shapes::small_cylinder;
  if (thing.mesh) {
    const Look& look = things.look(thing);
    shape = Shapes::file(look.file);
    scale = Vec3::Constant(look.mesh->scale);
    origin = thing.mesh_middle;
  }
  Placed placed{};
  placed.shape = shape;
  placed.distance = thing.center.norm() - thing.radius;
  placed.row = {f(origin.x()), f(origin.y()), f(origin.z()), f(static_cast<double>(number)),
                f(scale.x()),  f(scale.y()),  f(scale.z()),  0};
  placed.bounds = bounds_of(origin, scale.cwiseProduct(shapes_.half(shape)), placed.cut);
  return placed;
}

/// Places what is seen, notes it in its tiles, and fills the rows that the shaders read about it.
void Solids::collect(const Things& things) {
  Occluders occluders(things.all(), lighting_);
  occluder_row_.clear();
  look_row_.clear();
  placed_.clear();
  const int columns = (eye_.size.width + tile_side - 1) / tile_side;
  for (const std::uint32_t i : things.solids()) {
    const Thing& thing = things.all()[i];
    const std::size_t number = placed_.size() + 1;  // 0: nothing
    placed_.push_back(place(things, thing, number));
    const std::size_t first = occluder_row_.size() / 4;
    occluders.append_rows(i, things, surfaces_, occluder_row_);
    for (const float c : things.look(thing).color) look_row_.push_back(c);
    for (const std::size_t x :
         {std::size_t{0}, first, occluder_row_.size() / 4 - first, std::size_t{0}, std::size_t{0}})
      look_row_.push_back(f(static_cast<double>(x)));

    const Rect& b = placed_.back().bounds;
    for (int y = b.top / tile_side; y * tile_side < b.bottom; ++y)
      for (int x = b.left / tile_side; x * tile_side < b.right; ++x) {
        Tile& tile = tiles_[static_cast<std::size_t>(y * columns + x)];
        Rect& used = tile.used;
        if (tile.solids.empty()) used = {tile.bounds.right, tile.bounds.bottom, tile.bounds.left, tile.bounds.top};
        used = {std::min(used.left, std::max(b.left, tile.bounds.left)),
                std::min(used.top, std::max(b.top, tile.bounds.top)),
                std::max(used.right, std::min(b.right, tile.bounds.right)),
                std::max(used.bottom, std::min(b.bottom, tile.bounds.bottom))};
        tile.solids.push_back(static_cast<std::uint32_t>(number - 1));
      }
  }
  if (!occluder_row_.empty()) occluders_.fill(occluder_row_);
  looks_.fill(look_row_);
}

void Solids::prepare(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  for (Tile& tile : tiles_) tile.solids.clear();
  rectangle_row_.clear();
  if (things.solids().empty()) return;
  collect(things);
  gl::Disable(GL_BLEND);
  gl::BindFramebuffer(GL_FRAMEBUFFER, color_buffer_.name());
  const float nothing[4] = {};
  gl::ClearBufferfv(GL_COLOR, 0, nothing);
  for (Tile& tile : tiles_) {
    if (tile.solids.empty()) continue;
    // Those of one shape together; front to back, so that little is drawn in vain.
    std::sort(tile.solids.begin(), tile.solids.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Placed &x = placed_[a], &y = placed_[b];
      return std::tie(x.shape, x.cut, x.distance, a) < std::tie(y.shape, y.cut, y.distance, b);
    });
    draw_points(tile);
    shade(tile, backdrop, rows);
    for (const int x : {tile.used.left, tile.used.top, tile.used.right, tile.used.bottom})
      rectangle_row_.push_back(f(x));
  }
  gl::check("drawing boxes, cylinders and meshes");
}

void Solids::draw_points(const Tile& tile) {
  const auto [left, top, right, bottom] = tile.bounds;
  gl::BindFramebuffer(GL_FRAMEBUFFER, point_buffer_.name());
  gl::Viewport(0, 0, (right - left) * fine_, (bottom - top) * fine_);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  gl::FrontFace(GL_CW);  // pictures have their top row first
  const GLuint nothing[4] = {};
  const float infinitely_far = 0;
  gl::ClearBufferuiv(GL_COLOR, 0, nothing);
  gl::ClearBufferfv(GL_DEPTH, 0, &infinitely_far);
  const double x = 1.0 / (right - left), y = 1.0 / (bottom - top);
  const auto [width, height] = eye_.size;
  for (const gl::Program* program : {&closed_points_, &open_points_}) {
    program->use();
    gl::Uniform4f(program->at("to_tile"), f(width * x), f(height * y), f((width - 2 * left) * x - 1),
                  f((height - 2 * top) * y - 1));
  }
  instance_row_.clear();
  for (const std::uint32_t i : tile.solids)
    instance_row_.insert(instance_row_.end(), placed_[i].row.begin(), placed_[i].row.end());
  shapes_.fill_instances(instance_row_);
  for (std::size_t first = 0, end = 0; first < tile.solids.size(); first = end) {
    const Placed& like = placed_[tile.solids[first]];
    const auto alike = [&](const Placed& other) { return other.shape == like.shape && other.cut == like.cut; };
    while (end < tile.solids.size() && alike(placed_[tile.solids[end]])) ++end;
    const bool closed = like.shape < Shapes::file(0);
    (closed ? closed_points_ : open_points_).use();
    if (closed && !like.cut) gl::Enable(GL_CULL_FACE);
    shapes_.draw(like.shape, first, end - first);
    gl::Disable(GL_CULL_FACE);
  }
}

void Solids::shade(const Tile& tile, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  gl::BindFramebuffer(GL_FRAMEBUFFER, color_buffer_.name());
  gl::Viewport(0, 0, eye_.size.width, eye_.size.height);
  gl::Disable(GL_DEPTH_TEST);
  shade_.use();
  gl::Uniform2i(shade_.at("tile"), tile.bounds.left, tile.bounds.top);
  occluders_.bind(0);
  rows.bind(1);
  if (meshes_) meshes_->bind(7);
  if (surfaces_.walls()) {
    gl::bind_texture(2, backdrop.edge);
    gl::bind_texture(3, backdrop.edge_depth);
  }
  looks_.bind(4);
  gl::bind_texture(5, what_);
  gl::bind_texture(6, what_depth_);
  const float used[4] = {f(tile.used.left), f(tile.used.top), f(tile.used.right), f(tile.used.bottom)};
  rectangles_.draw(used);
}

void Solids::draw(Cover cover) {
  if (rectangle_row_.empty()) return;
  draw_.use();
  gl::Uniform1i(draw_.at("whole"), cover == Cover::whole ? 1 : 0);
  gl::bind_texture(0, color_);
  gl::bind_texture(1, color_depth_);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  gl::Enable(GL_BLEND);
  gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  rectangles_.draw(rectangle_row_);
}

}  // namespace carom
