#pragma once
// A motion in long double by extrapolation of the midpoint rule (Gragg, Bulirsch & Stoer; Hairer, Norsett & Wanner,
// Solving Ordinary Differential Equations I, II.9): a reference that shares no coefficient with the methods under test.

#include "std.h"

namespace carom {

using Long3 = array<long double, 3>;
struct LongState {
  Long3 x, v;
};
using LongForce = function<Long3(const Long3& x, const Long3& v)>;

/// One step of h (s) with `columns` extrapolations: order 2 columns.
inline LongState extrapolated_step(const LongState& s, long double h, const LongForce& a, int columns = 8) {
  const auto add = [&](const LongState& y, long double dt, const LongState& at) {
    LongState z = y;
    const Long3 f = a(at.x, at.v);
    for (int p = 0; p < 3; ++p) {
      z.x[p] += dt * at.v[p];
      z.v[p] += dt * f[p];
    }
    return z;
  };

  array<LongState, 16> t;
  for (int k = 0; k < columns; ++k) {
    const int n = 2 * (k + 1);
    const long double dt = h / n;
    LongState before = s, y = add(s, dt, s);
    for (int i = 1; i < n; ++i) {
      LongState next = add(before, 2 * dt, y);
      before = y;
      y = next;
    }
    t[k] = y;

    for (int l = k - 1; l >= 0; --l) {
      const long double ratio = static_cast<long double>(k + 1) / (l + 1), share = 1 / (ratio * ratio - 1);
      for (int p = 0; p < 3; ++p) {
        t[l].x[p] = t[l + 1].x[p] + share * (t[l + 1].x[p] - t[l].x[p]);
        t[l].v[p] = t[l + 1].v[p] + share * (t[l + 1].v[p] - t[l].v[p]);
      }
    }
  }

  return t[0];
}

}  // namespace carom
