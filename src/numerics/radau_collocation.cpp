// Collocation of order 13 at seven Radau points (Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed.
// 1996, IV.5), for forces with stiff drag. The stages are solved by spectral deferred correction (Dutt, Greengard &
// Rokhlin, BIT 40 (2000) 241), with the triangular factor of Weiser, BIT 55 (2015) 1219. Newton's method on all stages
// at once would couple them. A sweep treats one stage at a time, and `hold` can apply the constraints there.
#include "numerics/radau_collocation.h"

#include "numerics/polynomial.h"
#include "numerics/radau_points.h"
#include "std.h"

namespace carom {

namespace {

constexpr int nodes = 7;
constexpr int most_sweeps = 40;
// An error of so many times the tolerance: the step is rejected.
constexpr double hopeless = 1e4;

using StageRow = array<double, nodes>;

struct Method {
  StageRow c = radau_points<nodes>();
  array<StageRow, nodes> a = collocation_matrix(c, gauss_5);
  // The sweep's matrix: the transpose of U, where L U is the transpose of a.
  array<StageRow, nodes> lower;

  Method() {
    array<StageRow, nodes> u;
    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < nodes; ++j) u[i][j] = a[j][i];

    for (int k = 0; k < nodes; ++k)
      for (int i = k + 1; i < nodes; ++i) {
        const double factor = u[i][k] / u[k][k];
        for (int j = k; j < nodes; ++j) u[i][j] -= factor * u[k][j];
      }

    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < nodes; ++j) lower[i][j] = j <= i ? u[j][i] : 0;
  }
};

const Method& method() {
  static const Method radau;
  return radau;
}

}  // namespace

/// One sweep over all stages, each computed from those before it. Returns the greatest change of a velocity (m/s).
double RadauCollocation::sweep(span<const Forces> forces, const Hold& hold) {
  const Method& m = method();
  const vector<vector<Vec3>> old_speed = speed_, old_rate = rate_;
  double changed = 0;
  for (int i = 0; i < nodes; ++i) {
    const double s = length_ * m.lower[i][i];

    // m/s: velocities without and with the new rate of this stage.
    vector<Vec3> known(size()), u(size());
    for (size_t k = 0; k < size(); ++k) {
      Vec3 way = Vec3::Zero(), speed = Vec3::Zero();
      for (int j = 0; j < nodes; ++j) {
        way += m.a[i][j] * old_speed[j][k];
        speed += m.a[i][j] * old_rate[j][k];
      }

      // Stages before it have changed in this sweep.
      for (int j = 0; j < i; ++j) {
        way += m.lower[i][j] * (speed_[j][k] - old_speed[j][k]);
        speed += m.lower[i][j] * (rate_[j][k] - old_rate[j][k]);
      }

      at_[i][k] = x_[k] + length_ * way;
      known[k] = v_[k] + length_ * speed - s * old_rate[i][k];
      u[k] = (known[k] + s * forces[k].pull) / (1 + s * forces[k].fade);
    }

    hold(at_[i], s, u);
    for (size_t k = 0; k < size(); ++k) {
      changed = max(changed, (u[k] - old_speed[i][k]).cwiseAbs().maxCoeff());
      speed_[i][k] = u[k];
      rate_[i][k] = (u[k] - known[k]) / s;
    }
  }

  return changed;
}

double RadauCollocation::step(double h, span<const Forces> forces, const Hold& hold, double position, double velocity) {
  length_ = h;
  at_.assign(nodes, x_);
  speed_.assign(nodes, v_);
  rate_.assign(nodes, vector<Vec3>(size(), Vec3::Zero()));

  const double enough = 0.01 * min(velocity, position / h);
  double before = never;
  for (int pass = 0; pass < most_sweeps && before > enough; ++pass) {
    const double changed = sweep(forces, hold);
    // Rounding or the method allows no better agreement.
    if (pass > nodes && !(changed < before)) break;
    before = changed;
  }

  if (before > 100 * enough) return hopeless;
  const double missed = interpolate();
  return max(missed / velocity, missed * method().c[0] * h / position);
}

/// Makes polynomials of the stages' velocities. Returns their greatest miss of the velocity at the start (m/s), which
/// is not one of the stages.
double RadauCollocation::interpolate() {
  const StageRow& weight = method().a.back();
  double worst = 0;

  of_displacement_.assign(terms * size(), Vec3::Zero());
  of_velocity_.assign(terms * size(), Vec3::Zero());
  for (size_t k = 0; k < size(); ++k) {
    Vec3* const d = &of_displacement_[terms * k];
    Vec3* const v = &of_velocity_[terms * k];
    // Radau's weights integrate these products exactly.
    for (int j = 0; j < nodes; ++j) {
      const auto p = legendre<nodes>(method().c[j]);
      for (int n = 0; n < nodes; ++n) v[n] += (2 * n + 1) * weight[j] * p[n] * speed_[j][k];
    }

    Vec3 missed = v_[k];
    for (int n = 0; n < nodes; ++n) missed -= n % 2 == 0 ? v[n] : Vec3(-v[n]);
    worst = max(worst, missed.cwiseAbs().maxCoeff());

    // The integral of P_n from the start on is proportional to P_(n+1) - P_(n-1).
    d[0] = d[1] = 0.5 * length_ * v[0];
    for (int n = 1; n < nodes; ++n) {
      const Vec3 share = 0.5 * length_ / (2 * n + 1) * v[n];
      d[n + 1] += share;
      d[n - 1] -= share;
    }

    // (P_6 - P_7) / 2 is 1 at the start and 0 at the stages.
    v[nodes - 1] += 0.5 * missed;
    v[nodes] = -0.5 * missed;
  }

  return worst;
}

Vec3 RadauCollocation::sum(const vector<Vec3>& coefficients, size_t k, double s) {
  const auto p = legendre<nodes>(s);
  Vec3 all = Vec3::Zero();
  for (size_t n = 0; n < terms; ++n) all += p[n] * coefficients[terms * k + n];
  return all;
}

Vec3 RadauCollocation::displacement(size_t k, double t) const {
  return sum(of_displacement_, k, t / length_);
}

Vec3 RadauCollocation::velocity(size_t k, double t) const {
  return sum(of_velocity_, k, t / length_);
}

PolynomialPath RadauCollocation::path(size_t k) const {
  // Coefficients of Legendre's polynomials in powers of s: (n + 1) P_(n+1) = (2n + 1) (2s - 1) P_n - n P_(n-1).
  array<double, terms> before{}, p{1};
  array<Vec3, terms> velocity;
  velocity.fill(Vec3::Zero());

  for (size_t n = 0; n < terms; ++n) {
    for (size_t power = 0; power <= n; ++power) velocity[power] += p[power] * of_velocity_[terms * k + n];
    array<double, terms> after{};
    const auto order = double(n);
    for (size_t power = 0; power < terms; ++power) {
      const double below = power > 0 ? p[power - 1] : 0;
      after[power] = ((2 * order + 1) * (2 * below - p[power]) - order * before[power]) / (order + 1);
    }
    before = exchange(p, after);
  }

  PolynomialPath path;
  path.length = length_;
  for (size_t power = 0; power < terms; ++power)
    path.displacement[power] = length_ / double(power + 1) * velocity[power];
  return path;
}

}  // namespace carom
