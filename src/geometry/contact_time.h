#pragma once
// Times of impact of moving spheres with each other, with planes, and with the faces, edges and corners of walls.
// Times are in seconds from the instant at which the arguments hold. `never` (polynomial.h) means no contact.
// An approach slower than the rounding of its velocities is none, so that noise does not strike touching bodies again.

#include "geometry/relative_motion.h"
#include "numerics/polynomial.h"
#include "std.h"

namespace carom {

struct Wall;

/// First t in [0, horizon] at which spheres with radii of sum s (m) touch and approach.
/// The equation is |d + w t + a t^2/2|^2 = s^2: a quadratic where a = 0, otherwise a quartic.
/// The Lagrange identity, the product form of the root and compensated dot products keep the quadratic exact.
/// A grazing or nearly touching pair is then as exact as its data. For the quartic, see CurvedContacts.
double sphere_contact_time(const RelativeMotion& motion, double s, double horizon);

/// First t in [0, horizon] at which the distance of two points reaches s (m) from below: a string of that length goes
/// taut. just_separated: it has just been taut, and its gap is zero by definition.
double taut_time(const RelativeMotion& motion, double s, double horizon);

/// The side from which a distance approaches s.
enum class Side : uint8_t { outside, inside };

/// |d + w t + a t^2/2|^2 - s^2, m^2, or from inside its negative. With just_separated the constant term is zero.
Polynomial squared_gap_polynomial(const RelativeMotion& motion, double s, Side side = Side::outside);

/// s^2 - |d + w t + a t^2/2|^2, m^2: the room before the rim of a disc, of two points that have not just separated.
Polynomial room_in_disc(const RelativeMotion& motion, double s);

/// The times in [0, horizon] at which a path leaves a disc.
Roots exit_times(const RelativeMotion& motion, double s, double horizon);

/// The contacts of spheres of unequal accelerations, one after the other, because a curved path may enter twice. From
/// inside: the times at which a string goes taut.
/// The quartic's coefficients lose the digits to which the square of a long path is rounded.
/// So the quartic only gives the pieces of the path on which contact is possible, by its least value within rounding.
/// On these pieces the gap is evaluated in double-double.
class CurvedContacts {
 public:
  CurvedContacts(const RelativeMotion& motion, double s, double horizon, Side side = Side::outside);
  /// The next contact (s); never: there is no other.
  double next();

 private:
  double exact_gap(double t) const;
  double within(double from, double to) const;

  RelativeMotion m_;
  double s_;  // m
  Side side_;
  Polynomial f_;
  // They have just separated and approach again, because another impact has changed their velocities since.
  bool again_;
  Descents pieces_;
};

/// First t in [0, horizon] at which gap + speed t + acceleration t^2/2 (m; gap > 0: free) crosses zero downwards.
/// `noise` (m/s): a slower approach at a closed gap is none. just_separated: the gap is zero by definition.
double plane_contact_time(double gap, double speed, double acceleration, double noise, bool just_separated,
                          double horizon);

/// (x - point) . normal - radius, compensated where it cancels. m, negative: overlap.
double plane_gap(const Vec3& x, const Vec3& point, const Vec3& normal, double radius);

/// The parts of a wall: two faces, four edges, four corners.
enum WallFeature : uint8_t {
  wall_front,  // on the normal's side
  wall_back,
  wall_edges,                    // right, left, top, bottom
  wall_corners = wall_edges + 4  // right top, left top, right bottom, left bottom
};
inline constexpr uint8_t no_feature = 255;

/// An instant, and the feature at which two things touch then.
struct FeatureTime {
  double time;  // s, or never
  uint8_t feature;
};

/// First contact of a sphere at x (m) with velocity v (m/s) and acceleration a (m/s^2) with a wall.
/// A wall enlarged by the radius is convex: slabs over its faces, cylinders along its edges, balls at its corners.
/// The contact is the first entry into any of them, on its own stretch. `left`: the feature that the sphere has just
/// bounced off, or no_feature.
FeatureTime wall_contact_time(const Wall& wall, const Vec3& x, const Vec3& v, const Vec3& a, double radius,
                              uint8_t left, double horizon);

/// The same, from the wall's motion as seen from the sphere: d = wall.center - x.
FeatureTime wall_contact_time(const Wall& wall, const RelativeMotion& motion, double radius, uint8_t left,
                              double horizon);

/// The wall's point nearest to x (m), with its centre at `center` (m), or where it is at time 0.
Vec3 nearest_on_wall(const Wall& wall, const Vec3& center, const Vec3& x);
Vec3 nearest_on_wall(const Wall& wall, const Vec3& x);

/// First t in (0, horizon] at which a sphere that slides over a face leaves it. Its point of contact then crosses the
/// rectangle's rim.
FeatureTime wall_release_time(const Wall& wall, const RelativeMotion& motion, double horizon);

}  // namespace carom
