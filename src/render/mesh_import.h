#pragma once
// assimp's side of read_mesh: runs in the child process alone.
#include <string>
#include <vector>

#include "render/mesh.h"

namespace carom {

/// As it goes through the pipe.
struct ImportedMesh {
  std::vector<float> vertices, normals;  // three a vertex
  std::vector<std::uint32_t> triangles;
};

/// The endings of the files that are read, in lower case, without the dot.
const std::vector<std::string>& mesh_endings();

/// Throws std::exception with what is wrong; may as well crash or not return.
ImportedMesh import_mesh(const std::string& path, const std::string& ending, const MeshLimits& limits);

}  // namespace carom
