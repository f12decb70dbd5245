// Decides when bouncing ends in lasting contact: by inelastic collapse (McNamara & Young, Phys. Fluids A 4 (1992) 496),
// or by slow impacts under load. A limit on speed alone would miss a collapse, which can be fast. So impacts are
// counted for each body, over the time of a hop and over the distance that the body moves.
#include "simulate/contact/collapse_detector.h"

#include "physics/world.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

void CollapseDetector::count_in_turn(Entity i, double lost) {
  collapse_.write(i).lost += lost;
}

/// Counts a slow impact of body i. Returns whether it is one of many within a window of time (s).
bool CollapseDetector::in_burst(Entity i, double window, int many) {
  const double now = bodies_.now.hi;
  Burst& burst = burst_.write(i);
  if (now - burst.start > window) burst = {now, 0, false};
  return ++burst.impacts > many;
}

bool CollapseDetector::collapses(Entity i, Entity other, double e, double approach, double length) {
  // No impact has lost energy.
  if (e >= 1 && collapse_.empty()) return false;
  Collapse& collapse = collapse_.write(i);
  const double away = max(exact_tolerance::collapse_gap * length,
                          exact_tolerance::position_rounding * bodies_.flights[i].x.cwiseAbs().sum());
  if (approach * (bodies_.now - collapse.start) > away) collapse = {bodies_.now, 0};
  if (bodies_.body[i].origin_partner != other) collapse.lost = max(collapse.lost + 1 - e, 0.0);
  if (collapse.lost <= exact_tolerance::collapse_loss) return false;
  collapse.ended = bodies_.now;
  return true;
}

bool CollapseDetector::count_impact(Entity a, Entity b, double e, double approach, double press, double length,
                                    bool alone, bool again) {
  const bool body = bodies_.world.is_body(b);
  if (!again) {
    const bool collapse_a = collapses(a, b, e, approach, length);
    const bool collapse_b = body && collapses(b, a, e, approach, length);
    if (collapse_a || collapse_b) return true;
  }
  if (e >= 1 || !(press > 0)) return false;

  const double slow = bodies_.slow_speed(press, length);
  if (approach >= slow) return false;
  if (bodies_.in_contact(a) || (body && bodies_.in_contact(b))) return true;
  if (again) return false;

  // Alone on flat surfaces a body comes to rest on each of them in closed form. Only between several of them can it
  // continue for ever.
  const double window = 2 * slow / press;
  if (alone) return bodies_.body[a].origin_partner != b && in_burst(a, window, exact_tolerance::burst_on_surfaces);

  const bool burst_a = in_burst(a, window, exact_tolerance::burst_of_bodies);
  const bool burst_b = body && in_burst(b, window, exact_tolerance::burst_of_bodies);
  if (body) burst_.write(a).bodies = burst_.write(b).bodies = true;
  return burst_a || burst_b;
}

}  // namespace carom
