#pragma once
// Springs with a rest length, on a body that moves along a line through their anchors. At an anchor such a spring's
// push turns round at once. A step that is to end there is carried on as if it did not.
#include <vector>

#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"

namespace carom {

struct World;

class SpringsInLine {
 public:
  /// Of a body at x (m) with velocity v (m/s) at `time` (s), and the acceleration a (m/s^2) there.
  SpringsInLine(const World& world, Entity body, double time, const Vec3& x, const Vec3& v, const Vec3& a);

  /// Whether the body moves along such a line. Off it, and without such a spring, there are none.
  bool any() const { return !springs_.empty(); }
  /// m/s^2: the acceleration at x (m) without a turn, of the one that forces give there; along the line, across which
  /// compressed springs would push rounding on.
  Vec3 without_turn(const Vec3& x, const Vec3& acceleration) const {
    return along_.dot(acceleration + correction(x)) * along_;
  }
  /// s: when a path from x (m) on first comes to an anchor; infinity: not before its end.
  double arrival(const Vec3& x, const PolynomialPath& path) const;

 private:
  struct OneSpring {
    Vec3 anchor;     // m
    double push;     // m/s^2: stiffness times rest length, over the mass
    double side;     // 1, -1: the body is on this side of it, along the line
    double rounded;  // m: what is less along the line is none
  };
  Vec3 correction(const Vec3& x) const;

  Vec3 along_ = Vec3::Zero();  // of length 1
  std::vector<OneSpring> springs_;
};

}  // namespace carom
