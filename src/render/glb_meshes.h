#pragma once
// The meshes, materials and textures of a glTF file that is written, in assimp's form. Things of one shape and colour
// share a mesh.
#include <assimp/scene.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "render/model.h"

namespace carom {

class GlbMeshes {
 public:
  /// Numbers of assimp's meshes that are drawn together.
  using Numbers = std::vector<unsigned>;

  /// A volume of half size 1, in a colour.
  const Numbers& volume(Shape shape, const Color& color);
  /// A mesh file drawn in place of a volume about the origin. `color`: of the parts without one. Throws RenderError.
  const Numbers& file(const MeshUse& use, const Color& color);
  /// A mesh of its own. `two_sided`: both sides of its triangles are seen.
  Numbers single(const Mesh& mesh, const Color& color, bool two_sided, const std::string& name);

  bool empty() const { return meshes_.empty(); }
  /// Gives all of them to the scene, which owns them then.
  void hand_over(aiScene& scene);

 private:
  using Srgb = std::array<double, 3>;
  using Use = std::tuple<std::string, std::array<double, 4>, bool, Srgb>;

  unsigned add(const Mesh& mesh, std::size_t material, const std::string& name);
  std::size_t material(const Color& color, bool two_sided);
  std::size_t material(const MeshPart& part, const std::vector<std::size_t>& textures, const std::string& name);
  /// Equal textures are written once.
  std::size_t texture(const MeshTexture& picture);

  std::vector<std::unique_ptr<aiMesh>> meshes_;
  std::vector<std::unique_ptr<aiMaterial>> materials_;
  std::vector<std::unique_ptr<aiTexture>> textures_;
  std::map<std::pair<Srgb, bool>, std::size_t> material_numbers_;
  std::map<std::pair<Shape, Srgb>, Numbers> volumes_;
  std::map<Use, Numbers> files_;
};

}  // namespace carom
