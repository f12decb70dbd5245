#pragma once
// The materials of a mesh file as assimp reads them, in the child process only.
#include <assimp/scene.h>

#include "render/mesh_data.h"
#include "render/mesh_files.h"
#include "std.h"

namespace carom {

/// A component of a colour, pressed into 0 to 1.
inline float color_share(float x) {
  return x >= 0 ? min(x, 1.0F) : 0;
}

/// What a part's vertices need besides its MeshPart.
struct PartSource {
  MeshPart part;
  unsigned uv_set = 0;
  bool srgb_tint = false;  // its vertices' colours are sRGB
  /// From assimp's place in the texture (u, v, 1; v upwards) to that of MeshPaint::uv.
  array<array<float, 3>, 2> uv = {{{1, 0, 0}, {0, -1, 1}}};
};

/// Reads materials, and each texture once.
class MeshMaterials {
 public:
  MeshMaterials(const aiScene& scene, const MeshFiles& files, const string& ending, const MeshLimits& limits);

  /// Of a part of the mesh. Throws runtime_error with the fault of a texture.
  PartSource of(const aiMesh& mesh);
  vector<MeshTexture> take_textures() { return std::move(textures_); }

 private:
  bool gives_color(const aiMesh& mesh, const aiMaterial& material) const;
  void add_texture(const aiMaterial& material, bool opaque, PartSource& source);
  MeshTexture texture(const string& name) const;

  const aiScene& scene_;
  const MeshFiles& files_;
  const MeshLimits& limits_;
  bool wavefront_;
  uint64_t most_kept_;                       // pixels of a texture
  map<pair<string, bool>, uint32_t> known_;  // by name and whether it is opaque
  vector<MeshTexture> textures_;
};

}  // namespace carom
