// Begins and ends flights, and books the work of forces and the method's own error on each flight that ends.
// Work is booked from the flight as a whole, in closed form where forces are constant.
#include "simulate/contact/flight_changes.h"

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/path/path_log.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

FlightChanges::FlightChanges(ExactBodies& bodies, FlatContacts& flat, PathLog& paths)
    : bodies_(bodies), flat_(flat), paths_(paths), curved_(bodies), in_contact_(bodies.body.size()) {
  paths_.follow(curved_);
}

void FlightChanges::begin(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin) {
  go_on(i, x, v, origin);
  if (bodies_.mode(i) == Mode::held) bodies_.islands.of(i).end = min(bodies_.islands.of(i).end, bodies_.now);
}

void FlightChanges::go_on(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin) {
  paths_.note_change(i);
  const double speed = v.norm();
  bodies_.hold_to_bounds(i, bodies_.now.hi, x, v);
  bodies_.note_speed(i, v);
  book(i, x, bodies_.now);

  const Mode mode = bodies_.mode(i);
  const Contact contact = mode == Mode::stepped ? Contact::crowd : Contact::none;
  if (contact != in_contact_[i]) {
    // The next step of its own does not continue one of contact.
    if (in_contact_[i] == Contact::followed) bodies_.flights.accelerate(i, bodies_.flights.acceleration(i));
    in_contact_.write(i) = contact;
  }
  // Its crowd gives it the next drift.
  if (contact == Contact::crowd) {
    bodies_.flights.set(i, {bodies_.now, x, v, Vec3::Zero()});
    bodies_.kick.write(i) = {bodies_.now};
    return end_change(i, origin);
  }

  // A body that has just joined an island falls until its first step.
  const bool falls =
      mode == Mode::fresh && (bodies_.flights.acceleration(i) != Vec3::Zero() || bodies_.flights.curve(i) != nullptr);

  // A negligible speed becomes zero, on a flat surface also one with a negligible hop.
  const double negligible = bodies_.negligible_speed();
  const bool still = speed <= negligible ||
                     (lies_on_flat(mode) && speed * speed < exact_tolerance::negligible_hop *
                                                                bodies_.applied[i].norm() * bodies_.world.radius[i]);
  Vec3 kept = v;
  for (int k = 0; k < 3; ++k)
    if (still || std::abs(v[k]) <= negligible) kept[k] = 0;
  bodies_.refresh(i, x, kept);

  // A flight in steps follows a curve.
  if (const bool free = mode == Mode::flying;
      bodies_.in_steps && (free ? bodies_.flies_in_steps(i) : falls && bodies_.bent[i])) [[unlikely]] {
    curve(i, {bodies_.now, x, kept, bodies_.force_at(i, x, kept)}, free);
    return end_change(i, origin);
  }

  // Any other path is a parabola, or decays with its drag.
  const Vec3 pull = falls ? bodies_.applied[i] : flat_.keep_pressing(i);
  if (bodies_.fade.empty() || (!falls && in_lasting_contact(mode))) [[likely]]
    bodies_.flights.set(i, {bodies_.now, x, kept, pull});
  else
    bodies_.flights.set(i, {bodies_.now, x, kept, pull - bodies_.fade[i] * kept, bodies_.fade[i]});
  end_change(i, origin);
}

inline void FlightChanges::end_change(Entity i, const FlightOrigin& origin) {
  if (bodies_.contact_work.any()) [[unlikely]]
    note_forces(i);
  bodies_.body[i].set_origin(origin);
  bodies_.neighbours.turned(i);
  count(i);
  note_changed(i);
}

/// Stores the forces of surfaces that carry body i by itself, and the power of those that move. Those of islands are
/// stored with their steps, and those of a sleeper where it falls asleep.
void FlightChanges::note_forces(Entity i) {
  if (is_member(bodies_.mode(i))) return;
  in_lasting_contact(bodies_.mode(i)) ? bodies_.contact_work.change(i, bodies_.now, 0) : flat_.note_forces(i);
}

/// Starts a step of body i's flight: by the scene's method if it is free, otherwise by that of contact.
void FlightChanges::curve(Entity i, Flight from, bool free) {
  if (!free) return bodies_.flights.set(i, from, curved_.step_of_its_own(i, from.x, from.v));
  const PolynomialPath* const last = bodies_.flights.curve(i);
  const Instant& now = bodies_.now;
  const bool next = last == nullptr ? now == Instant{} : bodies_.flights[i].start + last->length <= now;
  const PolynomialPath path = curved_.step(i, from.x, from.v, next);
  from.a = path.acceleration(0);
  bodies_.flights.set(i, from, path);
}

Vec3 FlightChanges::position_of_method(Entity i, const Instant& at) const {
  if (curved_.follows_closed_form(i)) [[unlikely]]
    return curved_.closed_place(i, at).x;
  const Flight f = bodies_.flights[i];
  return f.position(at - f.start);
}

Vec3 FlightChanges::velocity_of_method(Entity i, const Instant& at) const {
  if (curved_.follows_closed_form(i)) [[unlikely]]
    return curved_.closed_place(i, at).v;
  const Vec3 v = bodies_.velocity_without_kick(i, at);
  const Flight f = bodies_.flights[i];
  if (f.curve == nullptr || in_lasting_contact(bodies_.mode(i))) return v;
  if (bodies_.options.integrator != Integrator::verlet) return v - f.curve->ahead;
  return v + bodies_.verlet_change(i, f, at - f.start);
}

void FlightChanges::end_by_method(Entity i) {
  paths_.note_change(i);
  const Vec3 x = position_of_method(i, bodies_.now);
  const Vec3 v = velocity_of_method(i, bodies_.now);
  book(i, x, bodies_.now);
  bodies_.flights.set(i, {bodies_.now, x, v, bodies_.force_at(i, x, v)});
}

void FlightChanges::take_step(Entity i) {
  if (const CurvedFlights::Reached* end = curved_.reached(i)) {
    const auto [x, v] = *end;
    return go_on(i, x, v, {});
  }
  end_step(i);
  go_on(i, bodies_.position(i), bodies_.velocity(i), {});
}

void FlightChanges::let_fall(Entity i) {
  const Flight f = bodies_.flights[i];
  bodies_.refresh(i, f.x, f.v);
  const bool free = !in_lasting_contact(bodies_.mode(i));
  if (free ? bodies_.flies_in_steps(i) : bodies_.bent[i] != 0)
    curve(i, {f.start, f.x, f.v, bodies_.force_at(i, f.x, f.v)}, free);
  else
    bodies_.flights.accelerate(i, bodies_.force_at(i, f.x, f.v), bodies_.fade[i]);
}

void FlightChanges::follow(Entity i, const PolynomialPath& path) {
  Flight f = bodies_.flights[i];
  f.a = path.acceleration(0);
  bodies_.flights.set(i, f, path);
  in_contact_.write(i) = Contact::followed;
}

void FlightChanges::count(Entity i) {
  if (++bodies_.body[i].version == 0) [[unlikely]]
    count_anew(i);
}

/// Old events must not appear fresh.
void FlightChanges::count_anew(Entity i) {
  bodies_.body[i].version = 1;
  for (ExactBody& body : bodies_.body)
    if (body.event.kind == ExactEvent::Kind::body_body && body.event.partner == i) body.event.partner_version = 0;
  for (const Entity string : bodies_.ties.of(i))
    if (const Entity other = bodies_.ties.other(string, i); other != no_entity)
      if (ExactEvent& event = bodies_.body[other].event; event.kind == ExactEvent::Kind::string)
        event.partner_version = 0;
}

/// Books a flight in contact. A crowd books its own steps.
void FlightChanges::book_contact(Entity i, const Vec3& x, const Instant& end) {
  if (in_contact_[i] == Contact::followed) bodies_.bent[i] ? book_varying(i, x, end) : book_followed(i, x, end);
}

void FlightChanges::book_forces(Entity i, const Vec3& x, const Instant& end) {
  const World& world = bodies_.world;
  const Flight f = bodies_.flights[i];
  const Vec3 displacement = x - f.x;
  const double fade = bodies_.fade[i];
  const double mass = world.mass[i];
  const double dragged = fade == 0 ? 0 : fade * f.path().squared_speed(end - f.start);  // m^2/s^2
  // On a path that decays with its drag, contact forces are constant.
  const Vec3 held = f.fade == 0 ? Vec3(bodies_.applied[i] - f.a) : Vec3(bodies_.force_at(i, f.x, f.v) - f.a);
  bodies_.log.deviate(mass * (held.dot(displacement) - (f.fade == 0 ? dragged : 0)));
  if (!world.forces.empty()) book_work(i, f.start.hi, displacement, fade == 0 ? 0 : dragged / fade);
}

/// Books the work of forces that are constant except for linear drag, and returns it (J). Drag acts by an integral of
/// the squared speed (m^2/s).
double FlightChanges::book_work(Entity i, double time, const Vec3& displacement, double squared_speed) {
  double all = 0;
  const World& world = bodies_.merged.given();
  const span<const Entity> parts = bodies_.merged.parts_of(i);

  for (const Entity part : parts.empty() ? span<const Entity>(&i, 1) : parts)
    for (size_t k = 0; k < world.forces.size(); ++k) {
      const Force& force = world.forces[k];
      if (!acts(force, part, time)) continue;

      // The force on a body at rest, wind included, and the drag on its motion.
      const Vec3 any = Vec3::Zero();
      const Vec3 standing = working_acceleration(world, force, part, any, any);
      const double work = world.mass[part] * standing.dot(displacement) - fade_of(force.law) * squared_speed;
      if (work != 0) bodies_.log.add_work(k, work);
      all += work;
    }
  return all;
}

double FlightChanges::book_drift(Entity i, const Flight& drift, double length) {
  if (bodies_.bent[i]) return curved_.book_work(i, drift, length);
  return book_work(i, drift.start.hi, length * drift.v, length * drift.v.squaredNorm());
}

/// The greatest speed of a flight on a curve (m/s) in `length` (s) of it, by the scene's method. Within a step the
/// speed rises and falls only once.
double FlightChanges::greatest_speed(Entity i, const Flight& f, double length) const {
  const VelocityBeyond beyond = bodies_.beyond_curve(i, f, length);
  const auto velocity = [&](double t) { return Vec3(f.velocity(t) + beyond.at(t)); };
  const auto rise = [&](double t) { return velocity(t).dot(f.curve->acceleration(t) + beyond.slope(t)); };
  double rising = 0;
  double falling = length;
  if (!(rise(rising) > 0 && rise(falling) < 0)) return max(velocity(0).norm(), velocity(length).norm());
  for (int k = 0; k < 24; ++k) {
    const double middle = 0.5 * (rising + falling);
    (rise(middle) > 0 ? rising : falling) = middle;
  }
  return velocity(rising).norm();
}

/// The effect of forces on a free flight is in the potential and in their work. For other flights the rest is due to
/// contact, which does no work: it is the method's error.
void FlightChanges::book_varying(Entity i, const Vec3& x, const Instant& end) {
  const Flight f = bodies_.flights[i];
  const double length = end - f.start;
  if (!(length > 0)) return;
  const double work = curved_.book_work(i, f, length);
  if (f.curve != nullptr) bodies_.log.note_speed(i, greatest_speed(i, f, length));
  if (f.curve != nullptr && in_contact_[i] != Contact::followed) return;
  bodies_.log.deviate(kinetic_loss(i, f, length) + bodies_.merged.potential(i, f.x) - bodies_.merged.potential(i, x) +
                      work);
}

/// The same for a path of constrained motion under forces that are constant except for linear drag.
void FlightChanges::book_followed(Entity i, const Vec3& x, const Instant& end) {
  const Flight f = bodies_.flights[i];
  const double length = end - f.start;
  const double mass = bodies_.world.mass[i];
  if (!(length > 0)) return;
  bodies_.log.note_speed(i, greatest_speed(i, f, length));
  const Vec3 displacement = x - f.x;
  const double fade = bodies_.fade[i];
  const double squared = fade == 0 ? 0 : CurvedFlights::squared_speed(f, length);
  bodies_.log.deviate(kinetic_loss(i, f, length) + mass * (bodies_.applied[i].dot(displacement) - fade * squared));
  if (!bodies_.world.forces.empty()) book_work(i, f.start.hi, displacement, squared);
}

/// The kinetic energy that body i loses in `length` (s) of its flight (J).
double FlightChanges::kinetic_loss(Entity i, const Flight& f, double length) const {
  const Vec3 v = f.velocity(length);
  return 0.5 * bodies_.world.mass[i] * (f.v - v).dot(f.v + v);
}

void FlightChanges::take_out(Entity i, const Vec3& x, const Vec3& v) {
  if (in_contact_[i] != Contact::none) in_contact_.write(i) = Contact::none;
  bodies_.flights.set(i, {bodies_.now, x, v, Vec3::Zero()});
  bodies_.body[i].set_origin({});
  count(i);
  note_changed(i);
}

Vec3 FlightChanges::book_until(Entity i, const Instant& at) {
  const Flight f = bodies_.flights[i];
  const Vec3 x = f.position(at - f.start);
  const Vec3 v = bodies_.velocity_without_kick(i, at);
  bodies_.hold_to_bounds(i, at.hi, x, v);
  bodies_.note_speed(i, v);
  book(i, x, at);
  bodies_.contact_work.change(i, at, 0);
  return v;
}

void FlightChanges::book_last(double time) {
  if (ended_) return;
  ended_ = true;
  for (Entity i = 0; i < bodies_.world.body_count(); ++i) book_until(i, {time, 0});
}

}  // namespace carom
