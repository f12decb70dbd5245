#pragma once
// What the process that reads a mesh file sends through the pipe, and what is made of it. It may have been damaged by
// the file: nothing of it is trusted.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "render/mesh.h"

namespace carom {

/// What comes first. A mesh follows as its vertices and normals (floats), then its triangles; trouble as its text.
struct MeshReplyHead {
  std::uint32_t vertices = 0, triangles = 0;
  std::uint32_t text = 0;  // bytes; above 0: no mesh follows
};

inline constexpr std::uint32_t longest_mesh_trouble = 300;  // bytes

/// The other end of the pipe.
struct MeshReplySource {
  std::function<bool(void* bytes, std::size_t size)> receive;  // false: so many do not come
  std::function<std::string()> trouble;                        // why not
};

/// Throws std::runtime_error whose text says what is wrong with the mesh; without its path.
Mesh receive_mesh(const MeshReplySource& source, const MeshLimits& limits);

}  // namespace carom
