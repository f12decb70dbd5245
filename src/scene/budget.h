#pragma once
// Limits on what a run may compute and write unless --force is given, and what exceeds them.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/output_kinds.h"

namespace carom {

struct Scene;

/// Limits on a scene, checked before anything is allocated for it.
struct Budget {
  std::uint64_t bodies = 2'000'000;
  std::uint64_t frames = 100'000;  // pictures of all kinds together
  // Of each output that has a row for every body at every instant.
  std::uint64_t rows = 200'000'000;
  // Of each such output that is held in memory until the run's end.
  std::uint64_t keys = 10'000'000;
  std::uint64_t files = 100'000;              // of a series other than pictures
  std::uint64_t steps = 100'000'000;          // time steps
  std::uint64_t body_steps = 10'000'000'000;  // time steps times bodies
  bool enforced = true;                       // --force: false

  /// The same budget without limits on output.
  Budget without_outputs() const;
};

/// An output that exceeds the budget.
struct Excess {
  const OutputKind* kind;
  double figure;  // the number that exceeds the limit
  std::string what;
  std::uint64_t limit;
};

/// The number of time steps of a scene's engine. With a `tolerance` it is a lower bound.
/// None: the engine goes from event to event.
std::optional<double> steps_of(const Scene& scene);

/// The outputs beyond `budget`, pictures excluded. `duration` in s.
std::vector<Excess> excesses(const Output& output, double duration, double bodies, const Budget& budget);

}  // namespace carom
