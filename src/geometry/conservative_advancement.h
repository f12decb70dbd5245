#pragma once
// The first contact of a point with a convex set, by conservative advancement with separating planes. The set lies
// wholly beyond the plane through its nearest point. Until the path arrives at that plane there is no contact. On a
// parabola that time is the root of a quadratic. The search moves there and repeats, so that no contact can be missed.
// Head on, this is Newton's method on a convex gap. Where the path only grazes, each step halves the rest. At the end
// the time is computed once more from the feature's own equation.

#include "geometry/contact_time.h"
#include "geometry/relative_way.h"
#include "geometry/separation.h"
#include "std.h"

namespace carom {

inline RelativeMotion in_frame(const auto& frame, const RelativeMotion& m) {
  return {frame.to(m.d), frame.to(m.w), frame.to(m.a), m.speeds, m.just_separated};
}

template <typename Set, typename Way = ParabolicWay>
class ConservativeAdvancement {
 public:
  /// far: the size of the positions of which motion.d is the difference (m).
  ConservativeAdvancement(const Set& set, const RelativeMotion& motion, double far, double horizon)
      : ConservativeAdvancement(set, motion, ParabolicWay(motion), far, horizon) {}
  /// On a path of another kind, which begins as `motion` does.
  ConservativeAdvancement(const Set& set, const RelativeMotion& motion, const Way& way, double far, double horizon)
      : set_(set), m_(motion), way_(way), far_(far), horizon_(horizon) {}

  FeatureTime run(uint8_t left) {
    left_ = left;
    if (left != no_feature && set_.sharp(left)) left_ = face_left(left, m_.d, m_.w, m_.a);
    if (left_ != no_feature) m_.d = set_.within(m_.d, left_);
    Separation s = left_ != no_feature ? set_.at(m_.d, left_) : set_.nearest(m_.d);
    if (left_ != no_feature) s.gap = 0;
    if (s.gap <= 0 && set_.sharp(s.feature)) s = set_.at(m_.d, set_.foremost_face(m_.d, s.feature));

    double t = 0;
    if (s.gap <= 0) {
      if (left == no_feature) s = over_the_edge(s, 0, m_.w);
      // From here on the gap is one that leaves from zero, whatever its rounding.
      left_ = s.feature;

      double speed = s.normal.dot(m_.w);
      if (std::abs(speed) <= noise(s.feature)) speed = 0;
      if (speed < 0) return {0, s.feature};
      t = leaves_until(s, 0, m_.w, speed);
      if (t == 0) return {0, s.feature};
    }

    // A path that leaves a curved surface with nearly its curvature takes thousands of steps to come clear of it.
    while (t <= horizon_) {
      s = separation_at(t);
      const Vec3 v = way_.velocity(t);
      const double speed = s.normal.dot(v);

      double on;
      if (s.gap > 0) {
        on = way_.descent(s.normal, t, s.gap, speed, horizon_ - t);
      } else {
        if (s.feature != left_) s = over_the_edge(s, t, v);
        double out = s.normal.dot(v);
        if (std::abs(out) <= noise(s.feature)) out = 0;
        on = out < 0 ? 0 : leaves_until(s, t, v, out);
        if (on == 0) return contact(t, s.feature);
      }
      if (on == never) return {never, no_feature};

      // At the plane, or as near to it as positions can tell.
      const Vec3 p = m_.d + displacement(t), there = m_.d + displacement(t + on);
      if (s.gap > 0 && (closed(s, p) || p == there)) {
        if (set_.sharp(s.feature)) s = set_.at(p, face_left(s.feature, p, v, way_.acceleration(t)));
        if (s.feature != left_) s = over_the_edge(s, t, v);
        double out = s.normal.dot(v);
        if (std::abs(out) <= noise(s.feature)) out = 0;

        // A curved surface may have turned away by the time the path arrives at the plane.
        if (out < 0 && p != there && !closed(separation_at(t + on), there)) {
          t += on;
          continue;
        }
        if (out < 0) return contact(t + on, s.feature);
        const double clear = leaves_until(s, t, v, out);
        // Pressed on hardly at all, it would arrive in steps that rounding hides.
        if (clear == 0) return contact(t + on, s.feature);
        on = max(on, clear);
        if (on == never) return {never, no_feature};
      }

      t = max(t + on, std::nextafter(t, never));
    }

    return {never, no_feature};
  }

 private:
  static constexpr double rounding = 0x1p-53;
  /// The rounding of a speed along the normal. On a curved surface the normal turns with the positions' rounding.
  double noise(uint8_t feature) const {
    const double turn = set_.flat(feature) ? 0 : far_ / set_.curvature_radius(m_.d, feature);
    return 16 * rounding * m_.speeds * (1 + turn);
  }
  /// Whether positions are too coarse to resolve the gap of a point at p.
  static bool closed(const Separation& s, const Vec3& p) {
    return s.gap <= 2 * rounding * s.normal.cwiseAbs().dot(p.cwiseAbs());
  }
  Vec3 displacement(double t) const { return way_.displacement(t); }

  Separation separation_at(double t) const {
    const Vec3 p = m_.d + displacement(t);
    const Separation s = set_.nearest(p);
    if (left_ == no_feature) return s;
    // The gap of `left_` is zero at the start by definition. Near the seam to the next feature, rounding must not
    // decide between the two.
    const double gap = set_.displaced_gap(m_.d, left_, 0, displacement(t));
    const double seam = 16 * rounding * (set_.size() + m_.d.cwiseAbs().sum());
    if (s.feature == left_ || (gap > s.gap && gap - s.gap <= seam)) return {gap, set_.at(p, left_).normal, left_};
    return s;
  }

  /// For a point within rounding of a sharp edge: the face over which it leaves or along which it slides, if there is
  /// one. Faces that lie in one plane, up to rounding, do not meet.
  Separation over_the_edge(const Separation& s, double t, const Vec3& v) const {
    const Vec3 p = m_.d + displacement(t);
    const double ahead = 8 * rounding * (set_.size() + far_);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 beyond = p + ahead * s.normal;
      beyond[axis] += std::copysign(ahead, p[axis]);
      const uint8_t edge = set_.nearest(beyond).feature;
      if (!set_.sharp(edge)) continue;
      const Separation other = set_.at(p, face_left(edge, p, v, way_.acceleration(t)));
      if (other.normal.dot(v) >= -noise(other.feature)) return other;
    }
    return s;
  }

  /// The time for which a path that leaves a closed gap at time t is surely outside. It is 0 if the path presses on
  /// instead.
  double leaves_until(const Separation& s, double t, const Vec3& v, double speed) const {
    const Vec3 relative_acceleration = way_.acceleration(t);
    const double acceleration = s.normal.dot(relative_acceleration);
    if (acceleration >= 0 || speed > 0) return way_.back(s.normal, t, speed, horizon_ - t);
    const double unsure = 16 * rounding * relative_acceleration.cwiseAbs().sum();
    // Rounding of the acceleration takes the path no deeper than rounding of positions.
    if (!Way::parabola && -acceleration <= unsure) return sqrt(rounding * (far_ + set_.size()) / unsure);
    const Vec3 p = m_.d + displacement(t);
    if (!(acceleration + set_.bending(p, s.feature, v) > 0)) return 0;
    // The path flies off along a curved surface that turns away faster than it does. The plane gives no information
    // here. A short step, relative to the surface's size, lifts the path off.
    constexpr double step = 0x1p-26;
    return step * min(set_.size() / v.norm(), sqrt(set_.size() / relative_acceleration.norm()));
  }

  /// Of the faces at a sharp edge, the one over which the point leaves.
  uint8_t face_left(uint8_t edge, const Vec3& p, const Vec3& v, const Vec3& a) const {
    uint8_t best = no_feature;
    double best_speed = 0, best_acceleration = 0;

    set_.for_each_face(edge, [&](uint8_t face) {
      const Vec3 n = set_.at(p, face).normal;
      const double speed = n.dot(v), acceleration = n.dot(a);
      const bool equal = std::abs(speed - best_speed) <= noise(face);

      if (best == no_feature || (equal ? acceleration > best_acceleration : speed > best_speed)) {
        best = face;
        best_speed = speed;
        best_acceleration = acceleration;
      }
    });

    return best;
  }

  /// The contact near time t, to the precision of the feature's own equation.
  FeatureTime contact(double t, uint8_t feature) const {
    if (set_.sharp(feature)) feature = set_.foremost_face(m_.d + displacement(t), feature);
    const bool is_left = feature == left_;
    const Separation start = set_.at(m_.d, feature);
    const double gap = is_left ? 0 : start.gap;

    // The closed form, from the start on. It is valid if it is the contact, and not another crossing of the feature's
    // surface.
    double closed = never;
    RelativeMotion reduced;
    double radius;
    if constexpr (!Way::parabola) {
      closed = never;
    } else if (set_.flat(feature)) {
      closed = plane_contact_time(gap, start.normal.dot(m_.w), start.normal.dot(m_.a), 0, is_left, horizon_);
    } else if (set_.as_spheres(feature, m_, reduced, radius)) {
      reduced.just_separated = is_left;
      closed = sphere_contact_time(reduced, radius, horizon_);
    }

    const auto tolerance = [&](double time) {
      double reach = m_.d.cwiseAbs().sum() + time * (m_.w.cwiseAbs().sum() + time * m_.a.cwiseAbs().sum());
      if constexpr (!Way::parabola) reach = m_.d.cwiseAbs().sum() + displacement(time).cwiseAbs().sum();
      return 64 * rounding * (reach + set_.size());
    };

    if (closed < never && std::abs(separation_at(closed).gap) <= tolerance(closed) &&
        (is_left || std::abs(set_.at(m_.d + displacement(closed), feature).gap) <= tolerance(closed)))
      return {closed, feature};

    // Newton's method on the feature's gap. Where the path only just touches the feature's rim, the method may find
    // another point of the extended surface.
    const double found = t;
    double last = never;
    for (int k = 0; k < 8; ++k) {
      const double slope = set_.at(m_.d + displacement(t), feature).normal.dot(way_.velocity(t));
      if (!(slope < 0)) break;

      double rest;
      if (is_left || !Way::parabola || !set_.rim_gap(feature, m_, t, rest))
        rest = set_.displaced_gap(m_.d, feature, gap, displacement(t));

      const double step = -rest / slope;
      if (!(std::abs(step) < 0.5 * last) || !(t + step >= 0) || t + step == t) break;
      last = std::abs(step);
      t += step;
    }

    if (t != found && std::abs(separation_at(t).gap) > tolerance(t)) t = found;
    if (t > horizon_) return {never, no_feature};
    return {t, feature};
  }

  const Set& set_;
  RelativeMotion m_;
  Way way_;
  double far_, horizon_;
  uint8_t left_ = no_feature;
};

}  // namespace carom
