#pragma once
// The meshes, materials and textures of a glTF file. Things of one shape and coat share a mesh.
#include <tuple>

#include "render/glb_file.h"
#include "render/model.h"
#include "scene/colors.h"
#include "scene/look.h"
#include "std.h"

namespace carom {

/// What a surface without a texture looks like.
struct Coat {
  Color color;
  Surface surface;  // without a finish plastic
};

/// Its functions return the number of a mesh in the file.
class GlbMeshes {
 public:
  explicit GlbMeshes(GlbFile& file) : file_(file) {}

  /// A volume of half size 1.
  size_t volume(Shape shape, const Coat& coat);
  /// A mesh file drawn in place of a volume about the origin. `coat`: of the parts without a colour. Throws
  /// RenderError.
  size_t file(const MeshUse& use, const Coat& coat);
  /// A mesh of its own. `two_sided`: both sides of its triangles are seen.
  size_t single(const Mesh& mesh, const Coat& coat, bool two_sided, const string& name);

 private:
  using Key = array<double, 5>;  // of a coat
  using Use = std::tuple<string, array<double, 13>, bool, Key>;

  nlohmann::ordered_json primitive(const Mesh& mesh, size_t material);
  size_t material(const Coat& coat, bool two_sided);
  /// `image`: the number of the part's texture among the images, if it has one.
  size_t material(const MeshPart& part, optional<size_t> image, const string& name);
  /// Equal pictures are written once.
  size_t image(const MeshTexture& picture);

  GlbFile& file_;
  map<string, size_t> images_;  // by their bytes
  map<pair<Shape, Key>, size_t> volumes_;
  map<Use, size_t> files_;
};

}  // namespace carom
