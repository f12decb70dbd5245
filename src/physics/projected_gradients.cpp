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
    const auto immovable = static_cast<std::uint32_t>(inverse_mass.size());
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const ContactConstraint& pair = pairs[c];
      const bool fixed = pair.b == ContactConstraint::fixed;
      const double of_a = inverse_mass[pair.a], of_b = fixed ? 0 : inverse_mass[pair.b];
      const double scale = 1 / std::sqrt(of_a + of_b);
      rows_[c] = {pair.normal, scale, scale * of_a, scale * of_b, pair.a, fixed ? immovable : pair.b};
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

/// The unknowns and their gradient, with what one step needs.
class ProjectedGradients {
 public:
  ProjectedGradients(const ContactProblem& problem, double unit, std::span<const double> inverse_mass)
      : a_(inverse_mass, problem.contacts), step_(1.9 / a_.norm()), per_step_(1 / step_) {
    const std::size_t m = problem.contacts.size();
    for (std::vector<double>* v : {&x_, &g_, &direction_, &image_, &constant_, &slack_, &next_x_, &next_g_})
      v->resize(m);
    for (std::size_t c = 0; c < m; ++c) {
      const ContactConstraint& pair = problem.contacts[c];
      const Vec3 w = pair.b == ContactConstraint::fixed ? Vec3(-problem.motion[pair.a])
                                                        : Vec3(problem.motion[pair.b] - problem.motion[pair.a]);
      x_[c] = std::max(pair.force, 0.0) * unit / a_.scale(c);
      constant_[c] = a_.scale(c) * (pair.normal.dot(w) - pair.target);
      slack_[c] = a_.scale(c) * pair.slack;
    }
  }

  bool run(int iterations) {
    start();
    for (int iteration = 0; iteration < iterations && !done_; ++iteration)
      if (!iterate()) break;
    return done_;
  }

  const std::vector<Vec3>& moved() { return a_.move(x_); }
  double force(std::size_t c) const { return x_[c] * a_.scale(c); }

 private:
  std::size_t size() const { return x_.size(); }
  double flush(double value) const { return std::abs(value) < least_ ? 0 : value; }
  void find_gradient() {
    a_.multiply(x_, [&](std::size_t c, double result) { g_[c] = result + constant_[c]; });
  }

  /// The potential, x A x / 2 + constant x, only falls from here on, and with it the energy that pairs with no target
  /// leave; it must not start above that of no forces at all. What has died away to nothing is none: its squares would
  /// underflow, and other units would give other bits.
  void start() {
    find_gradient();
    double potential = 0;
    for (std::size_t c = 0; c < size(); ++c) potential += 0.5 * x_[c] * (g_[c] + constant_[c]);
    if (!(potential <= 0)) {
      std::fill(x_.begin(), x_.end(), 0.0);
      g_ = constant_;
    }
    least_ = 0;
    for (std::size_t c = 0; c < size(); ++c) least_ = std::max({least_, std::abs(constant_[c]), x_[c]});
    least_ *= 0x1p-200;
    begin(0);
  }

  /// direction_: of the conjugate gradients on the face of the pairs that press, g less `turn` times the last one. And
  /// whether all is within its slack.
  void begin(double turn) {
    reduced_ = chopped_ = 0;
    done_ = true;
    for (std::size_t c = 0; c < size(); ++c) {
      direction_[c] = flush((x_[c] > 0 ? g_[c] : 0) - (turn == 0 ? 0 : turn * direction_[c]));
      if (x_[c] > 0) {
        reduced_ += std::min(x_[c] * per_step_, g_[c]) * g_[c];
        done_ = done_ && std::abs(std::min(g_[c], x_[c])) <= slack_[c];  // else falls short, or presses while it parts
      } else if (g_[c] < 0) {
        chopped_ += g_[c] * g_[c];
        done_ = done_ && -g_[c] <= slack_[c];
      }
    }
  }

  /// False: nothing is left but rounding.
  bool iterate() {
    const bool on_face = chopped_ <= reduced_;
    if (!on_face)  // pairs that pull to press: let them, as far as is best
      for (std::size_t c = 0; c < size(); ++c) direction_[c] = x_[c] > 0 ? 0 : std::min(g_[c], 0.0);
    double gp = 0, pap = 0;
    a_.multiply(direction_, [&](std::size_t c, double result) {
      image_[c] = result;
      gp += g_[c] * direction_[c];
      pap += direction_[c] * result;
    });
    if (!(pap > 0)) return false;
    const double best = gp / pap;
    bool feasible = true;
    double turn = 0;
    for (std::size_t c = 0; c < size(); ++c) {
      next_x_[c] = flush(x_[c] - best * direction_[c]);
      next_g_[c] = flush(g_[c] - best * image_[c]);
      feasible = feasible && !(next_x_[c] < 0);
      turn += next_x_[c] > 0 ? next_g_[c] * image_[c] : 0;
    }
    if (feasible || !on_face) {
      x_.swap(next_x_);
      g_.swap(next_g_);
      begin(on_face ? turn / pap : 0);
    } else {
      go_to_bound();
    }
    return true;
  }

  /// Onto the bound, and on along the projected gradient.
  void go_to_bound() {
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < size(); ++c)
      if (next_x_[c] < 0) first = std::min(first, x_[c] / direction_[c]);
    for (std::size_t c = 0; c < size(); ++c) {
      const double at_bound = std::max(x_[c] - first * direction_[c], 0.0);
      const double slope = x_[c] > 0 ? g_[c] - first * image_[c] : 0;
      x_[c] = std::max(at_bound - step_ * slope, 0.0);
    }
    find_gradient();
    begin(0);
  }

  Scaled a_;
  double step_, per_step_;
  std::vector<double> x_, g_, direction_, image_, constant_, slack_, next_x_, next_g_;  // by pair
  double least_ = 0;
  double reduced_ = 0, chopped_ = 0;  // the gradient on the free pairs, what of it the bounds leave; the pull on others
  bool done_ = false;
};

}  // namespace

bool project_gradients(const ContactProblem& problem, int iterations) {
  if (problem.contacts.empty()) return true;
  // Masses in a unit of their own, a power of two: masses scaled by one give the same bits.
  const double unit = power_of_two_near(problem.inverse_mass);  // 1/kg
  std::vector<double> inverse_mass(problem.inverse_mass.begin(), problem.inverse_mass.end());
  for (double& w : inverse_mass) w /= unit;
  ProjectedGradients method(problem, unit, inverse_mass);
  const bool done = method.run(iterations);
  const std::vector<Vec3>& moved = method.moved();
  for (std::size_t i = 0; i < problem.motion.size(); ++i) problem.motion[i] += moved[i];
  for (std::size_t c = 0; c < problem.contacts.size(); ++c) problem.contacts[c].force = method.force(c) / unit;
  return done;
}

}  // namespace carom
