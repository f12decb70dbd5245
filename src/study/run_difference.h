#pragma once
// Two runs held against each other: their scenes, the collision in which they part, how far apart they end.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/run_list.h"

namespace carom {

/// A value of the scenes that is not the same in both. Empty: that scene does not have it.
struct ValueDifference {
  std::string path, unit, a, b;
};

/// A row of collisions.csv, as far as it is shown.
struct CollisionFacts {
  double time = 0;              // s
  std::string kind, a, b;       // a and b: who met
  double separation_speed = 0;  // m/s, along the normal
};

/// Collisions by their order. Two are the same if kind, a, b and time are; their outcomes if the rest of the row is.
struct CollisionDifference {
  std::uint64_t same = 0;                        // of the first ones
  std::uint64_t count_a = 0, count_b = 0;        // of all
  bool part = false;                             // after those that are the same; and then what each run did next:
  std::optional<CollisionFacts> next_a, next_b;  // none: nothing more
  /// The first of the same ones whose outcome is not the same: its number from 0 on, and both rows.
  std::optional<std::uint64_t> outcome;
  CollisionFacts outcome_a, outcome_b;
  std::string column, cell_a,
      cell_b;  // the column in which these differ (the separation speed, if in that) and its cells
};

/// Where bodies are at the ends of the runs.
struct EndDifference {
  double time_a = 0, time_b = 0;            // s
  std::uint64_t bodies = 0;                 // that both have
  double greatest = 0;                      // m, distance of a body's two positions
  std::string body;                         // whose it is
  std::vector<std::string> only_a, only_b;  // bodies that the other one does not have
};

struct RunDifference {
  ListedRun a, b;
  std::vector<ValueDifference> values;
  CollisionDifference collisions;
  std::optional<EndDifference> end;  // none: a run has no trajectory.csv; which one says `no_end`
  std::string no_end;
  bool equal() const;
};

/// Of two runs' folders. Throws ExportError, which names what is missing and the remedy.
RunDifference difference_of(const std::string& a, const std::string& b);

}  // namespace carom
