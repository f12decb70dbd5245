#pragma once
// The differences of two runs: of their scenes, of their collisions, and of their positions at the end.

#include "std.h"
#include "study/run_list.h"

namespace carom {

/// A value that differs between the two scenes. Empty: the scene has no such value.
struct ValueDifference {
  string path, unit, a, b;
};

/// The displayed cells of a row of collisions.csv.
struct CollisionFacts {
  double time = 0;  // s
  /// `a` and `b`: the two things that collide.
  string kind, a, b;
  double separation_speed = 0;  // m/s, along the normal
  /// A row of kind `rest` ends bounces, and is no collision.
  bool is_rest() const { return kind == "rest"; }
};

/// Compares collisions in their order. Two are the same if kind, a, b and time are equal.
/// Their outcomes are the same if the rest of the row is.
/// Rows of kind `rest` are compared too, but are counted nowhere, as in the report of a run.
struct CollisionDifference {
  /// Number of equal collisions from the start.
  uint64_t same = 0;
  uint64_t count_a = 0, count_b = 0;  // number of all collisions
  /// Whether the runs differ after the equal collisions. The next collision of each run then follows.
  bool part = false;
  optional<CollisionFacts> next_a, next_b;  // none: no further collision
  /// The number of collisions before the first equal row with different outcomes, and both rows.
  optional<uint64_t> outcome;
  CollisionFacts outcome_a, outcome_b;
  string column, cell_a,
      /// The column in which these differ, and its two cells. It is the separation speed, if that differs.
      cell_b;
};

/// The positions of bodies at the ends of the runs.
struct EndDifference {
  double time_a = 0, time_b = 0;  // s
  uint64_t bodies = 0;            // number of bodies in both runs
  double greatest = 0;            // m, distance of a body's two positions
  string body;                    // the body with that distance
  vector<string> only_a, only_b;  // bodies that the other run lacks
};

struct RunDifference {
  ListedRun a, b;
  vector<ValueDifference> values;
  CollisionDifference collisions;
  /// None: a run has no trajectory.csv. `no_end` names that run.
  optional<EndDifference> end;
  string no_end;
  bool equal() const;
};

/// Compares two runs by their folders. Throws ExportError with a text that names what is missing and the remedy.
RunDifference difference_of(const string& a, const string& b);

}  // namespace carom
