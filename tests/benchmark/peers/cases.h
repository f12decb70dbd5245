#pragma once
// Scenes to measure peers, with their true motion where it is known.
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// The true state at a time (s); times rise from call to call.
using Truth = std::function<const State&(double time)>;

struct Case {
  std::string name;
  Scene scene;
  double end;                                  // s
  double sample_interval;                      // s; interval of the checks, or every step if that is longer
  double horizon;                              // s; positions are compared up to there: beyond, a gas is chaotic
  double budget;                               // s of CPU time, after which a run is ended
  std::function<Truth(const Scene&)> truth{};  // none: unknown
};

/// Those whose names begin with `name`, or all. Throws SceneError.
std::vector<Case> cases_named(const std::string& name);

}  // namespace carom
