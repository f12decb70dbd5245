#pragma once
// The volumes of bodies and obstacles. A mesh is drawn in place of a volume, or a volume is fitted around it.

#include "geometry/fit.h"
#include "physics/volume.h"
#include "scene/keys.h"
#include "scene/load_options.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

struct Form {
  Volume volume;
  optional<MeshUse> mesh;
};

/// Reads each mesh file once, and fits each kind of volume around it once.
class Forms {
 public:
  /// `folder`: the folder of the scene file.
  Forms(string folder, const LoadOptions& options, Diagnostics& diagnostics)
      : folder_(std::move(folder)), options_(options), diagnostics_(diagnostics) {}

  /// The form of a ball, a group's ball, a body or an obstacle.
  /// None: its volume or its mesh has an error, which was reported.
  /// `colored`: the scene gives its colour. Otherwise a mesh has the colours of its file.
  optional<Form> of(const VolumeKeys& thing, bool colored);

  /// The mesh files in the order of their first use. `film`: the file name of the film, which no copy may take.
  vector<MeshFile> files(const string& film) const;

 private:
  optional<Form> plain(const VolumeKeys& thing);
  optional<Form> fitted(Shape shape, const Node& mesh);
  optional<Form> drawn(const Volume& volume, const Node& mesh);
  const vector<Vec3>* points(const Node& mesh);
  optional<Fit> fit(Shape shape, const Node& mesh);
  string path_of(const Node& mesh) const;

  string folder_;
  const LoadOptions& options_;
  Diagnostics& diagnostics_;
  /// By path. Empty: unusable.
  map<string, vector<Vec3>> points_;
  map<pair<string, Shape>, optional<Fit>> fits_;  // none: unusable
  vector<string> order_;                          // paths
  map<string, Place> own_colors_;                 // first uses of meshes with the file's colours
};

}  // namespace carom
