#pragma once
// A scene file: the claims of its opening comment, and the outcome of its run.

#include "physics/collision.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::testing {

/// Standard gravity, m/s^2.
inline constexpr double g_n = 9.80665;

/// Names of all scene files below scenes/, without .yaml: "bouncing_ball", "benchmark/gas_1000".
vector<string> scene_names();

/// The scene, its meshes read.
Scene load(const string& name);

/// The opening comment in one line, every run of blanks and # made one blank.
string comment_of(const string& name);

/// The number after `words` in the comment. Fails the test unless the words occur there exactly once.
double stated(const string& name, const string& words);

/// A run to the end, and the states at the requested times.
struct Played {
  Scene scene;
  vector<Collision> collisions;  // without the ends of bounces
  vector<Collision> rests;
  vector<State> states;     // at `times`, in order
  double energy_start = 0;  // J, of the simulator's state at time 0
  State end = {};
  Tally tally = {};

  Entity number(const string& name) const;  // of a ball or a fixed thing
  /// Collisions in which it takes part.
  vector<Collision> of(const string& name) const;
  Vec3 velocity(const string& ball) const { return end.velocity[number(ball)]; }
  Vec3 position(const string& ball) const { return end.position[number(ball)]; }
};

/// `times`: s, in ascending order, at most the duration.
Played play(const string& name, const vector<double>& times = {});

}  // namespace carom::testing
