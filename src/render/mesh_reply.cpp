// Receives a mesh from the child process and checks every count, index and number, because a damaged file may have
// corrupted the child.
#include "render/mesh_reply.h"

#include "std.h"

namespace carom {
namespace {

/// The message of a reader on one line, without bytes that a terminal would interpret.
string message_of(string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "it is damaged" : text;
}

vector<Vec3> vectors(span<const float> values) {
  vector<Vec3> result(values.size() / 3);
  for (size_t i = 0; i < result.size(); ++i)
    result[i] = Vec3(double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]});
  return result;
}

[[noreturn]] void refuse() {
  throw runtime_error("it is damaged");
}

template <typename Item>
void receive(const MeshReplySource& source, vector<Item>& items) {
  if (!source.receive(items.data(), items.size() * sizeof(Item))) throw runtime_error(source.trouble());
}

bool is_share(float x) {
  return x >= 0 && x <= 1;
}

void check_part(const MeshPart& part, uint32_t textures) {
  const auto is_wrap = [](Wrap wrap) { return wrap <= Wrap::mirror; };
  if (part.texture > textures || part.sharp > 1 || part.colored > 1 || !isfinite(part.cutoff) || part.cutoff < 0 ||
      !all_of(part.wrap, is_wrap) || !all_of(part.factor, is_share))
    refuse();
}

MeshTexture receive_texture(const MeshReplySource& source, uint64_t& bytes_left) {
  array<uint32_t, 2> sides{};
  if (!source.receive(sides.data(), sizeof sides)) throw runtime_error(source.trouble());
  for (const uint32_t side : sides)
    if (side == 0 || side > longest_texture_side) refuse();
  const uint64_t bytes = uint64_t{4} * sides[0] * sides[1];
  if (bytes > bytes_left) refuse();
  bytes_left -= bytes;
  MeshTexture texture{sides[0], sides[1], vector<uint8_t>(bytes)};
  receive(source, texture.rgba);
  return texture;
}

MeshPaint receive_paint(const MeshReplySource& source, const MeshReplyHead& head, const MeshLimits& limits) {
  MeshPaint paint;
  paint.parts.resize(head.parts);
  receive(source, paint.parts);

  uint64_t triangles = 0;
  for (const MeshPart& part : paint.parts) {
    check_part(part, head.textures);
    triangles += part.triangles;
  }
  if (triangles != head.triangles) refuse();

  paint.uv.resize(head.vertices);
  receive(source, paint.uv);
  for (const auto& uv : paint.uv)
    if (!isfinite(uv[0]) || !isfinite(uv[1])) refuse();

  paint.tint.resize(head.vertices);
  receive(source, paint.tint);
  for (const auto& tint : paint.tint)
    if (!all_of(tint, is_share)) refuse();

  uint64_t bytes_left = limits.texture_bytes;
  for (uint32_t i = 0; i < head.textures; ++i) paint.textures.push_back(receive_texture(source, bytes_left));
  return paint;
}

}  // namespace

Mesh receive_mesh(const MeshReplySource& source, const MeshLimits& limits) {
  MeshReplyHead head;
  if (!source.receive(&head, sizeof head)) throw runtime_error(source.trouble());

  if (head.text > 0) {
    string text(min(head.text, longest_mesh_trouble), ' ');
    source.receive(text.data(), text.size());
    throw runtime_error(message_of(text));
  }

  if (head.vertices > limits.vertices || head.triangles > limits.triangles || head.triangles == 0) refuse();
  if (head.parts > limits.parts || head.textures > limits.parts) refuse();

  vector<float> positions(3 * size_t{head.vertices}), normals(positions.size());
  Mesh mesh;
  mesh.triangles.resize(3 * size_t{head.triangles});
  receive(source, positions);
  receive(source, normals);
  receive(source, mesh.triangles);

  const auto finite = [](float x) { return isfinite(x); };
  if (!all_of(positions, finite) || !all_of(normals, finite)) throw runtime_error("a vertex is not finite");
  for (uint32_t i : mesh.triangles)
    if (i >= head.vertices) throw runtime_error("a triangle refers to a missing vertex");

  mesh.vertices = vectors(positions);
  mesh.normals = vectors(normals);
  if (head.parts > 0) mesh.paint = receive_paint(source, head, limits);
  return mesh;
}

}  // namespace carom
