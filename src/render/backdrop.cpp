// Draws background, planes and walls by tracing one ray for each pixel, in a fragment shader over the whole picture.
// Endless planes cannot be drawn as triangles. Where neighbouring rays meet different surfaces, a pixel takes 16
// samples.
#include "render/backdrop.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "scene/scene.h"

namespace carom {
namespace {

// Finds the surface that a ray meets. With s = 1 / z every plane is a linear function of the picture, s = -(n.d) / h,
// and the horizon is s = 0. The free sides of all planes together are a convex room. A ray shows the plane through
// which it leaves the room. Before that it must have entered the room through the planes that the eye is behind. Planes
// thus cut each other off where they meet, a room is visible from outside, and no plane hides a movable thing.
const char* const tracing = R"(
uniform samplerBuffer rows;
uniform int planes, walls;

vec4 texel(int surface, int column) { return texelFetch(rows, surface * 5 + column); }

// The number of the surface in direction d, 0 for none; s = 1 / z there.
int surface_at(vec3 d, out float s) {
  float entry = 1e30;
  int number = 0;
  s = 0;
  for (int i = 0; i < planes; ++i) {
    vec4 plane = texel(i, 0);
    float slope = dot(plane.xyz, d);
    if (plane.w > 0) {
      float leave = -slope / plane.w;
      if (leave > s) { s = leave; number = i + 1; }
    } else if (plane.w < 0) {
      entry = min(entry, max(slope, 0) / -plane.w);
    }
  }
  if (s >= entry) { s = 0; number = 0; }
  for (int i = planes; i < planes + walls; ++i) {
    vec4 wall = texel(i, 0);
    float at = -dot(wall.xyz, d) / max(wall.w, 1e-30);
    if (at <= s) continue;
    vec3 p = d / at;
    vec4 right = texel(i, 1), up = texel(i, 2), half_size = texel(i, 4);
    if (abs(dot(right.xyz, p) + right.w) > half_size.x || abs(dot(up.xyz, p) + up.w) > half_size.y) continue;
    s = at;
    number = i + 1;
  }
  return number;
}
)";

const char* const shading = R"(
uniform float unit, reach, pixel;
uniform bool plain_background;
uniform vec3 background_color;

vec3 background(vec3 d) {
  if (plain_background) return background_color;
  float height = dot(normalize(d), world_up);
  vec3 horizon = vec3(0.66, 0.69, 0.72);
  vec3 far = height > 0 ? vec3(0.30, 0.38, 0.47) : vec3(0.36, 0.37, 0.39);
  return mix(horizon, far, smoothstep(0, 0.75, abs(height)));
}

// Squares and lines, averaged over the box w that a pixel covers.
float squares(vec2 p, vec2 w) {
  vec2 i = 2 * (abs(fract((p - 0.5 * w) * 0.5) - 0.5) - abs(fract((p + 0.5 * w) * 0.5) - 0.5)) / w;
  return 0.5 - 0.5 * i.x * i.y;
}
float lines(vec2 p, vec2 w, float width) {
  vec2 a = p - 0.5 * w + 0.5 * width, b = p + 0.5 * w + 0.5 * width;
  vec2 covered = (floor(b) * width + min(fract(b), width) - floor(a) * width - min(fract(a), width)) / w;
  return 1 - (1 - covered.x) * (1 - covered.y);
}

vec3 plane_color(int i, vec3 p, vec3 px, vec3 py) {
  vec4 right = texel(i, 1), up = texel(i, 2);
  vec2 at = vec2(dot(right.xyz, p) + right.w, dot(up.xyz, p) + up.w) / unit;
  vec2 w = vec2(abs(dot(right.xyz, px)) + abs(dot(right.xyz, py)), abs(dot(up.xyz, px)) + abs(dot(up.xyz, py))) / unit;
  w = max(w, vec2(1e-4));
  vec3 color = texel(i, 3).rgb;
  color *= 1 - 0.17 * squares(at, w);
  float fine = 1 - smoothstep(0.02, 0.10, max(w.x, w.y));  // lines closer than a few pixels turn into an even tone
  color *= 1 - 0.16 * fine * lines(at * 10, w * 10, 0.04);
  return color;
}

vec3 wall_color(int i, vec3 p, vec3 px, vec3 py) {
  vec4 right = texel(i, 1), up = texel(i, 2), size = texel(i, 4);
  vec2 at = vec2(dot(right.xyz, p) + right.w, dot(up.xyz, p) + up.w);
  vec2 w = vec2(abs(dot(right.xyz, px)) + abs(dot(right.xyz, py)), abs(dot(up.xyz, px)) + abs(dot(up.xyz, py)));
  w = max(w, vec2(1e-6 * unit));
  vec3 color = texel(i, 3).rgb;
  color *= 1 - 0.06 * squares(at / (0.5 * unit), w / (0.5 * unit));
  vec2 inside = size.xy - abs(at);  // a darker rim shows where the wall ends
  float rim = 0.02 * min(size.x, size.y) + 0.004 * unit;
  vec2 edge = 1 - clamp((inside - rim) / w + 0.5, 0, 1);
  return color * (1 - 0.35 * max(edge.x, edge.y));
}

// A surface's colour with and without the key light.
void shade(int number, float s, vec3 d, out vec3 lit, out vec3 shaded) {
  vec3 sky = background(d);
  lit = shaded = sky;
  if (number == 0) return;
  int i = number - 1;
  vec3 n = texel(i, 0).xyz;
  float h = texel(i, 0).w;
  vec3 p = d / s;
  vec3 px = (vec3(pixel, 0, 0) + p * n.x * pixel / h) / s;  // how p moves from pixel to pixel
  vec3 py = (vec3(0, pixel, 0) + p * n.y * pixel / h) / s;
  vec3 color = i < planes ? plane_color(i, p, px, py) : wall_color(i, p, px, py);

  vec3 soft = hemisphere(n);
  for (int k = 0; k < planes; ++k) {  // corners are a little darker
    vec4 other = texel(k, 0);
    if (k == i || other.w <= 0) continue;
    float away = max(dot(other.xyz, p) + other.w, 0);
    soft *= 1 - 0.30 * exp(-away / (0.35 * unit));
  }
  for (int k = 1; k < LIGHTS; ++k) soft += light_radiance[k] * max(dot(n, towards_light(k, p)), 0);
  vec3 l = towards_light(0, p);
  float open = 1;
  for (int k = planes; k < planes + walls; ++k) {
    if (k == i) continue;
    vec4 right = texel(k, 1), up = texel(k, 2);
    vec3 normal = texel(k, 0).xyz;
    vec3 center = -right.w * right.xyz - up.w * up.xyz - texel(k, 0).w * normal;
    open *= through_wall(p, l, normal, center, right.xyz, texel(k, 4).x, up.xyz, texel(k, 4).y);
  }
  vec3 hard = light_radiance[0] * max(dot(n, l), 0) * open;
  // An endless plane melts into the background long before its pattern could flicker.
  float away = i < planes ? length(p) / (8 * reach) : 0;
  float haze = 1 - exp(-away * away);
  lit = mix(color * (soft + hard), sky, haze);
  shaded = mix(color * soft, sky, haze);
}
)";

const char* const fragment_main = R"(
uniform vec2 tangent, picture;
uniform float near;
layout(location = 0) out vec4 lit_out;
layout(location = 1) out vec4 edge_out;
layout(location = 2) out float edge_depth_out;

vec3 ray(vec2 at) { return vec3((2 * at / picture - 1) * vec2(1, -1) * tangent, 1); }

void main() {
  vec3 lit, shaded;
  float s;
  int number = surface_at(ray(gl_FragCoord.xy), s);
  shade(number, s, ray(gl_FragCoord.xy), lit, shaded);
  edge_out = vec4(0);
  edge_depth_out = 0;
  gl_FragDepth = clamp(near * s, 0, 1);

#ifdef SMOOTH
  bool one = true;
  for (int k = 0; k < 4; ++k) {
    float s_k;
    one = one && surface_at(ray(gl_FragCoord.xy + vec2(k & 1, k >> 1) - 0.5), s_k) == number;
  }
  if (!one) {
    lit = shaded = vec3(0);
    float farthest = 1e30, nearest = 0, covered = 0;
    vec3 wall = vec3(0);
    for (int k = 0; k < 16; ++k) {
      vec3 d = ray(gl_FragCoord.xy + (vec2(k & 3, k >> 2) + 0.5) / 4 - 0.5);
      float s_k;
      vec3 lit_k, shaded_k;
      int number_k = surface_at(d, s_k);
      shade(number_k, s_k, d, lit_k, shaded_k);
      lit += lit_k / 16;
      shaded += shaded_k / 16;
      farthest = min(farthest, s_k);
      if (number_k > planes) { nearest = max(nearest, s_k); covered += 1; wall += lit_k; }
    }
    gl_FragDepth = clamp(near * farthest, 0, 1);
    if (covered > 0 && covered < 16) {
      edge_out = vec4(wall / covered, covered / 16);
      edge_depth_out = clamp(near * nearest, 0, 1);
    }
  }
#endif
  lit_out = vec4(lit, light_mix(dot(shaded, vec3(1)) / max(dot(lit, vec3(1)), 1e-6)));
}
)";

}  // namespace

Backdrop::Backdrop(const Scene& scene, const Eye& eye, const Lighting& lighting, const Surfaces& surfaces,
                   const gl::TexelBuffer& rows, bool smooth) {
  const auto [width, height] = eye.size;
  const bool walls = surfaces.walls() > 0;
  lit = gl::make_texture(GL_SRGB8_ALPHA8, width, height);
  depth = gl::make_texture(GL_DEPTH_COMPONENT32F, width, height);
  std::vector<GLuint> targets{lit.name()};
  if (walls) {
    edge = gl::make_texture(GL_SRGB8_ALPHA8, width, height);
    edge_depth = gl::make_texture(GL_R32F, width, height);
    targets.insert(targets.end(), {edge.name(), edge_depth.name()});
  }
  const gl::Framebuffer framebuffer = gl::make_framebuffer(targets, depth.name());
  const gl::Program program({picture_vertex_shader},
                            {smooth ? "#define SMOOTH\n" : "", lighting.shader(), tracing, shading, fragment_main});
  program.use();
  lighting.set(program);
  gl::Uniform1i(program.at("rows"), 0);
  rows.bind(0);
  gl::Uniform1i(program.at("planes"), static_cast<GLint>(surfaces.planes()));
  gl::Uniform1i(program.at("walls"), static_cast<GLint>(surfaces.walls()));
  gl::Uniform1f(program.at("unit"), static_cast<float>(surfaces.unit()));
  gl::Uniform1f(program.at("reach"), static_cast<float>(surfaces.reach()));
  gl::Uniform1f(program.at("pixel"), static_cast<float>(eye.pixel));
  gl::Uniform1f(program.at("near"), static_cast<float>(eye.camera.near));
  gl::Uniform2f(program.at("tangent"), static_cast<float>(eye.tan_x), static_cast<float>(eye.tan_y));
  gl::Uniform2f(program.at("picture"), static_cast<float>(width), static_cast<float>(height));
  gl::Uniform1i(program.at("plain_background"), scene.background ? 1 : 0);
  if (scene.background) gl::Uniform3fv(program.at("background_color"), 1, linear(*scene.background).data());

  gl::Viewport(0, 0, width, height);
  gl::Disable(GL_BLEND);
  gl::Enable(GL_FRAMEBUFFER_SRGB);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_ALWAYS);
  gl::draw_picture();
  gl::check("drawing the planes and walls");
}

}  // namespace carom
