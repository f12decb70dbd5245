// Sweeps over the rows of a crowd. A gradient method on the dual problem (projected gradients, accelerated or not)
// needs two to six times as many passes over the rows at the accuracy of a step.
#include "simulate/crowd/crowd_solver.h"

#include <algorithm>

namespace carom {

namespace {

/// Of all forces, as a factor. Sweeps that have converged need far less.
constexpr double greatest_scale = 1.25;
/// Sweeps that change little, after which rows that are short stay so.
constexpr int most_stuck = 150;

/// The numbers of the marked groups.
std::vector<std::uint32_t> marked(std::span<const std::uint8_t> marks) {
  std::vector<std::uint32_t> which;
  for (std::uint32_t k = 0; k < marks.size(); ++k)
    if (marks[k] != 0) which.push_back(k);
  return which;
}

}  // namespace

/// Lets all groups take part that may press. Returns whether some are new.
bool CrowdSolver::mark(const CrowdRows& rows, const std::vector<Four>& v, double length, double gap) {
  if (!kernels_.mark(rows.hot.data(), rows.groups(), v.data(), length, gap, marks_.data())) return false;
  which_ = marked(marks_);
  return true;
}

SweepResult CrowdSolver::hold(CrowdRows& rows, std::vector<Four>& v, const Goal& goal) {
  before_.resize(v.size());
  marks_.assign(rows.groups(), 0);
  which_.clear();
  mark(rows, v, goal.length, goal.near);
  const auto forget_direction = [&] {
    direction_.assign(v.size(), Four{});
    for (const std::uint32_t k : which_) std::ranges::fill(rows.change[k].direction, 0.0);
  };
  forget_direction();

  double last = 0;
  int stuck = 0;  // sweeps that have changed little, with rows that are short
  for (int done = 1;; ++done) {
    std::copy(v.begin(), v.end(), before_.begin());
    const SweepResult found = kernels_.sweep(rows.hot.data(), rows.change.data(), which_, v.data(), goal.length);
    const bool solved = found.change <= goal.change && !found.is_short;
    if (solved && !mark(rows, v, goal.length, 0)) return found;
    if (found.change <= goal.change && found.is_short) ++stuck;
    if (done >= goal.sweeps || stuck == most_stuck) return found;

    // A direction in which changes have grown is no longer followed, nor that of fewer rows.
    const double beta = last > 0 ? found.change / last : 0;
    last = solved ? 0 : found.change;
    if (solved || beta > 1) {
      forget_direction();
      continue;
    }
    kernels_.conjugate(rows.hot.data(), rows.change.data(), which_, v.data(), before_.data(), direction_.data(),
                       v.size(), beta);
  }
}

void CrowdSolver::sweep(CrowdRows& rows, std::vector<Four>& v, double length, std::span<const std::uint8_t> marks,
                        int sweeps) {
  which_ = marked(marks);
  for (int k = 0; k < sweeps; ++k) kernels_.sweep(rows.hot.data(), rows.change.data(), which_, v.data(), length);
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
