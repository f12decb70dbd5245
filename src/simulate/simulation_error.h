#pragma once
// Reasons why a run cannot continue.

#include "physics/bounds.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

/// The run cannot continue: a limit is reached, or doubles cannot represent a number. The text is for the user.
class SimulationError : public runtime_error {
 public:
  using runtime_error::runtime_error;
  /// An error about a body, which simulators identify by number: "<before>body 3<after>".
  SimulationError(const string& before, Entity body, const string& after);
  /// An error about several things. after: the text after each of them.
  SimulationError(string before, vector<Entity> things, vector<string> after);

  /// The same error with the things' names in place of their numbers.
  SimulationError named(const function<string(Entity)>& name) const;

 private:
  string before_;
  vector<Entity> things_;
  vector<string> after_;  // by thing
};

/// Remedies against a speed, and against a position, that is out of bounds.
struct Remedies {
  const char* speed = "restitution above 1 adds energy at every collision; lower it, or shorten simulate.duration";
  const char* place = "shorten simulate.duration, or hold it back by a wall";
};

/// Throws SimulationError: a body's position x (m) or velocity v (m/s) at `time` (s) is out of bounds.
[[noreturn]] void fail_out_of_bounds(const Bounds& bounds, Entity body, double time, const Vec3& x, const Vec3& v,
                                     const Remedies& remedies);

}  // namespace carom
