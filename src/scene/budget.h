#pragma once
// How much a run may write without being forced to, and what is beyond.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/output.h"

namespace carom {

struct Scene;

/// How much a scene may ask for before anything is allocated for it.
struct Budget {
  std::uint64_t bodies = 2'000'000;
  std::uint64_t frames = 100'000;             // pictures of all kinds together
  std::uint64_t rows = 200'000'000;           // of each output that has a row of every body at every instant
  std::uint64_t keys = 10'000'000;            // the same of one that is held in memory until the run's end
  std::uint64_t files = 100'000;              // of a series other than pictures
  std::uint64_t steps = 100'000'000;          // of time,
  std::uint64_t body_steps = 10'000'000'000;  // and of all bodies together
  bool enforced = true;                       // --force: false

  /// The same, but with no limit to what is written.
  Budget without_outputs() const;
};

/// An output that would write too much.
struct Excess {
  const OutputKind* kind;
  double figure;  // so many
  std::string what;
  std::uint64_t limit;
};

/// How many steps of time a scene's engine takes; with a `tolerance` at least. None: it goes from event to event.
std::optional<double> steps_of(const Scene& scene);

/// Pictures aside. `duration` in s.
std::vector<Excess> excesses(const Output& output, double duration, double bodies, const Budget& budget);

}  // namespace carom
