#pragma once
// The volumes of bodies and obstacles. A mesh is drawn in place of a volume, or a volume is fitted around it.

#include <tuple>

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
  /// A mesh as the scene gives it.
  struct Given {
    const Node* file;
    double scale;  // m per unit of the file
    MeshTurn turn;
  };
  /// None: it has an error, which was reported.
  static optional<Given> given(const Node& mesh);

  optional<Form> fitted(Shape shape, const Given& mesh);
  optional<Form> drawn(const Volume& volume, const Given& mesh);
  Form form_of(const Volume& volume, const Given& mesh, const Fit& tight, double scale) const;
  bool check_size(const Volume& volume, const Given& mesh);
  const vector<Vec3>* points(const Node& file);
  /// The tightest volume of the turned mesh, in the file's own units.
  optional<Fit> fit(Shape shape, const Given& mesh);
  string path_of(const Node& file) const;

  string folder_;
  const LoadOptions& options_;
  Diagnostics& diagnostics_;
  /// By path. Empty: unusable.
  map<string, vector<Vec3>> points_;
  /// By path, shape and turn. None: unusable.
  map<std::tuple<string, Shape, array<double, 9>>, optional<Fit>> fits_;
  vector<string> order_;           // paths
  map<string, Place> own_colors_;  // first uses of meshes with the file's colours
};

}  // namespace carom
