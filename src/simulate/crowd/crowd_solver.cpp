// Sweeps over the rows of a crowd. A gradient method on the dual problem (projected gradients, accelerated or not)
// needs two to six times as many passes over the rows at the accuracy of a step.
#include "simulate/crowd/crowd_solver.h"

#include <algorithm>

namespace carom {

namespace {

/// Of all forces, as a factor. Sweeps that have converged need far less.
constexpr double greatest_scale = 1.25;

}  // namespace

bool CrowdSolver::hold(CrowdRows& rows, std::vector<Four>& v, const Goal& goal) {
  direction_.assign(v.size(), Four{});
  before_.resize(v.size());
  for (RowChange& change : rows.change) std::fill(std::begin(change.direction), std::end(change.direction), 0.0);

  double last = 0;
  for (int done = 1;; ++done) {
    std::copy(v.begin(), v.end(), before_.begin());
    const SweepResult found = kernels_.sweep(rows.hot.data(), rows.change.data(), rows.groups(), v.data(), goal.length);
    if (found.change <= goal.change && !found.is_short) return true;
    if (done >= goal.sweeps) return false;

    // A direction in which changes have grown is no longer followed.
    const double beta = last > 0 ? found.change / last : 0;
    last = found.change;
    if (beta > 1) {
      std::fill(direction_.begin(), direction_.end(), Four{});
      for (RowChange& change : rows.change) std::fill(std::begin(change.direction), std::end(change.direction), 0.0);
      continue;
    }
    kernels_.conjugate(rows.hot.data(), rows.change.data(), rows.groups(), v.data(), before_.data(), direction_.data(),
                       v.size(), beta);
  }
}

void CrowdSolver::sweep(CrowdRows& rows, std::vector<Four>& v, double length, int sweeps) {
  for (int k = 0; k < sweeps; ++k) {
    kernels_.sweep(rows.hot.data(), rows.change.data(), rows.groups(), v.data(), length);
  }
}

void CrowdSolver::scale(CrowdRows& rows, std::vector<Four>& v, const std::vector<Four>& free, double length) const {
  const GuardSums sums = kernels_.guard(rows.hot.data(), rows.groups(), v.data(), free.data(), length);
  if (!(sums.gain > 0)) return;
  const double factor = std::clamp(-sums.aim / sums.gain, 0.0, greatest_scale);
  for (RowGroup& group : rows.hot)
    for (double& impulse : group.impulse) impulse *= factor;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (int k = 0; k < 3; ++k) v[i].at[k] = free[i].at[k] + factor * (v[i].at[k] - free[i].at[k]);
}

}  // namespace carom
