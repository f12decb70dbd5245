#pragma once
// Balls and shells: spheres, half spheres and sides of cylinders that are hollow and have no thickness. A shell has an
// inner and an outer surface, and where it is open, rims. A ball's centre is inside or outside from one opening to the
// next, so that its path falls into pieces on which it can meet but one of these.
//
// Positions p are those of the ball's centre from the shell's centre. The normals point from the ball to the shell.

#include "geometry/contact_time.h"
#include "geometry/separation.h"
#include "numerics/polynomial_path.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

enum ShellFeature : uint8_t { shell_inner, shell_outer, shell_low_rim, shell_high_rim };

struct Shell {
  explicit Shell(const Obstacle& obstacle);

  bool round;        // a sphere or half of one, else the side of a cylinder
  double radius;     // m
  double low, high;  // m: the heights between which it extends. Infinite: there is no rim.

  /// The distance of a point (m).
  double distance(const Vec3& p) const;
  uint8_t nearest(const Vec3& p) const;
  /// Of a ball of radius r (m), from a feature's surface, extended without end.
  Separation at(const Vec3& p, double r, uint8_t feature) const;
  /// Second derivative of the gap (m/s^2) at constant relative velocity w (m/s).
  double bending(const Vec3& p, uint8_t feature, const Vec3& w) const;
  /// The least radius of curvature of the path of a ball's centre in contact (m).
  double bend_radius(double r, uint8_t feature) const;

  /// First contact of a ball of radius r (m), as time_of_impact of touch.h. motion.d is that from the ball to the
  /// shell.
  FeatureTime contact_time(double r, const RelativeMotion& motion, uint8_t left, double horizon) const;
  /// The same on a polynomial path. d, displacement: of the shell from the ball (m), by t / length (s).
  FeatureTime contact_time(double r, const Vec3& d, const PolynomialPath::Terms& displacement, double length,
                           double speeds, uint8_t left, double horizon) const;
  /// See leave_feature in touch.h. motion.d is that from the ball to the shell.
  FeatureTime leave(uint8_t feature, const RelativeMotion& motion, double horizon) const;

  /// The height of a rim (m).
  double height(uint8_t rim) const { return rim == shell_low_rim ? low : high; }
};

/// First t in [0, horizon] at which the distance of two points reaches s (m) from that side, on a polynomial path from
/// d (m) on. `displacement`: m, by t / length (s). just_separated: the gap is zero by definition.
double distance_time(const Vec3& d, const PolynomialPath::Terms& displacement, double length, double s, Side side,
                     double speeds, bool just_separated, double horizon);

}  // namespace carom
