// Rest on flat fixed surfaces, where bounces end at a time in closed form and paths stay parabolas. A change of
// velocity may lift a body off a surface, or press it into one. The contact solver gives the allowed velocity and
// acceleration. Hops that rounding hides are suppressed, because they would cost events without an effect.
#include "simulate/flat_contacts.h"

#include <algorithm>
#include <cmath>

#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/collapse_detector.h"
#include "simulate/flat_contact_problems.h"
#include "simulate/tolerances.h"

namespace carom {

using exact_tolerance::velocity_rounding;

namespace {

constexpr std::size_t most = FlatContactList::most;

/// Stores the normals of all contacts except those with `without`. Returns their number.
std::size_t normals_of(const FlatContactList& contacts, Entity without, std::array<Vec3, most>& normals) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface != without) normals[n++] = contacts.at[k].normal;
  return n;
}

}  // namespace

bool FlatContacts::carry(Entity i, Entity surface) const {
  for (std::size_t k = 0; k < contacts_[i].count; ++k)
    if (contacts_[i].at[k].surface == surface) return true;
  return false;
}

bool FlatContacts::hide(Entity i, Entity fixed) const {
  const FlatContactList& contacts = contacts_[i];
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (lies_behind(bodies_.world, i, bodies_.position(i), fixed, contacts.at[k].normal)) return true;
  return false;
}

void FlatContacts::remove_level(Entity i, const Vec3& normal) {
  const FlatContactList contacts = contacts_[i];
  for (std::size_t k = 0; k < contacts.count; ++k)
    if ((contacts.at[k].normal - normal).norm() <= exact_tolerance::level) remove(i, contacts.at[k].surface);
}

FlightOrigin FlatContacts::hand_over(Entity i, Entity surface) {
  const World& world = bodies_.world;
  const FlatContactList contacts = contacts_[i];
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface == surface) normal = contacts.at[k].normal;
  remove(i, surface);
  const Flight f = bodies_.flights[i];
  const Vec3 x = bodies_.position(i), v = bodies_.velocity(i), a = f.acceleration(bodies_.now - f.start);
  // A little ahead, the body is over the other surface's face, if the rims are no farther apart than rounding.
  const double ahead =
      std::max(exact_tolerance::rim_gap * world.radius[i], exact_tolerance::initial_rounding * x.cwiseAbs().sum());
  const double speed = v.norm();
  if (speed == 0) return {};
  const Vec3 there = x + ahead / speed * v;
  FlatContact next{no_entity, 0, normal, false, bodies_.now, 0};
  double longest = -1;
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || e == surface || carry(i, e)) continue;
    const Vec3& point = world.fixed_position(e);
    const Touch level = touch(world, i, there, e, point);
    const double rounding =
        exact_tolerance::initial_rounding * (x.cwiseAbs().sum() + point.cwiseAbs().sum() + world.radius[i]);
    if (!is_flat(world, i, e, level.feature) || std::abs(level.gap) > rounding ||
        (level.normal + normal).norm() > velocity_rounding)
      continue;
    const RelativeMotion m{point - there, -v, -a, speed, true};
    const double stay = leave_feature(world, i, e, level.feature, m, bodies_.options.duration).time;
    if (!(stay > longest)) continue;
    longest = stay;
    next.surface = e;
    next.feature = level.feature;
    next.normal = -level.normal;
  }
  if (next.surface != no_entity) add(i, next);
  return {next.surface, next.feature};
}

void FlatContacts::add(Entity i, const FlatContact& contact) {
  bodies_.log.lose(impact_loss(bodies_.world.mass[i], ExactBodies::immovable, contact.residual_speed, 0));
  FlatContactList& contacts = contacts_.write(i);
  if (contacts.count == 0) bodies_.log.add_resting(1);
  contacts.at[contacts.count++] = contact;
}

void FlatContacts::remove(Entity i, Entity surface) {
  FlatContactList& contacts = contacts_.write(i);
  for (std::size_t k = 0; k < contacts.count; ++k) {
    if (contacts.at[k].surface != surface) continue;
    contacts.at[k] = contacts.at[--contacts.count];
    if (contacts.count == 0) bodies_.log.remove_resting(1);
    break;
  }
}

void FlatContacts::clear(Entity i) {
  if (contacts_[i].count == 0) return;
  contacts_.write(i).count = 0;
  bodies_.log.remove_resting(1);
}

void FlatContacts::find_initial(Entity i) {
  const World& world = bodies_.world;
  if (bodies_.neighbours.surfaces(i).empty()) return;
  Flight f = bodies_.flights[i];
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || contacts_[i].count == most) continue;
    const Vec3& point = world.fixed_position(e);
    const Touch there = touch(world, i, f.x, e, point);
    const double rounding =
        exact_tolerance::flat_rounding * (f.x.cwiseAbs().sum() + point.cwiseAbs().sum() + world.radius[i]);
    if (!is_flat(world, i, e, there.feature) || std::abs(there.gap) > rounding ||
        std::abs(there.normal.dot(f.v)) > velocity_rounding * f.v.norm() || there.normal.dot(bodies_.applied[i]) <= 0)
      continue;
    add(i, {e, there.feature, -there.normal, false, {}, 0});
    f.x += there.gap * there.normal;
    bodies_.body[i].set_origin({e, there.feature});
  }
  f.a = keep_pressing(i) - f.fade * f.v;
  bodies_.flights.set(i, f);
}

void FlatContacts::end_bounces(Entity i) {
  for (std::size_t k = 0; k < contacts_[i].count; ++k) {
    FlatContact& contact = contacts_.write(i).at[k];
    if (!contact.settling || bodies_.now < contact.rest_time) continue;
    contact.settling = false;
    const World& world = bodies_.world;
    const Vec3 point =
        bodies_
            .touch_at(i, bodies_.position(i), contact.surface, world.fixed_position(contact.surface), contact.feature)
            .point;
    bodies_.log.record(make_collision(world, CollisionKind::rest, bodies_.now.hi, i, contact.surface, point,
                                      -contact.normal, contact.residual_speed, 0,
                                      pair_restitution(world, i, contact.surface)));
    break;
  }
}

/// Records a bounce that ends at once: an impact that leaves no speed.
void FlatContacts::record_bounce(Entity i, const FlatContact& contact, double approach, double e) {
  const World& world = bodies_.world;
  // It is in turn with the impact that threw the body at the surface.
  collapses_.count_in_turn(i, 1 - e);
  const Vec3 point =
      bodies_.touch_at(i, bodies_.position(i), contact.surface, world.fixed_position(contact.surface), contact.feature)
          .point;
  bodies_.log.record(make_collision(world, CollisionKind::body_fixed, bodies_.now.hi, i, contact.surface, point,
                                    -contact.normal, approach, 0, e));
}

void FlatContacts::keep(FlatContactList& contacts, const std::array<bool, most>& which) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (which[k]) contacts.at[kept++] = contacts.at[k];
  contacts.count = kept;
}

Vec3 FlatContacts::keep_at_surfaces(Entity i, const Vec3& v) {
  FlatContactList& contacts = contacts_.write(i);
  const double now = bodies_.now.hi;
  const Vec3 x = bodies_.position(i);
  const double noise = velocity_rounding * (v.norm() + bodies_.flights[i].v.norm());
  std::array<bool, most> kept;
  std::array<double, most> press;
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const FlatContact& contact = contacts.at[k];
    const Vec3 n = -contact.normal;
    // Into the surface.
    const double u = n.dot(v);
    press[k] = n.dot(acceleration_without(i, contact.surface));
    kept[k] = std::abs(u) <= noise || (press[k] > 0 && bodies_.too_low(x, u, press[k]));
    if (kept[k] || u < 0 || press[k] <= 0) continue;
    const double e = pair_restitution(bodies_.world, i, contact.surface);
    kept[k] = e < 1 && now + 2 * e * u / (press[k] * (1 - e)) == now;
    if (kept[k]) record_bounce(i, contact, u, e);
  }
  std::size_t n = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (kept[k]) press[n++] = press[k];
  keep(contacts, kept);
  std::array<Vec3, most> normals;
  n = normals_of(contacts, no_entity, normals);
  FlatSolution solution = solve_flat_contacts(v, {normals.data(), n});
  bodies_.log.note(solution.certificate);
  // A push into one surface may lift the body off another.
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const double u = normals[k].dot(solution.u);
    kept[k] = u <= noise || bodies_.too_low(x, u, press[k]);
  }
  keep(contacts, kept);
  n = normals_of(contacts, no_entity, normals);
  solution = keep_flat_contacts(solution.u, {normals.data(), n});
  bodies_.log.note(solution.certificate);
  const Vec3& allowed = solution.u;
  if (contacts.count == 0) bodies_.log.remove_resting(1);
  bodies_.log.lose(0.5 * bodies_.world.mass[i] * (v - allowed).dot(v + allowed));
  return allowed;
}

Vec3 FlatContacts::keep_pressing_surfaces(Entity i) {
  FlatContactList& contacts = contacts_.write(i);
  std::array<Vec3, most> normals;
  const std::size_t n = normals_of(contacts, no_entity, normals);
  const FlatSolution solution = solve_flat_contacts(bodies_.applied[i], {normals.data(), n});
  bodies_.log.note(solution.certificate);
  std::array<bool, most> presses;
  for (std::size_t k = 0; k < most; ++k) presses[k] = solution.active >> k & 1u;
  keep(contacts, presses);
  if (contacts.count == 0) bodies_.log.remove_resting(1);
  return solution.u;
}

Vec3 FlatContacts::acceleration_without(Entity i, Entity surface) const {
  if (contacts_[i].count == 0) return bodies_.applied[i];
  std::array<Vec3, most> normals;
  const std::size_t n = normals_of(contacts_[i], surface, normals);
  const FlatSolution solution = solve_flat_contacts(bodies_.applied[i], {normals.data(), n});
  bodies_.log.note(solution.certificate);
  return solution.u;
}

void FlatContacts::report(Entity i, std::vector<ContactForce>& forces) const {
  const FlatContactList& contacts = contacts_[i];
  std::vector<ContactConstraint> pairs;
  for (std::size_t k = 0; k < contacts.count; ++k)
    pairs.push_back({0, ContactConstraint::fixed, -contacts.at[k].normal});
  const double inverse_mass = 1 / bodies_.world.mass[i];
  Vec3 a = bodies_.applied[i];
  solve({{&inverse_mass, 1}, {&a, 1}, pairs});
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (pairs[k].force > 0) forces.push_back({i, contacts.at[k].surface, pairs[k].force});
}

}  // namespace carom
