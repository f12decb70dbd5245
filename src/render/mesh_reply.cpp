// Receives a mesh from the child process and checks every count, index and number, because a damaged file may have
// corrupted the child.
#include "render/mesh_reply.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace carom {
namespace {

/// The message of a reader on one line, without bytes that a terminal would interpret.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "it is damaged" : text;
}

std::vector<Vec3> vectors(std::span<const float> values) {
  std::vector<Vec3> result(values.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = Vec3(double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]});
  return result;
}

}  // namespace

Mesh receive_mesh(const MeshReplySource& source, const MeshLimits& limits) {
  MeshReplyHead head;
  if (!source.receive(&head, sizeof head)) throw std::runtime_error(source.trouble());
  if (head.text > 0) {
    std::string text(std::min(head.text, longest_mesh_trouble), ' ');
    source.receive(text.data(), text.size());
    throw std::runtime_error(printable(text));
  }
  if (head.vertices > limits.vertices || head.triangles > limits.triangles || head.triangles == 0)
    throw std::runtime_error("it is damaged");
  std::vector<float> positions(3 * std::size_t{head.vertices}), normals(positions.size());
  Mesh mesh;
  mesh.triangles.resize(3 * std::size_t{head.triangles});
  if (!source.receive(positions.data(), positions.size() * sizeof(float)) ||
      !source.receive(normals.data(), normals.size() * sizeof(float)) ||
      !source.receive(mesh.triangles.data(), mesh.triangles.size() * sizeof(std::uint32_t)))
    throw std::runtime_error(source.trouble());
  const auto finite = [](float x) { return std::isfinite(x); };
  if (!std::all_of(positions.begin(), positions.end(), finite) || !std::all_of(normals.begin(), normals.end(), finite))
    throw std::runtime_error("a vertex is not finite");
  for (std::uint32_t i : mesh.triangles)
    if (i >= head.vertices) throw std::runtime_error("a triangle refers to a missing vertex");
  mesh.vertices = vectors(positions);
  mesh.normals = vectors(normals);
  return mesh;
}

}  // namespace carom
