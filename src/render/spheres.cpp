// Draws each ball as one quadrilateral, in which the ray of every pixel is intersected with the sphere. Balls of any
// size are exactly round. Edges have analytic coverage. Balls smaller than a pixel become larger and fainter, with the
// same coverage.
#include "render/spheres.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/material.h"

#include "render/renderer.h"

namespace carom {
namespace {

const char* const sphere_vertex_shader = R"(
layout(location = 0) in vec4 ball_in;       // centre, radius
layout(location = 1) in vec4 outline_in;    // centre and longer half axis in the plane z = 1; a zero axis: no ellipse
layout(location = 2) in vec4 shape_in;      // shorter half axis' length, depth2, opacity, -
layout(location = 3) in vec4 color_in;      // linear colour, -
layout(location = 4) in vec2 occluders_in;  // first, count
flat out vec4 ball, outline, shape;
flat out vec3 color;
flat out ivec2 occluders;
out vec2 at;     // in the plane z = 1
out vec2 local;  // in half axes
uniform vec2 tangent;
uniform float pixel;

void main() {
  ball = ball_in; outline = outline_in; shape = shape_in; color = color_in.rgb; occluders = ivec2(occluders_in);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1;
  float a = length(outline.zw), b = shape.x;
  if (a > 0) {
    vec2 along = outline.zw / a;
    local = corner * (1 + 1.0 * pixel / vec2(a, b));  // a margin for the soft edge
    at = outline.xy + local.x * outline.zw + local.y * b * vec2(-along.y, along.x);
  } else {
    local = vec2(0);
    at = corner * tangent;
  }
  gl_Position = vec4(at / tangent * vec2(1, -1), 0, 1);
}
)";

const char* const sphere_fragment_shader = R"(
flat in vec4 ball, outline, shape;
flat in vec3 color;
flat in ivec2 occluders;
in vec2 at, local;
uniform float pixel, near;
layout(location = 0) out vec4 color_out;
#ifdef WALLS
uniform sampler2D edges, edge_depths;
#endif

void main() {
  // The ray t (at, 1) meets the sphere where d.d t^2 - 2 d.c t + c.c - r^2 = 0; its discriminant is 0 on the outline. Of
  // small and distant balls the outline's own coordinates give it without cancellation.
  vec3 d = vec3(at, 1);
  float dd = dot(d, d), dc = dot(d, ball.xyz);
  float disc, inside;  // inside: pixels from the outline, to first order
  if (shape.x > 0) {
    float rest = 1 - dot(local, local);
    vec2 slope = local / vec2(length(outline.zw), shape.x);
    disc = shape.y * max(rest, 0.5 * pixel / shape.x);  // an edge pixel is shaded as the covered part of it, not as its rim
    float out_at = length(local);
    inside = (1 - out_at) * (out_at > 1e-4 ? out_at / length(slope) : shape.x) / pixel;
  } else {
    float power = dot(ball.xyz, ball.xyz) - ball.w * ball.w;
    disc = dc * dc - dd * power;
    inside = disc / (2 * length(dc * ball.xy - power * at) * pixel + 1e-20);
  }
#ifdef SMOOTH
  float cover = clamp(inside + 0.5, 0, 1) * shape.z;
#else
  float cover = inside >= 0 ? 1 : 0;
#endif
  if (cover <= 0) discard;

  float half_chord = sqrt(max(disc, 0)) / dd, middle = dc / dd;
  float t = middle - half_chord;
  bool cut = t < near;  // the near plane cuts the ball open: its inside shows
  if (cut) t = middle + half_chord;
  if (t < near) discard;
  gl_FragDepth = near / t;
#ifdef WALLS
  bool behind_edge = near / t < texelFetch(edge_depths, ivec2(gl_FragCoord.xy), 0).r;
#endif

  vec3 p = d * t;
  vec3 n = normalize(p - ball.xyz);
  vec3 seen = seen_light(p, n, normalize(-d), color, occluders, cut);
#ifdef WALLS
  vec4 edge = texelFetch(edges, ivec2(gl_FragCoord.xy), 0);
  if (behind_edge) seen = mix(seen, edge.rgb, edge.a);
#endif
  color_out = vec4(seen, cover);
}
)";

// Row numbers pass through float attributes, which are exact integers only up to this number.
// The balls in front come last, and would be without shadows upon them. In a picture of so many balls, single ones are
// not visible.
constexpr std::size_t most_rows = (std::size_t{1} << 24) - 4096;

}  // namespace

Spheres::Spheres(const Eye& eye, const Lighting& lighting, const Surfaces& surfaces, const MeshShadows* meshes,
                 bool solids, bool smooth)
    : eye_(eye),
      lighting_(lighting),
      surfaces_(surfaces),
      meshes_(meshes),
      smooth_(smooth),
      program_({sphere_vertex_shader},
               {smooth ? "#define SMOOTH\n" : "", surfaces.walls() ? "#define WALLS\n" : "",
                solids ? "#define SOLIDS\n" : "", meshes ? "#define MESHES\n" : "", lighting.shader(),
                meshes ? MeshShadows::shader() : "", material_shader, sphere_fragment_shader}),
      instances_({4, 4, 4, 4, 2}) {
  program_.use();
  lighting.set(program_);
  if (meshes) meshes->set(program_, 4);
  gl::Uniform2f(program_.at("tangent"), static_cast<float>(eye.tan_x), static_cast<float>(eye.tan_y));
  gl::Uniform1f(program_.at("pixel"), static_cast<float>(eye.pixel));
  gl::Uniform1f(program_.at("near"), static_cast<float>(eye.camera.near));
  gl::Uniform1i(program_.at("occluder_rows"), 0);
  gl::Uniform1i(program_.at("rows"), 1);
  gl::Uniform1i(program_.at("edges"), 2);
  gl::Uniform1i(program_.at("edge_depths"), 3);
}

void Spheres::draw(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  const std::span<const Thing> balls = things.all();
  const std::span<const std::uint32_t> seen = things.balls();
  if (seen.empty()) return;
  // Constructed only if some ball is large enough to show a shadow upon it.
  std::optional<Occluders> occluders;
  row_.clear();
  occluder_row_.clear();
  const auto f = [](double x) { return static_cast<float>(x); };
  for (std::uint32_t i : seen) {
    const Thing& ball = balls[i];
    Outline o{};
    double opacity = 1, b = 0;
    bool large = true;
    if (outline_of(ball.center, ball.radius, o)) {
      const double a = std::hypot(o.ax, o.ay);
      b = std::hypot(o.bx, o.by);
      large = b > 1.5 * eye_.pixel;
      // A disc smaller than a pixel cannot be drawn. A larger and fainter one has the same coverage.
      const double least = smooth_ ? eye_.pixel : 0;
      const double wide_a = std::max(a, least), wide_b = std::max(b, least);
      // The soft edge is a ramp one pixel wide. It adds the area of a disc of radius pixel / sqrt 12.
      if (wide_b > b) opacity = a * b / (wide_a * wide_b + eye_.pixel * eye_.pixel / 12);
      o.ax *= wide_a / a, o.ay *= wide_a / a;
      b = wide_b;
    }
    const std::size_t first = occluder_row_.size() / 4;
    if (large && first < most_rows) {
      if (!occluders) occluders.emplace(balls, lighting_);
      occluders->append_rows(i, things, surfaces_, occluder_row_);
    }
    for (double x : {ball.center.x(), ball.center.y(), ball.center.z(), ball.radius, o.x, o.y, o.ax, o.ay, b, o.depth2,
                     opacity, 0.0})
      row_.push_back(f(x));
    for (const float c : things.look(ball).color) row_.push_back(c);
    row_.push_back(0);
    row_.push_back(static_cast<float>(first));
    row_.push_back(static_cast<float>(occluder_row_.size() / 4 - first));
  }
  program_.use();
  if (!occluder_row_.empty()) occluders_.fill(occluder_row_);
  occluders_.bind(0);
  rows.bind(1);
  if (meshes_) meshes_->bind(4);
  if (surfaces_.walls()) {
    gl::bind_texture(2, backdrop.edge);
    gl::bind_texture(3, backdrop.edge_depth);
  }
  gl::Enable(GL_BLEND);
  gl::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  instances_.draw(row_);
  gl::check("drawing balls");
}

}  // namespace carom
