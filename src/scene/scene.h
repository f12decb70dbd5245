#pragma once
// The whole request that a scene file makes, checked: const from here on. Types only; load.h reads files into them.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "numerics/vec3.h"
#include "physics/state.h"
#include "physics/world.h"
#include "scene/colors.h"
#include "scene/output.h"
#include "scene/simulate_settings.h"

namespace carom {

/// A mesh to draw in place of a volume: a vertex p of the file stands at position + scale * (p - center).
struct MeshUse {
  std::string file;            // a path that opens from the working folder
  Vec3 center = Vec3::Zero();  // in the file's own units
  double scale = 1;            // m per unit of the file
};

/// A mesh file of the scene. A run's folder keeps a copy, which the resolved text names, so that the folder runs alone.
struct MeshFile {
  std::string file;  // as in MeshUse
  std::string copy;  // a plain file name, no other output's; empty: a .gltf, which has its data in further files
};

/// A name of the scene file and the bodies it stands for: one ball or body, or a group's members name.0, name.1, ...
struct BodyRange {
  std::string name;
  Entity first = 0;
  Entity count = 1;
  bool group = false;
  Color color;
  std::optional<MeshUse> mesh = std::nullopt;
};

struct FixedName {
  std::string name;  // room.x_min etc. for a room's planes
  Color color;
  bool visible = true;
  std::optional<MeshUse> mesh = std::nullopt;  // of an obstacle
};

/// Who is who, in the order of the file, which is the order of every output.
struct Roster {
  std::vector<BodyRange> bodies;                 // by first
  std::vector<FixedName> fixed;                  // by entity: the planes, the walls, the obstacles
  std::string name(Entity e) const;              // "red", "gas.17", "lane"
  const BodyRange& range_of(Entity body) const;  // the range that holds this body
};

struct Camera {
  Vec3 eye = Vec3::Zero();     // m
  Vec3 target = Vec3::Zero();  // m
  Vec3 up = Vec3(0, 1, 0);
  double fov = 45;  // degrees, along fov_horizontal's axis
  bool fov_horizontal = false;
  double near = 0.1;  // m
  double far = 1000;  // m
};

struct Light {
  std::string name;
  std::optional<Vec3> direction;  // the way the light travels; exactly one of direction and position is set
  std::optional<Vec3> position;   // m
  Color color;
  double intensity = 1;
};

struct Scene {
  std::string file;  // as named on the command line
  std::string title;
  std::uint64_t seed = 0;
  World world;
  State initial;  // at time 0, before impulses
  Roster roster;
  Simulate simulate;
  std::optional<Camera> camera;
  std::vector<Light> lights;  // empty: the renderer's own
  std::optional<Color> ambient;
  std::optional<Color> background;
  Output output;
  std::vector<MeshFile> meshes;  // each once
  std::string resolved;  // YAML text: this scene with defaults and --set applied; running it gives the same bytes
};

}  // namespace carom
