#pragma once
// The motion of one thing as seen from another, along parabolas.
#include "numerics/vec3.h"

namespace carom {

/// Two points' relative motion: d = x_b - x_a (m), w = v_b - v_a (m/s), a = a_b - a_a (m/s^2).
struct RelativeMotion {
  Vec3 d, w, a;
  // |v_a| + |v_b|, m/s: the rounding of w has this scale.
  double speeds;
  // The two touch and have just collided. Their gap is zero by definition, not by computation.
  bool just_separated;
  // m, how far a fixed b is from its position at time 0: positions are rounded on this scale too.
  double moved = 0;
};

}  // namespace carom
