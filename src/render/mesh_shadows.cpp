// Renders the outline of each mesh along the light into a layer of a texture, with mipmaps. A shadow is then one
// lookup, and its blur selects the mipmap level.
#include "render/mesh_shadows.h"

#include <array>
#include <cmath>

namespace carom {
namespace {

// Side of the largest picture, a power of two.
constexpr int shadow_side = 1024;

const char* const depth_vertex_shader = R"(
layout(location = 0) in vec3 vertex;
uniform mat3 axes;  // the world's
uniform vec3 across_u, across_v;
uniform float reach;

void main() {
  vec3 p = axes * vertex / reach;
  gl_Position = vec4(dot(p, across_u), dot(p, across_v), 0, 1);
}
)";

const char* const depth_fragment_shader = R"(
layout(location = 0) out float covered;
void main() { covered = 1; }
)";

const char* const shadow_functions = R"(
uniform sampler2DArray mesh_outlines;
uniform vec3 across_u, across_v;

float through_mesh(vec3 p, vec3 l, vec3 to_middle, float file, float reach) {
  float along = dot(to_middle, l);
  vec2 at = -vec2(dot(to_middle, across_u), dot(to_middle, across_v)) / reach;
  if (along <= 0 || any(greaterThan(abs(at), vec2(1.2)))) return 1;
  // The outline averaged over squares as wide as its blur.
  float blurred = softness * along / reach * float(textureSize(mesh_outlines, 0).x);
  return 1 - textureLod(mesh_outlines, vec3(0.5 + 0.5 * at, file), log2(max(blurred, 1))).r;
}
)";

void set_vector(const gl::Program& program, const char* name, const Vec3& v) {
  gl::Uniform3f(program.at(name), static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

}  // namespace

const char* MeshShadows::shader() {
  return shadow_functions;
}

MeshShadows::MeshShadows(const Shapes& shapes, std::size_t files, const Eye& eye, const Lighting& lighting) {
  const Vec3& l = lighting.key();
  across_u_ = l.cross(std::abs(l.x()) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
  across_v_ = l.cross(across_u_);
  outlines_ = gl::make_outlines(shadow_side, static_cast<int>(files));
  const gl::Program program({depth_vertex_shader}, {depth_fragment_shader});
  program.use();
  std::array<float, 9> axes{};
  for (int i = 0; i < 9; ++i)
    axes[static_cast<std::size_t>(i)] = static_cast<float>(eye.direction(Vec3::Unit(i / 3))[i % 3]);
  gl::UniformMatrix3fv(program.at("axes"), 1, GL_FALSE, axes.data());
  set_vector(program, "across_u", across_u_);
  set_vector(program, "across_v", across_v_);
  shapes.fill_instances(std::array<float, Shapes::row>{});
  for (std::size_t i = 0; i < files; ++i) {
    const gl::Framebuffer framebuffer = gl::make_layer_framebuffer(outlines_, static_cast<int>(i));
    gl::Viewport(0, 0, shadow_side, shadow_side);
    gl::Disable(GL_BLEND);
    gl::Disable(GL_DEPTH_TEST);
    const float nothing[4] = {};
    gl::ClearBufferfv(GL_COLOR, 0, nothing);
    gl::Uniform1f(program.at("reach"), static_cast<float>(reach(shapes, i)));
    shapes.draw(Shapes::file(i), 0, 1);
  }
  bind(0);
  gl::GenerateMipmap(GL_TEXTURE_2D_ARRAY);
  gl::check("drawing the meshes' outlines");
}

void MeshShadows::set(const gl::Program& program, GLuint unit) const {
  gl::Uniform1i(program.at("mesh_outlines"), static_cast<GLint>(unit));
  set_vector(program, "across_u", across_u_);
  set_vector(program, "across_v", across_v_);
}

void MeshShadows::bind(GLuint unit) const {
  gl::ActiveTexture(GL_TEXTURE0 + unit);
  gl::BindTexture(GL_TEXTURE_2D_ARRAY, outlines_.name());
}

}  // namespace carom
