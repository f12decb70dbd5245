// Rest on flat fixed surfaces. A body's bounces under load end at a time known in closed form: after an impact that
// leaves it with the speed u, at 2u / (p (1 - e)) from then, where p is the acceleration that presses it on (a
// geometric series of flights). When that is less than the clock can resolve, or the impact is slower than rest_speed,
// the body is put to rest: from then on it moves in the surface, with the reaction taken from its acceleration, and its
// path is a parabola again. Contact of any other kind, a body carried by a body, an edge, a corner or anything round,
// has no such path: such bodies join the crowd (exact_crowd.cpp).
#include <algorithm>
#include <cmath>

#include "physics/complementarity.h"
#include "physics/contact_cone.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr double velocity_rounding = 0x1p-48;  // of the speeds that a component is made of

}  // namespace

/// Adds a surface to those that carry body i.
void ExactSimulator::settle(Entity i, const Contact& contact) {
  log_.lose(impact_loss(world_.mass[i], immovable, contact.residual_speed, 0));
  Contacts& contacts = contacts_.write(i);
  if (contacts.count == 0) log_.add_resting(1);
  contacts.at[contacts.count++] = contact;
}

/// The bounces' end, as a line in the record: the body has been carried since the last impact.
void ExactSimulator::finish_rest(Entity i) {
  for (std::size_t k = 0; k < contacts_[i].count; ++k) {
    Contact& contact = contacts_.write(i).at[k];
    if (!contact.settling || now_ < contact.rest_time) continue;
    contact.settling = false;
    const Vec3 n = -contact.normal;
    const Vec3 x = flight_[i].position(now_ - flight_[i].start);
    const Vec3 point = touch_at(i, x, contact.surface, world_.fixed_position(contact.surface), contact.feature).point;
    log_.record(make_collision(world_, CollisionKind::rest, now_.hi, i, contact.surface, point, n,
                               contact.residual_speed, 0, pair_restitution(world_, i, contact.surface)));
    break;
  }
  predict(i);
}

/// Body i slides over the rim of the wall's face that carried it; the rim's edge is what it has last touched.
void ExactSimulator::release(Entity i, Entity surface, std::uint8_t edge) {
  Contacts& contacts = contacts_.write(i);
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface == surface) {
      contacts.at[k] = contacts.at[--contacts.count];
      if (contacts.count == 0) log_.remove_resting(1);
      break;
    }
  const double t = now_ - flight_[i].start;
  restart(i, flight_[i].position(t), flight_[i].velocity(t), {surface, edge});
  predict(i);
}

/// A body's velocity has become v: which contacts still carry it? One that it leaves, or strikes, is given up (the
/// strike comes next, as an event), unless the hop or the bounce would be one that numbers cannot tell from none.
/// Gives the velocity that the contacts allow.
Vec3 ExactSimulator::keep_contacts(Entity i, Vec3 v) {
  if (contacts_[i].count == 0) return v;
  Contacts& contacts = contacts_.write(i);
  const Vec3 x = flight_[i].position(now_ - flight_[i].start);
  const double noise = velocity_rounding * (v.norm() + flight_[i].v.norm());
  std::array<bool, max_contacts> keep;
  std::array<double, max_contacts> press;
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const Contact& contact = contacts.at[k];
    const Vec3 n = -contact.normal;
    const double u = n.dot(v);  // into the surface
    press[k] = n.dot(free_acceleration(i, contact.surface));
    keep[k] = std::abs(u) <= noise || (press[k] > 0 && too_low(x, u, press[k]));
    if (keep[k] || u < 0 || press[k] <= 0) continue;
    const double e = pair_restitution(world_, i, contact.surface);
    keep[k] = e < 1 && now_.hi + 2 * e * u / (press[k] * (1 - e)) == now_.hi;
    if (!keep[k]) continue;
    ++collapse_.write(i).impacts;  // in turn with the one that threw it at the surface
    collapse_.write(i).lost += 1 - e;
    const Vec3 point = touch_at(i, x, contact.surface, world_.fixed_position(contact.surface), contact.feature).point;
    log_.record(make_collision(world_, CollisionKind::body_fixed, now_.hi, i, contact.surface, point, n, u, 0, e));
  }
  std::array<Vec3, max_contacts> normals;
  const auto thin_out = [&] {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < contacts.count; ++k) {
      if (!keep[k]) continue;
      normals[kept] = contacts.at[k].normal;
      press[kept] = press[k];
      contacts.at[kept++] = contacts.at[k];
    }
    contacts.count = kept;
  };
  thin_out();
  unsigned active;
  Vec3 allowed = project_to_cone(v, {normals.data(), contacts.count}, active);
  // A push into one surface may lift the body off another.
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const double u = normals[k].dot(allowed);
    keep[k] = u <= noise || too_low(x, u, press[k]);
  }
  thin_out();
  allowed = project_to_common_plane(allowed, {normals.data(), contacts.count});
  if (contacts.count == 0) log_.remove_resting(1);
  log_.lose(0.5 * world_.mass[i] * (v - allowed).dot(v + allowed));
  return allowed;
}

/// The acceleration that gravity and the contacts' reactions leave to body i. Contacts that do not press are given up.
Vec3 ExactSimulator::contact_acceleration(Entity i) {
  if (crowded(i)) return Vec3::Zero();  // the crowd's steps have the forces in them
  if (contacts_[i].count == 0) return pull_[i];
  Contacts& contacts = contacts_.write(i);
  std::array<Vec3, max_contacts> normals;
  for (std::size_t k = 0; k < contacts.count; ++k) normals[k] = contacts.at[k].normal;
  unsigned active;
  const Vec3 a = project_to_cone(pull_[i], {normals.data(), contacts.count}, active);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (active >> k & 1u) contacts.at[kept++] = contacts.at[k];
  contacts.count = kept;
  if (kept == 0) log_.remove_resting(1);
  return a;
}

/// The same without one surface, and changing nothing: what would press body i against that surface.
Vec3 ExactSimulator::free_acceleration(Entity i, Entity without) const {
  if (contacts_[i].count == 0) return pull_[i];
  const Contacts& contacts = contacts_[i];
  std::array<Vec3, max_contacts> normals;
  std::size_t n = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface != without) normals[n++] = contacts.at[k].normal;
  unsigned active;
  return project_to_cone(pull_[i], {normals.data(), n}, active);
}

/// At the start: a body that touches a flat surface (but for rounding of the scene's numbers), does not move along its
/// normal and is pressed on rests there from the first.
void ExactSimulator::touch_down(Entity i) {
  if (neighbours_.surfaces(i).empty()) return;
  Flight f = flight_[i];
  for (Entity e : known_to(i)) {
    if (world_.is_body(e) || contacts_[i].count == max_contacts) continue;
    const Vec3& point = world_.fixed_position(e);
    const Touch there = touch(world_, i, f.x, e, point);
    const double rounding = 0x1p-50 * (f.x.cwiseAbs().sum() + point.cwiseAbs().sum() + world_.radius[i]);
    if (!carom::is_flat(world_, i, e, there.feature) || std::abs(there.gap) > rounding ||
        std::abs(there.normal.dot(f.v)) > velocity_rounding * f.v.norm() || there.normal.dot(pull_[i]) <= 0)
      continue;
    settle(i, {e, there.feature, -there.normal, false, {}, 0});
    f.x += there.gap * there.normal;
    body_[i].set_origin({e, there.feature});
  }
  f.a = contact_acceleration(i);
  flight_.set(i, f);
}

/// At the start: a body that touches others, or a curved surface, without speed along the normal and is pressed on is
/// of the crowd from the first, and so is whoever leans on it.
void ExactSimulator::lean_together(Entity first) {
  std::vector<Entity> todo{first};
  while (!todo.empty()) {
    const Entity i = todo.back();
    todo.pop_back();
    for (Entity e : known_to(i)) {
      const Flight f = flight_[i];
      const bool body = world_.is_body(e);
      if (in_contact(i, e) || (crowded(i) && (!body || crowded(e)))) continue;
      const Vec3 xe = body ? flight_[e].x : world_.fixed_position(e);
      const Vec3 ve = body ? flight_[e].v : Vec3(Vec3::Zero()), ae = body ? flight_[e].a : Vec3(Vec3::Zero());
      const double rounding = 0x1p-46 * (f.x.cwiseAbs().sum() + xe.cwiseAbs().sum() + world_.radius[i]);
      if (body && (xe - f.x).norm() > world_.radius[i] + world_.radius[e] + 2 * rounding) continue;
      const Touch there = touch(world_, i, f.x, e, xe);
      if (std::abs(there.gap) > rounding) continue;
      const Vec3 w = ve - f.v;
      if (std::abs(there.normal.dot(w)) > velocity_rounding * (f.v.norm() + ve.norm())) continue;
      const bool leans = crowded(i) || (body && crowded(e));
      const double press = -(there.normal.dot(ae - f.a) + bending(world_, i, f.x, e, xe, there, w));
      if (!leans && !(press > 0)) continue;
      if (!crowded(i)) {
        join(i);
        flight_.accelerate(i, Vec3::Zero());
        todo.push_back(i);
      }
      if (body && !crowded(e)) {
        join(e);
        flight_.accelerate(e, Vec3::Zero());
        todo.push_back(e);
      }
    }
  }
}

bool ExactSimulator::in_contact(Entity i, Entity surface) const {
  for (std::size_t k = 0; k < contacts_[i].count; ++k)
    if (contacts_[i].at[k].surface == surface) return true;
  return false;
}

/// The forces of body i's contacts with flat surfaces: what keeps it to them.
void ExactSimulator::report_rest(Entity i) {
  const Contacts& contacts = contacts_[i];
  std::vector<PressedPair> pairs;
  for (std::size_t k = 0; k < contacts.count; ++k)
    pairs.push_back({0, PressedPair::none, -contacts.at[k].normal, 0, 1e-15 * pull_[i].norm(), 0});
  const double inverse_mass = 1 / world_.mass[i];
  Vec3 a = pull_[i];
  press_apart({&inverse_mass, 1}, {&a, 1}, pairs, 1000);
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (pairs[k].force > 0) contact_forces_.push_back({i, contacts.at[k].surface, pairs[k].force});
}

std::span<const ContactForce> ExactSimulator::contacts() {
  contact_forces_.clear();
  for (Entity i = 0; i < world_.body_count(); ++i) {
    if (contacts_[i].count > 0) report_rest(i);
    if (body_[i].place == Place::outside || (following_ && body_[i].place == Place::crowd)) continue;
    for (const Pressed& p : pressed_[i]) contact_forces_.push_back({i, p.partner, p.force});
  }
  if (following_ && !crowd_.empty()) report_followed();
  std::sort(contact_forces_.begin(), contact_forces_.end(),
            [](const ContactForce& p, const ContactForce& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  return contact_forces_;
}

}  // namespace carom
