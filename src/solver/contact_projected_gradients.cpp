// MPRGP (Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23): conjugate gradients on the rows that press, projected
// steps elsewhere. The matrix is never formed. A product with it goes over the rows twice: forces to bodies, and
// bodies' motion to rows. Four rows are side by side in vectors of four doubles. Sums have one order, so that the bits
// do not depend on the vector width of the processor. Sweeps from row to row (projected Gauss-Seidel) make no progress
// in an island that is nearly at rest.
#include "solver/contact_projected_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>

// gcc defines __SANITIZE_ADDRESS__; clang answers __has_feature.
#if defined(__SANITIZE_ADDRESS__)
#define CAROM_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAROM_SANITIZED
#endif
#endif

// The same arithmetic in vectors of 2 or of 4, as the processor has them. The choice happens before a sanitizer is
// ready.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(CAROM_SANITIZED)
#define CAROM_FOR_ALL_PROCESSORS __attribute__((target_clones("avx2", "default")))
#else
#define CAROM_FOR_ALL_PROCESSORS
#endif

namespace carom {

namespace {

inline __attribute__((always_inline)) double sum(const auto& four) {
  return (four[0] + four[1]) + (four[2] + four[3]);
}

}  // namespace

/// Adds the forces x of the four rows to those on their bodies.
inline __attribute__((always_inline)) void ContactProjectedGradients::push(const Rows& rows, const Four& x,
                                                                           Motion* moved) {
  const Four zero{};
  const Four px = x * rows.normal[0], py = x * rows.normal[1], pz = x * rows.normal[2];
  // Transposed: from axes to rows.
  const Four xy_even = __builtin_shufflevector(px, py, 0, 4, 2, 6);
  const Four xy_odd = __builtin_shufflevector(px, py, 1, 5, 3, 7);
  const Four z_even = __builtin_shufflevector(pz, zero, 0, 4, 2, 6);
  const Four z_odd = __builtin_shufflevector(pz, zero, 1, 5, 3, 7);
  const Four p0 = __builtin_shufflevector(xy_even, z_even, 0, 1, 4, 5);
  const Four p1 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 4, 5);
  const Four p2 = __builtin_shufflevector(xy_even, z_even, 2, 3, 6, 7);
  const Four p3 = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 6, 7);
  // One after the other, because they may share bodies.
  moved[rows.a[0]].u -= p0;
  moved[rows.b[0]].u += p0;
  moved[rows.a[1]].u -= p1;
  moved[rows.b[1]].u += p1;
  moved[rows.a[2]].u -= p2;
  moved[rows.b[2]].u += p2;
  moved[rows.a[3]].u -= p3;
  moved[rows.b[3]].u += p3;
}

/// The motion of the bodies along the four rows of unit length.
inline __attribute__((always_inline)) void ContactProjectedGradients::find_rate(const Rows& rows, const Motion* moved,
                                                                                Four& rate) {
  const Four w0 = moved[rows.b[0]].u - moved[rows.a[0]].u, w1 = moved[rows.b[1]].u - moved[rows.a[1]].u;
  const Four w2 = moved[rows.b[2]].u - moved[rows.a[2]].u, w3 = moved[rows.b[3]].u - moved[rows.a[3]].u;
  // Transposed: from rows to axes.
  const Four low01 = __builtin_shufflevector(w0, w1, 0, 4, 2, 6);
  const Four low23 = __builtin_shufflevector(w2, w3, 0, 4, 2, 6);
  const Four high01 = __builtin_shufflevector(w0, w1, 1, 5, 3, 7);
  const Four high23 = __builtin_shufflevector(w2, w3, 1, 5, 3, 7);
  const Four x = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  const Four y = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  const Four z = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  rate = rows.normal[0] * x + rows.normal[1] * y + rows.normal[2] * z;
}

/// Turns forces on bodies into the bodies' motion.
inline __attribute__((always_inline)) void divide_by_mass(const double* inverse_mass, auto* moved, std::size_t bodies) {
  for (std::size_t k = 0; k < bodies; ++k) moved[k].u *= inverse_mass[k];
}

/// The motion of every body under the next forces.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::move_next(const Rows* rows, const Next* next, std::size_t count,
                                          const double* inverse_mass, Motion* moved, std::size_t bodies) {
  std::fill(moved, moved + bodies, Motion{});
  for (std::size_t k = 0; k < count; ++k) push(rows[k], next[k].x, moved);
  divide_by_mass(inverse_mass, moved, bodies);
}

/// The direction for rows that must press and do not, and the motion of every body along it.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::chop(const Rows* rows, Forces* forces, std::size_t count, const double* inverse_mass,
                                     Motion* turned, std::size_t bodies, Sums& sums) {
  const Four zero{};
  Four gp{}, square{};
  std::fill(turned, turned + bodies, Motion{});
  for (std::size_t k = 0; k < count; ++k) {
    Forces& f = forces[k];
    f.direction = f.x > zero || f.g > zero ? zero : f.g;
    gp += f.g * f.direction;
    square += f.direction * f.direction;
    push(rows[k], f.direction, turned);
  }
  divide_by_mass(inverse_mass, turned, bodies);
  sums.gp = sum(gp);
  sums.square = sum(square);
}

/// The image of the direction in the rows, from the bodies' motion.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::find_image(const Rows* rows, Forces* forces, std::size_t count, const Motion* turned,
                                           Sums& sums) {
  Four pap{};
  for (std::size_t k = 0; k < count; ++k) {
    Forces& f = forces[k];
    find_rate(rows[k], turned, f.image);
    pap += f.direction * f.image;
  }
  sums.pap = sum(pap);
}

/// The forces after this step, and their gradient.
inline __attribute__((always_inline)) void ContactProjectedGradients::reach(const Forces& f, double step, double least,
                                                                            Next& next) {
  const Four zero{};
  const Four x = f.x - step * f.direction, g = f.g - step * f.image;
  next.x = (x < zero ? -x : x) < least ? zero : x;
  next.g = (g < zero ? -g : g) < least ? zero : g;
}

/// Whether the step keeps all bounds, and the sums for the next direction.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::try_step(const Forces* forces, std::size_t count, double step, double least,
                                         Sums& sums) {
  const Four zero{};
  Four lowest{}, turn{};
  for (std::size_t k = 0; k < count; ++k) {
    Next next;
    reach(forces[k], step, least, next);
    lowest = next.x < lowest ? next.x : lowest;
    turn += next.x > zero ? next.g * forces[k].image : zero;
  }
  sums.feasible = !(std::min(std::min(lowest[0], lowest[1]), std::min(lowest[2], lowest[3])) < 0);
  sums.turn = sum(turn);
}

struct ContactProjectedGradients::Parts {
  Four square{}, gp{}, reduced{}, chopped{}, potential{}, beyond{};
  void add_up(Sums& sums) const {
    sums.square = sum(square);
    sums.gp = sum(gp);
    sums.reduced = sum(reduced);
    sums.chopped = sum(chopped);
    sums.potential = sum(potential);
    sums.within_slack = sum(beyond) == 0;
  }
};

/// Takes the next forces, and sets the direction of the conjugate gradients on the face of the rows that press.
/// It is g less `turn` times the last direction.
inline __attribute__((always_inline)) void ContactProjectedGradients::take(const Rows& rows, Forces& f,
                                                                           const Next& next, double turn,
                                                                           double per_step, double least,
                                                                           Motion* turned, Parts& parts) {
  const Four zero{};
  const Four x = next.x, g = next.g;
  f.x = x;
  f.g = g;
  Four p = x > zero ? g : zero;
  if (turn != 0) p -= turn * f.direction;
  p = (p < zero ? -p : p) < least ? zero : p;
  f.direction = p;
  push(rows, p, turned);
  parts.square += p * p;
  parts.gp += g * p;
  const Four limited = x * per_step < g ? x * per_step : g, pull = g < zero ? g : zero;
  parts.reduced += x > zero ? limited * g : zero;
  parts.chopped += x > zero ? zero : pull * pull;
  parts.potential += x * (g + f.constant);
  // A row that presses falls short, or presses while it parts.
  const Four least_of = x < g ? x : g, part = g >= zero ? zero : -g;
  const Four off = x > zero ? (least_of < zero ? -least_of : least_of) : part;
  // This catches values that are not finite too.
  parts.beyond = off <= f.slack ? parts.beyond : zero + 1;
}

/// Takes the next forces, or without them those after this step. The new direction is conjugate to the last one, or the
/// gradient where turn is 0. Computes the motion of every body along it.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::take_all(const Rows* rows, Forces* forces, const Next* next, std::size_t count,
                                         double step, double turn, double per_step, double least,
                                         const double* inverse_mass, Motion* turned, std::size_t bodies, Sums& sums) {
  Parts parts;
  std::fill(turned, turned + bodies, Motion{});
  for (std::size_t k = 0; k < count; ++k) {
    Next here;
    if (next)
      here = next[k];
    else
      reach(forces[k], step, least, here);
    take(rows[k], forces[k], here, turn, per_step, least, turned, parts);
  }
  divide_by_mass(inverse_mass, turned, bodies);
  parts.add_up(sums);
}

/// The next forces: those after this step, projected onto their bounds. Returns the step along the direction to the
/// first bound.
CAROM_FOR_ALL_PROCESSORS
double ContactProjectedGradients::project(const Forces* forces, Next* next, std::size_t count, double step,
                                          double least) {
  const Four zero{};
  Four lowest = zero + std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const Forces& f = forces[k];
    reach(f, step, least, next[k]);
    const Four x = next[k].x, until = x < zero ? f.x / f.direction : lowest;
    lowest = until < lowest ? until : lowest;
    next[k].x = x > zero ? x : zero;
  }
  return std::min(std::min(lowest[0], lowest[1]), std::min(lowest[2], lowest[3]));
}

/// Goes along the direction to the first bound, and from there by this step along the projected gradient.
CAROM_FOR_ALL_PROCESSORS
void ContactProjectedGradients::bend(const Forces* forces, Next* next, std::size_t count, double first, double step) {
  const Four zero{};
  for (std::size_t k = 0; k < count; ++k) {
    const Forces& f = forces[k];
    const Four there = f.x - first * f.direction, slope = f.x > zero ? f.g - first * f.image : zero;
    const Four x = (there > zero ? there : zero) - step * slope;
    next[k].x = x > zero ? x : zero;
  }
}

void ContactProjectedGradients::take_rows() {
  const ContactIsland& island = *island_;
  const auto immovable = static_cast<std::uint32_t>(island.free.size());
  const std::size_t count = (island.rows.size() + width - 1) / width;
  Rows none{};
  std::fill(std::begin(none.a), std::end(none.a), immovable);
  std::fill(std::begin(none.b), std::end(none.b), immovable);
  rows_.assign(count, none);
  forces_.assign(count, Forces{});
  next_.assign(count, Next{});
  inverse_mass_ = island.inverse_mass;
  inverse_mass_.push_back(0);
  moved_.resize(inverse_mass_.size());
  turned_.resize(inverse_mass_.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < island.rows.size(); ++c) {
    const ContactIsland::Row& r = island.rows[c];
    const auto [four, lane] = place(c);
    Rows& rows = rows_[four];
    Forces& forces = forces_[four];
    for (int axis = 0; axis < 3; ++axis) rows.normal[axis][lane] = r.scale * r.normal[axis];
    rows.a[lane] = r.a;
    rows.b[lane] = r.moves_b() ? r.b : immovable;
    const Vec3 w = r.moves_b() ? Vec3(island.free[r.b] - island.free[r.a]) : Vec3(-island.free[r.a]);
    const double slack = r.scale * r.slack;
    next_[four].x[lane] = r.force / r.scale;
    forces.constant[lane] = r.scale * (r.normal.dot(w) - r.target);
    forces.slack[lane] = slack;
    least = std::min(least, slack);
  }
  slack_energy_ = least * least * static_cast<double>(island.rows.size());
}

/// An upper bound of the greatest eigenvalue of A, from the rows that share a body (Gershgorin's discs, |n . n'| <= 1).
double ContactProjectedGradients::norm() {
  std::fill(moved_.begin(), moved_.end(), Motion{});
  const ContactIsland& island = *island_;
  for (const ContactIsland::Row& r : island.rows) {
    moved_[r.a].u[0] += r.scale;
    if (r.moves_b()) moved_[r.b].u[0] += r.scale;
  }
  double most = 0;
  for (const ContactIsland::Row& r : island.rows) {
    double sum = island.inverse_mass[r.a] * moved_[r.a].u[0];
    if (r.moves_b()) sum += island.inverse_mass[r.b] * moved_[r.b].u[0];
    most = std::max(most, r.scale * sum);
  }
  return most;
}

/// Computes the gradient of the next forces. Returns twice their potential.
double ContactProjectedGradients::find_next_gradient() {
  move_next(rows_.data(), next_.data(), next_.size(), inverse_mass_.data(), moved_.data(), moved_.size());
  Four potential{};
  for (std::size_t k = 0; k < next_.size(); ++k) {
    Next& next = next_[k];
    find_rate(rows_[k], moved_.data(), next.g);
    next.g += forces_[k].constant;
    potential += next.x * (next.g + forces_[k].constant);
  }
  ++products_;
  return sum(potential);
}

void ContactProjectedGradients::start(const ContactIsland& island) {
  island_ = &island;
  products_ = reach_ = 0;
  take_rows();
  step_ = 1.9 / norm();
  // Values that have decayed this far are set to zero. Their squares would underflow, and other units would give other
  // bits.
  Four most{};
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Four constant = forces_[k].constant, size = constant < Four{} ? -constant : constant;
    most = size > most ? size : most;
    most = next_[k].x > most ? next_[k].x : most;
  }
  least_ = 0x1p-200 * std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  find_next_gradient();
  scale_next(0);
  begin();
  fresh_ = true;
  potential_.assign(1, sums_.potential);
}

/// Whether forces x have an effect on bodies beyond rounding, by x A x and x x. Some forces press against each other
/// and have none.
bool ContactProjectedGradients::moves_bodies(double xax, double xx) const {
  return xax * step_ > 0x1p-46 * xx;
}

/// Multiplies the next forces by the factor of least potential, which is not above that without forces. The factor is
/// `else_by` if they have no effect.
void ContactProjectedGradients::scale_next(double else_by) {
  Four quadratic{}, linear{}, square{};
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Four &x = next_[k].x, &constant = forces_[k].constant;
    quadratic += x * (next_[k].g - constant);
    linear += x * constant;
    square += x * x;
  }
  const double xax = sum(quadratic), cx = sum(linear), xx = sum(square);
  const double factor = moves_bodies(xax, xx) ? std::max(-cx / xax, 0.0) : else_by;
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Four& constant = forces_[k].constant;
    next_[k].g = factor * (next_[k].g - constant) + constant;
    next_[k].x *= factor;
  }
  for (Motion& m : moved_) m.u *= factor;
}

/// Takes the next forces with their gradient. The gradient is the new direction.
void ContactProjectedGradients::begin() {
  take_all(rows_.data(), forces_.data(), next_.data(), forces_.size(), 0, 0, 1 / step_, least_, inverse_mass_.data(),
           turned_.data(), turned_.size(), sums_);
}

/// One step: along the face of the rows that press, onto its bound, or with rows that must press.
/// False: only rounding is left, or no motion satisfies all rows.
bool ContactProjectedGradients::iterate() {
  fresh_ = false;
  const bool on_face = sums_.chopped <= sums_.reduced;
  if (!on_face)
    chop(rows_.data(), forces_.data(), forces_.size(), inverse_mass_.data(), turned_.data(), turned_.size(), sums_);
  find_image(rows_.data(), forces_.data(), forces_.size(), turned_.data(), sums_);
  ++products_;
  if (!moves_bodies(sums_.pap, sums_.square)) return false;
  const double step = sums_.gp / sums_.pap;
  try_step(forces_.data(), forces_.size(), step, least_, sums_);
  if (!sums_.feasible && on_face)
    go_on_at_bounds(step);
  else
    take_all(rows_.data(), forces_.data(), nullptr, forces_.size(), step, on_face ? sums_.turn / sums_.pap : 0,
             1 / step_, least_, inverse_mass_.data(), turned_.data(), turned_.size(), sums_);
  return true;
}

/// Continues in the same direction past the bounds and projects onto them, if that is better than a stop at the first
/// bound. Otherwise it goes from there along the projected gradient, as far as gain is certain. (Kruzik, Horak, Cermak,
/// Pospisil & Pecha, Adv. Eng. Softw. 149 (2020) 102895.)
void ContactProjectedGradients::go_on_at_bounds(double step) {
  const double first = project(forces_.data(), next_.data(), forces_.size(), step, least_);
  const double at_first = sums_.potential - first * (2 * sums_.gp - first * sums_.pap);
  if (!(find_next_gradient() <= at_first)) {
    bend(forces_.data(), next_.data(), forces_.size(), first, step_);
    find_next_gradient();
  }
  begin();
}

/// The cost of products with the matrix and of the work that goes with them, in ns, as ExactCost.
double ContactProjectedGradients::cost() const {
  constexpr double per_four_rows = 18, per_product = 25;
  return static_cast<double>(products_) * (per_four_rows * static_cast<double>(rows_.size()) + per_product);
}

/// Whether the second half of all iterations gained no more than the slack's energy.
/// It is tested only after as many iterations as a force needs to get from any row to any other.
bool ContactProjectedGradients::gains_little() {
  const std::size_t now = potential_.size() - 1;
  if (now == 0 || !(potential_[now / 2] - potential_[now] <= slack_energy_)) return false;
  if (reach_ == 0) reach_ = std::max<std::size_t>(island_->reach(), 1);
  return now >= reach_;
}

/// Recomputes the gradient, because the one that steps have updated is rounded. What remains of it does no work.
/// For that, all forces change by one factor, that of least potential.
void ContactProjectedGradients::renew() {
  for (std::size_t k = 0; k < forces_.size(); ++k) next_[k].x = forces_[k].x;
  find_next_gradient();
  scale_next(1);
  begin();
  fresh_ = true;
}

bool ContactProjectedGradients::run(ContactAccuracy accuracy, double most_cost) {
  for (;;) {
    if (sums_.within_slack) {
      if (fresh_) return true;
      renew();
      continue;
    }
    if (cost() >= most_cost || !iterate()) return false;
    potential_.push_back(sums_.potential);
    if (accuracy == ContactAccuracy::energy && gains_little()) {
      renew();
      return true;
    }
  }
}

void ContactProjectedGradients::guess(ContactIsland& island) const {
  for (std::size_t c = 0; c < island.rows.size(); ++c)
    island.rows[c].force = island.rows[c].scale * forces_[place(c).four].x[place(c).lane];
}

double ContactProjectedGradients::finish(ContactSolution& solution) const {
  const ContactIsland& island = *island_;
  solution.motion.resize(island.unknowns());
  solution.force.resize(island.rows.size());
  for (std::size_t k = 0; k < island.free.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      solution.motion[3 * k + axis] = two_sum(island.free[k][static_cast<int>(axis)], moved_[k].u[axis]);
  double change = 0;
  for (std::size_t c = 0; c < island.rows.size(); ++c) {
    const ContactIsland::Row& r = island.rows[c];
    const auto [four, lane] = place(c);
    const double x = forces_[four].x[lane], g = forces_[four].g[lane];
    solution.force[c] = {r.scale * x, 0};
    const double off = x > 0 ? std::abs(g) : std::max(-g, 0.0);
    if (off > 0) change = std::max(change, off / island.noise_scale(r));
  }
  return change;
}

}  // namespace carom
