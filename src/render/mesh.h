#pragma once
// Meshes from files. A damaged file can crash assimp, hang it or fill the memory.
// The import therefore runs in a process of its own. That has limits for each of these, cannot write, and returns the
// mesh through a pipe.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "numerics/vec3.h"

namespace carom {

struct Mesh {
  std::vector<Vec3> vertices;            // in the file's own units and axes, placed by its nodes
  std::vector<Vec3> normals;             // by vertex, unit; zero: unknown
  std::vector<std::uint32_t> triangles;  // three vertices each
};

struct MeshLimits {
  std::uint64_t file_bytes = std::uint64_t{256} << 20U;
  std::uint64_t memory_bytes = std::uint64_t{2} << 30U;
  unsigned seconds = 10;  // of processor time; three times as many on the clock
  std::uint32_t vertices = 2'000'000;
  std::uint32_t triangles = 2'000'000;
};

/// Reads a Wavefront (.obj), STL (.stl) or glTF 2 (.gltf, .glb) file. Of other files it reads only those in the same
/// folder that the file names. Polygons become triangles, and vertices at one position are joined. Missing normals are
/// computed, smooth where faces meet at less than 45 degrees. Throws std::runtime_error with the path and the fault.
Mesh read_mesh(const std::string& path, const MeshLimits& limits = {});

/// Sets the function that is called 20 times a second during the wait for a mesh. An exception from it passes to the
/// caller of read_mesh. Set it once, at the start of the program.
void check_while_reading(std::function<void()> stop_check);

/// The vertices alone, for the fit of a volume.
std::vector<Vec3> read_mesh_points(const std::string& path, const MeshLimits& limits = {});

}  // namespace carom
