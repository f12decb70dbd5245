#pragma once
// A scene as data for other programs: what stands still as triangles, what moves as keys. Types only; still_things.h
// and glb.h make something of them.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/volume.h"
#include "render/mesh.h"
#include "scene/colors.h"

namespace carom {

struct Scene;

/// A plane, a wall or an obstacle that a picture shows.
struct StillThing {
  std::string name;
  Color color;
  Mesh mesh;               // m, in the world's frame; counterclockwise from outside, or from a plane's free side
  bool two_sided = false;  // a wall
};

/// An upright box; from above to below: nothing.
struct Extent {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);  // m

  void include(const Vec3& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
  void include(const Vec3& center, const Vec3& half) { include(center - half), include(center + half); }
};

/// The bodies' positions at instants, and their volumes where these change.
struct KeyedMotion {
  /// From key `key` on body `body` has this volume; none: it has become part of another.
  struct Change {
    std::size_t key;
    Entity body;
    std::optional<Volume> volume;
  };
  std::vector<double> times;                   // s, rising
  std::vector<std::array<float, 3>> position;  // m, by key, then by body
  std::vector<Change> changes;                 // by key
  Extent extent;                               // of all bodies at all instants
};

/// What render/ makes of these for src/export/. Both throw RenderError.
struct ModelMakers {
  /// `seen`: planes, which have no bounds, are cut off some way around it.
  std::function<std::vector<StillThing>(const Scene& scene, const Extent& seen)> still_things;
  /// The bytes of a binary glTF 2 file.
  std::function<std::string(const Scene& scene, const KeyedMotion& motion)> glb;
};

}  // namespace carom
