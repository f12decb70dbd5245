#pragma once
// The message through the pipe from the process that reads a mesh file, and its conversion to a Mesh. The file may have
// corrupted that process, so every part of the message is checked.

#include "render/mesh_data.h"
#include "std.h"

namespace carom {

/// The start of the message. A mesh follows as its vertices and normals (floats), then its triangles. If it has parts,
/// its paint follows: the parts, `uv` and `tint` by vertex, then each texture as its two sides and its bytes. An error
/// follows as its text.
struct MeshReplyHead {
  uint32_t vertices = 0, triangles = 0;
  uint32_t text = 0;                 // bytes; above 0: no mesh follows
  uint32_t parts = 0, textures = 0;  // no parts: no paint
};

inline constexpr uint32_t longest_mesh_trouble = 400;  // bytes

/// The receiving end of the pipe.
struct MeshReplySource {
  function<bool(void* bytes, size_t size)> receive;  // false: so many bytes do not come
  function<string()> trouble;                        // the reason
};

/// Throws runtime_error. Its text states the fault of the mesh, without the path.
Mesh receive_mesh(const MeshReplySource& source, const MeshLimits& limits);

}  // namespace carom
