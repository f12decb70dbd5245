#pragma once
// The volumes of bodies and obstacles. A mesh is drawn in place of a volume, or a volume is fitted around it.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geometry/fit.h"
#include "physics/volume.h"
#include "scene/keys.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "yaml/diagnostics.h"

namespace carom {

struct Form {
  Volume volume;
  std::optional<MeshUse> mesh;
};

/// Reads each mesh file once, and fits each kind of volume around it once.
class Forms {
 public:
  /// `folder`: the folder of the scene file.
  Forms(std::string folder, const LoadOptions& options, Diagnostics& diagnostics)
      : folder_(std::move(folder)), options_(options), diagnostics_(diagnostics) {}

  /// The form of a ball, a group's ball, a body or an obstacle.
  /// None: its volume or its mesh has an error, which was reported.
  /// `colored`: the scene gives its colour. Otherwise a mesh has the colours of its file.
  std::optional<Form> of(const VolumeKeys& thing, bool colored);

  /// The mesh files in the order of their first use. `film`: the file name of the film, which no copy may take.
  std::vector<MeshFile> files(const std::string& film) const;

 private:
  std::optional<Form> plain(const VolumeKeys& thing);
  std::optional<Form> fitted(Shape shape, const Node& mesh);
  std::optional<Form> drawn(const Volume& volume, const Node& mesh);
  const std::vector<Vec3>* points(const Node& mesh);
  std::optional<Fit> fit(Shape shape, const Node& mesh);
  std::string path_of(const Node& mesh) const;

  std::string folder_;
  const LoadOptions& options_;
  Diagnostics& diagnostics_;
  /// By path. Empty: unusable.
  std::map<std::string, std::vector<Vec3>> points_;
  std::map<std::pair<std::string, Shape>, std::optional<Fit>> fits_;  // none: unusable
  std::vector<std::string> order_;                                    // paths
  std::map<std::string, Place> own_colors_;                           // first uses of meshes with the file's colours
};

}  // namespace carom
