#pragma once
// The things of a picture other than planes, walls and box obstacles: bodies and obstacles, placed in the camera's
// frame.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "physics/state.h"
#include "render/eye.h"
#include "scene/scene.h"

namespace carom {

class Shapes;

struct Thing {
  Vec3 center;                      // m
  double radius;                    // m, of a ball around it
  Shape shape = Shape::sphere;      // of its volume
  Vec3 half = Vec3::Zero();         // m, of its volume, along the world's axes
  std::uint32_t look = 0;           // number of its look (Things::look)
  bool mesh = false;                // is drawn as its look's mesh
  Vec3 mesh_middle = Vec3::Zero();  // m, of that mesh

  bool operator==(const Thing&) const = default;
};

/// The constant look of a body or obstacle.
struct Look {
  std::array<float, 3> color{1, 1, 1};  // linear
  std::optional<MeshUse> mesh = std::nullopt;
  std::size_t file = 0;  // of the mesh, in Things::files()
  // The mesh as it is drawn, m:
  double mesh_radius = 0;           // of a ball about the body's position
  Vec3 mesh_middle = Vec3::Zero();  // from the position, along the world's axes
  double outline_reach = 0;         // MeshShadows::reach; 0: it casts its volume's shadow
};

class Things {
 public:
  Things(const Scene& scene, const Eye& eye);

  /// The files of the meshes, without repetitions.
  const std::vector<std::string>& files() const { return files_; }
  /// Computes the sizes of meshes. Call it after the files have been read.
  void measure(const Shapes& shapes, bool outlines);

  bool any() const { return !looks_.empty(); }
  bool any_solids() const { return any_solids_; }  // whether some things may not be balls

  /// Places the bodies of `state`, and the obstacles. A body that is part of another is left out, and the joint body
  /// has the volume of the state. Returns whether anything has changed since the last call.
  bool place(const State& state);
  std::span<const Thing> all() const { return all_; }
  // Numbers in all() of the balls in the picture, back to front.
  std::span<const std::uint32_t> balls() const { return balls_; }
  // Numbers in all() of the other things in the picture.
  std::span<const std::uint32_t> solids() const { return solids_; }
  const Look& look(const Thing& thing) const { return looks_[thing.look]; }

 private:
  Look look_of(const Color& color, const std::optional<MeshUse>& mesh);
  void add(const Vec3& position, const Volume& volume, double radius, std::uint32_t look, bool mesh);
  std::uint32_t keep(const Thing& thing);
  void sort_balls();

  const Scene& scene_;
  const Eye& eye_;
  std::vector<Look> looks_;               // of the bodies, then of obstacles_
  std::vector<std::uint32_t> obstacles_;  // those that are drawn as things
  std::vector<std::string> files_;
  bool any_solids_ = false;
  // While things are placed anew, it holds those of the last call from number placed_ on.
  std::vector<Thing> all_;
  std::uint32_t placed_ = 0;  // number of things placed
  bool differs_ = false;      // some of them differ from the last call
  std::vector<std::uint32_t> balls_, solids_;
  std::vector<std::pair<double, std::uint32_t>> order_;
};

}  // namespace carom
