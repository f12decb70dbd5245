// Each law's derivatives in closed form, with the limits at the places where a law has a corner.
#include "physics/force_jacobian.h"

#include "std.h"

namespace carom {

// d/du of -(c + q |u|) u is -(c + q |u|) - q u u^T / |u|. The last term goes to zero with u.
ForceJacobian jacobian(const Drag& drag, const Particle& p) {
  const Vec3 u = p.v - drag.wind;
  const double speed = u.norm();
  ForceJacobian j;
  j.by_velocity.diagonal().setConstant(-(drag.linear + drag.quadratic * speed));
  if (drag.quadratic != 0 && speed > 0) j.by_velocity -= (drag.quadratic / speed * u) * u.transpose();
  j.by_velocity /= p.mass;
  return j;
}

// With n = d / |d|, the spring has -k + k l / |d| (1 - n n^T).
// The damper has -c n n^T by the velocity, and -c (n v^T + (n . v) (1 - 2 n n^T)) / |d| by the position.
// At the anchor the rest length does not count, and the damper acts along every direction, as in Spring.
ForceJacobian jacobian(const Spring& spring, const Particle& p) {
  const Vec3 d = p.x - spring.anchor;
  const double length = d.norm();
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  ForceJacobian j;
  j.by_position = -spring.stiffness * one;

  if (length > 0) {
    const Vec3 n = d / length;
    const Eigen::Matrix3d along = n * n.transpose();
    const double approach = n.dot(p.v);  // m/s, away from the anchor
    j.by_position += (spring.stiffness * spring.rest_length / length) * (one - along);
    j.by_position -= (spring.damping / length) * (n * p.v.transpose() + approach * (one - 2 * along));
    j.by_velocity = -spring.damping * along;
  } else {
    j.by_velocity = -spring.damping * one;
  }

  j.by_position /= p.mass;
  j.by_velocity /= p.mass;
  return j;
}

// d/dd of -mu d / D^(3/2), D = |d|^2 + s^2, is -mu / D^(3/2) (1 - 3 d d^T / D).
// It is left at zero at an unsoftened centre, where the acceleration has no value either.
ForceJacobian jacobian(const Attractor& attractor, const Particle& p) {
  const Vec3 d = p.x - attractor.center;
  const double square = d.squaredNorm() + attractor.softening * attractor.softening;
  ForceJacobian j;
  if (!(square > 0)) return j;
  const Eigen::Matrix3d along = d * (d / square).transpose();
  j.by_position = -attractor.strength / (square * sqrt(square)) * (Eigen::Matrix3d::Identity() - 3 * along);
  return j;
}

}  // namespace carom
