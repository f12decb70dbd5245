// All impacts at one instant: from the bodies to a set of rows, round by round, and back. What decides about a row is
// decided before each round, from the velocities that it meets (impact_rules.h).
#include "simulate/impact/instant_impacts.h"

#include "geometry/contact_time.h"
#include "physics/impact.h"
#include "physics/state.h"
#include "physics/world.h"
#include "simulate/contact/contact_list.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flight_changes.h"
#include "simulate/impact/impact_rules.h"
#include "simulate/impact/stall_guard.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

double InstantImpacts::close_times(const State& initial) const {
  double extent = 0;   // m
  double fastest = 0;  // m/s
  for (const Vec3& x : initial.position) extent = max(extent, x.cwiseAbs().sum());
  for (const Vec3& v : initial.velocity) fastest = max(fastest, v.norm());
  for (const double radius : bodies_.world.radius) extent = max(extent, radius);
  fastest = max(fastest, sqrt(bodies_.world.gravity.norm() * extent));
  return tol::tie_of_places * (fastest > 0 ? extent / fastest : bodies_.options.duration);
}

bool InstantImpacts::strike(const Due& due) {
  Moment now(parts_.group.numbers, bodies_.options.one_by_one);
  add_due(now, due);

  // Impacts elsewhere belong to it where touching bodies connect them.
  gather_all(now);
  Rows approaching = find_approaching(now);

  // The first one alone: an impact of two, or a string that goes taut without an impact. Without room to rebound,
  // impacts of two have no end, and with e = 0 what touches stays closed.
  const Touching& first = now.touching.front();
  const bool string = bodies_.world.is_string(first.thing);
  const bool meets = contains(approaching, 0u);
  const bool stays =
      now.set.rows() > 1 && pair_restitution(bodies_.world, first.a, first.thing) == 0 && !leaves_asleep(first);
  const bool endless = parts_.guard.may_be_endless() && !now.set.has_room();
  if (!string && (!meets || (approaching.size() == 1 && !now.set.linked() && !stays && !endless))) return false;
  if (!meets) hold_string(now);

  // Round follows round until nothing approaches.
  while (!approaching.empty()) {
    if (now.set.may_be_endless()) {
      gather_all(now);
      const auto& ended = now.set.end_endless(approaching);
      if (now.set.certificate().verdict == Certificate::Verdict::infeasible) check_room(now);
      if (!ended.empty()) {
        for (const ImpactSet::Impact& impact : ended) now.absorbed += now.set.without_room() ? impact.lost : 0;
        apply(now, ended, true);
        break;
      }
    }

    end_steps(now, approaching);
    now.resting.assign(now.members.size(), 0);
    for (const uint32_t c : approaching) decide(now, c);
    const auto& impacts = now.set.strike(approaching);
    if (now.set.certificate().verdict == Certificate::Verdict::infeasible) check_room(now);
    if (impacts.empty()) break;  // what approaches is rounding beside the speeds of what links connect
    apply(now, impacts, false);
    parts_.guard.count(StallGuard::Happened::impact, bodies_.now.hi);
    approaching = find_approaching(now);
  }

  apply(now, now.set.finish(), true);
  book(now);
  note_open(now);
  return true;
}

/// The number of body i in the set, to which it is added.
uint32_t InstantImpacts::member_number(Moment& now, Entity i) const {
  if (now.members.add(i)) {
    now.set.add_body(bodies_.world.mass[i], bodies_.velocity(i));
    now.gathered.push_back(0);
    now.struck.push_back(0);
  }
  return now.members.number(i);
}

void InstantImpacts::add_row(Moment& now, Entity a, Entity thing, const Touch& there, ImpactSet::Kind kind) const {
  const Entity b = bodies_.world.second_body(thing);
  ImpactSet::Row row;
  row.a = member_number(now, a);
  row.b = b == no_entity ? ImpactSet::fixed : member_number(now, b);
  row.normal = there.normal;
  row.place = bodies_.position(a) + (b == no_entity ? bodies_.position(a) : bodies_.position(b));
  row.kind = kind;
  if (b == no_entity && !bodies_.world.is_string(thing)) row.surface = there.normal.dot(bodies_.fixed_velocity(thing));
  now.set.add_row(row);
  now.touching.push_back({a, thing, there.feature, there});
}

/// Whether the two things have a row.
bool InstantImpacts::is_known(const Moment& now, Entity a, Entity thing) {
  const uint32_t number = now.members.number(a);
  return number != Numbering::none && any_of(now.set.rows_of(number), [&](uint32_t c) {
           return now.touching[c].a == a && now.touching[c].thing == thing;
         });
}

/// Adds an impact that is due. It is the row that was predicted, however rounding sees its gap.
void InstantImpacts::add_due(Moment& now, const Due& due) const {
  const World& world = bodies_.world;
  const bool pair = world.is_body(due.thing);
  const Entity a = pair                         ? min(due.body, due.thing)
                   : world.is_string(due.thing) ? world.string(due.thing).body
                                                : due.body;
  const Entity thing = pair ? max(due.body, due.thing) : due.thing;
  const Touch there = pair ? rules_.find_pair(a, thing, due.feature).there
                      : world.is_string(thing)
                          ? bodies_.string_now(thing)
                          : bodies_.touch_at(a, bodies_.position(a), thing, bodies_.fixed_position(thing), due.feature);
  add_row(now, a, thing, there, ImpactSet::Kind::touching);
  now.touching.back().feature = due.feature;
}

/// The gap (m) of two things that touch. In lasting contact it is that of constrained motion, elsewhere the rounding of
/// places.
double InstantImpacts::near_gap(Entity i, Entity thing) const {
  const Entity second = bodies_.world.second_body(thing);
  const Vec3 x = bodies_.position(i);
  const Vec3 xe = bodies_.position_of(thing);
  const bool lasting =
      in_lasting_contact(bodies_.mode(i)) && (second == no_entity || in_lasting_contact(bodies_.mode(second)));
  const double rounding = tol::initial_rounding * (x.cwiseAbs().sum() + xe.cwiseAbs().sum() + bodies_.world.radius[i]);
  if (bodies_.world.is_string(thing)) return max(rounding, bodies_.contact_gap(i, x, xe));
  return lasting ? max(rounding, tol::drift * bodies_.world.radius[i]) : rounding;
}

/// Adds all that touches body i, and the strings and rods that hold it.
void InstantImpacts::gather(Moment& now, Entity i) const {
  const World& world = bodies_.world;
  const uint32_t number = member_number(now, i);
  if (now.gathered[number]) return;
  now.gathered[number] = 1;
  if (bodies_.ties.any()) gather_strings(now, i);
  if (bodies_.mode(i) == Mode::stepped) return;

  const Vec3 x = bodies_.position(i);
  for (const Entity e : bodies_.neighbours_of(i)) {
    const bool body = world.is_body(e);
    if (body && (!is_in_world(bodies_.mode(e)) || bodies_.mode(e) == Mode::stepped)) continue;
    const Entity a = body ? min(i, e) : i;
    const Entity thing = body ? max(i, e) : e;
    if (is_known(now, a, thing)) continue;

    const Vec3 xe = bodies_.position_of(e);
    const double near = near_gap(i, e);
    if (body && (xe - x).norm() > world.radius[i] + world.radius[e] + 2 * near) continue;

    const Touch there = body ? rules_.find_pair(a, thing, no_feature).there : bodies_.touch_at(i, x, e, xe, no_feature);
    if (there.gap <= near && presses({a, thing, there.feature, there}))
      add_row(now, a, thing, there, ImpactSet::Kind::touching);
  }
}

/// The same for strings: those that hold are links, and slack ones that have reached their length are rows.
void InstantImpacts::gather_strings(Moment& now, Entity i) const {
  for (const Entity string : bodies_.ties.of(i)) {
    const String& s = bodies_.world.string(string);
    if (is_known(now, s.body, string)) continue;
    const Touch there = bodies_.string_now(string);
    const bool holds = bodies_.holds(string);
    if (!holds && (s.rod || there.gap > near_gap(s.body, string))) continue;

    const ImpactSet::Kind kind = !holds  ? ImpactSet::Kind::touching
                                 : s.rod ? ImpactSet::Kind::rod
                                         : ImpactSet::Kind::taut;
    add_row(now, s.body, string, there, kind);
    if (!holds) continue;
    for (const Entity end : {s.body, s.other})
      if (end != no_entity) gather(now, end);
  }
}

/// Adds all that touches, directly or through others.
void InstantImpacts::gather_all(Moment& now) const {
  for (size_t k = 0; k < now.members.size(); ++k) gather(now, now.members[k]);
}

/// Whether a row that approaches can be struck, in the present modes of its bodies.
bool InstantImpacts::may_strike(const Moment& now, uint32_t c) const {
  const Touching& row = now.touching[c];
  const Entity i = row.a;
  const double approach = now.set.approach(c);
  if (bodies_.world.is_string(row.thing)) return approach > bodies_.negligible_speed();
  if (!(approach > bodies_.negligible_speed())) return false;

  // The error of paths that constrained motion has. Its next step removes it.
  if (bodies_.world.is_body(row.thing)) {
    const Entity e = row.thing;
    if (bodies_.mode(i) == Mode::held && bodies_.mode(e) == Mode::held &&
        approach <= bodies_.drift_of(i, bodies_.velocity(i), bodies_.velocity(e)))
      return false;
    return bodies_.world.volume.empty() || meets_by_volume(row, bodies_.velocity(e) - bodies_.velocity(i));
  }

  if (lies_on_flat(bodies_.mode(i)) && (parts_.flat.carries(i, row.thing) || parts_.flat.hides(i, row.thing)))
    return false;
  if (bodies_.mode(i) == Mode::held && parts_.group.hides(i, row.thing)) return false;
  return bodies_.world.volume.empty() || meets_by_volume(row, bodies_.fixed_velocity(row.thing) - bodies_.velocity(i));
}

/// Whether volumes that touch meet at this relative velocity (m/s). Faces that pass in one plane do not.
bool InstantImpacts::meets_by_volume(const Touching& row, const Vec3& velocity) const {
  const Vec3 between = bodies_.position_of(row.thing) - bodies_.position(row.a);
  const double soon = 4 * near_gap(row.a, row.thing) / row.there.normal.dot(-velocity);  // s
  const RelativeMotion motion{between, velocity, Vec3::Zero(), velocity.cwiseAbs().sum(), false};
  return time_of_impact(bodies_.world, row.a, row.thing, motion, no_feature, soon).time <= soon;
}

/// Whether an impact is too slow to wake one of its bodies, which counts as fixed then.
bool InstantImpacts::leaves_asleep(const Touching& row) const {
  return bodies_.world.is_body(row.thing) &&
         rules_.left_asleep(rules_.find_pair(row.a, row.thing, row.feature)) != no_entity;
}

/// Whether two things that touch would press on each other if they were pushed together. Those that share an edge of
/// volumes alone do not.
bool InstantImpacts::presses(const Touching& row) const {
  return bodies_.world.volume.empty() || meets_by_volume(row, -row.there.normal);
}

/// The rows that approach, and can be struck. Bodies that take part bring all that touches them.
InstantImpacts::Rows InstantImpacts::find_approaching(Moment& now) const {
  Rows approaching;
  for (uint32_t c = 0; c < now.set.rows(); ++c) {
    if (!now.set.approaches(c) || !may_strike(now, c)) continue;
    approaching.push_back(c);
    const Entity second = bodies_.world.second_body(now.touching[c].thing);
    for (const Entity i : {now.touching[c].a, second})
      if (i != no_entity) gather(now, i);
  }
  return approaching;
}

/// Ends the steps of bodies with methods of their own.
void InstantImpacts::end_steps(Moment& now, const Rows& approaching) {
  const bool ties = bodies_.ties.any();
  if (!bodies_.in_steps && !ties) return;
  for (const uint32_t c : approaching) {
    const Entity second = bodies_.world.second_body(now.touching[c].thing);
    for (const Entity i : {now.touching[c].a, second}) {
      if (i == no_entity || now.struck[now.members.number(i)]) continue;
      now.struck[now.members.number(i)] = 1;
      parts_.flights.end_step(i);
      now.set.set_velocity(now.members.number(i), bodies_.velocity(i));
      parts_.flights.note_changed(i);
    }
  }
}

/// Throws SimulationError where things that move leave a body no room, or strings hold it against one.
void InstantImpacts::check_room(const Moment& now) const {
  ContactList rows;
  vector<Vec3> velocities;
  for (uint32_t k = 0; k < now.set.bodies(); ++k) velocities.push_back(now.set.velocity(k));
  for (uint32_t c = 0; c < now.set.rows(); ++c) {
    const ImpactSet::Row& row = now.set.row(c);
    ContactConstraint pair{row.a, row.b, row.normal};
    pair.surface = row.surface;
    pair.bilateral = row.kind == ImpactSet::Kind::rod;
    rows.add(pair, {now.touching[c].a, now.touching[c].thing, now.touching[c].feature}, now.touching[c].there.gap);
  }
  rows.check_room(bodies_, velocities);
}

/// Decides how the next impact of a row ends.
void InstantImpacts::decide(Moment& now, uint32_t c) {
  Touching& row = now.touching[c];
  if (bodies_.world.is_string(row.thing))
    decide_string(row);
  else
    bodies_.world.is_body(row.thing) ? decide_pair(row) : decide_fixed(now, row);

  row.counted = true;
  bodies_.note_speed(row.a, bodies_.velocity(row.a));
  parts_.guard.note_restitution(row.e, bodies_.world.moves(row.thing));
  now.set.set_restitution(c, row.ends || row.rests ? 0 : row.e);
}

void InstantImpacts::decide_string(Touching& row) {
  const StringImpact impact = rules_.find_string(row.thing);
  row.e = impact.e;
  row.press = impact.press;
  row.length = impact.length;
  row.ends = rules_.ends(impact, row.counted);
}

void InstantImpacts::decide_pair(Touching& row) {
  const PairImpact impact = rules_.find_pair(row.a, row.thing, row.feature);
  row.e = impact.e;
  row.press = impact.press;
  row.length = impact.length;
  row.pressed = impact.press > 0 || rules_.pressed(row.a, row.thing) > 0;
  row.ends = rules_.ends(impact, row.counted);
  bodies_.note_speed(row.thing, impact.vb);
  bodies_.log.note_overlap(-impact.there.gap);
}

void InstantImpacts::decide_fixed(Moment& now, Touching& row) {
  const FixedImpact impact = rules_.find_fixed(row.a, row.thing, row.feature);
  if (bodies_.moving.any()) rules_.check_room(impact);
  row.e = impact.e;
  row.press = impact.press;
  row.length = bodies_.world.radius[row.a];
  row.pressed = impact.press > 0 || rules_.pressed(row.a, row.thing) > 0;

  // More surfaces than a body lies on by itself carry it as an island.
  uint8_t& resting = now.resting[now.members.number(row.a)];
  row.rests = rules_.comes_to_rest(impact, row.contact) && parts_.flat.has_room(row.a, resting);
  resting += row.rests;
  row.ends = !row.rests && rules_.ends(impact, row.counted);
  bodies_.log.note_overlap(-impact.there.gap);
}

/// Applies what a round has changed. `last`: the end of endless rounds, in contact.
void InstantImpacts::apply(Moment& now, span<const ImpactSet::Impact> impacts, bool last) {
  if (impacts.empty()) return;
  for (const ImpactSet::Impact& impact : impacts) {
    Touching& row = now.touching[impact.row];
    if (last) {
      row.ends = true;
      row.rests = false;
    }
    note(now, impact, last);
  }

  begin_flights(now, impacts);
  unite_ended(now, impacts);
}

/// Begins the flights of the bodies that a round has struck.
void InstantImpacts::begin_flights(Moment& now, span<const ImpactSet::Impact> impacts) {
  const World& world = bodies_.world;
  vector<FlightOrigin> origin(now.members.size());
  vector<Vec3> down(now.members.size(), Vec3::Zero());  // m

  for (const ImpactSet::Impact& impact : impacts) {
    const Touching& row = now.touching[impact.row];
    const Entity second = world.second_body(row.thing);
    for (const Entity i : {row.a, second}) {
      if (i == no_entity) continue;
      if (row.ends || bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
      parts_.group.note_needed(i);
      const Entity other = i == row.a ? row.thing : world.is_string(row.thing) ? row.thing : row.a;
      origin[now.members.number(i)] = {other, row.feature};
    }
    if (row.ends && second != no_entity) parts_.group.unite_fresh(row.a, second);

    // A flat surface carries the body from here on, unless its island does, which another impact of the round has made.
    if (!row.rests) continue;
    if (!is_member(bodies_.mode(row.a))) {
      if (!row.contact.settling) parts_.flat.remove_level(row.a, row.contact.normal);
      if (!parts_.flat.carries(row.a, row.thing)) parts_.flat.add(row.a, row.contact);
    }
    down[now.members.number(row.a)] += row.there.gap * row.there.normal;
  }

  vector<uint32_t> changed = now.set.changed();
  ranges::sort(changed, [&](uint32_t k, uint32_t l) { return now.members[k] < now.members[l]; });
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const uint32_t k : changed) {
    const Entity i = now.members[k];
    if (bodies_.mode(i) == Mode::asleep) parts_.group.join(i);
    bodies_.note_speed(i, bodies_.velocity(i));
    parts_.flights.begin(i, bodies_.position(i) + down[k], parts_.flat.keep_at(i, now.set.velocity(k)), origin[k]);
    now.set.set_velocity(k, bodies_.velocity(i));
  }
  for (const uint32_t k : changed) gather(now, now.members[k]);
}

/// Unites the bodies whose impacts have ended in contact.
void InstantImpacts::unite_ended(Moment& now, span<const ImpactSet::Impact> impacts) {
  for (const ImpactSet::Impact& impact : impacts) {
    const Touching& row = now.touching[impact.row];
    if (!row.ends) continue;
    const Entity second = bodies_.world.second_body(row.thing);
    if (!bodies_.world.is_string(row.thing)) {
      for (const Entity i : {row.a, second}) {
        if (i == no_entity) continue;
        parts_.group.await_step(i);
        parts_.flights.note_changed(i);
      }
    }
    if (second != no_entity) parts_.group.unite(row.a, second);

    // A string that holds connects the islands of its bodies. Their next step is due.
    if (bodies_.world.is_string(row.thing)) bodies_.islands.of(row.a).end = bodies_.now;
  }
}

/// Lets the first row, a string that has reached its length without an approach, hold from here on.
void InstantImpacts::hold_string(Moment& now) {
  end_steps(now, {0});
  const Touching& row = now.touching.front();
  const Entity second = bodies_.world.second_body(row.thing);
  for (const Entity i : {row.a, second}) {
    if (i == no_entity) continue;
    parts_.group.join(i);
    parts_.flights.begin(i, bodies_.position(i), parts_.flat.keep_at(i, bodies_.velocity(i)), {row.thing, 0});
    now.set.set_velocity(now.members.number(i), bodies_.velocity(i));
  }
  if (second != no_entity) parts_.group.unite(row.a, second);
  bodies_.islands.of(row.a).end = bodies_.now;
}

/// Keeps what a round did to a row. An inelastic impact goes on until the end.
void InstantImpacts::note(Moment& now, const ImpactSet::Impact& impact, bool last) const {
  Touching& row = now.touching[impact.row];
  const bool inelastic = now.set.row(impact.row).restitution == 0;
  if (last) {
    now.records.push_back({impact.row, true, row.e, impact.approach, 0, impact.impulse, impact.lost});
    return;
  }

  if (inelastic && row.record != none) {
    now.records[row.record].impulse += impact.impulse;
    now.records[row.record].lost += impact.lost;
    return;
  }
  const bool settles = row.rests && row.contact.settling;
  row.record = inelastic && !(settles && row.contact.residual_speed > 0) ? now.records.size() : none;
  const double approach = max(impact.approach, 0.0);  // of a pair that others press, rounding
  now.records.push_back({impact.row, row.ends, row.e, approach, impact.separation, impact.impulse, impact.lost});
  Record& record = now.records.back();
  if (inelastic) record.separation = 0;

  // The record of a rest has the energy of bounces that are left out, unless a level surface has taken over.
  if (!row.rests) return;
  record.ends = !settles;
  if (!settles) return;
  record.separation = row.contact.residual_speed;
  record.lost -= impact_loss(bodies_.world.mass[row.a], ExactBodies::immovable, record.separation, 0);
}

/// Shares among the others what a row has given back, and what it has lost where later rounds have taken back all of
/// its impulse. Such a row is dropped. Impulses of one round may end in a later one, through another row. Impacts with
/// e above 1 make their energy themselves.
void InstantImpacts::share_gains(Moment& now) {
  double greatest = 0;  // N s
  for (const Record& of : now.records) greatest = max(greatest, of.impulse);

  double lost = 0;    // J
  double others = 0;  // J
  for (Record& of : now.records) {
    if (of.e > 1) continue;
    if (of.impulse <= tol::impulse_rounding * greatest) of.impulse = 0;
    const bool keeps = of.impulse > 0 && of.lost > 0;
    (keeps ? lost : others) += of.lost;
    if (!keeps) of.lost = 0;
  }
  std::erase_if(now.records, [](const Record& of) { return of.impulse == 0; });
  if (others == 0) return;

  // More than all can only be rounding.
  if (lost + others < 0) bodies_.log.deviate(lost + others);
  const double share = lost > 0 ? max(lost + others, 0.0) / lost : 0;
  for (Record& of : now.records)
    if (of.e <= 1) of.lost *= share;
}

/// Counts an outcome that rigid bodies leave open, and impacts without room.
void InstantImpacts::note_open(const Moment& now) {
  const optional<ImpactSet::OpenOutcome>& open = now.set.open_outcome();
  if (!open && !now.set.without_room()) return;
  SharedImpacts all;
  all.without_room = now.set.without_room();
  all.absorbed = now.absorbed;

  if (open) {
    all.instants = 1;
    all.ties = now.set.tied();
    all.first = bodies_.now.hi;
    all.body = now.members[open->body];
    const auto met = [&](uint32_t c) {
      return now.touching[c].a == all.body ? now.touching[c].thing : now.touching[c].a;
    };
    all.one = met(open->row);
    all.other = met(open->other);
  }
  bodies_.log.note(all);
}

/// Books the energy of all impacts, and records those that have not ended in contact.
void InstantImpacts::book(Moment& now) {
  const World& world = bodies_.world;
  bodies_.log.note(now.set.certificate());
  share_gains(now);

  for (const Record& of : now.records) {
    const Touching& row = now.touching[of.row];
    if (in_lasting_contact(bodies_.mode(row.a)))
      parts_.group.note_parted(row.a, row.thing, of.separation > 0 && !row.pressed);
    const CollisionKind kind = impact_kind(world, row.thing);
    bodies_.contact_work.impulses.strike(bodies_.now, row.a, row.thing, of.impulse);
    if (kind == CollisionKind::body_fixed && bodies_.moving.any())
      bodies_.log.add_work(-of.impulse * row.there.normal.dot(bodies_.fixed_velocity(row.thing)));

    rules_.book({bodies_.now.hi, kind, row.a, row.thing, row.there.point, row.there.normal, of.approach, of.separation,
                 of.e, of.impulse, of.lost},
                of.ends, row.press, row.length);
  }

  // What strings and rods have passed on.
  for (uint32_t c = 0; c < now.set.rows(); ++c)
    if (const double pull = now.set.pull(c); pull != 0)
      bodies_.contact_work.impulses.strike(bodies_.now, now.touching[c].a, now.touching[c].thing, std::abs(pull));
}

}  // namespace carom
