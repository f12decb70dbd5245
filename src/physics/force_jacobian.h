#pragma once
// The Jacobians of the forces' accelerations. An implicit method needs them for stiff forces.
#include <Eigen/Core>

#include "physics/attractor.h"
#include "physics/drag.h"
#include "physics/spring.h"
#include "physics/uniform_acceleration.h"
#include "physics/uniform_force.h"

namespace carom {

/// The derivatives of an acceleration.
struct ForceJacobian {
  Eigen::Matrix3d by_position = Eigen::Matrix3d::Zero();  // 1/s^2
  Eigen::Matrix3d by_velocity = Eigen::Matrix3d::Zero();  // 1/s

  ForceJacobian& operator+=(const ForceJacobian& other) {
    by_position += other.by_position;
    by_velocity += other.by_velocity;
    return *this;
  }
};

inline ForceJacobian jacobian(const UniformForce&, const Particle&) {
  return {};
}
inline ForceJacobian jacobian(const UniformAcceleration&, const Particle&) {
  return {};
}

ForceJacobian jacobian(const Drag& drag, const Particle& p);
ForceJacobian jacobian(const Spring& spring, const Particle& p);
ForceJacobian jacobian(const Attractor& attractor, const Particle& p);

}  // namespace carom
