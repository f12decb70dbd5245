// Detects that events continue while the clock does not advance, and ends the run with an error.
// Elastic impacts and exits from regions count separately, with a limit a thousand times as high.
#include "simulate/impact/stall_guard.h"

#include <fmt/format.h>

#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

void StallGuard::count(Happened what, double now) {
  const bool impact = what == Happened::impact;
  const bool elastic = what == Happened::region_left || (impact && restitution_ == 1 && !moving_);
  const bool crossing = what == Happened::region_crossed;

  // A crossing is no part of an instant's rounds.
  if (!crossing) {
    if (now - instant_ > close_) {
      instant_ = now;
      at_instant_ = 0;
    }
    ++at_instant_;
  }

  if (impact) {
    highest_ = max(highest_, restitution_);
    lowest_ = min(lowest_, restitution_);
    moved_ = moved_ || moving_;
  }

  Watch& watch = elastic ? elastic_ : lossy_;
  const bool full = ++watch.events >= (elastic ? 1000 * many_ : many_);
  if (!full && watch.events % many_ != 0) return;

  // At a billionth of the duration in a million events a run would never end. The same holds for progress by the
  // clock's rounding.
  if (now - watch.checked <= exact_tolerance::clock_rounding * now ||
      (full && now - watch.since < exact_tolerance::least_progress * duration_)) {
    // The last of these that applies is the advice.
    const char* advice =
        " (jammed, or inelastic collapse): give them room, raise their restitution, or simulate.rest_speed";
    if (moved_)
      advice =
          " (jammed, or inelastic collapse): give them room, end or slow `motion` before, or raise their restitution";
    if (moved_ && lowest_ == 1)
      advice = " (things that move close in on them): end or slow their `motion` before, or shorten simulate.duration";
    if (crossing) advice = ": shorten simulate.duration, or remove the regions";
    if (elastic) advice = " (jammed, or masses too unequal): give them room, or shorten simulate.duration";
    if (highest_ > 1)
      advice = " (restitution above 1 adds energy at every collision): lower it, or shorten simulate.duration";

    throw SimulationError(fmt::format("at t = {} s bodies {} so often that the clock stands still{}", now,
                                      crossing ? "cross regions" : "collide", advice));
  }

  watch.checked = now;
  if (!full) return;
  watch.events = 0;
  watch.since = now;
  highest_ = 0;
  lowest_ = 1;
  moved_ = false;
}

}  // namespace carom
