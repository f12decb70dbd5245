#pragma once
// The bodies, obstacles and walls of a picture, placed in the camera's frame.

#include "physics/state.h"
#include "raster/shot.h"
#include "render/drawing.h"
#include "render/eye.h"
#include "render/wall_thickness.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The mean colour by area of a mesh with colours of its own, linear.
struct MeanColor {
  raster::Float3 colored{};  // of the parts with a colour, times their share of the area
  float plain = 0;           // share of the parts without
  raster::Float3 with(const raster::Float3& color) const {
    return {colored[0] + plain * color[0], colored[1] + plain * color[1], colored[2] + plain * color[2]};
  }
};

/// A mesh as it is drawn, m.
struct MeshSize {
  double radius = 0;                   // of a ball about the body's position
  Vec3 middle = Vec3::Zero();          // from the position, along the world's axes
  double half_shadow = 0;              // half the side of its shadow's outline; 0: it casts its volume's shadow
  optional<MeanColor> mean = nullopt;  // if it is drawn in colours of its own
};

/// A file of meshes, as it is read and turned.
struct DrawnFile {
  string path;
  MeshTurn turn;
  bool own_colors;  // with the colours of the file, where it has any
  friend bool operator==(const DrawnFile&, const DrawnFile&) = default;
};

/// The constant look of a body or obstacle.
struct Look {
  raster::Float3 color{1, 1, 1};  // linear
  optional<MeshUse> mesh = nullopt;
  size_t file = 0;  // of the mesh, in Things::files()
  MeshSize size;
  uint32_t finish = 0;  // in Things::finishes()
};

/// A mesh in the picture, by the number of its solid.
struct PlacedMesh {
  size_t file;
  Vec3 middle;  // m, camera's frame
  double scale;
  int32_t solid;
  raster::Float3 plain{};  // linear; of the parts without a colour, if it has colours of its own
};

/// All that a picture shows as solids: what a body is, and what it can meet.
class Things {
 public:
  explicit Things(const Scene& scene);

  /// The files of the meshes, without repetitions.
  const vector<DrawnFile>& files() const { return files_; }
  /// Sets the sizes of meshes. Call it after the files have been read.
  template <typename SizeOf>
  void measure(SizeOf size_of) {
    const Look* last = nullptr;
    for (Look& look : looks_) {
      if (!look.mesh) continue;
      // Bodies of a group look alike.
      look.size = last && *last->mesh == *look.mesh ? last->size : size_of(*look.mesh, look.file);
      last = &look;
    }
  }

  /// Fills the solids of a picture with the bodies of `state`, the obstacles and the walls. Bodies that are gone are
  /// left out, and a joint body has the size of the state.
  void place(const State& state, const Drawing& drawing, const Eye& eye, raster::Shot& shot);
  const vector<PlacedMesh>& meshes() const { return meshes_; }

 private:
  Look look_of(const Color& color, const optional<MeshUse>& mesh, const Surface& surface);
  uint32_t finish_of(const Surface& surface);
  void add(const Vec3& position, const Volume& volume, double radius, const Look& look, bool mesh, const Eye& eye,
           raster::Shot& shot);
  void add_shell(const Obstacle& obstacle, const Vec3& inward, const Look& look, const Eye& eye, raster::Shot& shot);
  /// Gives the last solid the mean of its mesh's own colours, for the light that it sends and where it is tiny.
  void take_mean(const Look& look, raster::Shot& shot);
  void add_walls(const State& state, const Drawing& drawing, const Eye& eye, raster::Shot& shot) const;
  void fade(const Drawing& drawing, size_t fixed, raster::Shot& shot) const;
  void add_halos(const Eye& eye, raster::Shot& shot) const;

  const Scene& scene_;
  vector<Look> looks_;          // of the bodies, then of obstacles_
  vector<uint32_t> obstacles_;  // those that are visible
  vector<DrawnFile> files_;
  vector<PlacedMesh> meshes_;
  // How surfaces reflect light, without repetitions. The first is that of plastic.
  vector<raster::SurfaceLight> finishes_ = vector<raster::SurfaceLight>(1);
  vector<uint32_t> wall_finishes_;  // by wall
  uint32_t faded_finish_ = 0;
  WallThickness thickness_;
};

}  // namespace carom
