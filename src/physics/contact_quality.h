#pragma once
// How finely crowds are computed: islands with contacts that change too often to be followed one by one.
#include <array>
#include <cstdint>

namespace carom {

/// One row of the table of qualities. Lengths are shares of the least radius r, times of falling by it: sqrt(2 r / a).
struct ContactQuality {
  const char* name;
  double longest_step;  // of the time of falling
  double displacement;  // of r, of the fastest body in a step
  double accuracy;      // of the speed that a step gives a body, or of its speed: what forces may leave
  double shell;         // of r: the gap that contacts keep
  int sweeps;           // of a step's forces, at most
  int impact_sweeps;    // of a step's impacts, at most
  double overlap;       // of r, that is allowed; 0: none
  bool rests_by_speed;  // bodies that are slow for a while rest, whether or not forces are in balance
};

inline constexpr std::array<ContactQuality, 6> contact_qualities{{
    {"preview", 0.16, 0.5, 1, 1e-2, 20, 5, 0.05, true},
    {"fast", 0.08, 0.2, 0.3, 3e-3, 300, 20, 0, true},
    {"normal", 0.04, 0.1, 0.05, 1e-3, 300, 20, 0, false},
    {"fine", 0.02, 0.05, 0.05, 1e-3, 300, 20, 0, false},
    {"finer", 0.01, 0.02, 0.05, 3e-4, 300, 20, 0, false},
    {"reference", 0.005, 0.005, 0.03, 1e-4, 300, 20, 0, false},
}};
inline constexpr const ContactQuality& normal_quality = contact_qualities[2];

}  // namespace carom
