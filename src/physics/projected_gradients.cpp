#include "physics/projected_gradients.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// The problem in scaled unknowns x_c = p_c sqrt(A_cc), for which the matrix has a unit diagonal: bodies of any masses
/// weigh alike. The matrix is never formed: A x is what impulses x do to the pairs' relative motion. Fixed things are
/// one more body, which nothing moves.
class Scaled {
 public:
  Scaled(std::span<const double> inverse_mass, std::span<const ContactConstraint> pairs)
      : rows_(pairs.size()), moved_(inverse_mass.size() + 1) {
    const auto nobody = static_cast<std::uint32_t>(inverse_mass.size());
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const ContactConstraint& pair = pairs[c];
      const bool fixed = pair.b == ContactConstraint::fixed;
      const double of_a = inverse_mass[pair.a], of_b = fixed ? 0 : inverse_mass[pair.b];
      const double scale = 1 / std::sqrt(of_a + of_b);
      rows_[c] = {pair.normal, scale, scale * of_a, scale * of_b, pair.a, fixed ? nobody : pair.b};
    }
  }

  double scale(std::size_t c) const { return rows_[c].scale; }

  /// By body, what the forces x do to it.
  const std::vector<Vec3>& move(const std::vector<double>& x) {
    std::fill(moved_.begin(), moved_.end(), Vec3::Zero());
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      if (x[c] == 0) continue;
      const Pair& p = rows_[c];
      const double left = p.left * x[c], right = p.right * x[c];
      moved_[p.a] -= left * p.normal;
      moved_[p.b] += right * p.normal;
    }
    return moved_;
  }

  /// Calls take(c, (A x)_c) for every pair.
  template <typename Take>
  void multiply(const std::vector<double>& x, Take take) {
    move(x);
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      const Pair& p = rows_[c];
      const Vec3 &a = moved_[p.a], &b = moved_[p.b];
      take(c, p.scale * p.normal.dot(b - a));
    }
  }

  /// At least the greatest eigenvalue: by the pairs that share a body (Gershgorin's discs, |n . n'| <= 1).
  double norm() const {
    std::vector<double> sum(moved_.size(), 0.0);
    for (const Pair& p : rows_) {
      sum[p.a] += p.scale;
      sum[p.b] += p.scale;
    }
    double most = 0;
    for (const Pair& p : rows_) most = std::max(most, p.left * sum[p.a] + p.right * sum[p.b]);
    return most;
  }

 private:
  struct Pair {
    Vec3 normal;
    double scale;        // 1 / sqrt(A_cc)
    double left, right;  // scale / mass, of a and b
    std::uint32_t a, b;
  };
  std::vector<Pair> rows_;
  std::vector<Vec3> moved_;
};

/// A power of two: above the greatest of them, at most twice it.
double power_of_two_near(std::span<const double> values) {
  int exponent;
  std::frexp(*std::max_element(values.begin(), values.end()), &exponent);
  return std::ldexp(1.0, exponent);
}

}  // namespace

bool project_gradients(const ContactProblem& problem, int iterations) {
  const std::span<const double> inverse_masses = problem.inverse_mass;
  const std::span<Vec3> u = problem.motion;
  const std::span<ContactConstraint> pairs = problem.contacts;
  const std::size_t m = pairs.size();
  if (m == 0) return true;
  // Masses in a unit of their own, a power of two: masses scaled by one give the same bits.
  const double unit = power_of_two_near(inverse_masses);  // 1/kg
  std::vector<double> inverse_mass(inverse_masses.begin(), inverse_masses.end());
  for (double& w : inverse_mass) w /= unit;
  Scaled a(inverse_mass, pairs);
  std::vector<double> x(m), g(m), direction(m), image(m), constant(m), slack(m);
  for (std::size_t c = 0; c < m; ++c) {
    const ContactConstraint& pair = pairs[c];
    const Vec3 w = pair.b == ContactConstraint::fixed ? Vec3(-u[pair.a]) : Vec3(u[pair.b] - u[pair.a]);
    x[c] = std::max(pair.force, 0.0) * unit / a.scale(c);
    constant[c] = a.scale(c) * (pair.normal.dot(w) - pair.target);
    slack[c] = a.scale(c) * pair.slack;
  }
  const auto gradient = [&] { a.multiply(x, [&](std::size_t c, double result) { g[c] = result + constant[c]; }); };
  const double step = 1.9 / a.norm(), per_step = 1 / step;
  gradient();
  // The potential, x A x / 2 + constant x, only falls from here on, and with it the energy that pairs with no target
  // leave; it must not start above that of no forces at all.
  double potential = 0;
  for (std::size_t c = 0; c < m; ++c) potential += 0.5 * x[c] * (g[c] + constant[c]);
  if (!(potential <= 0)) {
    std::fill(x.begin(), x.end(), 0.0);
    g = constant;
  }
  std::vector<double> next_x(m), next_g(m);
  // What has died away to nothing is none: its squares would underflow, and other units would give other bits.
  double least = 0;
  for (std::size_t c = 0; c < m; ++c) least = std::max({least, std::abs(constant[c]), x[c]});
  least *= 0x1p-200;
  const auto flush = [&](double value) { return std::abs(value) < least ? 0 : value; };
  double reduced = 0, chopped = 0;  // the gradient on the free pairs, what of it the bounds leave; the pull on others
  bool done = false;
  const auto look = [&](std::size_t c) {
    if (x[c] > 0) {
      reduced += std::min(x[c] * per_step, g[c]) * g[c];
      done = done && std::abs(std::min(g[c], x[c])) <= slack[c];  // else falls short, or presses while it parts
    } else if (g[c] < 0) {
      chopped += g[c] * g[c];
      done = done && -g[c] <= slack[c];
    }
  };
  // direction: of the conjugate gradients on the face of the pairs that press, g less `turn` times the last one.
  const auto begin = [&](double turn) {
    reduced = chopped = 0;
    done = true;
    for (std::size_t c = 0; c < m; ++c) {
      direction[c] = flush((x[c] > 0 ? g[c] : 0) - (turn == 0 ? 0 : turn * direction[c]));
      look(c);
    }
  };
  begin(0);
  for (int iteration = 0; iteration < iterations && !done; ++iteration) {
    const bool on_face = chopped <= reduced;
    if (!on_face)  // pairs that pull to press: let them, as far as is best
      for (std::size_t c = 0; c < m; ++c) direction[c] = x[c] > 0 ? 0 : std::min(g[c], 0.0);
    double gp = 0, pap = 0;
    a.multiply(direction, [&](std::size_t c, double result) {
      image[c] = result;
      gp += g[c] * direction[c];
      pap += direction[c] * result;
    });
    if (!(pap > 0)) break;  // nothing left but rounding
    const double best = gp / pap;
    bool feasible = true;
    double turn = 0;
    for (std::size_t c = 0; c < m; ++c) {
      next_x[c] = flush(x[c] - best * direction[c]);
      next_g[c] = flush(g[c] - best * image[c]);
      feasible = feasible && !(next_x[c] < 0);
      turn += next_x[c] > 0 ? next_g[c] * image[c] : 0;
    }
    if (feasible || !on_face) {
      x.swap(next_x);
      g.swap(next_g);
      begin(on_face ? turn / pap : 0);
      continue;
    }
    // Onto the bound, and on along the projected gradient.
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < m; ++c)
      if (next_x[c] < 0) first = std::min(first, x[c] / direction[c]);
    for (std::size_t c = 0; c < m; ++c) {
      const double at_bound = std::max(x[c] - first * direction[c], 0.0);
      const double slope = x[c] > 0 ? g[c] - first * image[c] : 0;
      x[c] = std::max(at_bound - step * slope, 0.0);
    }
    gradient();
    begin(0);
  }
  const std::vector<Vec3>& moved = a.move(x);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += moved[i];
  for (std::size_t c = 0; c < m; ++c) pairs[c].force = x[c] * a.scale(c) / unit;
  return done;
}

}  // namespace carom
