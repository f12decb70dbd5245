// Uploads textures as sRGB, which OpenGL filters in linear light, with levels made by texture_levels.h. The mean colour
// is a sum over points of all triangles: bodies of less than a pixel have it.
#include "render/mesh_colors.h"

#include "render/texture_levels.h"
#include "std.h"

namespace carom {
namespace {

gl::Texture uploaded(const MeshTexture& finest) {
  const vector<MeshTexture> coarser = coarser_levels(finest);
  gl::Texture texture =
      gl::make_texture(GL_SRGB8_ALPHA8, int(finest.width), int(finest.height), int(coarser.size()) + 1);
  const auto upload = [](GLint level, const MeshTexture& from) {
    gl::TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, GLsizei(from.width), GLsizei(from.height), GL_RGBA, GL_UNSIGNED_BYTE,
                      from.rgba.data());
  };
  upload(0, finest);
  for (size_t i = 0; i < coarser.size(); ++i) upload(static_cast<GLint>(i + 1), coarser[i]);
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  return texture;
}

GLint mode_of(Wrap wrap) {
  return wrap == Wrap::mirror ? GL_MIRRORED_REPEAT : wrap == Wrap::clamp ? GL_CLAMP_TO_EDGE : GL_REPEAT;
}

/// The pixel of a side of `length` at x, 1 a side.
uint32_t pixel_at(float x, Wrap wrap, uint32_t length) {
  float inside = x - floor(x);
  if (wrap == Wrap::clamp) inside = clamp(x, 0.0F, 1.0F);
  if (wrap == Wrap::mirror) inside = 1 - std::abs(1 - (x - 2 * floor(x / 2)));
  return min(uint32_t(inside * float(length)), length - 1);
}

/// At least so many points of a mesh are looked at for its mean colour.
constexpr double least_points = 4096;

using Color4 = array<float, 4>;

/// At a place of a triangle with the vertices v, with its opacity. `at`: the vertices' weights.
Color4 color_at(const MeshPaint& paint, const MeshPart& part, const uint32_t* v, const array<float, 3>& at) {
  array<float, 2> uv{};
  array<float, 3> tint{};
  for (size_t k = 0; k < 3; ++k) {
    for (size_t i = 0; i < 2; ++i) uv[i] += at[k] * paint.uv[v[k]][i];
    for (size_t i = 0; i < 3; ++i) tint[i] += at[k] * paint.tint[v[k]][i];
  }

  Color4 color{part.factor[0] * tint[0], part.factor[1] * tint[1], part.factor[2] * tint[2], part.factor[3]};
  if (part.texture == 0) return color;

  const MeshTexture& texture = paint.textures[part.texture - 1];
  const Color4 light =
      light_of(texture, pixel_at(uv[0], part.wrap[0], texture.width), pixel_at(uv[1], part.wrap[1], texture.height));
  for (size_t c = 0; c < 4; ++c) color[c] *= light[c];
  return color;
}

/// Calls `use` with the weights of the vertices at n^2 points of a triangle, the middles of n^2 equal parts.
template <typename Use>
void for_points(int n, Use use) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * (n - i) - 1; ++k) {
      const float third = (k % 2 ? 2.0F : 1.0F) / 3;
      const float b = (float(i) + third) / float(n);
      const float c = (float(k / 2) + third) / float(n);
      use(array<float, 3>{1 - b - c, b, c});
    }
}

}  // namespace

MeshColors::MeshColors(const Mesh& mesh) : parts_(mesh.paint.parts), rows_(gl::make_buffer()) {
  textures_.push_back(uploaded({1, 1, {255, 255, 255, 255}}));
  for (const MeshTexture& texture : mesh.paint.textures) textures_.push_back(uploaded(texture));

  // A row for each vertex: its place in the texture, and its colour.
  constexpr size_t row = 5;
  vector<float> rows;
  rows.reserve(row * mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    rows.insert(rows.end(), mesh.paint.uv[i].begin(), mesh.paint.uv[i].end());
    rows.insert(rows.end(), mesh.paint.tint[i].begin(), mesh.paint.tint[i].end());
  }

  gl::BindBuffer(GL_ARRAY_BUFFER, rows_.name());
  gl::BufferData(GL_ARRAY_BUFFER, GLsizeiptr(rows.size() * sizeof(float)), rows.data(), GL_STATIC_DRAW);

  for (const auto& [index, floats, offset] : {array{4, 2, 0}, array{5, 3, 2}}) {
    gl::EnableVertexAttribArray(GLuint(index));
    gl::VertexAttribPointer(GLuint(index), floats, GL_FLOAT, GL_FALSE, row * sizeof(float),
                            reinterpret_cast<const void*>(size_t(offset) * sizeof(float)));
  }
}

bool MeshColors::has_holes() const {
  return any_of(parts_, [](const MeshPart& part) { return part.cutoff > 0; });
}

void MeshColors::bind(const MeshPart& part) const {
  gl::BindTexture(GL_TEXTURE_2D, textures_[part.texture].name());
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, mode_of(part.wrap[0]));
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, mode_of(part.wrap[1]));
  gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, part.sharp ? GL_NEAREST : GL_LINEAR);
}

MeanColor mean_color(const Mesh& mesh) {
  const double triangles = double(mesh.triangles.size()) / 3;
  const int n = max(1, int(ceil(sqrt(least_points / triangles))));

  array<double, 3> sum{};
  double area = 0, plain = 0;
  size_t t = 0;

  for (const MeshPart& part : mesh.paint.parts)
    for (const size_t end = t + size_t{3} * part.triangles; t < end; t += 3) {
      const uint32_t* v = &mesh.triangles[t];
      const Vec3 &a = mesh.vertices[v[0]], &b = mesh.vertices[v[1]], &c = mesh.vertices[v[2]];
      const double share = (b - a).cross(c - a).norm() / (n * n);

      for_points(n, [&](const array<float, 3>& at) {
        const Color4 color = color_at(mesh.paint, part, v, at);
        if (color[3] < part.cutoff) return;
        area += share;
        if (!part.colored) plain += share;
        for (size_t i = 0; part.colored && i < 3; ++i) sum[i] += share * double(color[i]);
      });
    }

  MeanColor mean{{}, 1};
  if (!(area > 0)) return mean;
  for (size_t i = 0; i < 3; ++i) mean.colored[i] = float(sum[i] / area);
  mean.plain = float(plain / area);
  return mean;
}

}  // namespace carom
