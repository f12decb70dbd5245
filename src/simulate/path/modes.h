#pragma once
// What moves each body now. A body has one mode at a time. ModeChanges (mode_changes.h) alone changes it.
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
//     settling, carried          -> flying             FlatContacts::keep_at, keep_pressing, remove: off all surfaces
//     flying, settling, carried  -> fresh              ExactGroup::join: lasting contact with other things
//     asleep                     -> fresh              ExactGroup::wake: struck, pressed on, or forces change
//     fresh                      -> held, stepped      ExactGroup::unite: the other island has taken steps
//     held                       -> stepped            ExactGroup::unite: the other island takes time steps
//     fresh, stepped             -> held               ConstrainedMotion::begin_flights: the island's next step
//     fresh, held                -> stepped            TimeStepping::begin_flights: the island's next step
//     held                       -> asleep, flying     ConstrainedMotion::begin_flight: at rest, or nothing binds it
//     stepped                    -> asleep, flying     TimeStepping::begin_flight: the same
//     flying                     -> part               BodyMerging::join, off all surfaces
//     flying                     -> gone               BodyRemoval::remove, off all surfaces
//     fresh, held, stepped       -> gone               BodyRemoval::remove, which wakes a sleeper before
//
// From its fall to its sleep in a pile a ball is flying, then fresh, then held or stepped, perhaps by turns, then
// asleep.
#include <cstddef>
#include <cstdint>

namespace carom {

/// What moves a body now, as in the table above.
enum class Mode : std::uint8_t { flying, settling, carried, fresh, held, stepped, asleep, part, gone };
inline constexpr std::size_t number_of_modes = 9;

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
  const auto to_one_of = [to](auto... some) { return ((to == some) || ...); };
  switch (from) {
    // Free.
    case flying:
      return to_one_of(settling, carried, fresh, part, gone);
    case settling:
      return to_one_of(flying, carried, fresh);
    case carried:
      return to_one_of(flying, settling, fresh);

    // In an island.
    case fresh:
      return to_one_of(held, stepped, gone);
    case held:
      return to_one_of(flying, stepped, asleep, gone);
    case stepped:
      return to_one_of(flying, held, asleep, gone);

    // At rest, or out of the world.
    case asleep:
      return to_one_of(fresh);
    case part:
    case gone:
      return false;
  }
  return false;
}

}  // namespace carom
