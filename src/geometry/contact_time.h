#pragma once
// When moving spheres meet: each other, planes, and the faces, edges and corners of walls. Times are in seconds from
// the instant at which the arguments hold; `never` (polynomial.h) means no contact. An approach slower than the
// rounding of the velocities it comes from is none: touching bodies are not hit again by noise.
#include <cstdint>

#include "numerics/polynomial.h"
#include "numerics/vec3.h"

namespace carom {

struct Wall;

/// Two points' relative motion: d = x_b - x_a (m), w = v_b - v_a (m/s), a = a_b - a_a (m/s^2).
struct RelativeMotion {
  Vec3 d, w, a;
  double speeds;        // |v_a| + |v_b|, m/s: w carries rounding of this size
  bool just_separated;  // they touch, having just collided: the gap is zero by definition, not by computation
};

/// First t in [0, horizon] at which spheres with radii that sum to s (m) touch and approach.
/// |d + w t + a t^2/2|^2 = s^2: a quadratic where a = 0, else a quartic (numerics: the Lagrange identity, the product
/// form of the root and compensated dots make a grazing or nearly touching pair as exact as its data; for the quartic,
/// see CurvedContacts).
double sphere_contact_time(const RelativeMotion& motion, double s, double horizon);

/// |d + w t + a t^2/2|^2 - s^2, m^2. just_separated: its constant term is zero.
Polynomial squared_gap_polynomial(const RelativeMotion& motion, double s);

/// The contacts of spheres of unequal accelerations, one after the other: a curved path may enter twice. The quartic's
/// coefficients lose what the square of a long path is rounded to, and a grazing pair is as inexact as they are. So it
/// only tells on which pieces of the path contact is possible, by the least value that rounding allows; there the gap
/// is evaluated in double-double.
class CurvedContacts {
 public:
  CurvedContacts(const RelativeMotion& motion, double s, double horizon);
  /// s, or never: there is none left.
  double next();

 private:
  double exact_gap(double t) const;
  double within(double from, double to) const;

  RelativeMotion m_;
  double s_;  // m
  Polynomial f_;
  bool again_;  // they have just separated, and approach again: something else has changed their velocities since
  Descents pieces_;
};

/// First t in [0, horizon] at which gap + speed t + acceleration t^2/2 (m; gap > 0: free) comes down through zero.
/// `noise` (m/s): a slower approach at a closed gap is none. just_separated: the gap is zero by definition.
double plane_contact_time(double gap, double speed, double acceleration, double noise, bool just_separated,
                          double horizon);

/// (x - point) . normal - radius, compensated where it cancels. m, negative: overlap.
double plane_gap(const Vec3& x, const Vec3& point, const Vec3& normal, double radius);

/// The parts of a wall: two faces, four edges, four corners.
enum WallFeature : std::uint8_t {
  wall_front,  // on the normal's side
  wall_back,
  wall_edges,                    // four: right, left, top, bottom
  wall_corners = wall_edges + 4  // four: right top, left top, right bottom, left bottom
};
inline constexpr std::uint8_t no_feature = 255;

struct WallContact {
  double time;           // s, or never
  std::uint8_t feature;  // of the wall
};

/// First contact of a sphere at x (m) with velocity v and acceleration a with a wall. A wall fattened by the radius is
/// convex: slabs over its faces, cylinders along its edges, balls at its corners; the first entry into any of them, on
/// its own stretch, is the contact. `left`: the feature that the sphere has just bounced off, or no_feature.
WallContact wall_contact_time(const Wall& wall, const Vec3& x, const Vec3& v, const Vec3& a, double radius,
                              std::uint8_t left, double horizon);

/// The same of the wall's motion seen from the sphere: d = wall.center - x.
WallContact wall_contact_time(const Wall& wall, const RelativeMotion& motion, double radius, std::uint8_t left,
                              double horizon);

/// The wall's point nearest to x (m).
Vec3 nearest_on_wall(const Wall& wall, const Vec3& x);

/// First t in (0, horizon] at which a sphere sliding over a face leaves it: its point of contact crosses the
/// rectangle's rim.
WallContact wall_release_time(const Wall& wall, const Vec3& x, const Vec3& v, const Vec3& a, double horizon);
WallContact wall_release_time(const Wall& wall, const RelativeMotion& motion, double horizon);

}  // namespace carom
