#pragma once
// The colours of mesh files on OpenGL: textures with their coarser levels, and vertices' colours. Only meshes whose
// file has colours have them.

#include "render/gl.h"
#include "render/mesh_data.h"
#include "render/things.h"
#include "std.h"

namespace carom {

class MeshColors {
 public:
  /// Uploads the paint, and adds attributes 4 (place in the texture) and 5 (colour) to the bound vertex array.
  explicit MeshColors(const Mesh& mesh);

  const vector<MeshPart>& parts() const { return parts_; }
  bool has_holes() const;
  /// Binds the part's texture, or a white one.
  void bind(const MeshPart& part) const;

 private:
  vector<MeshPart> parts_;
  vector<gl::Texture> textures_;  // the first one is white
  gl::Buffer rows_;
};

MeanColor mean_color(const Mesh& mesh);

}  // namespace carom
