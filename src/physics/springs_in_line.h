#pragma once
// Springs with a rest length, on a body that moves along a line through their anchors.
// At an anchor such a spring's push turns round at once. A step towards the anchor continues as if it did not, and ends
// there.

#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct World;

class SpringsInLine {
 public:
  /// For a body at x (m) with velocity v (m/s) at `time` (s), where the acceleration is a (m/s^2).
  SpringsInLine(const World& world, Entity body, double time, const Vec3& x, const Vec3& v, const Vec3& a);

  /// Whether the body moves along such a line. The set is empty off the line, and without such a spring.
  bool any() const { return !springs_.empty(); }
  /// The acceleration at x (m) without a turn (m/s^2), from the acceleration by all forces there.
  /// Only its part along the line counts, because compressed springs would amplify rounding across it.
  Vec3 without_turn(const Vec3& x, const Vec3& acceleration) const {
    return along_.dot(acceleration + correction(x)) * along_;
  }
  /// The time (s) at which a path from x (m) first arrives at an anchor; infinity: not before its end.
  double arrival(const Vec3& x, const PolynomialPath& path) const;

 private:
  struct OneSpring {
    Vec3 anchor;  // m
    double push;  // m/s^2: stiffness times rest length, over the mass
    // 1 or -1: the body's side of the anchor, along the line.
    double side;
    // m: a smaller distance along the line counts as none.
    double rounded;
  };
  Vec3 correction(const Vec3& x) const;

  Vec3 along_ = Vec3::Zero();  // of length 1
  vector<OneSpring> springs_;
};

}  // namespace carom
