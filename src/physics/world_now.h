#pragma once
// The World with the times that events (trigger.h) have set.

#include "physics/world.h"
#include "std.h"

namespace carom {

/// Sets the times that wait for a trigger, which has happened at `time` (s).
void set_off(World& world, uint32_t trigger, double time);
/// The same for all that have happened. fired: s, by trigger; not_yet: it has not happened. Empty: none has.
void set_off(World& world, span<const double> fired);

/// Those that count at `time` (s): the others have not happened.
vector<double> fired_by(span<const double> fired, double time);

/// A World with the times that events have set so far.
class WorldNow {
 public:
  /// `given` must outlive this object. It is copied only where events set times.
  explicit WorldNow(const World& given);
  WorldNow(WorldNow&&) noexcept;
  ~WorldNow();

  /// fired: as above. Those of before stay. It is the same object throughout.
  const World& at(span<const double> fired);

 private:
  const World& given_;
  unique_ptr<World> own_;
  vector<double> fired_;
};

}  // namespace carom
