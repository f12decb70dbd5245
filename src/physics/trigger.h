#pragma once
// Events at which forces and motions set in or cease, and strings are cut. Each happens once at most: it is the first
// of its kind in a run.
//
// The times of a World that wait for one are not_yet until then. They lie ahead when they are set. A World with the
// times that events have set in the end is thus right at all times before, too.

#include "physics/collision.h"
#include "physics/world_region.h"
#include "std.h"

namespace carom {

/// A time (s) that an event has yet to set. It is finite, so that what waits for it does not count as for ever.
inline constexpr double not_yet = numeric_limits<double>::max();

/// The first entry of a body into one of these regions, or the first collision of one of `a` with one of `b`.
struct Trigger {
  optional<EntityRange> regions{};  // by number in the World
  // Of a collision. A string collides where it goes taut.
  EntityRange a{};
  EntityRange b{};

  friend bool operator==(const Trigger&, const Trigger&) = default;
};

/// An end of a window of time that an event sets.
struct TriggeredEnd {
  /// What has the window.
  enum class Of : uint8_t { force, body_spring, gravitation, motion, string };
  Of of = Of::force;
  uint32_t index = 0;   // of this, in its list of the World
  uint32_t window = 0;  // of a motion
  bool ends = false;    // its `until`
  uint32_t trigger = 0;
  double after = 0;  // s, from the event on
};

/// Events, and the times that wait for them.
struct Triggers {
  vector<Trigger> all;
  vector<TriggeredEnd> ends;
};

/// Whether a collision is the event, and whether a crossing is.
bool is_event(const Trigger& trigger, const Collision& collision);
bool is_event(const Trigger& trigger, const RegionCrossing& crossing);

}  // namespace carom
