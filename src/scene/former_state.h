#pragma once
// What a scene with `start` takes from a former run.

#include "physics/state.h"
#include "std.h"

namespace carom {

/// The bodies of a former run at one time, `state.time`, in s of that run.
struct FormerState {
  /// By body, as in its trajectory.csv: "red", "gas.17".
  vector<string> names;
  /// Positions in m, velocities in m/s. `part_of` is no_entity for a body that has merged or left the world, where the
  /// run did not store which of the two.
  State state{};
  /// Whether bodies had merged by then. Joint bodies have other masses and sizes than the run's scene gives.
  bool has_merged = false;
  /// Why figures of the run may be wrong. Empty: no reason is known.
  string doubt{};
  /// The file of the run with this state, and its hash in hexadecimal digits.
  string file{}, sha256{};
};

/// A former run has no such state. The text is the fault, without the name of the run.
struct StartError : runtime_error {
  StartError(const string& fault, string the_remedy, bool is_of_time = false)
      : runtime_error(fault), remedy(std::move(the_remedy)), of_time(is_of_time) {}
  string remedy;  // lines
  bool of_time;   // the run is usable, but not at this time
};

/// Where the bodies of a scene come from.
struct StartedFrom {
  string run;  // the path of the folder, as in the scene
  /// The same, relative to the working folder.
  string folder;
  double at = 0;  // s of that run
  /// As in FormerState.
  string file, sha256;
};

}  // namespace carom
