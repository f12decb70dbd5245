#pragma once
// The loops over the rows of a crowd, in vectors. Each is compiled for each vector width, and chosen by the processor
// at run time. All widths have the same arithmetic in the same order, so that the bits do not depend on the processor.

#include "simulate/crowd/crowd_rows.h"
#include "std.h"

namespace carom {

/// What rows aim at in a step.
struct StepTarget {
  double length = 0;  // s
  double push = 0;    // share of a missing gap that a step restores
  double back = 0;    // of an overlap by rounding
  double share = 0;   // of a gap and of the shell: what errors may take
  double below = 0;   // the same, of a gap of less than half of the shell
  double least = 0;   // m: what rounding may take
  double shell = 0;   // m: the gap that rows keep once they have had it
  double way = 0;     // m: no pair's gap closes by more in the step
};

/// What rows are like at the start of a step.
struct AimResult {
  bool strikes = false;  // a row has an impact in the step
  double least_gap = 0;  // m, or greater than 0
};

/// What a sweep has found.
struct SweepResult {
  double change = 0;      // (m/s)^2: the sum of the squares of (1/m_a + 1/m_b) times a row's change
  bool is_short = false;  // a row was short by more than its slack
};

/// The sums by which all impulses are scaled so that they do no work beyond their targets.
struct GuardSums {
  double aim = 0;   // J: impulses times (base / h + speed without them)
  double gain = 0;  // J: impulses times the change of speed by them
};

/// How fast bodies move that press on each other.
struct Agitation {
  double squares = 0;   // (m/s)^2
  size_t pressing = 0;  // rows
};

struct CrowdKernels {
  /// Gaps and normals of groups [0, count), which are pairs of balls at x.
  void (*measure)(RowGroup* hot, RowState* state, size_t count, const Four* x);
  /// Bases and slacks of groups [0, count), from gaps, and which of them may have an impact in the step.
  AimResult (*aim)(RowGroup* hot, RowChange* change, RowState* state, size_t count, const Four* v,
                   const StepTarget& target, uint8_t* may_strike);
  /// The first of these groups from `from` on with an impact in the step, and which of its rows: a bit each; count:
  /// there is none.
  size_t (*next_strike)(const RowGroup* hot, const RowState* state, size_t from, size_t count, const Four* v,
                        double length, const uint8_t* may_strike, unsigned& which);
  /// Of rows with a force, of bodies with numbers below `movable`: the sum of the squares of their relative velocities.
  Agitation (*agitation)(const RowGroup* hot, const RowState* state, size_t count, const Four* v, uint32_t movable);
  /// Applies the impulses of all groups.
  void (*push)(const RowGroup* hot, size_t count, Four* v);
  /// Marks the groups with an impulse, or with a gap (m) of less than this at the step's end. Returns whether some are
  /// new.
  bool (*mark)(const RowGroup* hot, size_t count, const Four* v, double length, double gap, uint8_t* marks);
  /// One sweep of projected Gauss-Seidel over these groups.
  SweepResult (*sweep)(RowGroup* hot, RowChange* change, span<const uint32_t> which, Four* v, double length);
  /// Adds `beta` times the last direction to the impulses of these groups. The new direction is that and the last
  /// change.
  void (*conjugate)(RowGroup* hot, RowChange* change, span<const uint32_t> which, double beta);
  /// The same for the velocities of `count` bodies, and their change from `before`, which becomes v.
  void (*follow)(Four* v, Four* before, Four* direction, size_t count, double beta);
  GuardSums (*guard)(const RowGroup* hot, size_t count, const Four* v, const Four* free, double length);
  /// The longest drift (s) after which no listed pair overlaps by more than `rounding` (m).
  double (*safe_drift)(const RowGroup* hot, const RowState* state, size_t count, const Four* v, double rounding);
};

/// The kernels that this processor can run, the widest last.
vector<CrowdKernels> crowd_kernels();
const CrowdKernels& widest_crowd_kernels();

}  // namespace carom
