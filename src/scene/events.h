#pragma once
// Times of the World that events set (physics/trigger.h), as keys give them in place of numbers.

#include "physics/trigger.h"
#include "scene/decode.h"
#include "std.h"

namespace carom {

/// An end of a window of time, as decoding finds it.
struct WindowEnd {
  double time;                   // s; not_yet where an event sets it
  optional<uint32_t> trigger{};  // of the World
  double after = 0;              // s, from the event on
};

/// "{region: gate}", "{collision: [red, crate]}".
string event_text(const View& event);

class EventDecoder {
 public:
  EventDecoder(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics)
      : inventory_(inventory), scene_(scene), diagnostics_(diagnostics) {}

  /// The end that `key` of a map gives. `time`: s, its number or what holds without one. The event becomes a trigger of
  /// the World, unless it is one already. Regions must be decoded before.
  WindowEnd end(const View& view, string_view key, double time);
  /// Refuses a window that ends before it begins, as far as that is known before the run. `text`: the key that ends it.
  bool check(const View& view, const WindowEnd& from, const WindowEnd& until, string_view text = "until");
  /// Lets events set those ends of a window that have any: of item `index` of a list of the World.
  void wait(TriggeredEnd::Of of, size_t index, const WindowEnd& from, const WindowEnd& until, size_t window = 0);

 private:
  optional<Trigger> trigger_of(const View& event);
  optional<Trigger> collision_of(const Node& names);

  const Inventory& inventory_;
  Scene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace carom
