#pragma once
// How finely crowds are computed: islands with contacts that change too often to be followed one by one.

#include "std.h"

namespace carom {

enum class QualityLevel : uint8_t { preview, fast, normal, fine, finer, reference };

/// One row of the table of qualities. Lengths are shares of the least radius r, times of falling by it: sqrt(2 r / a).
struct ContactQuality {
  double longest_step;  // of the time of falling
  double displacement;  // of r, of the fastest body in a step
  double accuracy;      // of the speed that a step gives a body, or of its speed: what forces may leave
  double shell;         // of r: the gap that contacts keep
  int sweeps;           // of a step's forces, at most
  int impact_sweeps;    // of a step's impacts, at most
  double overlap;       // of r, that is allowed; 0: none
  bool rests_by_speed;  // bodies that are slow for a while rest, whether or not forces are in balance
};

/// By level.
inline constexpr array<ContactQuality, 6> contact_qualities{{
    {0.16, 0.5, 1, 1e-2, 20, 5, 0.05, true},
    {0.08, 0.2, 0.3, 3e-3, 300, 20, 0, true},
    {0.04, 0.1, 0.05, 1e-3, 300, 20, 0, false},
    {0.02, 0.05, 0.05, 1e-3, 300, 20, 0, false},
    {0.01, 0.02, 0.05, 3e-4, 300, 20, 0, false},
    {0.005, 0.005, 0.03, 1e-4, 300, 20, 0, false},
}};

constexpr const ContactQuality& quality_of(QualityLevel level) {
  return contact_qualities[size_t(level)];
}

}  // namespace carom
