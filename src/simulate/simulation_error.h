#pragma once
// Reasons why a run cannot continue.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/bounds.h"
#include "physics/entity.h"

namespace carom {

/// The run cannot continue: a limit is reached, or doubles cannot represent a number. The text is for the user.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// An error about a body, which simulators identify by number: "<before>body 3<after>".
  SimulationError(const std::string& before, Entity body, const std::string& after);
  /// An error about several things. after: the text after each of them.
  SimulationError(std::string before, std::vector<Entity> things, std::vector<std::string> after);

  /// The same error with the things' names in place of their numbers.
  SimulationError named(const std::function<std::string(Entity)>& name) const;

 private:
  std::string before_;
  std::vector<Entity> things_;
  std::vector<std::string> after_;  // by thing
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
