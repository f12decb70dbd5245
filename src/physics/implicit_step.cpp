// Radau IIA with seven stages, for one point under stiff forces (Hairer & Wanner, Solving Ordinary Differential
// Equations II, 2nd ed. 1996, IV.5 and IV.8). The unknowns are the changes Z_i of the velocity at the stages, X_i = x +
// c_i h v + h sum_j A_ij Z_j:
//   Z_i = h sum_j A_ij a(X_j, v + Z_j)
// Newton's method solves them, from the solution for forces that are linear about the start. Its matrix has the
// Jacobian of the start while that converges fast, and then those of all stages. Only the latter converge where a stiff
// direction turns within a step, as that of a damper does across its line.
#include "physics/implicit_step.h"

#include "numerics/lu_factors.h"
#include "numerics/radau_points.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t nodes = 7, axes = 3, unknowns = nodes * axes;

constexpr int most_passes = 12;
// The allowed error of the stages, as a share of the step's allowed error.
constexpr double enough = 0.01;
// Where rounding ends the iteration, the stages may be wrong by so many times `enough`.
constexpr double hopeless = 100;
// So many passes take as long as new factors.
constexpr int worth_factors = 6;

// Where forces are smooth, the velocity's error is e int prod (s - c_i).
// Its greatest value in the step is start_share of its slope at the start.
constexpr double start_share = 0.0175;
// The displacement's error as a share of the velocity's, by the step.
constexpr double displacement_share = 0.071;
// Measured: the error is 0.07 to 1.4 of the next term's size.
constexpr double term_share = 0.5;
// A share of the step. A transient that is over in less counts by its velocity, not by its acceleration.
constexpr double filter = 0x1p-5;

using NodeRow = array<double, nodes>;
using NodeMatrix = array<NodeRow, nodes>;

struct SevenStages {
  NodeRow c = radau_points<nodes>();
  NodeMatrix a = collocation_matrix(c, gauss_4);
  NodeMatrix a_squared;
  // Coefficients of Legendre's polynomials of degrees 4 to 7 in the polynomial of `power`.
  array<NodeRow, 4> tail;
  // Coefficients of s^(row + 1) in the polynomial that is 0 at 0, 1 at the column's point and 0 at the other points.
  NodeMatrix power;

  SevenStages() {
    for (size_t i = 0; i < nodes; ++i)
      for (size_t j = 0; j < nodes; ++j) {
        a_squared[i][j] = 0;
        for (size_t k = 0; k < nodes; ++k) a_squared[i][j] += a[i][k] * a[k][j];
      }

    for (size_t j = 0; j < nodes; ++j) {
      set_powers(j);
      set_tail(j);
    }
  }

  /// Coefficients of s / c_j times the product of (s - c_l) / (c_j - c_l) over the other points.
  void set_powers(size_t j) {
    NodeRow terms{1 / c[j]};
    size_t degree = 0;
    for (size_t l = 0; l < nodes; ++l) {
      if (l == j) continue;
      const double scale = 1 / (c[j] - c[l]);
      ++degree;
      for (size_t k = degree; k > 0; --k) terms[k] = scale * (terms[k - 1] - c[l] * terms[k]);
      terms[0] *= -scale * c[l];
    }
    for (size_t k = 0; k < nodes; ++k) power[k][j] = terms[k];
  }

  /// Radau's weights integrate the products exactly for degrees up to 6. A multiple of (P_6 - P_7) / 2 then brings the
  /// polynomial to 0 at 0. That one is 1 at 0 and zero at the points.
  void set_tail(size_t j) {
    const auto p = legendre<nodes>(c[j]);
    double missed = 0, sign = 1;
    for (size_t n = 0; n < nodes; ++n, sign = -sign) {
      const double term = double(2 * n + 1) * a[nodes - 1][j] * p[n];
      missed -= sign * term;
      if (n >= 4) tail[n - 4][j] = term;
    }
    tail[2][j] += 0.5 * missed;
    tail[3][j] = -0.5 * missed;
  }
};

const SevenStages& method() {
  static const SevenStages radau;
  return radau;
}

/// Whether n more passes leave more than `limit` of this change, where each pass leaves the share `rate`.
bool is_slow(double change, double rate, double limit, int n) {
  for (int pass = 0; pass < n && change > limit; ++pass) change *= rate;
  return change > limit;
}

}  // namespace

/// Newton's iteration for the stages of a step.
struct ImplicitStep::Newton {
  using Vector = LuFactors<unknowns>::Row;

  const double h;
  const Vec3 &x, &v;
  const Acceleration& acceleration;
  const Jacobian& jacobian;
  array<Vec3, stages>& z;
  LuFactors<unknowns> factors;

  Vec3 position(size_t i) const {
    Vec3 sum = method().c[i] * v;
    for (size_t j = 0; j < nodes; ++j) sum += method().a[i][j] * z[j];
    return x + h * sum;
  }

  /// I - h A (x) J_v - h^2 A^2 (x) J_x, with one Jacobian.
  bool factor(const ForceJacobian& j) {
    const SevenStages& m = method();
    const Eigen::Matrix3d hj = h * j.by_velocity, hhj = h * h * j.by_position;
    for (size_t row = 0; row < unknowns; ++row)
      for (size_t column = 0; column < unknowns; ++column) {
        const size_t i = row / axes, k = column / axes;
        const auto p = static_cast<Eigen::Index>(row % axes), q = static_cast<Eigen::Index>(column % axes);
        factors.at(row, column) = (row == column ? 1 : 0) - m.a[i][k] * hj(p, q) - m.a_squared[i][k] * hhj(p, q);
      }
    return factors.factor();
  }

  /// The same with the Jacobian of each stage.
  bool factor_at_stages() {
    const SevenStages& m = method();
    array<Eigen::Matrix3d, nodes> hj, hhj;
    for (size_t l = 0; l < nodes; ++l) {
      const ForceJacobian j = jacobian(position(l), v + z[l]);
      hj[l] = h * j.by_velocity;
      hhj[l] = h * h * j.by_position;
    }

    // One block for each pair of stages.
    for (size_t i = 0; i < nodes; ++i)
      for (size_t k = 0; k < nodes; ++k) {
        Eigen::Matrix3d block = m.a[i][k] * hj[k];
        for (size_t l = 0; l < nodes; ++l) block += (m.a[i][l] * m.a[l][k]) * hhj[l];
        for (size_t p = 0; p < axes; ++p)
          for (size_t q = 0; q < axes; ++q)
            factors.at(i * axes + p, k * axes + q) =
                (i == k && p == q ? 1 : 0) - block(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q));
      }

    return factors.factor();
  }

  /// Sets z to the solution for forces that are linear about the start, where the acceleration is a0 (m/s^2).
  void predict(const Vec3& a0, const ForceJacobian& j) {
    const Vec3 turn = 0.5 * h * h * (j.by_position * v);
    Vector b;
    for (size_t i = 0; i < nodes; ++i) {
      const double c = method().c[i];
      put(b, i, c * (h * a0 + c * turn));
    }
    factors.solve(b);
    for (size_t i = 0; i < nodes; ++i) z[i] = Vec3(b[axes * i], b[axes * i + 1], b[axes * i + 2]);
  }

  /// One pass of Newton's method. Returns the greatest change of a velocity (m/s); infinity: a number is not finite.
  double correct() {
    array<Vec3, nodes> a;
    for (size_t j = 0; j < nodes; ++j) a[j] = acceleration(position(j), v + z[j]);

    // What the stages miss, and the changes that make up for it.
    Vector b;
    for (size_t i = 0; i < nodes; ++i) {
      Vec3 sum = Vec3::Zero();
      for (size_t j = 0; j < nodes; ++j) sum += method().a[i][j] * a[j];
      put(b, i, h * sum - z[i]);
    }
    factors.solve(b);

    double changed = 0;
    for (size_t i = 0; i < nodes; ++i)
      for (size_t p = 0; p < axes; ++p) {
        const double change = b[axes * i + p];
        if (!isfinite(change)) return infinity;
        z[i][static_cast<Eigen::Index>(p)] += change;
        changed = max(changed, std::abs(change));
      }

    return changed;
  }

  static void put(Vector& b, size_t i, const Vec3& value) {
    std::copy(value.data(), value.data() + axes, b.begin() + ptrdiff_t(axes * i));
  }

  /// Whether the velocities converge to within `limit` (m/s).
  bool solve(double limit) {
    const array<Vec3, stages> predicted = z;
    double before = infinity;
    bool at_stages = false;
    for (int pass = 0; pass < most_passes; ++pass) {
      const double changed = correct();
      if (changed == infinity) return false;

      // The rate is 0 in a first pass.
      const double rate = changed / before;
      const bool first = before == infinity;
      if (changed <= limit || (!first && rate < 0.5 && rate * changed <= limit)) return true;

      // Rounding allows no better agreement.
      if (at_stages && rate >= 0.5 && changed <= hopeless * limit) return true;
      before = changed;

      // New factors, if they are worth their time.
      if (!is_slow(changed, rate, limit, worth_factors)) continue;
      if (!at_stages && !(rate < 0.5)) {
        z = predicted;
        before = infinity;
      }
      if (!factor_at_stages()) return false;
      at_stages = true;
    }

    return false;
  }
};

double ImplicitStep::step(double h, const Vec3& x, const Vec3& v, const Acceleration& acceleration,
                          const Jacobian& jacobian, double position, double velocity) {
  length_ = h;
  v_ = v;
  const Vec3 a = acceleration(x, v);
  const ForceJacobian j = jacobian(x, v);
  Newton newton{h, x, v, acceleration, jacobian, change_, {}};
  if (!newton.factor(j)) return infinity;
  newton.predict(a, j);
  if (!newton.solve(enough * min(velocity, position / h))) return infinity;
  const double wrong = max(error_by_terms(), error_by_start(a, j));
  return wrong * max(1 / velocity, displacement_share * h / position);
}

/// The error of the velocity (m/s), from the last terms of its polynomial. They fade by a similar factor each, and
/// terms of one parity may vanish. A transient that is small beside the slow motion stays hidden from this estimate.
double ImplicitStep::error_by_terms() const {
  // Sizes of the terms of degrees 4 to 7.
  array<double, 4> size;
  for (size_t n = 0; n < size.size(); ++n) {
    Vec3 sum = Vec3::Zero();
    for (size_t j = 0; j < nodes; ++j) sum += method().tail[n][j] * change_[j];
    size[n] = sum.cwiseAbs().maxCoeff();
  }

  const double last = max(size[2], size[3]), before = max(size[0], size[1]);
  if (!(last < before)) return last;
  const double fading = sqrt(last / before);
  return term_share * max(size[3], fading * size[2]) * fading;
}

/// The error of the velocity (m/s), from the difference between the polynomial's acceleration and a (m/s^2) at the
/// start. The start is the one point where the polynomial's acceleration is not that of the forces. The filter (Hairer
/// & Wanner, IV.8, eq. 8.20) reduces a fast transient to the size of its velocity. The estimate is too small near a
/// sign change of the error at the start.
double ImplicitStep::error_by_start(const Vec3& a, const ForceJacobian& j) const {
  const double s = filter * length_;
  LuFactors<axes> factors;
  for (size_t p = 0; p < axes; ++p)
    for (size_t q = 0; q < axes; ++q) {
      const auto row = static_cast<Eigen::Index>(p), column = static_cast<Eigen::Index>(q);
      factors.at(p, q) = (p == q ? 1 : 0) - s * j.by_velocity(row, column) - s * s * j.by_position(row, column);
    }
  if (!factors.factor()) return infinity;

  // The slope of the polynomial at the start, by the step, m/s.
  Vec3 slope = Vec3::Zero();
  for (size_t k = 0; k < nodes; ++k) slope += method().power[0][k] * change_[k];
  const Vec3 miss = length_ * a - slope;
  LuFactors<axes>::Row b{miss[0], miss[1], miss[2]};
  factors.solve(b);

  double greatest = 0;
  for (const double missed : b) {
    if (!isfinite(missed)) return infinity;
    greatest = max(greatest, std::abs(missed));
  }
  return start_share * greatest;
}

PolynomialPath ImplicitStep::path() const {
  PolynomialPath path;
  path.length = length_;
  path.displacement[0] = length_ * v_;
  for (size_t k = 0; k < nodes; ++k) {
    Vec3 sum = Vec3::Zero();
    for (size_t j = 0; j < nodes; ++j) sum += method().power[k][j] * change_[j];
    path.displacement[k + 1] = length_ / double(k + 2) * sum;
  }
  return path;
}

}  // namespace carom
