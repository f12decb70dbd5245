// Renders boxes, cylinders and meshes by a tiled, deferred pass. Four points along a pixel's side record only the thing
// and its normal. Each pixel is then shaded once, from the mean of its points. Multisampling of the full shader would
// evaluate all lights sixteen times.
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

Solids::Programs::Programs(const Lighting& lighting, bool walls, bool meshes, int fine)
    : closed_points({point_vertex_shader}, {"#define CLOSED\n", point_fragment_shader}),
      open_points({point_vertex_shader}, {point_fragment_shader}),
      shade({rectangle_vertex_shader},
            {fmt::format("#define SOLIDS\n#define FINE {}\n{}", fine, walls ? "#define WALLS\n" : ""),
             meshes ? "#define MESHES\n" : "", lighting.shader(), meshes ? MeshShadows::shader() : "", material_shader,
             pixel_fragment_shader}),
      draw({rectangle_vertex_shader}, {onto_fragment_shader}) {}

Solids::Points::Points(int width, int height)
    : what(gl::make_texture(GL_RG32UI, width, height)),
      depth(gl::make_texture(GL_DEPTH_COMPONENT32F, width, height)),
      buffer(gl::make_framebuffer(std::array{what.name()}, depth.name())) {}

Solids::Pixels::Pixels(int width, int height)
    : color(gl::make_texture(GL_SRGB8_ALPHA8, width, height)),
      depth(gl::make_texture(GL_R32F, width, height)),
      buffer(gl::make_framebuffer(std::array{color.name(), depth.name()}, 0)) {}

Solids::Solids(const Shapes& shapes, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
               const MeshShadows* meshes, bool smooth)
    : eye_(eye),
      lighting_(lighting),
      surfaces_(surfaces),
      meshes_(meshes),
      fine_(smooth ? 4 : 1),
      shapes_(shapes),
      axes_{eye.direction(Vec3::Unit(0)), eye.direction(Vec3::Unit(1)), eye.direction(Vec3::Unit(2))},
      programs_(lighting, surfaces.walls(), meshes != nullptr, fine_),
      points_(std::min(tile_side, eye.size.width) * fine_, std::min(tile_side, eye.size.height) * fine_),
      pixels_(eye.size.width, eye.size.height),
      rectangles_({4}) {
  const auto [width, height] = eye.size;
  for (int y = 0; y < height; y += tile_side)
    for (int x = 0; x < width; x += tile_side)
      tiles_.push_back({{x, y, std::min(x + tile_side, width), std::min(y + tile_side, height)}, {}, {}});
  set_constants(lighting, meshes);
  gl::check("preparing to draw boxes, cylinders and meshes");
}

/// Sets the uniforms that never change.
void Solids::set_constants(const Lighting& lighting, const MeshShadows* meshes) {
  const auto [width, height] = eye_.size;
  std::array<float, 9> axes{};
  for (std::size_t i = 0; i < 9; ++i) axes[i] = f(axes_[i / 3][static_cast<int>(i % 3)]);
  for (const gl::Program* program :
       {&programs_.closed_points, &programs_.open_points, &programs_.shade, &programs_.draw}) {
    program->use();
    gl::UniformMatrix3fv(program->at("axes"), 1, GL_FALSE, axes.data());
    gl::Uniform2f(program->at("tangent"), f(eye_.tan_x), f(eye_.tan_y));
    gl::Uniform2f(program->at("picture"), f(width), f(height));
    gl::Uniform1f(program->at("near"), f(eye_.camera.near));
  }
  programs_.shade.use();
  lighting.set(programs_.shade);
  if (meshes) meshes->set(programs_.shade, 7);
  GLint unit = 0;
  for (const char* name : {"occluder_rows", "rows", "edges", "edge_depths", "looks", "what", "what_depth"})
    gl::Uniform1i(programs_.shade.at(name), unit++);
  programs_.draw.use();
  gl::Uniform1i(programs_.draw.at("color"), 0);
  gl::Uniform1i(programs_.draw.at("color_depth"), 1);
}

/// The pixels in which a box in the camera's frame may be visible. They are those of its corners, or all if it reaches
/// before the near plane.
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

/// Places the visible things, registers them in their tiles, and fills the rows for the shaders.
void Solids::collect(const Things& things) {
  Occluders occluders(things.all(), lighting_);
  rows_.occluders.clear();
  rows_.looks.clear();
  placed_.clear();
  const int columns = (eye_.size.width + tile_side - 1) / tile_side;
  for (const std::uint32_t i : things.solids()) {
    const Thing& thing = things.all()[i];
    const std::size_t number = placed_.size() + 1;  // 0: no thing
    placed_.push_back(place(things, thing, number));
    const std::size_t first = rows_.occluders.size() / 4;
    occluders.append_rows(i, things, surfaces_, rows_.occluders);
    for (const float c : things.look(thing).color) rows_.looks.push_back(c);
    for (const std::size_t x :
         {std::size_t{0}, first, rows_.occluders.size() / 4 - first, std::size_t{0}, std::size_t{0}})
      rows_.looks.push_back(f(static_cast<double>(x)));

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
  if (!rows_.occluders.empty()) occluders_.fill(rows_.occluders);
  looks_.fill(rows_.looks);
}

void Solids::prepare(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  for (Tile& tile : tiles_) tile.solids.clear();
  rows_.rectangles.clear();
  if (things.solids().empty()) return;
  collect(things);
  gl::Disable(GL_BLEND);
  gl::BindFramebuffer(GL_FRAMEBUFFER, pixels_.buffer.name());
  const float nothing[4] = {};
  gl::ClearBufferfv(GL_COLOR, 0, nothing);
  for (Tile& tile : tiles_) {
    if (tile.solids.empty()) continue;
    // Things of one shape are together, from front to back, so that few hidden points are drawn.
    std::sort(tile.solids.begin(), tile.solids.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Placed &x = placed_[a], &y = placed_[b];
      return std::tie(x.shape, x.cut, x.distance, a) < std::tie(y.shape, y.cut, y.distance, b);
    });
    draw_points(tile);
    shade(tile, backdrop, rows);
    for (const int x : {tile.used.left, tile.used.top, tile.used.right, tile.used.bottom})
      rows_.rectangles.push_back(f(x));
  }
  gl::check("drawing boxes, cylinders and meshes");
}

void Solids::draw_points(const Tile& tile) {
  const auto [left, top, right, bottom] = tile.bounds;
  gl::BindFramebuffer(GL_FRAMEBUFFER, points_.buffer.name());
  gl::Viewport(0, 0, (right - left) * fine_, (bottom - top) * fine_);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  // Pictures have their top row first.
  gl::FrontFace(GL_CW);
  const GLuint nothing[4] = {};
  const float infinitely_far = 0;
  gl::ClearBufferuiv(GL_COLOR, 0, nothing);
  gl::ClearBufferfv(GL_DEPTH, 0, &infinitely_far);
  const double x = 1.0 / (right - left), y = 1.0 / (bottom - top);
  const auto [width, height] = eye_.size;
  for (const gl::Program* program : {&programs_.closed_points, &programs_.open_points}) {
    program->use();
    gl::Uniform4f(program->at("to_tile"), f(width * x), f(height * y), f((width - 2 * left) * x - 1),
                  f((height - 2 * top) * y - 1));
  }
  rows_.instances.clear();
  for (const std::uint32_t i : tile.solids)
    rows_.instances.insert(rows_.instances.end(), placed_[i].row.begin(), placed_[i].row.end());
  shapes_.fill_instances(rows_.instances);
  for (std::size_t first = 0, end = 0; first < tile.solids.size(); first = end) {
    const Placed& like = placed_[tile.solids[first]];
    const auto alike = [&](const Placed& other) { return other.shape == like.shape && other.cut == like.cut; };
    while (end < tile.solids.size() && alike(placed_[tile.solids[end]])) ++end;
    const bool closed = like.shape < Shapes::file(0);
    (closed ? programs_.closed_points : programs_.open_points).use();
    if (closed && !like.cut) gl::Enable(GL_CULL_FACE);
    shapes_.draw(like.shape, first, end - first);
    gl::Disable(GL_CULL_FACE);
  }
}

void Solids::shade(const Tile& tile, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  gl::BindFramebuffer(GL_FRAMEBUFFER, pixels_.buffer.name());
  gl::Viewport(0, 0, eye_.size.width, eye_.size.height);
  gl::Disable(GL_DEPTH_TEST);
  programs_.shade.use();
  gl::Uniform2i(programs_.shade.at("tile"), tile.bounds.left, tile.bounds.top);
  occluders_.bind(0);
  rows.bind(1);
  if (meshes_) meshes_->bind(7);
  if (surfaces_.walls()) {
    gl::bind_texture(2, backdrop.edge);
    gl::bind_texture(3, backdrop.edge_depth);
  }
  looks_.bind(4);
  gl::bind_texture(5, points_.what);
  gl::bind_texture(6, points_.depth);
  const float used[4] = {f(tile.used.left), f(tile.used.top), f(tile.used.right), f(tile.used.bottom)};
  rectangles_.draw(used);
}

void Solids::draw(Cover cover) {
  if (rows_.rectangles.empty()) return;
  programs_.draw.use();
  gl::Uniform1i(programs_.draw.at("whole"), cover == Cover::whole ? 1 : 0);
  gl::bind_texture(0, pixels_.color);
  gl::bind_texture(1, pixels_.depth);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  gl::Enable(GL_BLEND);
  gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  rectangles_.draw(rows_.rectangles);
}

}  // namespace carom
