#pragma once
// A scene as data for other programs: still things as triangles, motion as keyframes. These are only types.
// still_things.h and glb.h make the data.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/state.h"
#include "physics/volume.h"
#include "render/mesh_data.h"
#include "scene/colors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// A plane, a wall or an obstacle that a picture shows, where it is at time 0.
struct StillThing {
  string name;
  Color color;
  Mesh mesh;               // m, in the world's frame; counterclockwise from outside, or from a plane's free side
  bool two_sided = false;  // a wall
  size_t fixed = 0;        // its number among all fixed things
};

/// A box along the axes. It is empty if it extends from above to below.
struct Extent {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);  // m

  void include(const Vec3& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
  void include(const Vec3& center, const Vec3& half) { include(center - half), include(center + half); }
  Vec3 middle() const { return (low + high) / 2; }
  void keep(auto& archive) { archive(low, high); }
};

/// The bodies' positions at keyframes, the changes of their volumes, and the camera.
struct KeyedMotion {
  /// From keyframe `key` on, body `body` has this volume. Without one it has become part of another body.
  struct Change {
    size_t key;
    Entity body;
    optional<Volume> volume;

    void keep(auto& archive) { archive(key, body, volume); }
  };
  vector<double> times;              // s, ascending
  vector<array<float, 3>> position;  // m, by keyframe, then by body
  vector<Change> changes;            // by keyframe
  Extent extent;                     // of all bodies at all keyframes
  vector<Camera> cameras;            // by keyframe; empty: the scene's at time 0
  vector<double> fired;              // s, State::fired of the last keyframe

  void keep(auto& archive) { archive(times, position, changes, extent, cameras, fired); }
};

/// The functions by which render/ makes these for src/export/. They throw RenderError.
struct ModelMakers {
  /// `seen`: planes, which have no bounds, are cut off at some distance around it.
  function<vector<StillThing>(const Scene& scene, const Extent& seen)> still_things;
  /// The bytes of a binary glTF 2 file.
  function<string(const Scene& scene, const KeyedMotion& motion)> glb;
  /// The scene's camera at the state's time.
  function<Camera(const State& state)> camera;
};

}  // namespace carom
