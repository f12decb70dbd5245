// Rest on flat fixed surfaces, where bounces end at a time in closed form and paths stay parabolas. A change of
// velocity may lift a body off a surface, or press it into one. The contact solver gives the allowed velocity and
// acceleration. Hops that rounding hides are suppressed, because they would cost events without an effect.
#include "simulate/contact/flat_contacts.h"

#include "numerics/vanishing_sum.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/collapse_detector.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

using exact_tolerance::velocity_rounding;

namespace {

constexpr size_t most = FlatContactList::most;

}  // namespace

/// Stores the surfaces of all contacts except those with `without`. Returns their number. Their motion is `factor`
/// times their velocity: 1 where velocities are meant, the fade (1/s) of drag where accelerations of a carried body
/// are.
size_t FlatContacts::surfaces_of(const FlatContactList& contacts, Entity without, double factor,
                                 Surfaces& surfaces) const {
  size_t n = 0;
  for (size_t k = 0; k < contacts.count; ++k) {
    const auto& [surface, feature, normal, settling, rest_time, residual_speed] = contacts.at[k];
    if (surface == without) continue;
    const double along = bodies_.moving.any() ? normal.dot(bodies_.fixed_velocity(surface)) : 0;
    surfaces[n++] = {normal, factor * along};
  }
  return n;
}

bool FlatContacts::switches(Entity i) const {
  for (size_t k = 0; k < contacts_[i].count; ++k)
    if (bodies_.moving.switches(contacts_[i].at[k].surface, bodies_.now)) return true;
  return false;
}

FadingPath FlatContacts::path_of(Entity surface, const Instant& start) const {
  if (!bodies_.world.moves(surface)) return {bodies_.world.fixed_position(surface), Vec3::Zero(), Vec3::Zero(), 0};
  // A body that a surface carries has begun its flight on the surface's present leg.
  return {bodies_.moving.position(surface, start), bodies_.moving.velocity(surface, bodies_.now), Vec3::Zero(), 0};
}

/// The fewest surfaces that hold the body between them; all of them, if none do.
vector<Entity> FlatContacts::opposite_surfaces(const FlatContactList& contacts) {
  vector<Vec3> normals;
  vector<size_t> fewest;
  for (size_t k = 0; k < contacts.count; ++k) {
    normals.push_back(contacts.at[k].normal);
    fewest.push_back(k);
  }
  for (size_t k = 0; k < contacts.count; ++k)
    if (auto some = vanishing_sum(normals, k, exact_tolerance::level); !some.empty() && some.size() < fewest.size())
      fewest = std::move(some);
  vector<Entity> surfaces;
  for (const size_t k : fewest) surfaces.push_back(contacts.at[k].surface);
  return surfaces;
}

/// Notes the quality of a solution for body i's velocity, and adds the work of moving surfaces to the log and to `lost`
/// (J): it becomes no motion.
/// Throws SimulationError where they leave the body no room.
FlatSolution FlatContacts::note_solution(Entity i, const FlatSolution& solution, double& lost) {
  if (bodies_.moving.any()) {
    if (solution.certificate.verdict == Certificate::Verdict::infeasible) {
      bodies_.fail_squeezed(i, opposite_surfaces(contacts_[i]));
    }
    const double work = bodies_.world.mass[i] * solution.work;
    bodies_.log.add_work(work);
    lost += work;
  }
  bodies_.log.note(solution.certificate);
  return solution;
}

bool FlatContacts::carries(Entity i, Entity surface) const {
  for (size_t k = 0; k < contacts_[i].count; ++k)
    if (contacts_[i].at[k].surface == surface) return true;
  return false;
}

bool FlatContacts::hides(Entity i, Entity fixed) const {
  const FlatContactList& contacts = contacts_[i];
  for (size_t k = 0; k < contacts.count; ++k)
    if (bodies_.hidden(i, bodies_.position(i), fixed, contacts.at[k].normal, contacts.at[k].surface)) return true;
  return false;
}

void FlatContacts::remove_level(Entity i, const Vec3& normal) {
  const FlatContactList contacts = contacts_[i];
  for (size_t k = 0; k < contacts.count; ++k)
    if ((contacts.at[k].normal - normal).norm() <= exact_tolerance::level) remove(i, contacts.at[k].surface);
}

FlightOrigin FlatContacts::hand_over(Entity i, Entity surface) {
  const World& world = bodies_.world;
  const FlatContactList contacts = contacts_[i];
  Vec3 normal = Vec3::Zero();
  for (size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface == surface) normal = contacts.at[k].normal;
  remove(i, surface);

  const Flight f = bodies_.flights[i];
  const Vec3 x = bodies_.position(i);
  const Vec3 v = bodies_.velocity(i);
  const Vec3 a = f.acceleration(bodies_.now - f.start);
  const Vec3 w = v - bodies_.fixed_velocity(surface);

  // A little ahead, the body is over the other surface's face, if the rims are no farther apart than rounding.
  const double ahead =
      max(exact_tolerance::rim_gap * world.radius[i], exact_tolerance::initial_rounding * x.cwiseAbs().sum());
  const double speed = w.norm();
  if (speed == 0) return {};
  const Vec3 there = x + ahead / speed * w;

  // Of all level surfaces, the one that the body stays on the longest.
  FlatContact next{no_entity, 0, normal, false, bodies_.now, 0};
  double longest = -1;
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || e == surface || carries(i, e) || world.swing(e) != nullptr) continue;
    const Vec3 point = bodies_.fixed_position(e);
    const Vec3 u = bodies_.fixed_velocity(e);
    const Touch level = touch(world, i, there, e, point);

    // It must be flat and level with the other, and touch the body without speed along the normal, up to rounding.
    const double rounding =
        exact_tolerance::initial_rounding * (x.cwiseAbs().sum() + point.cwiseAbs().sum() + world.radius[i]);
    if (!is_flat(world, i, e, level.feature) || std::abs(level.gap) > rounding ||
        (level.normal + normal).norm() > velocity_rounding ||
        std::abs(normal.dot(v - u)) > velocity_rounding * (v.norm() + u.norm()))
      continue;

    // The time (s) for which the body stays at this feature.
    const RelativeMotion m{point - there, u - v, -a, speed, true};
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
  // The record of the rest, when bounces are over, has that energy.
  bodies_.log.absorb(impact_loss(bodies_.world.mass[i], ExactBodies::immovable, contact.residual_speed, 0));
  FlatContactList& contacts = contacts_.write(i);
  contacts.at[contacts.count++] = contact;
  note_mode(i);
}

/// Body i's mode follows its contacts, if it is free.
void FlatContacts::note_mode(Entity i) {
  const FlatContactList& contacts = contacts_[i];
  if (!is_free(bodies_.mode(i))) return;
  if (contacts.count == 0) return modes_.fly(i);
  modes_.lie(i, std::any_of(contacts.at.begin(), contacts.at.begin() + contacts.count,
                            [](const FlatContact& contact) { return contact.settling; }));
}

void FlatContacts::remove(Entity i, Entity surface) {
  FlatContactList& contacts = contacts_.write(i);
  for (size_t k = 0; k < contacts.count; ++k) {
    if (contacts.at[k].surface != surface) continue;
    contacts.at[k] = contacts.at[--contacts.count];
    break;
  }
  note_mode(i);
}

void FlatContacts::clear(Entity i) {
  if (contacts_[i].count == 0) return;
  contacts_.write(i).count = 0;
  note_mode(i);
}

void FlatContacts::find_initial(Entity i) {
  const World& world = bodies_.world;
  if (bodies_.neighbours.surfaces(i).empty()) return;

  Flight f = bodies_.flights[i];
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || world.swing(e) != nullptr || contacts_[i].count == most) continue;
    const Vec3 point = bodies_.fixed_position(e);
    const Vec3 u = bodies_.fixed_velocity(e);
    const Touch there = touch(world, i, f.x, e, point);

    // The body must touch a flat surface, without speed along the normal, and be pressed on.
    const double rounding =
        exact_tolerance::flat_rounding * (f.x.cwiseAbs().sum() + point.cwiseAbs().sum() + world.radius[i]);
    if (!is_flat(world, i, e, there.feature) || std::abs(there.gap) > rounding ||
        std::abs(there.normal.dot(f.v - u)) > velocity_rounding * (f.v.norm() + u.norm()) ||
        there.normal.dot(bodies_.applied[i]) + drag_along(i, there.normal, e) <= 0)
      continue;

    add(i, {e, there.feature, -there.normal, false, {}, 0});
    f.x += there.gap * there.normal;
    bodies_.body[i].set_origin({e, there.feature});
  }

  f.a = keep_pressing(i) - f.fade * f.v;
  bodies_.flights.set(i, f);
  if (bodies_.contact_work.any()) note_forces(i);
}

/// The point at which body i touches the surface of a contact (m).
Vec3 FlatContacts::place_of(Entity i, const FlatContact& contact) const {
  const Vec3 point = bodies_.fixed_position(contact.surface);
  return bodies_.touch_at(i, bodies_.position(i), contact.surface, point, contact.feature).point;
}

void FlatContacts::end_bounces(Entity i) {
  for (size_t k = 0; k < contacts_[i].count; ++k) {
    FlatContact& contact = contacts_.write(i).at[k];
    if (!contact.settling || bodies_.now < contact.rest_time) continue;

    contact.settling = false;
    note_mode(i);

    const World& world = bodies_.world;
    bodies_.log.record(
        with_effect(world, {bodies_.now.hi, CollisionKind::rest, i, contact.surface, place_of(i, contact),
                            -contact.normal, contact.residual_speed, 0, pair_restitution(world, i, contact.surface)}));
    break;
  }
}

/// Records a bounce that ends at once: an impact that leaves no speed. lost: J, that of a single surface or its part of
/// what several take together.
void FlatContacts::record_bounce(Entity i, const FlatContact& contact, double approach, double e, double lost) {
  Collision met = with_effect(bodies_.world, {bodies_.now.hi, CollisionKind::body_fixed, i, contact.surface,
                                              place_of(i, contact), -contact.normal, approach, 0, e});
  met.energy_lost = lost;
  bodies_.log.record(met);
}

void FlatContacts::retain(FlatContactList& contacts, const array<bool, most>& which) {
  size_t kept = 0;
  for (size_t k = 0; k < contacts.count; ++k)
    if (which[k]) contacts.at[kept++] = contacts.at[k];
  contacts.count = kept;
}

/// Adds the impulses by which these surfaces have changed body i's velocity, by their shares of it (m/s).
void FlatContacts::note_pushes(Entity i, const FlatContactList& contacts, span<const double> pushes) {
  for (size_t k = 0; k < pushes.size(); ++k)
    bodies_.contact_work.impulses.strike(bodies_.now, i, contacts.at[k].surface, bodies_.world.mass[i] * pushes[k]);
}

Vec3 FlatContacts::keep_at_surfaces(Entity i, const Vec3& v) {
  FlatContactList& contacts = contacts_.write(i);
  const double now = bodies_.now.hi;
  const double mass = bodies_.world.mass[i];
  const Vec3 x = bodies_.position(i);
  const double noise = velocity_rounding * (v.norm() + bodies_.flights[i].v.norm());

  array<bool, most> kept;
  array<double, most> press;
  // A bounce that ends at once.
  struct Bounce {
    FlatContact contact;
    double approach;  // m/s
    double e;
  };
  array<Bounce, most> bounces;
  size_t bounced = 0;

  for (size_t k = 0; k < contacts.count; ++k) {
    const FlatContact& contact = contacts.at[k];
    const Vec3 n = -contact.normal;  // into the surface
    const Vec3 of_surface = bodies_.fixed_velocity(contact.surface);
    const double u = n.dot(v - of_surface);

    // A contact stays where rounding hides the motion along the normal, or the hop.
    const FlatSolution without = acceleration_without(i, contact.surface);
    bodies_.log.note(without.certificate);
    press[k] = n.dot(without.u) + drag_along(i, n, contact.surface);
    kept[k] = std::abs(u) <= noise + velocity_rounding * of_surface.norm() ||
              (press[k] > 0 && bodies_.too_low(x, u, press[k]));

    // It also stays where bounces end in less time than the clock resolves.
    if (kept[k] || u < 0 || press[k] <= 0) continue;
    const double e = pair_restitution(bodies_.world, i, contact.surface);
    kept[k] = e < 1 && now + 2 * e * u / (press[k] * (1 - e)) == now;
    if (kept[k]) bounces[bounced++] = {contact, u, e};
  }

  size_t n = 0;
  for (size_t k = 0; k < contacts.count; ++k)
    if (kept[k]) press[n++] = press[k];
  retain(contacts, kept);

  Surfaces surfaces;
  n = surfaces_of(contacts, no_entity, 1, surfaces);
  double lost = 0;             // J
  array<double, most> pushes;  // m/s, by surface
  const span<double> wanted(pushes.data(), bodies_.contact_work.impulses.any() ? n : 0);
  FlatSolution solution = note_solution(i, solve_flat_contacts(v, {surfaces.data(), n}, wanted), lost);
  note_pushes(i, contacts, wanted);

  // A push into one surface may lift the body off another.
  for (size_t k = 0; k < contacts.count; ++k) {
    const double u = surfaces[k].normal.dot(solution.u) - surfaces[k].u;
    kept[k] = u <= noise + velocity_rounding * std::abs(surfaces[k].u) || bodies_.too_low(x, u, press[k]);
  }
  retain(contacts, kept);
  n = surfaces_of(contacts, no_entity, 1, surfaces);
  const span<double> wanted_by_kept = wanted.first(min(n, wanted.size()));
  solution = note_solution(i, keep_flat_contacts(solution.u, {surfaces.data(), n}, wanted_by_kept), lost);
  note_pushes(i, contacts, wanted_by_kept);
  const Vec3& allowed = solution.u;
  note_mode(i);

  // Bounces are in turn with the impact that threw the body at the surfaces.
  lost += 0.5 * mass * (v - allowed).dot(v + allowed);
  double squares = 0;  // m^2/s^2
  for (size_t k = 0; k < bounced; ++k) squares += bounces[k].approach * bounces[k].approach;
  for (size_t k = 0; k < bounced; ++k) {
    const auto& [contact, approach, e] = bounces[k];
    collapses_.count_in_turn(i, 1 - e);
    record_bounce(i, contact, approach, e, lost * (approach * approach / squares));
  }

  bounced > 0 ? bodies_.log.lose(lost) : bodies_.log.absorb(lost);
  return allowed;
}

Vec3 FlatContacts::keep_pressing_surfaces(Entity i) {
  FlatContactList& contacts = contacts_.write(i);
  Surfaces surfaces;
  const size_t n = surfaces_of(contacts, no_entity, bodies_.fade[i], surfaces);
  const FlatSolution solution = solve_flat_contacts(bodies_.applied[i], {surfaces.data(), n});
  bodies_.log.note(solution.certificate);
  array<bool, most> presses;
  for (size_t k = 0; k < most; ++k) presses[k] = solution.active >> k & 1u;
  retain(contacts, presses);
  note_mode(i);
  return solution.u;
}

FlatSolution FlatContacts::acceleration_without(Entity i, Entity surface) const {
  if (!lies_on_flat(bodies_.mode(i))) return {bodies_.applied[i]};
  Surfaces surfaces;
  const size_t n = surfaces_of(contacts_[i], surface, bodies_.fade[i], surfaces);
  return solve_flat_contacts(bodies_.applied[i], {surfaces.data(), n});
}

/// The flat surfaces that body i lies on: those that carry it, and others that it touches at the same level.
vector<FlatContacts::SurfaceForce> FlatContacts::surfaces_below(Entity i) const {
  const World& world = bodies_.world;
  const FlatContactList& contacts = contacts_[i];
  vector<SurfaceForce> surfaces;
  for (size_t k = 0; k < contacts.count; ++k) surfaces.push_back({contacts.at[k].surface, -contacts.at[k].normal});

  // Others that it touches without speed along the normal.
  const Vec3 x = bodies_.position(i);
  const Vec3 v = bodies_.velocity(i);
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (world.is_body(e) || carries(i, e) || world.swing(e) != nullptr) continue;
    const Vec3 point = bodies_.fixed_position(e);
    const Vec3 u = bodies_.fixed_velocity(e);
    const Touch there = touch(world, i, x, e, point);
    const double rounding =
        exact_tolerance::initial_rounding * (x.cwiseAbs().sum() + point.cwiseAbs().sum() + world.radius[i]);
    if (!is_flat(world, i, e, there.feature) || std::abs(there.gap) > rounding ||
        std::abs(there.normal.dot(v - u)) > velocity_rounding * (v.norm() + u.norm()))
      continue;

    const auto level = [&](const FlatContact& c) { return (c.normal + there.normal).norm() <= velocity_rounding; };
    if (std::any_of(contacts.at.begin(), contacts.at.begin() + contacts.count, level))
      surfaces.push_back({e, there.normal});
  }
  return surfaces;
}

/// The forces on body i by the surfaces that it lies on.
vector<FlatContacts::SurfaceForce> FlatContacts::forces_on(Entity i) const {
  vector<SurfaceForce> forces = surfaces_below(i);
  vector<ContactConstraint> pairs;
  for (SurfaceForce& of : forces) {
    if (bodies_.moving.any()) of.along = of.normal.dot(bodies_.fixed_velocity(of.surface));
    pairs.push_back({0, ContactConstraint::fixed, of.normal});
    pairs.back().surface = bodies_.fade[i] * of.along;
  }

  const double inverse_mass = 1 / bodies_.world.mass[i];
  Vec3 a = bodies_.applied[i];
  solve({{&inverse_mass, 1}, {&a, 1}, pairs, true});
  for (size_t k = 0; k < pairs.size(); ++k) forces[k].force = max(pairs[k].force, 0.0);
  return forces;
}

void FlatContacts::note_forces(Entity i) {
  const FlatContactList& contacts = contacts_[i];
  const bool moving = std::any_of(contacts.at.begin(), contacts.at.begin() + contacts.count,
                                  [&](const FlatContact& c) { return bodies_.moving.moves(c.surface, bodies_.now); });
  const bool summed = bodies_.contact_work.impulses.any() && contacts.count > 0;
  if (!moving && !summed) return bodies_.contact_work.change(i, bodies_.now, 0);

  double power = 0;  // W
  vector<ContactForce> forces;
  for (const SurfaceForce& of : forces_on(i)) {
    if (moving) power -= of.force * of.along;
    if (summed) forces.push_back({i, of.surface, of.force});
  }
  bodies_.contact_work.change(i, bodies_.now, power, forces);
}

void FlatContacts::report(Entity i, vector<ContactForce>& forces) const {
  for (const SurfaceForce& of : forces_on(i))
    if (of.force > 0) forces.push_back({i, of.surface, of.force});
}

}  // namespace carom
