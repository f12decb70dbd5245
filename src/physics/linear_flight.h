#pragma once
// Flight under constant forces and linear drag: x'' = pull - fade x', a straight line that bends towards the speed
// pull / fade. Of arithmetic, only + - * / reach the result.
#include "physics/vec3.h"

namespace carom {

struct LinearFlight {
  Vec3 pull = Vec3::Zero();  // m/s^2, of a body that stands
  double fade = 0;           // 1/s

  /// After t (s), which must not be longer than half of 1 / fade: x (m), v (m/s) in and out.
  void carry(double t, Vec3& x, Vec3& v) const {
    const double z = fade * t;
    double bend = 0;  // (exp(-z) - 1 + z) / z^2 = 1/2! - z/3! + z^2/4! - ...
    for (int n = terms; n >= 0; --n) bend = (1 - z * bend) / (n + 2);
    const double along = t * (1 - z * bend);  // s, (1 - exp(-z)) / fade
    x += along * v + (t * t * bend) * pull;
    v += along * (pull - fade * v);
  }

 private:
  static constexpr int terms = 14;  // to rounding
};

}  // namespace carom
