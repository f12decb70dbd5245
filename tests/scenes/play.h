#pragma once
// A scene file: the claims of its opening comment, and the outcome of its run.
#include <string>
#include <vector>

#include "physics/collision.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "scene/scene.h"

namespace carom::testing {

/// Standard gravity, m/s^2.
inline constexpr double g_n = 9.80665;

/// Names of all scene files below scenes/, without .yaml: "bouncing_ball", "benchmark/gas_1000".
std::vector<std::string> scene_names();

/// The scene, its meshes read.
Scene load(const std::string& name);

/// The opening comment in one line, every run of blanks and # made one blank.
std::string comment_of(const std::string& name);

/// The number after `words` in the comment. Fails the test unless the words occur there exactly once.
double stated(const std::string& name, const std::string& words);

/// A run to the end, and the states at the requested times.
struct Played {
  Scene scene;
  std::vector<Collision> collisions;  // without the ends of bounces
  std::vector<Collision> rests;
  std::vector<State> states;  // at `times`, in order
  double energy_start = 0;    // J, of the simulator's state at time 0
  State end = {};
  Tally tally = {};

  Entity number(const std::string& name) const;  // of a ball or a fixed thing
  /// Collisions in which it takes part.
  std::vector<Collision> of(const std::string& name) const;
  Vec3 velocity(const std::string& ball) const { return end.velocity[number(ball)]; }
  Vec3 position(const std::string& ball) const { return end.position[number(ball)]; }
};

/// `times`: s, in ascending order, at most the duration.
Played play(const std::string& name, const std::vector<double>& times = {});

}  // namespace carom::testing
