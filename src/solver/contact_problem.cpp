// Frictionless contact by Gauss's principle of least constraint, island by island. Each island goes to the cheapest
// method, by an estimate of costs. An island without pressing contacts and one of a single contact need no method. The
// certificate shows where a method fails. The next one then follows.
#include "solver/contact_problem.h"

#include "numerics/disjoint_sets.h"
#include "solver/active_set.h"
#include "solver/contact_interior_point.h"
#include "solver/contact_island.h"
#include "solver/least_forces.h"
#include "std.h"

namespace carom {

namespace {

/// Contacts that share bodies, one island after the other. `fixed` things do not connect.
struct ContactIslands {
  vector<uint32_t> contacts;  // contacts, by island, ascending
  // The first contact of each island, and at the end the number of contacts.
  vector<uint32_t> first;

  void find(size_t bodies, span<const ContactConstraint> all) {
    DisjointSets sets(bodies);
    for (const ContactConstraint& c : all)
      if (c.b != ContactConstraint::fixed) sets.join(c.a, c.b);

    // A counting sort by root: first the number of contacts of each, then the position of the next one.
    next_.assign(bodies, 0);
    for (const ContactConstraint& c : all) ++next_[sets.root(c.a)];
    first.assign(1, 0);
    for (uint32_t& next : next_) {
      const uint32_t count = next;
      next = first.back();
      if (count > 0) first.push_back(next + count);
    }

    contacts.resize(all.size());
    for (uint32_t k = 0; k < all.size(); ++k) contacts[next_[sets.root(all[k].a)]++] = k;
  }

 private:
  vector<uint32_t> next_;  // by root
};

/// The last solution of an island.
struct CachedIsland {
  DualActiveSet method;
  vector<double> inverse_mass;
  vector<ContactIsland::Row> rows;  // with their forces
  vector<uint32_t> now;             // by row: its number in the present island, or DualActiveSet::gone()

  bool resembles(const ContactIsland& island);
};

/// Whether the last factors or forces are a start: the masses are the same, and few rows differ.
bool CachedIsland::resembles(const ContactIsland& island) {
  // One row in so many may differ.
  constexpr size_t few = 16;
  if (island.inverse_mass != inverse_mass || rows.empty()) return false;

  // The rows of the present island, by their bodies.
  const auto key = [](const ContactIsland::Row& r) { return uint64_t{r.a} << 32 | r.b; };
  vector<pair<uint64_t, uint32_t>> order;
  for (uint32_t c = 0; c < island.rows.size(); ++c) order.emplace_back(key(island.rows[c]), c);
  ranges::sort(order);

  // Each former row takes the first equal one that is not taken.
  now.assign(rows.size(), DualActiveSet::gone());
  vector<uint8_t> taken(island.rows.size(), 0);
  size_t found = 0;
  for (size_t k = 0; k < rows.size(); ++k) {
    const ContactIsland::Row& r = rows[k];
    auto it = std::lower_bound(order.begin(), order.end(), pair(key(r), uint32_t{0}));

    for (; it != order.end() && it->first == key(r); ++it) {
      const ContactIsland::Row& is = island.rows[it->second];
      if (taken[it->second] || is.bilateral != r.bilateral || is.left != r.left || is.right != r.right) continue;
      now[k] = it->second;
      taken[it->second] = 1;
      ++found;
      break;
    }
  }

  const size_t others = (rows.size() - found) + (island.rows.size() - found);
  return others <= 1 + rows.size() / few;
}

/// Solves a problem of one contact, by far the most common, in closed form. A second pass removes the rounding of the
/// first. False: the problem needs a method, and is unchanged.
bool solve_single(const ContactProblem& problem, ContactConstraint& c, Certificate& certificate) {
  const bool fixed = c.b == ContactConstraint::fixed;
  const Vec3 none = Vec3::Zero();
  const double of_a = problem.inverse_mass[c.a];
  const double of_b = fixed ? 0 : problem.inverse_mass[c.b];
  const double per_force = c.normal.squaredNorm() * (of_a + of_b);

  Vec3 a = problem.motion[c.a];
  Vec3 b = fixed ? none : problem.motion[c.b];
  const double target = c.target - c.surface;
  const double scale = std::abs(target) + (fixed ? 1 : 2) * max(a.norm(), b.norm());

  const auto excess = [&] { return c.normal.dot(b - a) - target; };
  double w = excess();
  double force = 0;
  if (c.bilateral || !(w >= 0))
    for (int pass = 0; pass < 2; ++pass) {
      const double more = -w / per_force;
      force += more;
      a -= of_a * more * c.normal;
      b += of_b * more * c.normal;
      w = excess();
    }

  // A change above the accepted one is left to a method.
  const double change = force == 0 ? 0 : std::abs(w) / scale;
  if (!(change <= accepted_change)) return false;

  certificate = {Certificate::Verdict::solved, change};
  c.force = c.independent = force;
  problem.motion[c.a] = a;
  if (!fixed) problem.motion[c.b] = b;
  return true;
}

/// Whether contact allows the free motion.
bool nothing_presses(const ContactProblem& problem, span<const uint32_t> contacts) {
  return all_of(contacts, [&](uint32_t k) {
    const ContactConstraint& c = problem.contacts[k];
    const Vec3 b = c.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : problem.motion[c.b];
    return !c.bilateral && c.normal.dot(b - problem.motion[c.a]) >= c.target - c.surface;
  });
}

/// The cost of an exact solution, in ns on one core. Only its ratio to other costs matters.
/// Orthogonal factors take three operations in unknowns for every row. Sparse ones take some thirty factorisations and
/// a set-up that finds their pattern.
class ExactCost {
 public:
  explicit ExactCost(const ContactIsland& island) : island_(island) {
    constexpr double rows_taken_in = 1.3, per_row = 1500, per_operation = 0.1;
    constexpr double per_entry_set_up = 300, per_entry = 60;
    const double n = double(island.unknowns()), m = double(island.rows.size());
    const double taken = min(m, n), rows = rows_taken_in * taken;
    dense_ = rows * (per_row + per_operation * 6 * n * (n - 0.5 * taken));
    least_sparse_ = (per_entry_set_up + factorisations * per_entry) * (n + m);
  }

  double dense() const { return dense_; }
  /// A lower bound of the sparse method's cost, for any fill of its factors.
  double least_sparse() const { return least_sparse_; }
  double sparse() {
    constexpr double per_operation = 0.35;
    return least_sparse_ + factorisations * per_operation * method().operations();
  }
  /// The sparse method, set up on first use.
  ContactInteriorPoint& method() {
    if (!method_) method_.emplace(island_);
    return *method_;
  }

 private:
  static constexpr double factorisations = 35;
  const ContactIsland& island_;
  optional<ContactInteriorPoint> method_;
  double dense_;         // ns
  double least_sparse_;  // ns
};

}  // namespace

struct ContactSolver::Workspace {
  map<uint32_t, CachedIsland> cached;  // by the lowest body of an island
  CachedIsland uncached;               // where nothing is kept
  ContactIslands islands;
  ContactIsland island;
  ContactSolution solution;
  ContactSolution attempt;
  vector<uint32_t> place;   // by body: its number in the island
  vector<uint32_t> bodies;  // by number in the island
  bool caches = true;
  bool by_factors = false;  // the last exact solution is that of an active set

  void take_island(const ContactProblem& problem, span<const uint32_t> contacts);
  void give_back(const ContactProblem& problem, span<const uint32_t> contacts) const;
  Certificate solve_exactly(ExactCost& cost, CachedIsland& last);
  Certificate solve_island(const ContactProblem& problem, span<const uint32_t> contacts);
  Certificate solve(const ContactProblem& problem);
};

void ContactSolver::Workspace::take_island(const ContactProblem& problem, span<const uint32_t> contacts) {
  island.inverse_mass.clear();
  island.free.clear();
  island.rows.clear();
  bodies.clear();

  // The bodies, in ascending order.
  for (const uint32_t c : contacts)
    for (const uint32_t body : {problem.contacts[c].a, problem.contacts[c].b})
      if (body != ContactConstraint::fixed && place[body] == ContactConstraint::fixed) {
        place[body] = 0;
        bodies.push_back(body);
      }
  ranges::sort(bodies);

  for (uint32_t k = 0; k < bodies.size(); ++k) {
    place[bodies[k]] = k;
    island.inverse_mass.push_back(problem.inverse_mass[bodies[k]]);
    island.free.push_back(problem.motion[bodies[k]]);
  }

  // The rows, with bodies by their number in the island.
  for (const uint32_t c : contacts) {
    const ContactConstraint& from = problem.contacts[c];
    ContactIsland::Row& row = island.rows.emplace_back();
    row.a = place[from.a];
    row.b = from.b == ContactConstraint::fixed ? from.b : place[from.b];
    row.bilateral = from.bilateral;
    row.normal = from.normal;
    row.target = from.target - from.surface;
    row.slack = from.bilateral ? from.slack : 0;
    row.force = from.bilateral ? 0 : max(from.force, 0.0);
  }

  for (const uint32_t body : bodies) place[body] = ContactConstraint::fixed;
  island.close_mass_gaps();
  island.scale();
}

/// A speed that contact leaves is zero if double-double precision does not resolve it.
void ContactSolver::Workspace::give_back(const ContactProblem& problem, span<const uint32_t> contacts) const {
  const double nothing = 0x1p-96 * island.speed;
  const PowerOfTwo unit(island.motion_exponent);
  const PowerOfTwo unit_of_force(island.motion_exponent - island.mass_exponent);

  for (size_t k = 0; k < bodies.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double u = solution.motion[3 * k + size_t(axis)].value();
      const bool stopped = std::abs(u) <= nothing && u != island.free[k][axis];
      problem.motion[bodies[k]][axis] = stopped ? 0 : unit * u;
    }

  const vector<int> exponents = island.force_exponents(solution.force);
  for (size_t k = 0; k < contacts.size(); ++k) {
    const double force = unit_of_force * solution.force[k].value();
    problem.contacts[contacts[k]].force = exponents.empty() ? force : std::ldexp(force, exponents[k]);
  }
}

/// Chooses a method: the cheaper one, or orthogonal factors where masses are too unequal for sparse ones. If one method
/// fails, the other follows, and then orthogonal factors from nothing.
Certificate ContactSolver::Workspace::solve_exactly(ExactCost& cost, CachedIsland& last) {
  // Solutions for which factors are reused: factors may cost so many times more.
  constexpr double worth_while = 8;
  Certificate best{Certificate::Verdict::doubtful, infinity};

  // Keeps the better solution. Returns whether it is accepted.
  const auto take = [&](const Judgement& judgement, bool infeasible) {
    if (solution.motion.empty() || judgement.within_slack || judgement.change < best.change) {
      std::swap(solution, attempt);
      best.change = judgement.change;
    }
    if (infeasible) best.verdict = Certificate::Verdict::infeasible;
    if (judgement.within_slack) best.verdict = Certificate::Verdict::solved;
    return judgement.within_slack;
  };

  by_factors = true;
  const auto by_active_set = [&] {
    const DualActiveSet::Result result = last.method.solve(island, attempt);
    return take(result.judgement, result.infeasible);
  };

  solution.motion.clear();
  // Where the island resembles the last one, its factors are the start, or else its forces.
  const bool alike = caches && last.resembles(island);
  if (alike && last.method.has_factors()) {
    const DualActiveSet::Result result = last.method.solve_again(island, last.now, attempt);
    if (take(result.judgement, result.infeasible)) return best;
  }
  if (alike)
    for (size_t k = 0; k < last.rows.size(); ++k)
      if (last.now[k] != DualActiveSet::gone() && !last.rows[k].bilateral)
        island.rows[last.now[k]].force = last.rows[k].force;

  // Orthogonal factors where they are cheaper, or where masses are too unequal.
  const bool unequal = island.mass_ratio > 1e6 && island.unknowns() <= 1500;
  const double times = alike ? worth_while : 1;
  const bool dense = unequal || cost.dense() <= times * cost.least_sparse() || cost.dense() <= times * cost.sparse();
  if (dense && by_active_set()) return best;

  // Sparse factors.
  last.method.clear();
  by_factors = false;
  if (take(cost.method().solve(attempt), false)) return best;
  // Orthogonal factors, from the forces of the best solution so far.
  for (size_t c = 0; c < island.rows.size(); ++c)
    island.rows[c].force = island.rows[c].bilateral ? 0 : max(solution.force[c].hi, 0.0);
  if (by_active_set()) return best;
  // Orthogonal factors from nothing.
  for (ContactIsland::Row& r : island.rows) r.force = 0;
  by_active_set();
  return best;
}

Certificate ContactSolver::Workspace::solve_island(const ContactProblem& problem, span<const uint32_t> contacts) {
  Certificate certificate;

  // An island without pressing contacts needs no method, and one of a single contact seldom does.
  if (nothing_presses(problem, contacts)) {
    for (const uint32_t c : contacts) problem.contacts[c].force = problem.contacts[c].independent = 0;
    return certificate;
  }
  if (contacts.size() == 1 && solve_single(problem, problem.contacts[contacts.front()], certificate))
    return certificate;

  take_island(problem, contacts);
  if (island.speed == 0) {
    for (const uint32_t c : contacts) problem.contacts[c].force = problem.contacts[c].independent = 0;
    return certificate;
  }

  CachedIsland& last = caches ? cached[bodies.front()] : uncached;
  ExactCost cost(island);
  certificate = solve_exactly(cost, last);
  // A later solution may start from this one.
  if (caches) {
    last.inverse_mass = island.inverse_mass;
    last.rows = island.rows;
    for (size_t c = 0; c < last.rows.size(); ++c) last.rows[c].force = solution.force[c].hi;
  }

  give_back(problem, contacts);
  for (const uint32_t c : contacts) problem.contacts[c].independent = problem.contacts[c].force;
  if (problem.least_forces && certificate.solved() && take_least_forces(island, solution, by_factors))
    give_back(problem, contacts);
  return certificate;
}

Certificate ContactSolver::Workspace::solve(const ContactProblem& problem) {
  Certificate all;
  place.resize(max(place.size(), problem.motion.size()), ContactConstraint::fixed);
  islands.find(problem.motion.size(), problem.contacts);
  for (size_t k = 0; k + 1 < islands.first.size(); ++k) {
    const size_t first = islands.first[k], count = islands.first[k + 1] - first;
    all.merge(solve_island(problem, span(islands.contacts).subspan(first, count)));
  }
  return all;
}

ContactSolver::ContactSolver() : workspace_(make_unique<Workspace>()) {}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;
ContactSolver& ContactSolver::operator=(ContactSolver&&) noexcept = default;

Certificate ContactSolver::solve(const ContactProblem& problem) {
  return workspace_->solve(problem);
}

Certificate solve(const ContactProblem& problem) {
  // The workspace keeps nothing of a problem except its memory.
  thread_local ContactSolver::Workspace room;
  room.caches = false;
  return room.solve(problem);
}

}  // namespace carom
