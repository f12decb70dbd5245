#pragma once
// The impulses that hold a crowd apart in a step: 0 <= p, 0 <= base + h u, and p (base + h u) = 0 for each row.
//
// Projected Gauss-Seidel sweeps from the last step's forces, with nonsmooth nonlinear conjugate gradients between them
// (Silcowitz, Niebe & Erleben, Visual Computer 26 (2010) 893). A sweep changes velocities at once. They are therefore
// always those of the impulses, and momentum is kept to rounding.

#include "simulate/crowd/crowd_kernels.h"
#include "simulate/crowd/crowd_threads.h"
#include "std.h"

namespace carom {

class CrowdSolver {
 public:
  /// `threads` must outlive the solver.
  explicit CrowdSolver(CrowdThreads& threads) : threads_(threads) {}

  struct Goal {
    double length;  // s, of the step
    double change;  // (m/s)^2, of a sweep: see SweepResult
    double near;    // m: wider gaps at the step's end are looked at again when all others are solved
    int sweeps;     // at most
  };

  /// Changes the velocities `v` of all bodies, which contain the effect of the rows' present impulses, and the
  /// impulses. Returns the last sweep's result.
  SweepResult balance(CrowdRows& rows, vector<Four>& v, const Goal& goal);
  /// Sweeps so many times over the marked groups, without directions.
  void sweep(CrowdRows& rows, vector<Four>& v, double length, span<const uint8_t> marks, int sweeps);
  /// Scales all impulses by one factor, so that they do no work beyond their targets. free: velocities without them.
  void scale(CrowdRows& rows, vector<Four>& v, const vector<Four>& free, double length);

 private:
  static constexpr double anew = -1;  // in place of a factor of the last direction: there is none

  bool mark(const CrowdRows& rows, const vector<Four>& v, double length, double gap);
  void list_marked(const CrowdRows& rows, size_t part);
  void turn(CrowdRows& rows, vector<Four>& v, size_t part, double beta);
  template <typename Before>
  SweepResult sweep(CrowdRows& rows, vector<Four>& v, double length, const Before& before);

  const CrowdKernels& kernels_ = widest_crowd_kernels();
  CrowdThreads& threads_;
  vector<uint8_t> marks_;           // by group: it takes part
  vector<vector<uint32_t>> which_;  // these groups, by part
  vector<Four> before_;
  vector<Four> direction_;
};

}  // namespace carom
