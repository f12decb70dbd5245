// The lights of a scene, and GLSL functions for them. Shadows are analytic: the part of the key light's disc that a
// shape covers, as seen from a point. Soft edges follow from the disc's size without any sampling.
#include "render/lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/renderer.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr std::size_t most_lights = 32;

// A matt surface that faces a light of intensity 1 has its own colour. Light does not weaken with distance.
const char* const light_functions = R"(
const float softness = SOFTNESS;
uniform float lamp_radius;                // of a key light with a position
uniform vec4 light_vector[LIGHTS + 1];    // position (w = 1) or unit direction towards the light (w = 0)
uniform vec3 light_radiance[LIGHTS + 1];
uniform vec3 ambient;
uniform vec3 world_right, world_up, world_back;  // the world's axes x, y, z

vec3 towards_light(int i, vec3 p) {
  return light_vector[i].w > 0 ? normalize(light_vector[i].xyz - p) : light_vector[i].xyz;
}

// Ambient light comes from above somewhat more than from below.
vec3 hemisphere(vec3 n) { return ambient * (0.8 + 0.2 * dot(n, world_up)); }

// How much of a surface's light is not the key light's, in one number q, 0 to 1: as if it were lit by q times the ambient
// and 1 - q times the key light. From the part that stays in shadow, summed over the channels; and back, by channel.
float light_mix(float part) {
  float a = dot(ambient, vec3(1)), k = dot(light_radiance[0] + 1e-3, vec3(1));
  return clamp(part * k / max(part * k + (1 - part) * a, 1e-12), 0, 1);
}
vec3 part_in_shadow(float q) { return q * ambient / max(q * ambient + (1 - q) * (light_radiance[0] + 1e-3), 1e-12); }

// The part of the key light that a ball lets through to p; `to_ball` from p to its centre.
// Seen from p the light is a disc of tangent `spread`, the ball one of about radius / along.
float through_ball(vec3 p, vec3 l, vec3 to_ball, float radius) {
  float spread = softness, reach = 1e30;
  if (light_vector[0].w > 0) {
    reach = length(light_vector[0].xyz - p);
    spread = lamp_radius / reach;
  }
  float along = dot(to_ball, l);
  float aside2 = dot(to_ball, to_ball) - along * along;
  float blur = spread * along;
  if (along <= 0 || along >= reach || aside2 >= (radius + blur) * (radius + blur)) return 1;
  float clear = smoothstep(-blur, blur, sqrt(max(aside2, 0)) - radius);
  return 1 - (1 - clear) * min(1, radius * radius / (blur * blur));
}

// The part of the key light that a box or an upright cylinder lets through to p; `to_center` from p to its centre.
float through_solid(vec3 p, vec3 l, vec3 to_center, vec3 half_size, bool box) {
  vec3 c = vec3(dot(to_center, world_right), dot(to_center, world_up), dot(to_center, world_back));
  vec3 m = vec3(dot(l, world_right), dot(l, world_up), dot(l, world_back));
  float spread = softness, reach = 1e30;
  if (light_vector[0].w > 0) {
    reach = length(light_vector[0].xyz - p);
    spread = lamp_radius / reach;
  }
  vec3 per = 1 / mix(vec3(1e-6), m, greaterThan(abs(m), vec3(1e-6)));
  vec3 enter = c * per - half_size * abs(per), leave = c * per + half_size * abs(per);
  // `along` the light the ray to it is in the solid's middle; `aside`: how far outside of its outline the ray runs.
  float along, aside, flank = length(m.xz);
  if (box) {
    along = max(max(enter.x, enter.y), enter.z) + min(min(leave.x, leave.y), leave.z);
    // The outline is a hexagon whose sides are two of each edge.
    vec3 sides = vec3(length(m.yz), flank, length(m.xy));
    vec3 off = vec3(abs(m.z * c.y - m.y * c.z) - abs(m.z) * half_size.y - abs(m.y) * half_size.z,
                    abs(m.x * c.z - m.z * c.x) - abs(m.x) * half_size.z - abs(m.z) * half_size.x,
                    abs(m.y * c.x - m.x * c.y) - abs(m.y) * half_size.x - abs(m.x) * half_size.y);
    off = mix(vec3(-1e30), off / max(sides, vec3(1e-6)), greaterThan(sides, vec3(1e-3)));
    aside = max(max(off.x, off.y), off.z);
  } else {
    vec2 e = flank > 1e-4 ? m.xz / flank : vec2(1, 0);
    float r = half_size.x, u = dot(vec2(-e.y, e.x), c.xz), ahead = dot(e, c.xz);
    float chord = sqrt(max(r * r - u * u, 0));
    float slow = 1 / max(flank, 1e-6);
    along = max((ahead - chord) * slow, enter.y) + min((ahead + chord) * slow, leave.y);
    // The outline is an ellipse, the flattened top, drawn out along the flattened axis.
    float v = abs(c.y * flank - m.y * ahead);
    aside = max(abs(u) - r, v - half_size.y * flank - abs(m.y) * chord);
  }
  along *= 0.5;
  float blur = spread * along;
  if (along <= 0 || along >= reach || aside >= blur) return 1;
  float clear = smoothstep(-blur, blur, aside);
  // As much light as the mean outline of a convex body takes, a quarter of its surface.
  float size2 = box ? 0.64 * dot(half_size, half_size.yzx) : 0.5 * half_size.x * (half_size.x + 2 * half_size.y);
  return 1 - (1 - clear) * min(1, size2 / (blur * blur));
}

// The part of the key light that a wall lets through to p.
float through_wall(vec3 p, vec3 l, vec3 normal, vec3 center, vec3 right, float half_width, vec3 up, float half_height) {
  float slope = dot(normal, l);
  float along = dot(normal, center - p) / (abs(slope) > 1e-6 ? slope : 1e-6);
  float spread = softness, reach = 1e30;
  if (light_vector[0].w > 0) {
    reach = length(light_vector[0].xyz - p);
    spread = lamp_radius / reach;
  }
  if (along <= 1e-4 * (half_width + half_height) || along >= reach) return 1;
  vec3 q = p + along * l - center;
  float blur = spread * along;
  float across = smoothstep(-blur, blur, half_width - abs(dot(q, right)));
  float upward = smoothstep(-blur, blur, half_height - abs(dot(q, up)));
  return 1 - across * upward;
}
)";

double decode(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

std::array<float, 3> linear(const Color& srgb) {
  return {static_cast<float>(decode(srgb.r)), static_cast<float>(decode(srgb.g)), static_cast<float>(decode(srgb.b))};
}

KeyLight default_light(const CameraFrame& view) {
  Vec3 ahead = Vec3(view.forward.x(), 0, view.forward.z());
  if (!(ahead.norm() > 1e-3)) ahead = Vec3(view.up.x(), 0, view.up.z());
  ahead.normalize();
  const Vec3 right = Vec3(-ahead.z(), 0, ahead.x());
  return {(-0.55 * right + 1.0 * Vec3(0, 1, 0) - 0.45 * ahead).normalized(), {0.82F, 0.80F, 0.76F}};
}

Lighting::Lighting(const Scene& scene, const Eye& eye)
    : axes_{eye.direction(Vec3(1, 0, 0)), eye.direction(Vec3(0, 1, 0)), eye.direction(Vec3(0, 0, 1))} {
  if (scene.lights.size() > most_lights)
    throw RenderError(fmt::format("the scene has {} lights; pictures allow {}", scene.lights.size(), most_lights));
  for (const Light& light : scene.lights) {
    Source source{light.position.has_value(), Vec3::Zero(), linear(light.color)};
    source.vector = source.near ? eye.point(*light.position) : -eye.direction(light.direction->normalized());
    for (float& c : source.radiance) c *= static_cast<float>(light.intensity);
    lights_.push_back(source);
  }
  if (scene.lights.empty()) {
    const KeyLight light = default_light(eye.view);
    lights_.push_back({false, eye.direction(light.towards), light.radiance});
  }
  if (lights_[0].near) lamp_radius_ = softness * (eye.point(eye.camera.target) - lights_[0].vector).norm();
  ambient_ = scene.ambient ? linear(*scene.ambient) : std::array<float, 3>{0.26F, 0.28F, 0.31F};
  shader_ = fmt::format("#define LIGHTS {}\n#define SOFTNESS {:.6f}\n{}", lights_.size(), softness, light_functions);
}

void Lighting::set(const gl::Program& program) const {
  std::vector<float> vectors, radiance;
  for (const Source& light : lights_) {
    for (int i = 0; i < 3; ++i) vectors.push_back(static_cast<float>(light.vector[i]));
    vectors.push_back(light.near ? 1 : 0);
    radiance.insert(radiance.end(), light.radiance.begin(), light.radiance.end());
  }
  const auto count = static_cast<GLsizei>(lights_.size());
  gl::Uniform4fv(program.at("light_vector"), count, vectors.data());
  gl::Uniform3fv(program.at("light_radiance"), count, radiance.data());
  gl::Uniform1f(program.at("lamp_radius"), static_cast<float>(lamp_radius_));
  gl::Uniform3fv(program.at("ambient"), 1, ambient_.data());
  const std::array<const char*, 3> names{"world_right", "world_up", "world_back"};
  for (std::size_t i = 0; i < 3; ++i)
    gl::Uniform3f(program.at(names[i]), static_cast<float>(axes_[i].x()), static_cast<float>(axes_[i].y()),
                  static_cast<float>(axes_[i].z()));
}

}  // namespace carom
