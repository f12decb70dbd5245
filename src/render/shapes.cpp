// The triangle meshes of the renderer: uploaded once, drawn many times with instance rows.
// Vertices are stored relative to the mesh's centre, because floats would lose digits far from the origin.
#include "render/shapes.h"

#include "render/mesh.h"
#include "render/render_error.h"
#include "render/still_things.h"
#include "std.h"

namespace carom {
Shapes::Shapes(const vector<DrawnFile>& files) : instances_(gl::make_buffer()) {
  for (const DrawnFile& file : files) {
    Mesh mesh;
    try {
      mesh = file.own_colors ? read_painted_mesh(file.path) : read_mesh(file.path);
      turn_mesh(mesh, file.turn);
    } catch (const runtime_error& error) {
      throw RenderError(error.what());
    }
    upload(mesh);
    points_.push_back(std::move(mesh.vertices));
  }
  gl::check("loading the meshes");
}

void Shapes::upload(const Mesh& mesh) {
  Uploaded shape;
  Vec3 low = mesh.vertices.front(), high = low;
  for (const Vec3& p : mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  shape.middle = 0.5 * (low + high);
  shape.half = 0.5 * (high - low);

  // A row for each vertex: position and normal.
  vector<float> rows;
  rows.reserve(6 * mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 p = mesh.vertices[i] - shape.middle;
    for (int k = 0; k < 3; ++k) rows.push_back(float(p[k]));
    for (int k = 0; k < 3; ++k) rows.push_back(float(mesh.normals[i][k]));
  }

  shape.array = gl::make_vertices();
  shape.vertices = gl::make_buffer();
  shape.triangles = gl::make_buffer();
  shape.indices = GLsizei(mesh.triangles.size());

  gl::BindVertexArray(shape.array.name());
  gl::BindBuffer(GL_ARRAY_BUFFER, shape.vertices.name());
  gl::BufferData(GL_ARRAY_BUFFER, GLsizeiptr(rows.size() * sizeof(float)), rows.data(), GL_STATIC_DRAW);
  gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, shape.triangles.name());
  gl::BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(mesh.triangles.size() * sizeof(uint32_t)), mesh.triangles.data(),
                 GL_STATIC_DRAW);

  const auto attribute = [](GLuint index, GLint floats, size_t stride, size_t offset) {
    gl::EnableVertexAttribArray(index);
    gl::VertexAttribPointer(index, floats, GL_FLOAT, GL_FALSE, GLsizei(stride * sizeof(float)),
                            reinterpret_cast<const void*>(offset * sizeof(float)));
  };

  attribute(0, 3, 6, 0);
  attribute(1, 3, 6, 3);
  gl::BindBuffer(GL_ARRAY_BUFFER, instances_.name());
  attribute(2, 4, row, 0);
  attribute(3, 4, row, 4);
  for (const GLuint index : {2U, 3U}) gl::VertexAttribDivisor(index, 1);

  if (!mesh.paint.parts.empty()) {
    shape.colors.emplace(mesh);
    shape.mean = mean_color(mesh);
  }

  gl::BindVertexArray(0);
  shapes_.push_back(std::move(shape));
}

double Shapes::radius(size_t file, const Vec3& center) const {
  double square = 0;
  for (const Vec3& p : points_[file]) square = max(square, (p - center).squaredNorm());
  return sqrt(square);
}

void Shapes::fill_instances(span<const float> rows) const {
  gl::BindBuffer(GL_ARRAY_BUFFER, instances_.name());
  gl::BufferData(GL_ARRAY_BUFFER, GLsizeiptr(rows.size_bytes()), rows.data(), GL_STREAM_DRAW);
}

void Shapes::draw(size_t shape, size_t first, size_t count) const {
  gl::BindVertexArray(shapes_[shape].array.name());
  gl::DrawElementsInstancedBaseInstance(GL_TRIANGLES, shapes_[shape].indices, GL_UNSIGNED_INT, nullptr, GLsizei(count),
                                        GLuint(first));
}

void Shapes::draw_parts(size_t shape, size_t first, size_t count,
                        const function<void(const MeshPart& part)>& prepare) const {
  gl::BindVertexArray(shapes_[shape].array.name());
  size_t from = 0;
  for (const MeshPart& part : shapes_[shape].colors->parts()) {
    const size_t indices = size_t{3} * part.triangles;
    prepare(part);
    gl::DrawElementsInstancedBaseInstance(GL_TRIANGLES, GLsizei(indices), GL_UNSIGNED_INT,
                                          reinterpret_cast<const void*>(from * sizeof(uint32_t)), GLsizei(count),
                                          GLuint(first));
    from += indices;
  }
}

}  // namespace carom
