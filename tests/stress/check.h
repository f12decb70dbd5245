#pragma once
// Invariants of every run of every scene.

#include "std.h"
#include "stress/scene.h"

namespace carom::stress {

struct Verdict {
  vector<string> violations;  // empty: all is well
  uint64_t collisions = 0;
  bool crowds = false;   // some bodies moved as a crowd
  bool stopped = false;  // at a limit, as it may
};

/// s of CPU time for a run, by default. With sanitizers, or without optimisation, it takes many times as long.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
inline constexpr double usual_patience = 10;
#else
inline constexpr double usual_patience = 300;
#endif

/// `patience`: s of CPU time, for a run.
Verdict check(const RandomScene& scene, double patience = usual_patience);

/// Of a run in steps of time, by a method and with a step that the seed chooses.
Verdict check_stepped(const RandomScene& scene);

}  // namespace carom::stress
