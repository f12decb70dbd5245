#include "physics/complementarity.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

/// The problem in scaled unknowns x_c = p_c sqrt(A_cc), for which the matrix has a unit diagonal: bodies of any masses
/// weigh alike. The matrix is never formed: A x is what impulses x do to the pairs' relative motion.
struct Scaled {
  std::span<const double> inverse_mass;
  std::span<const PressedPair> pairs;
  std::vector<double> scale;  // by pair: 1 / sqrt(A_cc)
  std::vector<Vec3> moved;    // by body: M^-1 N p

  Scaled(std::span<const double> inverse, std::span<const PressedPair> all)
      : inverse_mass(inverse), pairs(all), scale(all.size()), moved(inverse.size()) {
    for (std::size_t c = 0; c < all.size(); ++c)
      scale[c] = 1 / std::sqrt(inverse[all[c].a] + (all[c].b == PressedPair::none ? 0 : inverse[all[c].b]));
  }

  void move(const std::vector<double>& x) {
    std::fill(moved.begin(), moved.end(), Vec3::Zero());
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      if (x[c] == 0) continue;
      const PressedPair& pair = pairs[c];
      const Vec3 p = (x[c] * scale[c]) * pair.normal;
      moved[pair.a] -= inverse_mass[pair.a] * p;
      if (pair.b != PressedPair::none) moved[pair.b] += inverse_mass[pair.b] * p;
    }
  }

  void multiply(const std::vector<double>& x, std::vector<double>& result) {
    move(x);
    for (std::size_t c = 0; c < pairs.size(); ++c) result[c] = scale[c] * relative(moved, c);
  }

  double relative(std::span<const Vec3> u, std::size_t c) const {
    const PressedPair& pair = pairs[c];
    return pair.b == PressedPair::none ? -pair.normal.dot(u[pair.a]) : pair.normal.dot(u[pair.b] - u[pair.a]);
  }

  /// At least the greatest eigenvalue: by the pairs that share a body (Gershgorin's discs, |n . n'| <= 1).
  double norm() const {
    std::vector<double> sum(inverse_mass.size(), 0.0);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      sum[pairs[c].a] += scale[c];
      if (pairs[c].b != PressedPair::none) sum[pairs[c].b] += scale[c];
    }
    double most = 0;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      double row = inverse_mass[pairs[c].a] * sum[pairs[c].a];
      if (pairs[c].b != PressedPair::none) row += inverse_mass[pairs[c].b] * sum[pairs[c].b];
      most = std::max(most, scale[c] * row);
    }
    return most;
  }
};

}  // namespace

bool press_apart(std::span<const double> inverse_masses, std::span<Vec3> u, std::span<PressedPair> pairs,
                 int iterations) {
  const std::size_t m = pairs.size();
  if (m == 0) return true;
  // Masses in a unit of their own, a power of two: masses scaled by one give the same bits.
  int exponent;
  std::frexp(*std::max_element(inverse_masses.begin(), inverse_masses.end()), &exponent);
  const double unit = std::ldexp(1.0, exponent);  // 1/kg
  std::vector<double> inverse_mass(inverse_masses.begin(), inverse_masses.end());
  for (double& w : inverse_mass) w /= unit;
  Scaled a(inverse_mass, pairs);
  std::vector<double> x(m), g(m), free(m), direction(m), image(m), constant(m);
  for (std::size_t c = 0; c < m; ++c) {
    x[c] = std::max(pairs[c].force, 0.0) * unit / a.scale[c];
    constant[c] = a.scale[c] * (a.relative(u, c) - pairs[c].target);
  }
  const auto gradient = [&] {
    a.multiply(x, g);
    for (std::size_t c = 0; c < m; ++c) g[c] += constant[c];
  };
  const double step = 1.9 / a.norm();
  gradient();
  // The potential, x A x / 2 + constant x, only falls from here on, and with it the energy that pairs with no target
  // leave; it must not start above that of no forces at all.
  double potential = 0;
  for (std::size_t c = 0; c < m; ++c) potential += 0.5 * x[c] * (g[c] + constant[c]);
  if (!(potential <= 0)) {
    std::fill(x.begin(), x.end(), 0.0);
    g = constant;
  }
  bool done = false;
  // direction: of the conjugate gradients on the face of the pairs that press.
  const auto begin = [&] {
    for (std::size_t c = 0; c < m; ++c) direction[c] = x[c] > 0 ? g[c] : 0;
  };
  begin();
  for (int iteration = 0; iteration < iterations; ++iteration) {
    // The gradient on the free pairs, what of it the bounds leave, and the pull on those that do not press yet.
    double reduced = 0, chopped = 0;
    done = true;
    for (std::size_t c = 0; c < m; ++c) {
      free[c] = x[c] > 0 ? g[c] : 0;
      const double pull = x[c] > 0 ? 0 : std::min(g[c], 0.0);
      reduced += std::min(x[c] / step, free[c]) * free[c];
      chopped += pull * pull;
      // A pair falls short, or presses while it parts.
      if (std::abs(x[c] > 0 ? std::min(g[c], x[c]) : pull) > pairs[c].slack * a.scale[c]) done = false;
    }
    if (done) break;
    if (chopped <= reduced) {
      a.multiply(direction, image);
      double gp = 0, pap = 0, feasible = std::numeric_limits<double>::infinity();
      for (std::size_t c = 0; c < m; ++c) {
        gp += g[c] * direction[c];
        pap += direction[c] * image[c];
        if (direction[c] > 0) feasible = std::min(feasible, x[c] / direction[c]);
      }
      if (!(pap > 0)) break;  // nothing left but rounding
      const double best = gp / pap;
      if (best <= feasible) {
        double turn = 0;
        for (std::size_t c = 0; c < m; ++c) {
          x[c] -= best * direction[c];
          g[c] -= best * image[c];
          if (x[c] > 0) turn += g[c] * image[c];
        }
        turn /= pap;
        for (std::size_t c = 0; c < m; ++c) direction[c] = (x[c] > 0 ? g[c] : 0) - turn * direction[c];
      } else {
        // Onto the bound, and on along the projected gradient.
        for (std::size_t c = 0; c < m; ++c) {
          const double at_bound = std::max(x[c] - feasible * direction[c], 0.0);
          const double slope = x[c] > 0 ? g[c] - feasible * image[c] : 0;
          x[c] = std::max(at_bound - step * slope, 0.0);
        }
        gradient();
        begin();
      }
    } else {
      // Pairs that pull to press: let them, as far as is best.
      for (std::size_t c = 0; c < m; ++c) direction[c] = x[c] > 0 ? 0 : std::min(g[c], 0.0);
      a.multiply(direction, image);
      double gp = 0, pap = 0;
      for (std::size_t c = 0; c < m; ++c) {
        gp += g[c] * direction[c];
        pap += direction[c] * image[c];
      }
      if (!(pap > 0)) break;
      const double best = gp / pap;
      for (std::size_t c = 0; c < m; ++c) {
        x[c] = std::max(x[c] - best * direction[c], 0.0);
        g[c] -= best * image[c];
      }
      begin();
    }
  }
  a.move(x);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += a.moved[i];
  for (std::size_t c = 0; c < m; ++c) pairs[c].force = x[c] * a.scale[c] / unit;
  return done;
}

}  // namespace carom
