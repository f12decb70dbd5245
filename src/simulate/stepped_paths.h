#pragma once
// Where each body's path through the present step begins, how it goes on from there, and where it ends. Arrays by body.
#include <cstdint>
#include <vector>

#include "physics/path.h"
#include "physics/state.h"
#include "physics/touch.h"
#include "physics/world.h"

namespace carom {

/// The thing that a body has just struck or left where its path begins.
struct PathOrigin {
  Entity partner = no_entity;
  std::uint8_t feature = no_feature;  // as in Touch
};

/// A path of this step that an impact has cut short.
struct StepPiece {
  Entity body;
  double from, to;   // s, since the step's start
  Path path;         // at `from`
  Vec3 end_v;        // m/s, at `to`
  bool constrained;  // contact forces shaped it
};

struct StepPaths {
  /// All bodies at time 0, after the world's impulses. `world` must outlive this.
  StepPaths(const World& world, const State& initial);

  /// The path of a body or a fixed thing from `time` (s, since the step's start) on.
  Path from(Entity e, double time) const;
  Vec3 position_of(Entity e) const { return world.is_body(e) ? x[e] : world.fixed_position(e); }  // m
  Vec3 velocity_of(Entity e) const { return world.is_body(e) ? v[e] : Vec3(Vec3::Zero()); }       // m/s
  std::uint32_t version_of(Entity e) const { return world.is_body(e) ? version[e] : 0; }          // fixed: 0

  /// Ends body i's path at `time` (s, since the step's start), and begins the next one there at x (m) and v (m/s).
  void cut(Entity i, double time, const Vec3& x, const Vec3& v, bool constrained);
  /// A body that has slept through the step until `time` wakes.
  void wake(Entity i, double time);
  /// Body i stays where its path begins, and keeps its velocity.
  void stay(Entity i);
  /// Begins a step where body i's path ended.
  void begin_step(Entity i) {
    x[i] = end_x[i];
    v[i] = end_v[i];
    start[i] = 0;
    origin[i] = {};
    ++version[i];
  }

  const World& world;
  std::vector<Vec3> x, v;              // m, m/s: where a path begins
  std::vector<double> start;           // s, since the step's start: when it does
  std::vector<Path> path;              // how it goes on to the step's end
  std::vector<Vec3> end_x, end_v;      // m, m/s: where it ends
  std::vector<PathOrigin> origin;      // what it began with
  std::vector<std::uint32_t> version;  // counts a body's paths
  std::vector<StepPiece> pieces;       // of this step, in the order in which they ended
};

}  // namespace carom
