#pragma once
// What moves each body now. A body has one mode at a time, and this class alone changes it.
//
//     mode      what moves the body                          its velocity between two events
//     flying    forces alone                                 that of a free flight
//     settling  forces and flat surfaces, until bounces end  along the surfaces
//     carried   forces and flat surfaces                     along the surfaces
//     fresh     an island that has not taken a step yet      as before it joined
//     held      an island, by constrained motion             on the others' surfaces
//     stepped   an island, by time stepping                  straight or falling until the step's end
//     asleep    nothing: contact forces are in balance       exactly zero
//     part      the body that it has merged into             none of its own
//     gone      nothing: it has left the world               none
//
// All changes, each with the function that makes it:
//
//     flying                     -> settling, carried  FlatContacts::add: bounces on a surface are over
//     settling                   -> carried            FlatContacts::end_bounces: as recorded
//     carried                    -> settling           FlatContacts::add: bounces on one more surface
//     settling, carried          -> flying             FlatContacts: the body leaves all surfaces, or none presses
//     flying, settling, carried  -> fresh              ExactGroup::join: lasting contact with other things
//     asleep                     -> fresh              ExactGroup::wake: struck, pressed on, or forces change
//     fresh                      -> held, stepped      ExactGroup::unite: the other island has taken steps
//     held                       -> stepped            ExactGroup::unite: the other island takes time steps
//     fresh, stepped             -> held               ConstrainedMotion::apply: the island's next step
//     fresh, held                -> stepped            TimeStepping::begin_flights: the island's next step
//     held                       -> asleep, flying     ConstrainedMotion::apply: at rest, or nothing binds the body
//     stepped                    -> asleep, flying     TimeStepping::begin_flight: the same
//     flying                     -> part               BodyMerging::join, off all surfaces
//     flying                     -> gone               BodyRemoval::remove, off all surfaces
//     fresh, held, stepped       -> gone               BodyRemoval::remove, which wakes a sleeper before
//
// From its fall to its sleep in a pile a ball is flying, fresh, held or stepped, and asleep.
#include <array>
#include <cstdint>
#include <vector>

#include "physics/entity.h"
#include "simulate/lazy_array.h"

namespace carom {

struct ExactBodies;

/// What moves a body now, as in the table above.
enum class Mode : std::uint8_t { flying, settling, carried, fresh, held, stepped, asleep, part, gone };
inline constexpr std::size_t modes = 9;

/// Whether the body moves by itself or on flat surfaces.
constexpr bool is_free(Mode mode) {
  return mode <= Mode::carried;
}
/// Whether it lies on flat surfaces, or bounces on one of them ever lower.
constexpr bool lies_on_flat(Mode mode) {
  return mode == Mode::settling || mode == Mode::carried;
}
/// Whether it is a member of an island.
constexpr bool is_member(Mode mode) {
  return Mode::fresh <= mode && mode <= Mode::stepped;
}
/// Whether it is a member of an island, or asleep.
constexpr bool in_lasting_contact(Mode mode) {
  return Mode::fresh <= mode && mode <= Mode::asleep;
}
/// Whether its island takes time steps, or no step yet. Its velocity may then contain a kick.
constexpr bool may_be_kicked(Mode mode) {
  return mode == Mode::fresh || mode == Mode::stepped;
}
/// Whether it is in the world by itself.
constexpr bool is_in_world(Mode mode) {
  return mode < Mode::part;
}

/// Whether the table above has this change.
constexpr bool may_become(Mode from, Mode to) {
  using enum Mode;
  switch (from) {
    case flying:
      return to == settling || to == carried || to == fresh || to == part || to == gone;
    case settling:
      return to == flying || to == carried || to == fresh;
    case carried:
      return to == flying || to == settling || to == fresh;
    case fresh:
      return to == held || to == stepped || to == gone;
    case held:
      return to == flying || to == stepped || to == asleep || to == gone;
    case stepped:
      return to == flying || to == held || to == asleep || to == gone;
    case asleep:
      return to == fresh;
    case part:
    case gone:
      return false;
  }
  return false;
}

class Modes {
 public:
  explicit Modes(ExactBodies& bodies);

  /// A free body flies by itself, or lies on flat surfaces. `settling`: its bounces on one of them have not ended.
  void fly(Entity i) { change(i, Mode::flying, false); }
  void carry(Entity i, bool settling) { change(i, settling ? Mode::settling : Mode::carried, false); }
  /// A body joins an island, or wakes.
  void join(Entity i) { change(i, Mode::fresh, false); }
  /// A member's island takes a step, or unites with one that does: by constrained motion or in time steps.
  void hold(Entity i) { change(i, Mode::held, presses_[i] != 0); }
  void step(Entity i) { change(i, Mode::stepped, presses_[i] != 0); }
  /// A thing presses on a member, or none does. The tally counts such bodies as at rest.
  void press(Entity i, bool pressed);
  /// A member leaves its island, at rest or to fly by itself.
  void fall_asleep(Entity i) { change(i, Mode::asleep, false); }
  void leave(Entity i);
  /// A body leaves the world: as a part of another one, or removed.
  void merge(Entity i) { change(i, Mode::part, false); }
  void remove(Entity i);

  /// The things that constrained motion keeps body i in contact with. Sleepers keep those of their last step.
  const std::vector<Entity>& partners(Entity i) const { return partners_[i]; }
  bool are_partners(Entity i, Entity e) const;
  /// Begins the lists of body i anew, and adds a thing to those of both.
  void clear_partners(Entity i);
  void add_partner(Entity i, Entity e);

  /// How often bodies have changed from one mode to another one.
  using Changes = std::array<std::array<std::uint64_t, modes>, modes>;  // from, to
  const Changes& changes() const { return changes_; }

 private:
  void change(Entity i, Mode to, bool pressed);
  bool rests(Entity i) const;
  void part_from_partners(Entity i);

  ExactBodies& bodies_;
  LazyArray<std::uint8_t> presses_;          // by body: it is a member, and a thing presses on it
  LazyArray<std::vector<Entity>> partners_;  // by body
  Changes changes_{};
};

}  // namespace carom
