#pragma once
// Motion about a fixed centre under an inverse square law, x'' = -mu x / |x|^3 with x from the centre.
// The path is an ellipse, a parabola or a hyperbola. It can be evaluated at any time directly.
// Only + - * / and the square root reach the result.

#include "numerics/compensated.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class KeplerOrbit {
 public:
  KeplerOrbit() = default;  // to be assigned to
  /// mu: m^3/s^2, not 0; negative: the centre repels. x: m, not 0. v: m/s. Squares of mu and of x cross v must be in
  /// the range of doubles.
  KeplerOrbit(double mu, const Vec3& x, const Vec3& v);

  /// Position (m, from the centre) and velocity (m/s) at t (s, >= 0, since the start).
  /// A path through the centre itself returns the way it came. Its velocity there is given as 0.
  void at(double t, Vec3& x, Vec3& v) const { at(DoubleDouble{t, 0}, x, v); }
  void at(DoubleDouble t, Vec3& x, Vec3& v) const;

  double pericentre() const { return near_.distance; }  // m
  /// The first passage of the pericentre (s, from the start on); infinity: never.
  double closest_time() const;
  /// The period of an ellipse (s), otherwise infinity.
  double period() const { return period_.hi; }

  void keep(auto& archive) {
    archive(mu_, beta_, root_, momentum_, near_, far_, ahead_, aside_);
    archive(period_, quarter_, starts_far_, start_, x_, v_);
  }

 private:
  /// One end of the long axis. At parameter s from there on, the time is distance s + bend G3(s). The distance from the
  /// centre is then distance + bend G2(s).
  struct Apsis {
    double side = 1;      // of the centre: 1 the near end, -1 the far end
    double distance = 0;  // m, from the centre
    double bend = 0;      // m^3/s^2: |mu| times the eccentricity, negative at the far end
  };
  /// The time since the passage through an apsis (s), negative before it.
  struct Phase {
    const Apsis* apsis;
    DoubleDouble time;
  };

  Phase phase(DoubleDouble t) const;
  double parameter(const Apsis& from, DoubleDouble time) const;
  double first_guess(const Apsis& from, double time) const;

  double mu_ = 1;                              // m^3/s^2
  double beta_ = 0;                            // m^2/s^2: -2 energy / mass
  double root_ = 0;                            // m/s: square root of |beta|
  double momentum_ = 0;                        // m^2/s: angular momentum / mass
  Apsis near_, far_;                           // far: of an ellipse only
  Vec3 ahead_ = Vec3::UnitX();                 // unit, towards the pericentre
  Vec3 aside_ = Vec3::Zero();                  // along the velocity there; 0 for a path on a line
  DoubleDouble period_ = {INFINITY, 0};        // s
  double quarter_ = INFINITY;                  // s: from the pericentre to the end of the short axis
  bool starts_far_ = false;                    // the start is nearer to the far end in phase
  DoubleDouble start_ = {0, 0};                // s: time of the start since that end
  Vec3 x_ = Vec3::UnitX(), v_ = Vec3::Zero();  // m, m/s: at the start
};

}  // namespace carom
