// The one place where a body's mode changes. What hangs on the mode changes with it: the number of bodies at rest, the
// work of moving things on the body, and the lists of partners in contact.
#include "simulate/modes.h"

#include <algorithm>

#include "simulate/exact_bodies.h"

namespace carom {

Modes::Modes(ExactBodies& bodies) : bodies_(bodies), presses_(bodies.body.size()), partners_(bodies.body.size()) {}

/// Whether the tally counts body i as at rest on a thing.
bool Modes::rests(Entity i) const {
  const Mode mode = bodies_.mode(i);
  return mode == Mode::settling || mode == Mode::carried || mode == Mode::asleep || presses_[i] != 0;
}

void Modes::change(Entity i, Mode to, bool pressed) {
  const Mode from = bodies_.mode(i);
  const bool rested = rests(i);
  bodies_.body[i].mode_ = to;
  if (pressed != (presses_[i] != 0)) presses_.write(i) = pressed;
  if (rests(i) != rested) rested ? bodies_.log.remove_resting(1) : bodies_.log.add_resting(1);
  if (from == to) return;

  ++changes_[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)];
  // Moving things do work in another way from here on.
  if (is_free(from) != is_free(to) || is_member(from) != is_member(to)) bodies_.contact_work.change(i, bodies_.now, 0);
}

void Modes::press(Entity i, bool pressed) {
  change(i, bodies_.mode(i), pressed);
}

void Modes::leave(Entity i) {
  part_from_partners(i);
  change(i, Mode::flying, false);
}

void Modes::remove(Entity i) {
  part_from_partners(i);
  change(i, Mode::gone, false);
}

bool Modes::are_partners(Entity i, Entity e) const {
  return std::ranges::find(partners_[i], e) != partners_[i].end();
}

void Modes::clear_partners(Entity i) {
  partners_.write(i).clear();
}

void Modes::add_partner(Entity i, Entity e) {
  partners_.write(i).push_back(e);
  const Entity other = bodies_.world.second_body(e);
  // A string has one name for both of its ends.
  if (other != no_entity) partners_.write(other).push_back(bodies_.world.is_body(e) ? i : e);
}

/// Takes body i out of the lists of its partners. It may meet all these things again.
void Modes::part_from_partners(Entity i) {
  if (partners_[i].empty()) return;
  for (const Entity e : partners_[i])
    if (bodies_.world.is_body(e)) std::erase(partners_.write(e), i);
  for (const Entity string : bodies_.ties.of(i))
    if (const Entity other = bodies_.ties.other(string, i); other != no_entity && !partners_[other].empty())
      std::erase(partners_.write(other), string);
  partners_.write(i).clear();
}

}  // namespace carom
