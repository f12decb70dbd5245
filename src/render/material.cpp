// The one GLSL text for the light that surfaces send to the eye: matt reflection, a highlight, and light at grazing
// angles. Occluders of the key light are a list for each thing, so that a pixel tests only those that may shade it.
#include "render/material.h"

namespace carom {

const char* const material_shader = R"(
uniform samplerBuffer occluder_rows;
#ifdef WALLS
uniform samplerBuffer rows;
vec4 texel(int surface, int column) { return texelFetch(rows, surface * 5 + column); }
#endif

float key_light(vec3 p, vec3 l, ivec2 occluders) {
  float open = 1;
  for (int k = occluders.x; k < occluders.x + occluders.y; ++k) {
    vec4 other = texelFetch(occluder_rows, k);
#ifdef SOLIDS
    if (other.w < -1.5) {
      ++k;
      vec3 more = texelFetch(occluder_rows, k).xyz;
#ifdef MESHES
      if (other.w < -3.5) {
        open *= through_mesh(p, l, other.xyz - p, more.x, more.y);
        continue;
      }
#endif
      open *= through_solid(p, l, other.xyz - p, more, other.w > -2.5);
      continue;
    }
#endif
#ifdef WALLS
    if (other.w < 0) {
      int i = int(other.x);
      vec4 right = texel(i, 1), up = texel(i, 2), plane = texel(i, 0);
      vec3 center = -right.w * right.xyz - up.w * up.xyz - plane.w * plane.xyz;
      open *= through_wall(p, l, plane.xyz, center, right.xyz, texel(i, 4).x, up.xyz, texel(i, 4).y);
      continue;
    }
#endif
    open *= through_ball(p, l, other.xyz - p, other.w);
  }
  return open;
}

vec3 seen_light(vec3 p, vec3 n, vec3 v, vec3 color, ivec2 occluders, bool inside) {
  vec3 matt = hemisphere(n), shine = vec3(0);
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 l = towards_light(i, p);
    float facing = dot(n, l);
    if (facing <= 0) continue;
    vec3 light = light_radiance[i] * (i == 0 ? key_light(p, l, occluders) : 1);
    matt += light * facing;
    float glint = max(dot(n, normalize(l + v)), 0);
    glint *= glint; glint *= glint; glint *= glint; glint *= glint; glint *= glint; glint *= glint;  // ^64
    shine += light * glint * 0.35;
  }
  float grazing = 1 - max(dot(n, v), 0);
  grazing *= grazing;
  shine += ambient * grazing * grazing * 0.35;
  return inside ? color * 0.4 * hemisphere(-n) : color * matt + shine;
}
)";

}  // namespace carom
