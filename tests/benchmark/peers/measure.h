#pragma once
// One run of a peer on a case, measured in its own process.
#include <array>
#include <cstdint>

#include "benchmark/peers/cases.h"
#include "benchmark/peers/peer.h"

namespace carom {

enum class Outcome : std::uint8_t {
  done,
  stopped,  // by the budget
  failed,
  beyond  // the peer's reach
};

inline constexpr std::array<double, 3> settling_times{2, 5, 10};  // s

/// Values that do not apply are NaN.
struct Result {
  Outcome outcome = Outcome::failed;
  double reached = 0;             // s
  double cpu = 0;                 // s, without the checks where the run is short
  double position_error = 0;      // m, the largest of all balls' at any sample up to the horizon
  double velocity_error = 0;      // m/s, the largest at the end, of a case whose horizon is its end
  double energy_error = 0;        // by the energy of the start, at the end
  double overlap = 0;             // by a radius, the deepest at any sample
  double end_overlap = 0;         // by a radius
  double exchange = 0;            // momentum change of the balls between checks, relative to the true one
  double kinetic = 0;             // J, at the end
  std::array<double, 3> until{};  // s of CPU time, to settling_times
  std::uint64_t collisions = 0;   // 0: not counted
  std::uint64_t hash = 0;         // of the state at the end
};

/// Runs the case once.
Result measure(const Peer& peer, const Case& what, double step);

}  // namespace carom
