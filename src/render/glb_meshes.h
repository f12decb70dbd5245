#pragma once
// The meshes, materials and textures of a glTF file that is written, in assimp's form. Things of one shape and colour
// share a mesh.
#include <assimp/scene.h>

#include <map>
#include <tuple>
#include <utility>

#include "render/model.h"
#include "std.h"

namespace carom {

class GlbMeshes {
 public:
  /// Numbers of assimp's meshes that are drawn together.
  using Numbers = vector<unsigned>;

  /// A volume of half size 1, in a colour.
  const Numbers& volume(Shape shape, const Color& color);
  /// A mesh file drawn in place of a volume about the origin. `color`: of the parts without one. Throws RenderError.
  const Numbers& file(const MeshUse& use, const Color& color);
  /// A mesh of its own. `two_sided`: both sides of its triangles are seen.
  Numbers single(const Mesh& mesh, const Color& color, bool two_sided, const string& name);

  bool empty() const { return meshes_.empty(); }
  /// Gives all of them to the scene, which owns them then.
  void hand_over(aiScene& scene);

 private:
  using Srgb = array<double, 3>;
  using Use = std::tuple<string, array<double, 4>, bool, Srgb>;

  unsigned add(const Mesh& mesh, size_t material, const string& name);
  size_t material(const Color& color, bool two_sided);
  size_t material(const MeshPart& part, const vector<size_t>& textures, const string& name);
  /// Equal textures are written once.
  size_t texture(const MeshTexture& picture);

  vector<unique_ptr<aiMesh>> meshes_;
  vector<unique_ptr<aiMaterial>> materials_;
  vector<unique_ptr<aiTexture>> textures_;
  std::map<std::pair<Srgb, bool>, size_t> material_numbers_;
  std::map<std::pair<Shape, Srgb>, Numbers> volumes_;
  std::map<Use, Numbers> files_;
};

}  // namespace carom
