#pragma once
// The scene's mesh files: a run's folder keeps copies, so that its scene.yaml runs wherever the folder goes.
#include <string>
#include <vector>

namespace carom {

struct Scene;

struct MeshCopy {
  std::string name, bytes;
};

/// The files to be copied, read whole. Throws ExportError where one cannot be read any more.
std::vector<MeshCopy> read_meshes(const Scene& scene);

/// Name and hash of each mesh file, as JSON: the scene's text does not tell whether a mesh has changed.
std::string meshes_text(const Scene& scene);

}  // namespace carom
