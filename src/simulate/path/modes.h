#pragma once
// What moves each body now. A body has one mode at a time. ModeChanges (mode_changes.h) alone changes it, for the
// functions that are named below.
//
//     mode      what moves the body                             its velocity between two events
//     flying    forces alone                                    that of a free flight
//     settling  the same as `carried`, and its last bounces on  along the surfaces
//               a surface, too low to be followed, go on
//     carried   forces and flat surfaces: it slides, or lies    along the surfaces, or zero
//     fresh     its island, which has not taken a step yet      as the impact left it
//     held      its island, by constrained motion               along what it touches
//     stepped   its island, as a crowd                          straight, until the step's end
//     asleep    nothing: contact forces are in balance          exactly zero
//     part      the body that it has merged into                none of its own
//     gone      nothing: it has left the world                  none
//     awaited   nothing: it has yet to come into the world      none
//
// All changes, each with the function that makes it:
//
//     flying             -> settling   FlatContacts::add: bounces on a flat surface are too low to be followed
//     flying             -> carried    FlatContacts::add: it lies on one, from the start or out of an island
//     settling           -> carried    FlatContacts::end_bounces: they are over, which the collisions record; keep_at,
//                                      keep_pressing, remove: it is off that surface, and on another one
//     carried            -> settling   FlatContacts::add: it bounces on one more surface
//     settling, carried  -> flying     FlatContacts::keep_at, keep_pressing, remove, clear: it is off all surfaces
//     any of these       -> fresh      ExactGroup::join: lasting contact with anything but flat surfaces
//     any of these       -> fresh      ExactGroup::couple: a force between bodies sets in
//     fresh              -> held,      ExactGroup::unite: its island becomes one with an island in that mode
//                           stepped
//     held               -> stepped    ExactGroup::unite: its island becomes one with a crowd
//     fresh, stepped     -> held       ConstrainedMotion::begin_flights: its island takes a step this way
//     fresh, held        -> stepped    CrowdMotion::add_member: its island takes a step as a crowd
//     held               -> asleep     ConstrainedMotion::begin_flight: it and all that it touches neither move nor can
//     stepped            -> asleep     CrowdSleep::falls_asleep: the same
//     held               -> flying     ConstrainedMotion::begin_flight: nothing presses on it, or only flat surfaces do
//     stepped            -> flying     CrowdMotion::let_go: nothing has pressed on it for some steps
//     asleep             -> fresh      ExactGroup::wake: it is struck, pressed on or removed, or forces change
//     fresh, held,       -> flying     BodyMerging::end_flight: it merges, and leaves its island before
//       stepped
//     flying             -> part       BodyMerging::join, which takes it off its surfaces before
//     flying             -> gone       BodyRemoval::remove, which takes it off its surfaces before
//     flying             -> awaited    ExactSimulator::hold_back, at the start
//     awaited            -> flying     Appearances::admit: it comes into the world, where there is room for it
//     fresh, held,       -> gone       BodyRemoval::remove, which wakes a sleeper before
//       stepped
//
// A ball that falls on a pile is flying, fresh, held or stepped (perhaps by turns), and asleep in the end. A ball that
// falls on a flat floor is flying, settling and carried. It lies there as `carried`, and never sleeps.

#include "std.h"

namespace carom {

/// What moves a body now, as in the table above.
enum class Mode : uint8_t { flying, settling, carried, fresh, held, stepped, asleep, part, gone, awaited };
inline constexpr size_t number_of_modes = 10;

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
/// Whether its flight is a drift at the velocity of the middle of a crowd's step.
constexpr bool is_kicked(Mode mode) {
  return mode == Mode::stepped;
}
/// Whether it is neither a part of another body nor gone nor awaited.
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
      return to_one_of(settling, carried, fresh, part, gone, awaited);
    case settling:
      return to_one_of(flying, carried, fresh);
    case carried:
      return to_one_of(flying, settling, fresh);

    // In an island.
    case fresh:
      return to_one_of(flying, held, stepped, gone);
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
    case awaited:
      return to_one_of(flying);
  }
  return false;
}

}  // namespace carom
