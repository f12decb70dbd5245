#include "numerics/radau_collocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "numerics/polynomial.h"
#include "numerics/radau_points.h"

namespace carom {

namespace {

constexpr int nodes = 9;
constexpr int most_sweeps = 40;
constexpr double hopeless = 1e4;  // an error of so many times what is allowed

using StageRow = std::array<double, nodes>;

/// Points and weights on [0, 1] that integrate polynomials of degree 9.
struct Gauss {
  std::array<double, 5> at, weight;
  Gauss() {
    const double root = 2 * std::sqrt(10.0 / 7), near = std::sqrt(5 - root) / 3, far = std::sqrt(5 + root) / 3;
    const double w_near = (322 + 13 * std::sqrt(70.0)) / 900, w_far = (322 - 13 * std::sqrt(70.0)) / 900;
    at = {0.5 * (1 - far), 0.5 * (1 - near), 0.5, 0.5 * (1 + near), 0.5 * (1 + far)};
    weight = {0.5 * w_far, 0.5 * w_near, 64.0 / 225, 0.5 * w_near, 0.5 * w_far};
  }
};

struct Method {
  StageRow c = radau_points<nodes>();
  Gauss gauss;
  std::array<StageRow, nodes> a;      // of the collocation: integrals of Lagrange's polynomials up to each point
  std::array<StageRow, nodes> lower;  // the sweeps': the transpose of U, where L U is the transpose of a

  Method() {
    for (int i = 0; i < nodes; ++i) a[i] = integrals(c[i]);
    std::array<StageRow, nodes> u;
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

  /// Of Lagrange's polynomials through the points, from 0 to s.
  StageRow integrals(double s) const {
    StageRow sum{};
    for (std::size_t g = 0; g < gauss.at.size(); ++g)
      for (int j = 0; j < nodes; ++j) {
        double product = s * gauss.weight[g];
        for (int l = 0; l < nodes; ++l)
          if (l != j) product *= (s * gauss.at[g] - c[l]) / (c[j] - c[l]);
        sum[j] += product;
      }
    return sum;
  }
};

const Method& method() {
  static const Method radau;
  return radau;
}

}  // namespace

/// Of all stages, each from those before it. Gives by how much a velocity has changed at most (m/s).
double RadauCollocation::sweep(std::span<const Forces> forces, const Hold& hold) {
  const Method& m = method();
  const std::vector<std::vector<Vec3>> old_speed = speed_, old_rate = rate_;
  double changed = 0;
  for (int i = 0; i < nodes; ++i) {
    const double s = length_ * m.lower[i][i];
    std::vector<Vec3> known(size()), u(size());  // m/s: without what is new in this stage; with it
    for (std::size_t k = 0; k < size(); ++k) {
      Vec3 way = Vec3::Zero(), speed = Vec3::Zero();
      for (int j = 0; j < nodes; ++j) {
        way += m.a[i][j] * old_speed[j][k];
        speed += m.a[i][j] * old_rate[j][k];
      }
      for (int j = 0; j < i; ++j) {
        way += m.lower[i][j] * (speed_[j][k] - old_speed[j][k]);
        speed += m.lower[i][j] * (rate_[j][k] - old_rate[j][k]);
      }
      at_[i][k] = x_[k] + length_ * way;
      known[k] = v_[k] + length_ * speed - s * old_rate[i][k];
      u[k] = (known[k] + s * forces[k].pull) / (1 + s * forces[k].fade);
    }
    hold(at_[i], s, u);
    for (std::size_t k = 0; k < size(); ++k) {
      changed = std::max(changed, (u[k] - old_speed[i][k]).cwiseAbs().maxCoeff());
      speed_[i][k] = u[k];
      rate_[i][k] = (u[k] - known[k]) / s;
    }
  }
  return changed;
}

double RadauCollocation::step(double h, std::span<const Forces> forces, const Hold& hold, double position,
                              double velocity) {
  length_ = h;
  at_.assign(nodes, x_);
  speed_.assign(nodes, v_);
  rate_.assign(nodes, std::vector<Vec3>(size(), Vec3::Zero()));
  const double enough = 0.01 * std::min(velocity, position / h);
  double before = never;
  for (int pass = 0; pass < most_sweeps && before > enough; ++pass) {
    const double changed = sweep(forces, hold);
    if (pass > nodes && !(changed < before)) break;  // as near as numbers or the method come
    before = changed;
  }
  if (before > 100 * enough) return hopeless;
  const double missed = interpolate();
  return std::max(missed / velocity, missed * method().c[0] * h / position);
}

/// Makes polynomials of the stages' velocities. Gives by how much they miss the start, of which they know nothing
/// (m/s).
double RadauCollocation::interpolate() {
  const StageRow& weight = method().a.back();
  double worst = 0;
  of_displacement_.assign(terms * size(), Vec3::Zero());
  of_velocity_.assign(terms * size(), Vec3::Zero());
  for (std::size_t k = 0; k < size(); ++k) {
    Vec3* const d = &of_displacement_[terms * k];
    Vec3* const v = &of_velocity_[terms * k];
    for (int j = 0; j < nodes; ++j) {  // Radau's weights integrate these products exactly
      const auto p = legendre<nodes>(method().c[j]);
      for (int n = 0; n < nodes; ++n) v[n] += (2 * n + 1) * weight[j] * p[n] * speed_[j][k];
    }
    Vec3 missed = v_[k];
    for (int n = 0; n < nodes; ++n) missed -= n % 2 == 0 ? v[n] : Vec3(-v[n]);
    worst = std::max(worst, missed.cwiseAbs().maxCoeff());
    // The integral of P_n from the start on is that of P_(n+1) less P_(n-1).
    d[0] = d[1] = 0.5 * length_ * v[0];
    for (int n = 1; n < nodes; ++n) {
      const Vec3 share = 0.5 * length_ / (2 * n + 1) * v[n];
      d[n + 1] += share;
      d[n - 1] -= share;
    }
    // (P_8 - P_9) / 2 is 1 at the start and 0 at the stages.
    v[nodes - 1] += 0.5 * missed;
    v[nodes] = -0.5 * missed;
  }
  return worst;
}

Vec3 RadauCollocation::sum(const std::vector<Vec3>& coefficients, std::size_t k, double s) {
  const auto p = legendre<nodes>(s);
  Vec3 all = Vec3::Zero();
  for (std::size_t n = 0; n < terms; ++n) all += p[n] * coefficients[terms * k + n];
  return all;
}

Vec3 RadauCollocation::displacement(std::size_t k, double t) const {
  return sum(of_displacement_, k, t / length_);
}

Vec3 RadauCollocation::velocity(std::size_t k, double t) const {
  return sum(of_velocity_, k, t / length_);
}

}  // namespace carom
