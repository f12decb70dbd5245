#pragma once
// Copies of the scene's mesh files in the run's folder, so that its scene.yaml runs wherever the folder is moved.

#include "std.h"

namespace carom {

struct Scene;

struct MeshCopy {
  string name, bytes;
};

/// The mesh files to copy, read completely. Throws ExportError if one cannot be read.
vector<MeshCopy> read_meshes(const Scene& scene);

/// Name and hash of each mesh file, as JSON. The scene's text does not show whether a mesh has changed.
string meshes_text(const Scene& scene);

}  // namespace carom
