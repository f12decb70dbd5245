#pragma once
// The part of read_mesh that uses assimp. It runs in the child process only.

#include "render/mesh_data.h"
#include "std.h"

namespace carom {

/// A mesh in the form in which it goes through the pipe.
struct ImportedMesh {
  vector<float> vertices, normals;  // three for each vertex
  vector<uint32_t> triangles;
  MeshPaint paint;
};

/// The endings of supported files, in lower case, without the dot.
const vector<string>& mesh_endings();

/// `painted`: with the file's colours, where it has any. Throws std::exception with the fault. It may also crash, or
/// never return.
ImportedMesh import_mesh(const string& path, const string& ending, bool painted, const MeshLimits& limits);

}  // namespace carom
