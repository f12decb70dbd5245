// The amplification of a linear mode by one step, as a matrix of position and velocity (Hairer & Wanner, Solving
// Ordinary Differential Equations II, 2nd ed. 1996, IV.2). Its spectral radius is above 1 beyond the stable step. For a
// swing w that is w h = 2 by euler and verlet and sqrt(8) by rk4, for a decay c it is c h = 2 and 2.7853.
#include "physics/stability.h"

#include <Eigen/Dense>

#include "std.h"

namespace carom {

namespace {

using Matrix = Eigen::Matrix2d;

/// A step of h (s) with the unit of time sqrt(1 / scale), so that all entries have one size.
Matrix amplification(Integrator method, double p, double c, double h) {
  Matrix change;
  change << 0, 1, -p, -c;
  const Matrix z = h * change, one = Matrix::Identity();

  switch (method) {
    case Integrator::euler: {
      const Eigen::RowVector2d v(-h * p, 1 - h * c);
      return (Matrix() << Eigen::RowVector2d(1, 0) + h * v, v).finished();
    }

    case Integrator::verlet: {
      const Eigen::RowVector2d a(-p, -c), x = Eigen::RowVector2d(1, h) + (0.5 * h * h) * a;
      const Eigen::RowVector2d v = Eigen::RowVector2d(0, 1) + h * a, next = -p * x - c * v;
      return (Matrix() << x, Eigen::RowVector2d(0, 1) + (0.5 * h) * (a + next)).finished();
    }

    case Integrator::rk4:
    case Integrator::dop853:
      break;
  }

  return one + z * (one + z / 2 * (one + z / 3 * (one + z / 4)));
}

double spectral_radius(const Matrix& of) {
  // Without cancellation where both eigenvalues are 1.
  const double apart = 0.5 * (of(0, 0) - of(1, 1)), half = 0.5 * of.trace();
  const double square = apart * apart + of(0, 1) * of(1, 0);
  return square < 0 ? sqrt(of.determinant()) : std::abs(half) + sqrt(square);
}

/// The rate at which a mode changes (1/s).
double rate_of(const LinearMode& mode) {
  return max(sqrt(mode.stiffness), mode.damping);
}

double stable_step(Integrator method, const LinearMode& mode) {
  // Up to there every method is stable, and beyond the other none.
  double stable = 0, unstable = 8 / rate_of(mode);
  constexpr double rounding = 0x1p-40;
  while (unstable - stable > 0x1p-30 * unstable) {
    const double middle = 0.5 * (stable + unstable);
    (growth(method, mode, middle) <= 1 + rounding ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace

double growth(Integrator method, const LinearMode& mode, double h) {
  const double rate = rate_of(mode);
  if (rate == 0) return 1;
  return spectral_radius(amplification(method, mode.stiffness / (rate * rate), mode.damping / rate, rate * h));
}

double stable_step(Integrator method, const ForceJacobian& slopes, LinearMode& mode) {
  double least = infinity;
  for (const Eigen::Matrix3d* const of : {&slopes.by_position, &slopes.by_velocity}) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(0.5 * (*of + of->transpose()));
    for (int k = 0; k < 3; ++k) {
      // The mode along this axis.
      const Vec3 u = axes.eigenvectors().col(k);
      const LinearMode along{max(-u.dot(slopes.by_position * u), 0.0), max(-u.dot(slopes.by_velocity * u), 0.0)};

      if (!(rate_of(along) > 0)) continue;
      const double step = stable_step(method, along);
      if (step < least) mode = along, least = step;
    }
  }

  return least;
}

}  // namespace carom
