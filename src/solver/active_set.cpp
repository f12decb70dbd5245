// The dual active set method of Goldfarb & Idnani, Math. Programming 27 (1983) 1, on orthogonal factors that are
// updated row by row. It starts from a guess of the active rows. Each round appends the most violated row, and drops
// rows with a negative force. The solution is then refined with residuals in double-double, so that the factors'
// rounding does not limit it. Where a set of rows returns, the method ends with what it has. A looser or stricter limit
// for dependent rows is tried then.
#include "solver/active_set.h"

#include "std.h"

namespace carom {

namespace {

// A row of unit length with a smaller tail depends on the others, up to rounding.
constexpr double dependent = 0x1p-43;
// A share of the greatest force: a smaller negative force is only rounding.
constexpr double pulling = 8 * 0x1p-53;
// A share of a row's scale: the rounding of the data, where residuals are exact.
constexpr double refined_change = 4 * 0x1p-53;

/// Whether a bilateral row that is not active, which the active ones therefore determine, is off by no more than it may
/// be. w: by how much its scaled value exceeds its target.
bool contradicts_little(const ContactIsland::Row& r, double w) {
  return r.bilateral && std::abs(w) <= r.scale * r.slack;
}

}  // namespace

/// Stores Q^T of row c in row_.
void DualActiveSet::transform(const ContactIsland& island, uint32_t c) {
  const ContactIsland::Row& r = island.rows[c];
  const size_t at[2] = {3 * r.a, 3 * size_t(r.moves_b() ? r.b : 0)};
  const double values[6] = {-r.left.x(), -r.left.y(), -r.left.z(), r.right.x(), r.right.y(), r.right.z()};
  factors_.transform(at, values, r.moves_b() ? 2 : 1, row_.data());
}

/// Appends row c without a force. False: it depends on the others.
bool DualActiveSet::append(const ContactIsland& island, uint32_t c) {
  if (factors_.rank() == factors_.columns()) return false;
  transform(island, c);
  if (factors_.tail(row_.data()) <= dependent_) return false;
  factors_.append(row_.data());
  place_[c] = uint32_t(active_.size());
  active_.push_back(c);
  force_.push_back(0);
  fixed_.push_back(island.rows[c].bilateral);
  return true;
}

/// Removes the active row at `place`, and updates row_.
void DualActiveSet::drop(size_t place) {
  factors_.remove(place, row_.data());
  place_[active_[place]] = none;
  const auto at = ptrdiff_t(place);
  active_.erase(active_.begin() + at);
  force_.erase(force_.begin() + at);
  fixed_.erase(fixed_.begin() + at);
  for (size_t k = place; k < active_.size(); ++k) place_[active_[k]] = uint32_t(k);
}

/// Makes new factors, of the bilateral rows and then of these.
void DualActiveSet::rebuild(const ContactIsland& island, const vector<uint32_t>& rows) {
  factors_.reset(island.unknowns());
  active_.clear();
  force_.clear();
  fixed_.clear();
  place_.assign(island.rows.size(), none);
  if (!island.unilateral)
    for (uint32_t c = 0; c < island.rows.size(); ++c)
      if (island.rows[c].bilateral) append(island, c);
  for (const uint32_t c : rows)
    if (place_[c] == none) append(island, c);
}

/// Computes the motion that satisfies the active rows exactly, and their forces.
void DualActiveSet::balance(const ContactIsland& island) {
  const size_t k = active_.size();
  ranges::fill(step_, 0.0);
  for (size_t j = 0; j < k; ++j) {
    const ContactIsland::Row& r = island.rows[active_[j]];
    step_[j] = r.scale * r.target - r.dot(free_.data());
  }
  factors_.solve_transposed(step_.data());
  factors_.from_q(step_.data(), y_.data());
  for (size_t i = 0; i < y_.size(); ++i) y_[i] += free_[i];
  factors_.solve(step_.data());
  std::copy(step_.begin(), step_.begin() + ptrdiff_t(k), force_.begin());
}

/// Returns to the motion of the active rows, without those that pull.
void DualActiveSet::settle(const ContactIsland& island) {
  do balance(island);
  while (drop_one_that_pulls(0));
}

/// Removes the row that pulls most, if one does.
bool DualActiveSet::drop_one_that_pulls(double tolerance) {
  double greatest = 0, least = 0;
  size_t which = none;
  for (size_t k = 0; k < active_.size(); ++k) {
    greatest = max(greatest, std::abs(force_[k]));
    if (!fixed_[k] && force_[k] < least) {
      least = force_[k];
      which = k;
    }
  }
  if (which == none || !(least < -tolerance * greatest)) return false;
  drop(which);
  return true;
}

/// The growth of row_'s force at which the first active row loses its force, and that row.
double DualActiveSet::blocking(size_t& first) const {
  double most = infinity;
  for (size_t k = 0; k < active_.size(); ++k)
    if (!fixed_[k] && step_[k] > 0 && force_[k] < most * step_[k]) {
      most = force_[k] / step_[k];
      first = k;
    }
  return most;
}

/// Appends row c, which is violated by `shortfall`: its force grows until it is satisfied. False: that is impossible.
bool DualActiveSet::activate(const ContactIsland& island, uint32_t c, double shortfall) {
  double force = 0;
  transform(island, c);

  for (;;) {
    const bool full = factors_.rank() == factors_.columns();
    const double tail = full ? 0 : factors_.tail(row_.data());
    const bool free = tail > dependent_;

    // The change of the active rows' forces for each unit of this one's.
    std::copy(row_.begin(), row_.begin() + ptrdiff_t(active_.size()), step_.begin());
    factors_.solve(step_.data());

    // The force grows until the row is satisfied, or until an active row loses its force.
    size_t first = none;
    const double most = blocking(first);
    const double enough = free ? max(shortfall, 0.0) / (tail * tail) : infinity;
    if (!free && first == none) return false;
    const double step = min(most, enough);

    // The active rows' forces and the motion change with it.
    for (size_t k = 0; k < active_.size(); ++k) {
      force_[k] -= step * step_[k];
      if (!fixed_[k]) force_[k] = max(force_[k], 0.0);
    }
    force += step;
    if (free) {
      factors_.tail_direction(row_.data(), work_.data());
      for (size_t i = 0; i < y_.size(); ++i) y_[i] += step * work_[i];
      shortfall -= step * tail * tail;
    }

    // The row is satisfied, and becomes active.
    if (enough <= most) {
      factors_.append(row_.data());
      place_[c] = uint32_t(active_.size());
      active_.push_back(c);
      force_.push_back(force);
      fixed_.push_back(0);
      return true;
    }

    // A value is not finite.
    if (first == none) return false;
    drop(first);
  }
}

/// Appends rows until none is violated by more than rounding. The solution's energy grows with every row.
/// If it does not for as many steps as there are rows, only rounding is left.
void DualActiveSet::take_in_violated(const ContactIsland& island) {
  double energy = 0;
  size_t idle = 0;
  // By body: the sum of the speeds that single forces give it.
  vector<double>& load = load_;
  load.resize(island.free.size());

  for (;;) {
    ranges::fill(load, 0.0);
    for (size_t k = 0; k < active_.size(); ++k) {
      const ContactIsland::Row& r = island.rows[active_[k]];
      load[r.a] += std::abs(force_[k]) * r.scale * island.inverse_mass[r.a];
      if (r.moves_b()) load[r.b] += std::abs(force_[k]) * r.scale * island.inverse_mass[r.b];
    }

    // Finds the row that is violated most, by more than rounding.
    uint32_t worst = none;
    double least = 0;
    for (uint32_t c = 0; c < island.rows.size(); ++c) {
      if (place_[c] != none || aside_[c]) continue;
      const ContactIsland::Row& r = island.rows[c];
      const double w = r.dot(y_.data()) - r.scale * r.target;
      if (!(w < least) || contradicts_little(r, w)) continue;
      const double noise = island.noise_scale(r) + r.scale * (load[r.a] + (r.moves_b() ? load[r.b] : 0));
      if (w >= -accepted_change * noise) continue;
      least = w;
      worst = c;
    }

    if (worst == none) return;
    // A row that cannot be satisfied is set aside.
    if (!activate(island, worst, -least)) {
      aside_[worst] = 1;
      settle(island);
      continue;
    }

    // A lower bound, for rows of unit length.
    const double more = 0.5 * least * least;
    idle = more > 0x1p-50 * energy ? 0 : idle + 1;
    energy += more;
    if (idle > island.rows.size()) return;
  }
}

/// Newton's method on the active rows (iterative refinement): the factors are rounded, the residuals are not.
void DualActiveSet::refine(const ContactIsland& island, ContactSolution& solution) {
  const size_t n = island.unknowns();
  const size_t k = active_.size();
  solution.motion.resize(n);
  solution.force.assign(island.rows.size(), DoubleDouble{0, 0});

  // Without active rows the motion is the free one.
  if (k == 0) {
    for (size_t i = 0; i < n; ++i) solution.motion[i] = {island.free[i / 3][int(i % 3)], 0};
    y_ = free_;
    return;
  }

  // The start is the solution in double precision.
  for (size_t i = 0; i < n; ++i) solution.motion[i] = {island.root[i / 3] * y_[i], 0};
  for (size_t j = 0; j < k; ++j) solution.force[active_[j]] = {island.rows[active_[j]].scale * force_[j], 0};
  double all = 0;
  for (const double y : y_) all = max(all, std::abs(y));

  // The rows' errors and the imbalance of forces. Each is reduced as long as it at least halves.
  double off = infinity;
  double unbalanced = infinity;
  vector<double>& p = row_;
  vector<double>& g = step_;
  vector<double>& dy = work_;
  const auto greatest = [](const vector<double>& v) {
    double most = 0;
    for (const double x : v) most = max(most, std::abs(x));
    return most;
  };

  // A pass leaves the share of an error that the factors' rounding makes. Where that is small enough, no further pass
  // is needed.
  const double left = 0x1p-50 / (factors_.least_diagonal() * factors_.least_diagonal());
  const double enough = 0x1p-92 * all;
  while (off > 0 || unbalanced > 0) {
    ranges::fill(g, 0.0);
    ranges::fill(p, 0.0);

    // The correction that removes the rows' errors.
    if (off > 0) {
      for (size_t j = 0; j < k; ++j) {
        const ContactIsland::Row& r = island.rows[active_[j]];
        g[j] = -r.scale * excess(r, solution.motion);
      }
      factors_.solve_transposed(g.data());
      const double now = greatest(g);
      if (!(now < 0.5 * off)) ranges::fill(g, 0.0);
      off = now < 0.5 * off && left * now > enough ? now : 0;
    }

    // The correction that removes the imbalance of forces.
    if (unbalanced > 0) {
      find_imbalance(island, solution);
      vector<double>& lacking = solution.lacking;
      for (size_t i = 0; i < n; ++i) lacking[i] /= island.root[i / 3];
      const double now = greatest(lacking);
      if (now < 0.5 * unbalanced) factors_.to_q(lacking.data(), p.data());
      unbalanced = now < 0.5 * unbalanced && left * now > enough ? now : 0;
    }

    // Both corrections together, for the motion and for the forces.
    std::copy(p.begin() + ptrdiff_t(k), p.end(), g.begin() + ptrdiff_t(k));
    factors_.from_q(g.data(), dy.data());
    for (size_t j = 0; j < k; ++j) g[j] -= p[j];
    factors_.solve(g.data());
    for (size_t i = 0; i < n; ++i)
      solution.motion[i] = solution.motion[i] + DoubleDouble{island.root[i / 3] * dy[i], 0};
    for (size_t j = 0; j < k; ++j) {
      DoubleDouble& x = solution.force[active_[j]];
      x = x + DoubleDouble{island.rows[active_[j]].scale * g[j], 0};
    }
  }

  // The refined values, in double precision.
  for (size_t i = 0; i < n; ++i) y_[i] = solution.motion[i].hi / island.root[i / 3];
  for (size_t j = 0; j < k; ++j) force_[j] = solution.force[active_[j]].hi / island.rows[active_[j]].scale;
}

/// The inactive row that is violated most, by more than the rounding of the data.
uint32_t DualActiveSet::worst_after_refining(const ContactIsland& island, const ContactSolution& solution,
                                             double& shortfall) const {
  uint32_t worst = none;
  shortfall = 0;

  for (uint32_t c = 0; c < island.rows.size(); ++c) {
    if (place_[c] != none || aside_[c] > 1) continue;
    const ContactIsland::Row& r = island.rows[c];

    // Surely satisfied.
    if (r.dot(y_.data()) - r.scale * r.target > 0x1p-40 * island.noise_scale(r)) continue;
    const double w = r.scale * excess(r, solution.motion);
    if (w >= -shortfall || w >= -refined_change * island.noise_scale(r) || contradicts_little(r, w)) continue;
    shortfall = -w;
    worst = c;
  }
  return worst;
}

/// A hash of the set of active rows, independent of their order.
uint64_t DualActiveSet::signature() const {
  uint64_t sum = active_.size();
  for (const uint32_t c : active_) {
    uint64_t x = c + 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    sum += x ^ x >> 31;
  }
  return sum;
}

/// Appends, removes and refines until nothing is left to do, or a set of rows returns.
void DualActiveSet::run(const ContactIsland& island, ContactSolution& solution) {
  vector<uint64_t> seen;
  infeasible_ = false;
  ranges::fill(aside_, 0);
  settle(island);
  take_in_violated(island);

  for (;;) {
    refine(island, solution);
    double shortfall = 0;

    // A row that pulls is removed first.
    if (drop_one_that_pulls(pulling)) {
      const uint64_t now = signature();
      if (contains(seen, now)) return;
      seen.push_back(now);
      settle(island);
      take_in_violated(island);
      continue;
    }

    // Then the row that is violated most becomes active.
    const uint32_t worst = worst_after_refining(island, solution, shortfall);
    if (worst == none) return;
    // A row that cannot be satisfied is set aside.
    if (!activate(island, worst, shortfall)) {
      infeasible_ = true;
      aside_[worst] = 2;
      settle(island);
      take_in_violated(island);
      continue;
    }

    // The method ends where a set of active rows returns.
    const uint64_t now = signature();
    if (contains(seen, now)) return;
    seen.push_back(now);
  }
}

void DualActiveSet::prepare(const ContactIsland& island) {
  const size_t n = island.unknowns();
  dependent_ = dependent;
  for (vector<double>* v : {&y_, &free_, &row_, &step_, &work_}) v->assign(n, 0.0);
  for (size_t i = 0; i < n; ++i) free_[i] = island.free[i / 3][int(i % 3)] / island.root[i / 3];
  aside_.assign(island.rows.size(), 0);
}

DualActiveSet::Result DualActiveSet::solve(const ContactIsland& island, ContactSolution& solution) {
  prepare(island);
  vector<uint32_t> rows;
  for (uint32_t c = 0; c < island.rows.size(); ++c)
    if (island.rows[c].force > 0 && !island.rows[c].bilateral) rows.push_back(c);
  ranges::sort(rows, [&](uint32_t p, uint32_t q) {
    const double fp = island.rows[p].force / island.rows[p].scale, fq = island.rows[q].force / island.rows[q].scale;
    return fp != fq ? fp > fq : p < q;
  });
  rebuild(island, rows);
  return finish(island, solution);
}

DualActiveSet::Result DualActiveSet::solve_again(const ContactIsland& island, span<const uint32_t> now,
                                                 ContactSolution& solution) {
  prepare(island);

  // Active rows that no longer exist are removed.
  for (size_t k = active_.size(); k-- > 0;) {
    active_[k] = now[active_[k]];
    if (active_[k] != none) continue;
    factors_.remove(k, row_.data());
    active_.erase(active_.begin() + ptrdiff_t(k));
  }

  // The others stay active, with their factors and without forces.
  force_.assign(active_.size(), 0);
  fixed_.resize(active_.size());
  place_.assign(island.rows.size(), none);
  for (size_t k = 0; k < active_.size(); ++k) {
    place_[active_[k]] = uint32_t(k);
    fixed_[k] = island.rows[active_[k]].bilateral;
  }

  // New bilateral rows become active.
  for (uint32_t c = 0; c < island.rows.size(); ++c)
    if (island.rows[c].bilateral && place_[c] == none) append(island, c);
  return finish(island, solution);
}

/// Solves from the active rows. If need be it repeats that with other limits for dependent rows.
DualActiveSet::Result DualActiveSet::finish(const ContactIsland& island, ContactSolution& solution) {
  Result best;
  best.judgement = {infinity, false};
  ContactSolution& attempt = attempt_;

  for (const double looser : {1.0, 32.0, 1.0 / 16, 1024.0}) {
    // Later attempts start from the active rows, the strongest first.
    if (looser != 1) {
      dependent_ = looser * dependent;
      vector<uint32_t> rows(active_);
      ranges::sort(rows, [&](uint32_t p, uint32_t q) {
        const double fp = solution.force[p].hi / island.rows[p].scale;
        const double fq = solution.force[q].hi / island.rows[q].scale;
        return fp != fq ? fp > fq : p < q;
      });
      rebuild(island, rows);
    }

    run(island, attempt);
    // These are negative by rounding alone.
    for (size_t c = 0; c < island.rows.size(); ++c)
      if (!island.rows[c].bilateral && attempt.force[c].hi < 0) attempt.force[c] = {0, 0};

    const Result result{judge(island, attempt), infeasible_};
    if (looser == 1 || result.judgement.change < best.judgement.change) {
      best = result;
      std::swap(solution, attempt);
    }
    if (best.judgement.within_slack) break;
  }

  best.infeasible = best.infeasible && !best.judgement.within_slack;
  return best;
}

}  // namespace carom
