#pragma once
// Meshes from files. A damaged file can crash assimp, hang it or fill the memory: it works in a process of its own,
// which may use so much of each, can write nothing, and hands the mesh back through a pipe.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "numerics/vec3.h"

namespace carom {

struct Mesh {
  std::vector<Vec3> vertices;            // in the file's own units and axes, as its nodes place them
  std::vector<Vec3> normals;             // by vertex, unit; zero: none known
  std::vector<std::uint32_t> triangles;  // three vertices each
};

struct MeshLimits {
  std::uint64_t file_bytes = std::uint64_t{256} << 20U;
  std::uint64_t memory_bytes = std::uint64_t{2} << 30U;
  unsigned seconds = 10;  // of a processor; three times as many of the clock
  std::uint32_t vertices = 2'000'000;
  std::uint32_t triangles = 2'000'000;
};

/// Reads a Wavefront (.obj), STL (.stl) or glTF 2 (.gltf, .glb) file; of other files only those that it names in its
/// own folder. Polygons are cut into triangles, vertices in one place joined; normals that the file does not give are
/// made, smooth where faces meet at less than 45 degrees. Throws std::runtime_error with the path and what is wrong.
Mesh read_mesh(const std::string& path, const MeshLimits& limits = {});

/// What is called 20 times a second while a mesh is waited for; it may throw, to be heard by read_mesh's caller. Set
/// once, where the program begins.
void look_while_reading(std::function<void()> look);

/// The vertices alone: what a volume is fitted around.
std::vector<Vec3> read_mesh_points(const std::string& path, const MeshLimits& limits = {});

}  // namespace carom
