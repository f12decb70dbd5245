// Sweeps over the rows of a crowd. A gradient method on the dual problem (projected gradients, accelerated or not)
// needs two to six times as many passes over the rows at the accuracy of a step.
#include "simulate/crowd/crowd_solver.h"

#include <atomic>

#include "std.h"

namespace carom {

namespace {

/// Of all forces, as a factor. Sweeps that have converged need far less.
constexpr double greatest_scale = 1.25;
/// Sweeps that change little, after which rows that are short stay so.
constexpr int most_stuck = 150;

}  // namespace

/// Lets all groups take part that may press. Returns whether some are new.
bool CrowdSolver::mark(const CrowdRows& rows, const vector<Four>& v, double length, double gap) {
  std::atomic<bool> any = false;
  threads_.each(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    if (!kernels_.mark(rows.hot.data() + begin, end - begin, v.data(), length, gap, marks_.data() + begin)) return;
    list_marked(rows, p);
    any = true;
  });
  return any;
}

void CrowdSolver::list_marked(const CrowdRows& rows, size_t part) {
  which_[part].clear();
  for (size_t k = rows.parts[part].begin; k < rows.parts[part].end; ++k)
    if (marks_[k] != 0) which_[part].push_back(uint32_t(k));
}

/// Goes `beta` times along the last direction, in the rows of a part and with the bodies of its slab.
void CrowdSolver::turn(CrowdRows& rows, vector<Four>& v, size_t part, double beta) {
  const bool has_bodies = part < rows.slabs();
  const size_t first = has_bodies ? rows.first[part] : 0;
  const size_t count = has_bodies ? rows.first[part + 1] - first : 0;
  if (beta != anew) {
    kernels_.conjugate(rows.hot.data(), rows.change.data(), which_[part], beta);
    kernels_.follow(v.data() + first, before_.data() + first, direction_.data() + first, count, beta);
    return;
  }

  for (const uint32_t k : which_[part]) ranges::fill(rows.change[k].direction, 0.0);
  std::copy_n(v.data() + first, count, before_.data() + first);
  std::fill_n(direction_.data() + first, count, Four{});
}

/// A sweep over the groups that take part. Calls before(part) first for each part.
template <typename Before>
SweepResult CrowdSolver::sweep(CrowdRows& rows, vector<Four>& v, double length, const Before& before) {
  vector<SweepResult> found(rows.parts.size());
  threads_.in_phases(rows, [&](size_t p) {
    before(p);
    found[p] = kernels_.sweep(rows.hot.data(), rows.change.data(), which_[p], v.data(), length);
  });
  return {rows.sum([&](size_t p) { return found[p].change; }),
          any_of(found, [](const SweepResult& of) { return of.is_short; })};
}

SweepResult CrowdSolver::balance(CrowdRows& rows, vector<Four>& v, const Goal& goal) {
  before_.resize(v.size());
  direction_.resize(v.size());
  marks_.assign(rows.groups(), 0);
  which_.resize(rows.parts.size());
  for (vector<uint32_t>& of_part : which_) of_part.clear();
  mark(rows, v, goal.length, goal.near);

  double last = 0;
  int stuck = 0;       // sweeps that have changed little, with rows that are short
  double beta = anew;  // share of the last direction that the next sweep follows first
  for (int done = 1;; ++done) {
    const SweepResult found = sweep(rows, v, goal.length, [&](size_t p) { turn(rows, v, p, beta); });
    const bool solved = found.change <= goal.change && !found.is_short;
    if (solved && !mark(rows, v, goal.length, 0)) return found;
    if (found.change <= goal.change && found.is_short) ++stuck;
    if (done >= goal.sweeps || stuck == most_stuck) return found;

    // A direction in which changes have grown is no longer followed, nor that of fewer rows.
    beta = last > 0 ? found.change / last : 0;
    last = solved ? 0 : found.change;
    if (solved || beta > 1) beta = anew;
  }
}

void CrowdSolver::sweep(CrowdRows& rows, vector<Four>& v, double length, span<const uint8_t> marks, int sweeps) {
  marks_.assign(marks.begin(), marks.end());
  which_.resize(rows.parts.size());
  threads_.each(rows, [&](size_t p) { list_marked(rows, p); });
  for (int k = 0; k < sweeps; ++k) sweep(rows, v, length, [](size_t) {});
}

void CrowdSolver::scale(CrowdRows& rows, vector<Four>& v, const vector<Four>& free, double length) {
  vector<GuardSums> sums(rows.parts.size());
  threads_.each(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    sums[p] = kernels_.guard(rows.hot.data() + begin, end - begin, v.data(), free.data(), length);
  });
  const double gain = rows.sum([&](size_t p) { return sums[p].gain; });
  const double target = rows.sum([&](size_t p) { return sums[p].aim; });
  if (!(gain > 0)) return;

  const double factor = clamp(-target / gain, 0.0, greatest_scale);
  for (RowGroup& group : rows.hot)
    for (double& impulse : group.impulse) impulse *= factor;
  for (size_t i = 0; i < v.size(); ++i)
    for (int k = 0; k < 3; ++k) v[i].at[k] = free[i].at[k] + factor * (v[i].at[k] - free[i].at[k]);
}

}  // namespace carom
