#pragma once
// The path of one thing as seen from another, for paths of different kinds: the interface of the search by separating
// planes. Lengths and times count from the instant at which the search begins. Displacements are those of b less those
// of a.

#include "geometry/contact_time.h"
#include "geometry/fading_descent.h"
#include "numerics/polynomial_path.h"
#include "std.h"

namespace carom {

/// Relative path of two parabolas.
class ParabolicWay {
 public:
  static constexpr bool parabola = true;
  explicit ParabolicWay(const RelativeMotion& m) : w_(m.w), a_(m.a) {}

  Vec3 displacement(double t) const { return t * (w_ + 0.5 * t * a_); }
  Vec3 velocity(double t) const { return w_ + t * a_; }
  const Vec3& acceleration(double) const { return a_; }
  /// The time (s, after t) at which the distance along n crosses zero downwards. It is `gap` (m) at t and changes at
  /// `rate` (m/s).
  double descent(const Vec3& n, double, double gap, double rate, double) const {
    return plane_contact_time(gap, rate, n.dot(a_), 0, false, never);
  }
  /// The time (s, after t) of return of a path that leaves from zero at `rate` (m/s, at least 0), or `never`.
  double back(const Vec3& n, double, double rate, double) const {
    const double acceleration = n.dot(a_);
    return acceleration >= 0 ? never : 2 * rate / -acceleration;
  }
  ParabolicWay in(const auto& frame) const {
    return ParabolicWay({Vec3::Zero(), frame.to(w_), frame.to(a_), 0, false});
  }

 private:
  Vec3 w_, a_;  // m/s, m/s^2
};

/// Relative path of two paths that linear drag bends.
class FadingWay {
 public:
  static constexpr bool parabola = false;
  FadingWay(const FadingPath& pa, const FadingPath& pb) : pa_(pa), pb_(pb) {
    pa_.x = pb_.x = Vec3::Zero();
    if (pa.fade != pb.fade) return;
    // The common part is removed, so that it takes no digits.
    pb_.v -= exchange(pa_.v, Vec3::Zero());
    pb_.a -= exchange(pa_.a, Vec3::Zero());
  }

  Vec3 displacement(double t) const { return pb_.position(t) - pa_.position(t); }
  Vec3 velocity(double t) const { return pb_.velocity(t) - pa_.velocity(t); }
  Vec3 acceleration(double t) const { return pb_.acceleration(t) - pa_.acceleration(t); }
  /// The greatest rate of change of the acceleration from t on (m/s^3).
  double jerk(double t) const { return pa_.fade * pa_.acceleration(t).norm() + pb_.fade * pb_.acceleration(t).norm(); }
  double descent(const Vec3& n, double t, double gap, double rate, double horizon) const {
    const FadingDistance distance{
        gap, rate, {{{-n.dot(pa_.acceleration(t)), pa_.fade}, {n.dot(pb_.acceleration(t)), pb_.fade}}}};
    return first_descent(distance, horizon);
  }
  double back(const Vec3& n, double t, double rate, double horizon) const { return descent(n, t, 0, rate, horizon); }
  /// The displacement from t on, for `length` (s), by parts of that, and for how long that is accurate (s).
  PolynomialPath::Terms displacement_from(double t, double length) const {
    PolynomialPath::Terms terms = pb_.displacement_from(t, length);
    const PolynomialPath::Terms of_a = pa_.displacement_from(t, length);
    for (size_t k = 0; k < terms.size(); ++k) terms[k] -= of_a[k];
    return terms;
  }
  double span(double t) const { return min(pa_.span(t), pb_.span(t)); }
  FadingWay in(const auto& frame) const {
    FadingWay way = *this;
    for (Vec3* v : {&way.pa_.v, &way.pa_.a, &way.pb_.v, &way.pb_.a}) *v = frame.to(*v);
    return way;
  }

 private:
  FadingPath pa_, pb_;
};

/// Relative path of two polynomial paths.
class PolynomialWay {
 public:
  static constexpr bool parabola = false;
  /// displacement: m, as a polynomial in s = t / length (s).
  PolynomialWay(const PolynomialPath::Terms& displacement, double length) : terms_(displacement), length_(length) {}

  Vec3 displacement(double t) const { return PolynomialPath::value(terms_, t / length_); }
  Vec3 velocity(double t) const { return PolynomialPath::slope(terms_, t / length_) / length_; }
  Vec3 acceleration(double t) const { return PolynomialPath::bend(terms_, t / length_) / (length_ * length_); }
  double descent(const Vec3& n, double t, double gap, double rate, double horizon) const {
    const PolynomialPath::Terms on = PolynomialPath::shifted(terms_, t / length_, 1);
    Polynomial distance;
    distance.degree = PolynomialPath::terms;
    distance.c[0] = gap;
    distance.c[1] = rate * length_;
    for (size_t k = 1; k < PolynomialPath::terms; ++k) distance.c[k + 1] = n.dot(on[k]);
    const double s = first_descent(distance, horizon / length_);
    return s == never ? never : s * length_;
  }
  double back(const Vec3& n, double t, double rate, double horizon) const { return descent(n, t, 0, rate, horizon); }
  PolynomialPath::Terms displacement_from(double t, double length) const {
    return PolynomialPath::shifted(terms_, t / length_, length / length_);
  }
  double span(double) const { return infinity; }
  PolynomialWay in(const auto& frame) const {
    PolynomialWay way = *this;
    for (Vec3& term : way.terms_) term = frame.to(term);
    return way;
  }

 private:
  PolynomialPath::Terms terms_;  // m
  double length_;                // s
};

}  // namespace carom
