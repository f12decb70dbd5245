// Draws shadows and contact darkening onto a copy of the backdrop, as rectangles that the depth test confines to their
// surface. Shadows are computed for each pixel by the analytic functions of lighting.cpp, so that they have no
// resolution.
#include "render/shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// Each instance is a rectangle on a surface, around the shadow of one ball there or around the place where the ball is
// close. The backdrop's depth confines it to the visible part of that surface. The darkest effect of all balls on a
// pixel counts, so that overlapping shadows are not darker than one.
const char* const thing_vertex_shader = R"(
layout(location = 0) in vec3 origin;     // middle of the rectangle
layout(location = 1) in vec3 u;          // half side
layout(location = 2) in vec3 v;          // half side
layout(location = 3) in vec4 ball_in;    // centre, radius
layout(location = 4) in vec3 normal_in;  // of the surface
layout(location = 5) in vec3 kind_in;    // 1: the ball's closeness darkens, 0: its shadow; 1: other planes may cut it off;
                                         // the wall's number, or -1: a plane
#ifdef SOLIDS
layout(location = 6) in vec4 solid_in;   // half size, 0: a ball, 1: a box, 2: a cylinder;
                                         // file, reach, -, 3: a mesh
flat out vec4 solid;
#endif
flat out vec4 ball;
flat out vec3 normal;
flat out vec3 kind;
out vec3 p;
uniform vec2 tangent;
uniform float near;

void main() {
#ifdef SOLIDS
  solid = solid_in;
#endif
  ball = ball_in;
  normal = normal_in;
  kind = kind_in;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1;
  p = origin + corner.x * u + corner.y * v;
  // The depth near / z as in the backdrop, a ten-thousandth nearer.
  gl_Position = vec4(p.xy / tangent * vec2(1, -1), 2.0002 * near - p.z, p.z);
}
)";

const char* const thing_fragment_shader = R"(
#ifdef SOLIDS
flat in vec4 solid;
#endif
flat in vec4 ball;
flat in vec3 normal;
flat in vec3 kind;
#ifdef WALLS
uniform samplerBuffer rows;
uniform float pixel;
#endif
in vec3 p;
uniform sampler2D lit;
uniform vec4 planes[PLANES + 1];  // normal, the eye's height
uniform float slack;
layout(location = 0) out vec4 color;

void main() {
  // Beyond another plane this surface is cut off, though nothing else may hide it there.
  if (kind.y > 0)
    for (int k = 0; k < PLANES; ++k)
      if (dot(planes[k].xyz, p) + planes[k].w < -slack) discard;
#ifdef WALLS
  if (kind.z >= 0) {
    int i = int(kind.z);
    vec4 right = texelFetch(rows, i * 5 + 1), up = texelFetch(rows, i * 5 + 2), half_size = texelFetch(rows, i * 5 + 4);
    vec2 at = vec2(dot(right.xyz, p) + right.w, dot(up.xyz, p) + up.w);
    if (any(greaterThan(abs(at), half_size.xy + pixel * p.z))) discard;
  }
#endif
  vec4 now = texelFetch(lit, ivec2(gl_FragCoord.xy), 0);
  vec3 to_ball = ball.xyz - p;
  float open = 1, sky = 1;
  if (kind.x > 0) {
    // A sphere above the horizon takes cos(angle) (r / d)^2 of an even sky's light.
    float d2 = max(dot(to_ball, to_ball), 1e-30);
    float taken = dot(normal, to_ball) * ball.w * ball.w / (d2 * sqrt(d2));
    sky = 1 - 0.85 * clamp((taken - LEAST_TAKEN) / (1 - LEAST_TAKEN), 0, 1);
#ifdef MESHES
  } else if (solid.w > 2.5) {
    open = through_mesh(p, towards_light(0, p), to_ball, solid.x, solid.y);
#endif
#ifdef SOLIDS
  } else if (solid.w > 0) {
    open = through_solid(p, towards_light(0, p), to_ball, solid.xyz, solid.w < 1.5);
#endif
  } else {
    open = through_ball(p, towards_light(0, p), to_ball, ball.w);
  }
  color = vec4(now.rgb * mix(vec3(open), vec3(sky), part_in_shadow(now.a)), 1);
}
)";

/// A shader can test only so many planes. Beyond more planes, the depth of the backdrop cuts rectangles off.
std::size_t cutting_planes(const Surfaces& surfaces) {
  return surfaces.planes() > 1 ? std::min<std::size_t>(surfaces.planes(), 200) : 0;
}

// A share of the sky: a ball that takes less darkens nothing.
constexpr double least_taken = 0.1;
// Light at a smaller slope is too weak on a surface to cast shadows.
constexpr double least_slope = 0.03;

}  // namespace

Shade::Shade(const Eye& eye, const Lighting& lighting, const Surfaces& surfaces, const MeshShadows* meshes, bool solids)
    : eye_(eye),
      lighting_(lighting),
      surfaces_(surfaces),
      meshes_(meshes),
      solids_(solids),
      program_({solids ? "#define SOLIDS\n" : "", thing_vertex_shader},
               {solids ? "#define SOLIDS\n" : "", surfaces.walls() ? "#define WALLS\n" : "",
                fmt::format("#define PLANES {}\n#define LEAST_TAKEN {}\n", cutting_planes(surfaces), least_taken),
                meshes ? "#define MESHES\n" : "", lighting.shader(), meshes ? MeshShadows::shader() : "",
                thing_fragment_shader}),
      instances_(solids ? gl::Instances{3, 3, 3, 4, 3, 3, 4} : gl::Instances{3, 3, 3, 4, 3, 3}) {
  program_.use();
  lighting.set(program_);
  if (meshes) meshes->set(program_, 2);
  gl::Uniform2f(program_.at("tangent"), static_cast<float>(eye.tan_x), static_cast<float>(eye.tan_y));
  gl::Uniform1f(program_.at("near"), static_cast<float>(eye.camera.near));
  gl::Uniform1f(program_.at("pixel"), static_cast<float>(eye.pixel));
  gl::Uniform1i(program_.at("lit"), 0);
  gl::Uniform1i(program_.at("rows"), 1);
  std::vector<float> planes;
  for (std::size_t k = 0; k < cutting_planes(surfaces); ++k) {
    const Surface& s = surfaces.all()[k];
    for (double x : {s.normal.x(), s.normal.y(), s.normal.z(), s.height}) planes.push_back(static_cast<float>(x));
  }
  if (!planes.empty()) gl::Uniform4fv(program_.at("planes"), static_cast<GLsizei>(planes.size() / 4), planes.data());
  gl::Uniform1f(program_.at("slack"), static_cast<float>(1e-5 * surfaces.reach()));
}

bool Shade::in_picture(const Vec3& center, double radius) const {
  const double x = std::abs(center.x()), y = std::abs(center.y()), z = center.z();
  return z > -radius && (x - z * eye_.tan_x) < radius * std::hypot(1, eye_.tan_x) &&
         (y - z * eye_.tan_y) < radius * std::hypot(1, eye_.tan_y);
}

void Shade::add(Darkens darkens, const Thing& ball, std::size_t surface, const Vec3& origin, const Vec3& u,
                const Vec3& v) {
  const Surface& s = surfaces_.all()[surface];
  // Beyond the rectangle there is nothing to darken.
  if (s.wall) {
    const Vec3 offset = origin - s.center;
    const double reach = u.norm() + v.norm();
    if (std::abs(s.right.dot(offset)) > s.half_width + reach || std::abs(s.up.dot(offset)) > s.half_height + reach)
      return;
  }
  if (!in_picture(origin, std::hypot(u.norm(), v.norm()))) return;
  const auto push = [&](const Vec3& p) {
    for (int i = 0; i < 3; ++i) rows_.push_back(static_cast<float>(p[i]));
  };
  push(origin), push(u), push(v);
  push(ball.center), rows_.push_back(static_cast<float>(ball.radius));
  push(s.normal);
  // True if a corner of the rectangle is behind the plane.
  const auto cuts = [&](const Surface& plane) {
    const double low =
        plane.normal.dot(origin) + plane.height - std::abs(plane.normal.dot(u)) - std::abs(plane.normal.dot(v));
    return low < -1e-6 * surfaces_.reach();
  };
  const auto planes = surfaces_.all().begin();
  const bool cut = std::any_of(planes, planes + static_cast<std::ptrdiff_t>(cutting_planes(surfaces_)), cuts);
  rows_.push_back(darkens == Darkens::by_closeness ? 1.0F : 0.0F);
  rows_.push_back(cut ? 1.0F : 0.0F);
  rows_.push_back(s.wall ? static_cast<float>(surface) : -1.0F);
  if (!solids_) return;
  push(ball.half);
  const bool outline = ball.mesh && meshes_;
  rows_.push_back(outline ? 3.0F : ball.shape == Shape::sphere ? 0.0F : ball.shape == Shape::box ? 1.0F : 2.0F);
}

void Shade::add_shadow(const Thing& ball, std::size_t surface) {
  const Surface& s = surfaces_.all()[surface];
  // Height of the ball's centre above the surface.
  const double height = s.normal.dot(ball.center) + s.height;
  if (!lighting_.key_is_near()) {
    // A round beam of the ball's radius, widened by the blur, cuts the surface in an ellipse.
    const Vec3& l = lighting_.key();
    const double blur = Lighting::softness;
    const double slope = s.normal.dot(l);
    if (slope < least_slope || height < -ball.radius) return;
    const double along = std::max(height, 0.0) / slope, tilt = std::sqrt(std::max(0.0, 1 - slope * slope)) / slope;
    const double wide = (ball.radius + blur * along) / std::max(0.2, 1 - blur * tilt);
    // The shadow is fainter than a step of the picture's bytes.
    if (along * blur > 12 * ball.radius) return;
    // Along the surface, towards the light.
    Vec3 down = l - slope * s.normal;
    down = down.norm() > 1e-9 ? Vec3(down.normalized()) : s.right;
    add(Darkens::by_shadow, ball, surface, ball.center - height * s.normal - height * tilt * down, wide / slope * down,
        wide * s.normal.cross(down));
    return;
  }
  // A lamp projects the ball onto the surface as an eye would see it, which gives the same ellipse.
  const Vec3 from_lamp = ball.center - lighting_.key();
  const double lamp_height = s.normal.dot(lighting_.key()) + s.height;
  if (lamp_height <= 0 || from_lamp.norm() <= ball.radius || height > lamp_height + ball.radius) return;
  const double distance = from_lamp.norm();
  const Vec3 across = s.normal.cross(s.right);
  const Vec3 seen(s.right.dot(from_lamp), across.dot(from_lamp), lamp_height - height);
  Outline o{};
  // The ellipse grows without bound as the shadow's end approaches the horizon. From there on it is left open-ended.
  double radius = std::min(ball.radius + lighting_.lamp_radius(), 0.999 * distance);
  while (!outline_of(seen, radius, o) && radius > 1e-3 * ball.radius) radius *= 0.7;
  if (radius <= 1e-3 * ball.radius) return;
  const Vec3 foot = lighting_.key() - lamp_height * s.normal;
  const auto place = [&](double x, double y) { return Vec3(lamp_height * (x * s.right + y * across)); };
  add(Darkens::by_shadow, ball, surface, foot + place(o.x, o.y), place(o.ax, o.ay), place(o.bx, o.by));
}

void Shade::add_closeness(const Thing& thing, std::size_t surface) {
  // For a box or a cylinder the largest ball inside counts, at the place nearest to the surface.
  Thing ball = thing;
  if (thing.shape != Shape::sphere) {
    ball.radius = thing.half.minCoeff();
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = eye_.direction(Vec3::Unit(i));
      ball.center -= (thing.half[i] - ball.radius) * surfaces_.all()[surface].normal.dot(axis) * axis;
    }
  }
  // cos (r / d)^2 at the distance x from the foot is h r^2 / (h^2 + x^2)^(3/2). The darkening ends where that falls to
  // least_taken.
  const Surface& s = surfaces_.all()[surface];
  const double height = s.normal.dot(ball.center) + s.height;
  if (height <= 0) return;
  const double d = std::cbrt(height * ball.radius * ball.radius / least_taken);
  if (d <= height) return;
  const double wide = std::sqrt(d * d - height * height);
  add(Darkens::by_closeness, ball, surface, ball.center - height * s.normal, wide * s.right,
      wide * s.normal.cross(s.right));
}

void Shade::draw(const Things& things, const Backdrop& backdrop, const gl::TexelBuffer& rows) {
  rows_.clear();
  for (std::size_t k = 0; k < surfaces_.all().size(); ++k) {
    if (!surfaces_.all()[k].seen()) continue;
    for (const Thing& thing : things.all()) {
      add_closeness(thing, k);
      const Look& look = things.look(thing);
      if (!thing.mesh || look.outline_reach == 0) {
        add_shadow(thing, k);
        continue;
      }
      // Here `half` holds the arguments of through_mesh.
      Thing outline = thing;
      outline.center = thing.mesh_middle;
      outline.radius = look.outline_reach;
      outline.half = Vec3(static_cast<double>(look.file), look.outline_reach, 0);
      add_shadow(outline, k);
    }
  }
  if (rows_.empty()) return;
  program_.use();
  gl::bind_texture(0, backdrop.lit);
  rows.bind(1);
  if (meshes_) meshes_->bind(2);
  gl::Enable(GL_DEPTH_TEST);
  gl::DepthFunc(GL_GREATER);
  gl::DepthMask(GL_FALSE);
  gl::Enable(GL_BLEND);
  gl::BlendEquation(GL_MIN);
  instances_.draw(rows_);
  gl::BlendEquation(GL_FUNC_ADD);
  gl::DepthMask(GL_TRUE);
  gl::check("drawing shadows");
}

}  // namespace carom
