#pragma once
// The one place where a body's mode changes. What hangs on the mode changes with it: the number of bodies at rest, the
// work of moving things on the body, and the lists of partners in contact.

#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "simulate/path/modes.h"
#include "std.h"

namespace carom {

struct ExactBodies;

class ModeChanges {
 public:
  explicit ModeChanges(ExactBodies& bodies);

  /// A free body flies by itself, or lies on flat surfaces. `settling`: its bounces on one of them have not ended.
  void fly(Entity i) { change(i, Mode::flying, false); }
  void lie(Entity i, bool settling) { change(i, settling ? Mode::settling : Mode::carried, false); }
  /// A body joins an island, or wakes.
  void join(Entity i) { change(i, Mode::fresh, false); }
  /// A member's island takes a step, or unites with one that does: by constrained motion or as a crowd.
  void constrain(Entity i) { change(i, Mode::held, presses_[i] != 0); }
  void step(Entity i) { change(i, Mode::stepped, presses_[i] != 0); }
  /// A thing presses on a member, or none does. The tally counts such bodies as at rest.
  void press(Entity i, bool pressed);
  /// A member leaves its island, at rest or to fly by itself.
  void fall_asleep(Entity i) { change(i, Mode::asleep, false); }
  void leave(Entity i);
  /// A body leaves the world: as a part of another one, or removed.
  void merge(Entity i) { change(i, Mode::part, false); }
  void remove(Entity i);
  /// A body has yet to come into the world, or comes into it.
  void hold_back(Entity i) { change(i, Mode::awaited, false); }
  void appear(Entity i) { change(i, Mode::flying, false); }

  /// The things that constrained motion keeps body i in contact with. Sleepers keep those of their last step.
  const vector<Entity>& partners(Entity i) const { return partners_[i]; }
  bool are_partners(Entity i, Entity e) const;
  /// Begins the lists of body i anew, and adds a thing to those of both.
  void clear_partners(Entity i);
  void add_partner(Entity i, Entity e);

  /// How often bodies have changed from one mode to another one.
  using Counts = array<array<uint64_t, number_of_modes>, number_of_modes>;  // from, to
  const Counts& counts() const { return counts_; }

  void keep(auto& archive) { archive(presses_, partners_, counts_); }

 private:
  void change(Entity i, Mode to, bool pressed);
  bool rests(Entity i) const;
  void part_from_partners(Entity i);

  ExactBodies& bodies_;
  LazyArray<uint8_t> presses_;          // by body: it is a member, and a thing presses on it
  LazyArray<vector<Entity>> partners_;  // by body
  Counts counts_{};
};

}  // namespace carom
