#pragma once
// Limits on what a run may compute and write unless --force is given, and what exceeds them.

#include "std.h"

namespace carom {

struct Output;
struct OutputKind;
struct Scene;

/// Limits on a scene, checked before anything is allocated for it.
struct Budget {
  uint64_t bodies = 2'000'000;
  uint64_t frames = 100'000;  // pictures of all kinds together
  // Of each output that has a row for every body at every instant.
  uint64_t rows = 200'000'000;
  // Of each such output that is held in memory until the run's end.
  uint64_t keys = 10'000'000;
  uint64_t files = 100'000;              // of a series other than pictures
  uint64_t steps = 100'000'000;          // time steps
  uint64_t body_steps = 10'000'000'000;  // time steps times bodies
  bool enforced = true;                  // --force: false

  /// The same budget without limits on output.
  Budget without_outputs() const;
};

/// An output that exceeds the budget.
struct Excess {
  const OutputKind* kind;
  double figure;  // the number that exceeds the limit
  string what;
  uint64_t limit;
};

/// The number of time steps of a scene's engine. With a `tolerance` it is a lower bound.
/// None: the engine goes from event to event.
optional<double> steps_of(const Scene& scene);

/// The outputs beyond `budget`, pictures excluded. `duration` in s.
vector<Excess> excesses(const Output& output, double duration, double bodies, const Budget& budget);

}  // namespace carom
