// The shaders of solids.cpp as text. They render points first, then pixels from the points, then the pixels onto the
// picture.
#include "render/solid_shaders.h"

namespace carom {

const char* const point_vertex_shader = R"(
layout(location = 0) in vec3 vertex;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 origin;  // in the camera's frame; number
layout(location = 3) in vec4 scale;   // along the world's axes; -
uniform mat3 axes;                    // the world's
uniform vec4 to_tile;                 // from (x / tangent, y / tangent, z) to the tile's clip space: factors, shifts
uniform vec2 tangent;
uniform float near;
out vec3 p;
out vec3 normal;
flat out uint number;

void main() {
  p = origin.xyz + axes * (scale.xyz * vertex);
  normal = axes * (normal_in / scale.xyz);
  number = uint(origin.w);
  vec2 at = p.xy / tangent * vec2(1, -1);
  gl_Position = vec4(to_tile.xy * at + to_tile.zw * p.z, 2 * near - p.z, p.z);  // the depth near / z as in the backdrop
}
)";

const char* const point_fragment_shader = R"(
in vec3 p;
in vec3 normal;
flat in uint number;
layout(location = 0) out uvec2 what;

void main() {
#ifdef CLOSED
  bool inside = !gl_FrontFacing;  // which shows where it is cut
  vec3 n = normalize(inside ? -normal : normal);
#else
  // The face's own normal, towards the eye, decides on which side of it the eye is: files disagree about the rest.
  vec3 face = cross(dFdx(p), dFdy(p));
  if (dot(face, p) > 0) face = -face;
  vec3 n = dot(normal, normal) > 0 ? normalize(normal) : normalize(face);
  if (dot(n, face) < 0) n = -n;
  const bool inside = false;
#endif
  uvec3 q = uvec3(clamp(n * 511 + 512.5, 0, 1023));
  what = uvec2(number, q.x | q.y << 10 | q.z << 20 | (inside ? 1u << 30 : 0u));
}
)";

const char* const rectangle_vertex_shader = R"(
layout(location = 0) in vec4 rectangle;  // left, top, right, bottom, in pixels
uniform vec2 picture;

void main() {
  vec2 corner = mix(rectangle.xy, rectangle.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  gl_Position = vec4(2 * corner / picture - 1, 0, 1);
}
)";

const char* const pixel_fragment_shader = R"(
uniform usampler2D what;
uniform sampler2D what_depth;
uniform samplerBuffer looks;  // colour, -; first occluder, count, -, -
uniform ivec2 tile;
uniform vec2 tangent, picture;
uniform float near;
#ifdef WALLS
uniform sampler2D edges, edge_depths;
#endif
layout(location = 0) out vec4 color_out;
layout(location = 1) out float depth_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), from = (pixel - tile) * FINE;
  ivec3 normals = ivec3(0);
  int covered = 0, of_first = 0, inside = 0;
  ivec2 first_at = ivec2(0), last_at = ivec2(0);
  uint first = 0u, last = 0u;
  for (int k = 0; k < FINE * FINE; ++k) {
    ivec2 offset = ivec2(k % FINE, k / FINE);
    uvec2 point = texelFetch(what, from + offset, 0).rg;
    if (point.x == 0u) continue;
    if (first == 0u) {
      first = point.x;
      first_at = offset;
    }
    last = point.x;
    last_at = offset;
    of_first += point.x == first ? 1 : 0;
    covered += 1;
    inside += int(point.y >> 30);
    normals += ivec3(uvec3(point.y, point.y >> 10, point.y >> 20) & 1023u) - 512;
  }
  if (covered == 0) discard;
  // The place is the middle between the two points: of a pixel that is wholly covered, its own.
  float depth = 0.5 * (texelFetch(what_depth, from + first_at, 0).r + texelFetch(what_depth, from + last_at, 0).r);
  vec2 at = vec2(pixel) + (0.5 * vec2(first_at + last_at) + 0.5) / FINE;
  vec3 d = vec3((2 * at / picture - 1) * vec2(1, -1) * tangent, 1);
  vec3 color = mix(texelFetch(looks, 2 * int(last) - 2).rgb, texelFetch(looks, 2 * int(first) - 2).rgb,
                   float(of_first) / covered);
  ivec2 occluders = ivec2(texelFetch(looks, 2 * int(first) - 1).xy);
  // The mean normal: its light is the mean of matt faces' light. Across an edge it is short, and nothing glints there
  // that would not on either face.
  vec3 n = vec3(normals) / (511 * covered);
  float even = length(n);
  if (even > 0.97) n /= even;
  vec3 seen = seen_light(d * near / depth, n, normalize(-d), color, occluders, 2 * inside > covered);
#ifdef WALLS
  if (depth < texelFetch(edge_depths, pixel, 0).r) {
    vec4 edge = texelFetch(edges, pixel, 0);
    seen = mix(seen, edge.rgb, edge.a);
  }
#endif
  color_out = vec4(seen, float(covered) / (FINE * FINE));
  depth_out = depth;
}
)";

const char* const onto_fragment_shader = R"(
uniform sampler2D color, color_depth;
uniform bool whole;
layout(location = 0) out vec4 color_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 seen = texelFetch(color, pixel, 0);
  if (seen.a == 0 || (seen.a == 1) != whole) discard;
  color_out = seen;
  gl_FragDepth = texelFetch(color_depth, pixel, 0).r;
}
)";

}  // namespace carom
