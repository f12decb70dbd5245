#pragma once
// The results of a run: the row of summary.csv, and what manifest.json holds besides.

#include "physics/tally.h"
#include "std.h"

namespace carom {

/// The work of one force in a run.
struct ForceWork {
  string force;     // "gravity", "merging", or its path in the scene: "forces.0.drag"
  double work = 0;  // J
};

/// The energy balance of a run, in J.
struct EnergyTotals {
  double start = 0, end = 0;
  // By impacts, both recorded and taken up by contact.
  double lost = 0;
  double work = 0;      // of forces without a potential
  double removed = 0;   // of bodies that regions have removed
  double appeared = 0;  // of bodies that have come after the start
  /// What neither impacts nor work account for: the error of the method, and rounding.
  double residual = 0;
  /// A lower bound of the energy that changed its form: kinetic at both ends or in between, potential, lost, work.
  double turnover = 0;
  vector<ForceWork> of_forces{};  // empty for a scene without forces
};

/// The reason why a result may be wrong, and the remedy.
struct Warning {
  /// One word, for programs: energy, step, tolerance, contact, rest, place, speed.
  string code;
  string text;
};

/// An event that sets times of the scene.
struct SceneEvent {
  string name;  // "{region: gate}"
  double time;  // s; NaN: it has not happened
};

/// Counts and events for the report only, not columns.
struct ContactCounts {
  uint64_t merges = 0;
  uint64_t tautened = 0;   // strings that went taut
  uint64_t removed = 0;    // bodies
  uint64_t appeared = 0;   // bodies
  uint64_t collapses = 0;  // clusters that became lasting contacts
  TakenUp taken_up;
  double made = 0;  // J, by errors of the steps of crowds
  uint64_t crowd_steps = 0;
  uint64_t unsolved_steps = 0;  // of crowds
  SharedImpacts shared;
  string first_shared{};  // "cue with up and low at 0.3 s"; empty: there was none
  vector<SceneEvent> events{};
};

/// A measure of a run: a number, or a text.
struct Measured {
  string name;                                         // "balls.red.speed_m_per_s"
  double value = numeric_limits<double>::quiet_NaN();  // not finite: undefined, or a text
  string text{};                                       // empty: a number, or undefined
};

/// The entry of a requested file that the run gave up.
struct LeftOut {
  string name, why;
};

/// How large a table is, heads not counted.
struct TableSize {
  string name;  // of the output: "trajectory"
  uint64_t rows = 0, columns = 0;
  bool is_bound = false;  // ahead of a run: it may have fewer rows
};

/// How long a run has lasted.
struct RunLength {
  double duration = 0;  // s
  /// "duration", "rest", "collisions" or "region pocket".
  string ended_by{};
};

/// The row of summary.csv.
struct Summary : RunLength {
  string run, title, engine, status;
  uint64_t bodies = 0, collisions = 0, body_body = 0, body_fixed = 0;
  double first_collision = 0, last_collision = 0;  // s; NaN: an empty cell
  EnergyTotals energy;
  double momentum_drift = 0;  // kg m/s, |p(end) - p(start)|
  double max_overlap = 0, max_speed = 0;
  uint64_t resting = 0, frames = 0;
  /// In s, summed over bodies: the time in lasting contact in crowds.
  double stepped_contact = 0;

  vector<Measured> measures;  // those that the scene defines, columns after all others

  ContactCounts contact;
  vector<Warning> warnings;  // with any, the status is `doubtful`
};

/// The command that a run's scene comes from (earlier_run.h).
struct SceneOrigin {
  /// The scene file's path from the run's folder. Empty: the run does not name its file.
  string path;
  vector<string> settings;  // path=value: --set and --seed, in their order

  void keep(auto& archive) { archive(path, settings); }
  friend bool operator==(const SceneOrigin&, const SceneOrigin&) = default;
};

/// The course of a run, only for manifest.json. Nothing here may appear in a CSV file.
struct RunFacts {
  /// Wall times, of the thread that runs the scene.
  double load_s = 0, simulate_s = 0, render_s = 0, export_s = 0;
  uint64_t peak_memory = 0;  // bytes
  SceneOrigin origin{};
  vector<Measured> measures{};
  vector<LeftOut> left_out{};
  vector<TableSize> tables{};  // for the report
};

}  // namespace carom
