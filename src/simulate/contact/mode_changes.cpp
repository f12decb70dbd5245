// Every change goes through one function, which counts it. Bodies rest where a thing presses on them.
#include "simulate/contact/mode_changes.h"

#include "simulate/contact/exact_bodies.h"
#include "std.h"

namespace carom {

ModeChanges::ModeChanges(ExactBodies& bodies)
    : bodies_(bodies), presses_(bodies.body.size()), partners_(bodies.body.size()) {}

/// Whether the tally counts body i as at rest on a thing.
bool ModeChanges::rests(Entity i) const {
  const Mode mode = bodies_.mode(i);
  return mode == Mode::settling || mode == Mode::carried || mode == Mode::asleep || presses_[i] != 0;
}

void ModeChanges::change(Entity i, Mode to, bool pressed) {
  const Mode from = bodies_.mode(i);
  const bool rested = rests(i);
  bodies_.body[i].mode_ = to;
  if (pressed != (presses_[i] != 0)) presses_.write(i) = pressed;
  if (rests(i) != rested) rested ? bodies_.log.remove_resting(1) : bodies_.log.add_resting(1);
  if (from == to) return;

  ++counts_[size_t(from)][size_t(to)];
  // Moving things do work in another way from here on.
  if (is_free(from) != is_free(to) || is_member(from) != is_member(to)) bodies_.contact_work.change(i, bodies_.now, 0);
}

void ModeChanges::press(Entity i, bool pressed) {
  change(i, bodies_.mode(i), pressed);
}

void ModeChanges::leave(Entity i) {
  part_from_partners(i);
  change(i, Mode::flying, false);
}

void ModeChanges::remove(Entity i) {
  part_from_partners(i);
  change(i, Mode::gone, false);
}

bool ModeChanges::are_partners(Entity i, Entity e) const {
  return contains(partners_[i], e);
}

void ModeChanges::clear_partners(Entity i) {
  partners_.write(i).clear();
}

void ModeChanges::add_partner(Entity i, Entity e) {
  partners_.write(i).push_back(e);
  const Entity other = bodies_.world.second_body(e);
  // A string has one name for both of its ends.
  if (other != no_entity) partners_.write(other).push_back(bodies_.world.is_body(e) ? i : e);
}

/// Takes body i out of the lists of its partners. It may meet all these things again.
void ModeChanges::part_from_partners(Entity i) {
  if (partners_[i].empty()) return;
  for (const Entity e : partners_[i])
    if (bodies_.world.is_body(e)) std::erase(partners_.write(e), i);
  for (const Entity string : bodies_.ties.of(i))
    if (const Entity other = bodies_.ties.other(string, i); other != no_entity && !partners_[other].empty())
      std::erase(partners_.write(other), string);
  partners_.write(i).clear();
}

}  // namespace carom
