// Draws meshes tile by tile with 4 x 4 points for each pixel, each with the number of its solid and its normal. A pixel
// is the mean of its points. Points of meshes in colours of their own have the colour besides, in a second picture.
#include "render/meshes.h"

#include "raster/silhouettes.h"
#include "render/render_error.h"
#include "std.h"

namespace carom {
namespace {

constexpr int outline_side = 1024;  // a power of two

// Of a mesh in colours of its own, `number` has this bit.
constexpr uint32_t colored_bit = 1U << 31U;

// The shaders are compiled without and with COLORS. Only those with HOLES drop points: without, OpenGL tests the depth
// before it computes a colour.
const char* const with_colors = "#define COLORS\n";
const char* const with_holes = "#define HOLES\n";

const char* const vertex_shader = R"(
layout(location = 0) in vec3 vertex;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 origin;  // in the camera's frame; number
layout(location = 3) in vec4 scale;   // and the solid's own colour
uniform mat3 axes;                    // the world's
uniform vec4 to_tile;                 // from (x / tangent, y / tangent, z) to the tile's clip space: factors, shifts
uniform vec2 tangent;
uniform float near;
out vec3 p;
out vec3 normal;
flat out uint number;
#ifdef COLORS
layout(location = 4) in vec2 uv_in;
layout(location = 5) in vec3 tint_in;
out vec2 uv;
out vec3 tint;
flat out vec3 own;
#endif

void main() {
  p = origin.xyz + axes * (scale.x * vertex);
  normal = axes * normal_in;
  number = uint(origin.w);
#ifdef COLORS
  number |= 0x80000000u;
  uv = uv_in;
  tint = tint_in;
  own = scale.yzw;
#endif
  vec2 at = p.xy / tangent * vec2(1, -1);
  gl_Position = vec4(to_tile.xy * at + to_tile.zw * p.z, 2 * near - p.z, p.z);  // the depth is near / z
}
)";

const char* const fragment_shader = R"(
in vec3 p;
in vec3 normal;
flat in uint number;
layout(location = 0) out uvec2 what;
#ifdef COLORS
in vec2 uv;
in vec3 tint;
flat in vec3 own;
layout(location = 1) out uint color;
uniform sampler2D picture;
uniform vec4 factor;
uniform float cutoff;
uniform float plain;  // 1: without a colour
#endif

void main() {
  // The face's own normal, towards the eye, decides on which side of it the eye is: files disagree about the rest.
  vec3 face = cross(dFdx(p), dFdy(p));
  if (dot(face, p) > 0) face = -face;
  vec3 n = dot(normal, normal) > 0 ? normalize(normal) : normalize(face);
  if (dot(n, face) < 0) n = -n;
  uvec3 q = uvec3(clamp(n * 511 + 512.5, 0, 1023));
  what = uvec2(number, q.x | q.y << 10 | q.z << 20);
#ifdef COLORS
  vec4 c = texture(picture, uv) * factor;
#ifdef HOLES
  if (c.a < cutoff) discard;
#endif
  // Roots of light, so that steps are equally small to the eye in the dark.
  uvec3 root = uvec3(sqrt(clamp(mix(c.rgb * tint, own, plain), 0, 1)) * 1023 + 0.5);
  color = root.x | root.y << 10 | root.z << 20;
#endif
}
)";

const char* const outline_vertex_shader = R"(
layout(location = 0) in vec3 vertex;
uniform mat3 axes;  // the world's
uniform vec3 across_u, across_v;
uniform float reach;
#ifdef COLORS
layout(location = 4) in vec2 uv_in;
out vec2 uv;
#endif

void main() {
  vec3 p = axes * vertex / reach;
#ifdef COLORS
  uv = uv_in;
#endif
  gl_Position = vec4(dot(p, across_u), dot(p, across_v), 0, 1);
}
)";

const char* const outline_fragment_shader = R"(
layout(location = 0) out float covered;
#ifdef COLORS
in vec2 uv;
uniform sampler2D picture;
uniform vec4 factor;
uniform float cutoff;
#endif

void main() {
#ifdef COLORS
  if (texture(picture, uv).a * factor.a < cutoff) discard;
#endif
  covered = 1;
}
)";

float f(double x) {
  return float(x);
}

void set_axes(const gl::Program& program, const raster::Shot& shot) {
  array<float, 9> axes{};
  for (size_t i = 0; i < 9; ++i) axes[i] = shot.lens.axes[i / 3][i % 3];
  gl::UniformMatrix3fv(program.at("axes"), 1, GL_FALSE, axes.data());
}

/// Sets what the fragment shaders need of a part.
void set_part(const gl::Program& program, const MeshColors& colors, const MeshPart& part) {
  colors.bind(part);
  gl::Uniform4f(program.at("factor"), part.factor[0], part.factor[1], part.factor[2], part.factor[3]);
  gl::Uniform1f(program.at("cutoff"), part.cutoff);
  gl::Uniform1f(program.at("plain"), part.colored ? 0 : 1);
}

/// Half the side of an outline's picture, in the file's units.
double reach_of(const Shapes& shapes, size_t file) {
  return 1.05 * shapes.half(file).norm();
}

/// Red, green or blue of a point in a colour of its own.
float light_at(uint32_t roots, size_t i) {
  const float root = float(roots >> 10 * i & 1023U) / 1023;
  return root * root;
}

/// Each level has the means of four values of the one before.
void add_levels(raster::OutlineLevels& outline) {
  for (int side = outline.side; side > 1; side /= 2) {
    const vector<float>& fine = outline.levels.back();
    const auto n = size_t(side), half = n / 2;
    vector<float> coarse(half * half);
    for (size_t y = 0; y < half; ++y)
      for (size_t x = 0; x < half; ++x)
        coarse[y * half + x] = 0.25F * (fine[2 * y * n + 2 * x] + fine[2 * y * n + 2 * x + 1] +
                                        fine[(2 * y + 1) * n + 2 * x] + fine[(2 * y + 1) * n + 2 * x + 1]);
    outline.levels.push_back(std::move(coarse));
  }
}

}  // namespace

Meshes::Meshes(const vector<DrawnFile>& files, Size size, bool smooth)
    : size_(size),
      fine_(smooth ? 4 : 1),
      shapes_(files),
      program_({vertex_shader}, {fragment_shader}),
      outline_program_({outline_vertex_shader}, {outline_fragment_shader}),
      what_(gl::make_texture(GL_RG32UI, tile_side * fine_, tile_side * fine_)),
      depth_(gl::make_texture(GL_DEPTH_COMPONENT32F, tile_side * fine_, tile_side * fine_)),
      buffer_(gl::make_framebuffer(array{what_.name()}, depth_.name())) {
  // By pixel.
  const size_t pixels = size_t(size.width) * size_t(size.height);
  pixels_.depth.resize(pixels);
  pixels_.cover.resize(pixels);
  pixels_.solid.resize(pixels);
  pixels_.normal.resize(pixels);
  pixels_.color.resize(pixels);

  bool colored = false;
  for (size_t i = 0; i < shapes_.count(); ++i) colored |= shapes_.colors(i) != nullptr;
  if (!colored) return;

  gl::Texture color = gl::make_texture(GL_R32UI, tile_side * fine_, tile_side * fine_);
  gl::Framebuffer both = gl::make_framebuffer(array{what_.name(), color.name()}, depth_.name());
  colored_.emplace(Colored{gl::Program({with_colors, vertex_shader}, {with_colors, fragment_shader}),
                           gl::Program({with_colors, vertex_shader}, {with_colors, with_holes, fragment_shader}),
                           gl::Program({with_colors, outline_vertex_shader}, {with_colors, outline_fragment_shader}),
                           std::move(color),
                           std::move(both),
                           {}});
}

Meshes::~Meshes() {
  try {
    context_.make_current();
  } catch (const RenderError&) {
    // A context that cannot be used has nothing left to free.
  }
}

MeshSize Meshes::size_of(const MeshUse& use, size_t file) const {
  return {use.scale * shapes_.radius(file, use.center), use.scale * (shapes_.middle(file) - use.center),
          use.scale * reach_of(shapes_, file), shapes_.mean(file)};
}

void Meshes::draw_outline(size_t file) const {
  const MeshColors* const colors = shapes_.colors(file);
  const bool holes = colors && colors->has_holes();
  const gl::Program& program = holes ? colored_->outline_program : outline_program_;
  program.use();
  gl::Uniform1f(program.at("reach"), f(reach_of(shapes_, file)));
  if (!holes) return shapes_.draw(file, 0, 1);
  shapes_.draw_parts(file, 0, 1, [&](const MeshPart& part) { set_part(program, *colors, part); });
}

void Meshes::draw_outlines(raster::Shot& shot) {
  const raster::Float3& l = shot.lighting.lamps[0].vector;
  const array<raster::Float3, 4> now{l, shot.lens.axes[0], shot.lens.axes[1], shot.lens.axes[2]};

  // The outlines stay as long as light and camera have these directions.
  if (outlines_.of_files.empty() || now != outlined_) {
    outlined_ = now;
    outlines_.across = raster::across(l);
    outlines_.of_files.assign(shapes_.count(), {});

    for (const gl::Program* program : {&outline_program_, colored_ ? &colored_->outline_program : nullptr}) {
      if (!program) continue;
      program->use();
      set_axes(*program, shot);
      gl::Uniform3fv(program->at("across_u"), 1, outlines_.across.u.data());
      gl::Uniform3fv(program->at("across_v"), 1, outlines_.across.v.data());
    }

    shapes_.fill_instances(array<float, Shapes::row>{});
    const gl::Texture texture = gl::make_texture(GL_R32F, outline_side, outline_side);
    const gl::Framebuffer framebuffer = gl::make_framebuffer(array{texture.name()}, 0);
    gl::Viewport(0, 0, outline_side, outline_side);
    gl::Disable(GL_DEPTH_TEST);

    for (size_t i = 0; i < shapes_.count(); ++i) {
      const float nothing[4] = {};
      gl::ClearBufferfv(GL_COLOR, 0, nothing);
      draw_outline(i);

      raster::OutlineLevels& outline = outlines_.of_files[i];
      outline.side = outline_side;
      outline.levels.emplace_back(size_t{outline_side} * outline_side);
      gl::ReadPixels(0, 0, outline_side, outline_side, GL_RED, GL_FLOAT, outline.levels[0].data());
      add_levels(outline);
    }

    gl::check("drawing the meshes' outlines");
  }

  shot.outlines = &outlines_;
}

void Meshes::draw_tile(const Rect& tile, const vector<PlacedMesh>& meshes, const vector<Rect>& bounds) {
  used_ = {tile.right, tile.bottom, tile.left, tile.top};

  // The meshes in this tile, and the part of it that they may cover.
  vector<size_t> inside;
  for (size_t i = 0; i < meshes.size(); ++i) {
    const Rect& b = bounds[i];
    if (b.left >= tile.right || b.right <= tile.left || b.top >= tile.bottom || b.bottom <= tile.top) continue;
    inside.push_back(i);

    used_ = {min(used_.left, max(b.left, tile.left)), min(used_.top, max(b.top, tile.top)),
             max(used_.right, min(b.right, tile.right)), max(used_.bottom, min(b.bottom, tile.bottom))};
  }

  if (inside.empty()) {
    used_ = {};
    return;
  }

  // Meshes of one file are together. Those in colours of their own hide the farther ones before these are coloured.
  ranges::stable_sort(inside, [&](size_t a, size_t b) {
    const PlacedMesh &m = meshes[a], &n = meshes[b];
    return m.file != n.file ? m.file < n.file : shapes_.colors(m.file) && m.middle.z() < n.middle.z();
  });

  vector<float> rows;
  for (const size_t i : inside) {
    const PlacedMesh& m = meshes[i];
    rows.insert(rows.end(), {f(m.middle.x()), f(m.middle.y()), f(m.middle.z()), f(m.solid + 1), f(m.scale), m.plain[0],
                             m.plain[1], m.plain[2]});
  }
  shapes_.fill_instances(rows);

  const int wide = tile.right - tile.left, high = tile.bottom - tile.top;
  gl::BindFramebuffer(GL_FRAMEBUFFER, buffer_.name());
  gl::Viewport(0, 0, wide * fine_, high * fine_);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  const GLuint nothing[4] = {};
  const float infinitely_far = 0;
  gl::ClearBufferuiv(GL_COLOR, 0, nothing);
  gl::ClearBufferfv(GL_DEPTH, 0, &infinitely_far);

  const double x = 1.0 / wide, y = 1.0 / high;
  program_.use();
  const array<float, 4> to_tile{f(size_.width * x), f(size_.height * y), f((size_.width - 2 * tile.left) * x - 1),
                                f((size_.height - 2 * tile.top) * y - 1)};
  gl::Uniform4f(program_.at("to_tile"), to_tile[0], to_tile[1], to_tile[2], to_tile[3]);

  // One call draws all meshes of one file.
  vector<FileRows> colored;
  for (size_t first = 0, end = 0; first < inside.size(); first = end) {
    const size_t file = meshes[inside[first]].file;
    while (end < inside.size() && meshes[inside[end]].file == file) ++end;
    if (shapes_.colors(file)) {
      colored.push_back({file, first, end - first});
    } else {
      shapes_.draw(file, first, end - first);
    }
  }

  if (colored_) draw_colored(colored, to_tile);
}

void Meshes::draw_colored(const vector<FileRows>& rows, const array<float, 4>& to_tile) {
  colored_->used = !rows.empty();
  if (rows.empty()) return;

  gl::BindFramebuffer(GL_FRAMEBUFFER, colored_->buffer.name());
  for (const gl::Program* program : {&colored_->program, &colored_->holes_program}) {
    program->use();
    gl::Uniform4f(program->at("to_tile"), to_tile[0], to_tile[1], to_tile[2], to_tile[3]);
  }

  for (const FileRows& of_file : rows) {
    const MeshColors& colors = *shapes_.colors(of_file.file);
    shapes_.draw_parts(of_file.file, of_file.first, of_file.count, [&](const MeshPart& part) {
      const gl::Program& program = part.cutoff > 0 ? colored_->holes_program : colored_->program;
      program.use();
      set_part(program, colors, part);
    });
  }
}

void Meshes::resolve(const Rect& tile, const raster::Shot& shot) {
  const int wide = (used_.right - used_.left) * fine_, high = (used_.bottom - used_.top) * fine_;
  if (wide <= 0) return;

  const size_t points = size_t(wide) * size_t(high);
  what_read_.resize(2 * points);
  depth_read_.resize(points);

  const int left = (used_.left - tile.left) * fine_, top = (used_.top - tile.top) * fine_;
  gl::PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl::ReadPixels(left, top, wide, high, GL_RG_INTEGER, GL_UNSIGNED_INT, what_read_.data());
  gl::ReadPixels(left, top, wide, high, GL_DEPTH_COMPONENT, GL_FLOAT, depth_read_.data());

  const bool colored = colored_ && colored_->used;
  if (colored) {
    colored_->read.resize(points);
    gl::ReadBuffer(GL_COLOR_ATTACHMENT1);
    gl::ReadPixels(left, top, wide, high, GL_RED_INTEGER, GL_UNSIGNED_INT, colored_->read.data());
    gl::ReadBuffer(GL_COLOR_ATTACHMENT0);
  }

  gl::check("drawing meshes");
  for (int y = used_.top; y < used_.bottom; ++y)
    for (int x = used_.left; x < used_.right; ++x) {
      raster::Float3 normal{}, color{};
      float nearest = 0, farthest = 2;
      uint32_t solid = 0;
      int covered = 0;

      // The mean over the places of the pixel.
      for (int k = 0; k < fine_ * fine_; ++k) {
        const auto at = size_t(((y - used_.top) * fine_ + k / fine_) * wide + (x - used_.left) * fine_ + k % fine_);
        const uint32_t number = what_read_[2 * at] & ~colored_bit, q = what_read_[2 * at + 1];
        if (number == 0) continue;

        const bool own = (what_read_[2 * at] & colored_bit) != 0;
        ++covered;
        if (depth_read_[at] > nearest) nearest = depth_read_[at], solid = number;
        farthest = min(farthest, depth_read_[at]);

        for (size_t i = 0; i < 3; ++i) {
          normal[i] += (float(q >> 10 * i & 1023U) - 512) / 511;
          color[i] += own ? light_at(colored_->read[at], i) : shot.solids[number - 1].color[i];
        }
      }

      if (covered == 0) continue;
      const auto pixel = size_t(y) * size_t(size_.width) + size_t(x);
      pixels_.depth[pixel] = shot.lens.near / (0.5F * (nearest + farthest));
      pixels_.cover[pixel] = float(covered) / float(fine_ * fine_);
      pixels_.solid[pixel] = int32_t(solid) - 1;

      // The mean normal: its light is the mean of matt faces' light. Across an edge it is short, and nothing glints
      // there that would not on either face.
      const float length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      const float even = length / float(covered);
      for (size_t i = 0; i < 3; ++i) {
        pixels_.normal[pixel][i] = even > 0.97F ? normal[i] / length : normal[i] / float(covered);
        pixels_.color[pixel][i] = color[i] / float(covered);
      }
    }
}

void Meshes::draw(const vector<PlacedMesh>& meshes, const Eye& eye, raster::Shot& shot) {
  context_.make_current();

  if (!shot.lighting.lamps[0].near) {
    draw_outlines(shot);
  } else {
    for (raster::MeshShadow& mesh : shot.meshes) mesh.outline = -1;
  }

  ranges::fill(pixels_.depth, 0.0F);
  shot.mesh_pixels = &pixels_;

  vector<const gl::Program*> programs{&program_};
  if (colored_) programs.insert(programs.end(), {&colored_->program, &colored_->holes_program});
  for (const gl::Program* program : programs) {
    program->use();
    set_axes(*program, shot);
    gl::Uniform2f(program->at("tangent"), f(eye.tan_x), f(eye.tan_y));
    gl::Uniform1f(program->at("near"), shot.lens.near);
  }

  vector<Rect> bounds;
  for (const PlacedMesh& m : meshes) {
    const raster::Solid& solid = shot.solids[size_t(m.solid)];
    const raster::PixelBounds b = raster::bounds_of_ball(shot.lens, solid.center, solid.radius);
    bounds.push_back({b.left, b.top, b.right, b.bottom});
  }

  for (int y = 0; y < size_.height; y += tile_side)
    for (int x = 0; x < size_.width; x += tile_side) {
      const Rect tile{x, y, min(x + tile_side, size_.width), min(y + tile_side, size_.height)};
      draw_tile(tile, meshes, bounds);
      resolve(tile, shot);
    }
}

}  // namespace carom
