// What events do to velocities and contacts.
//
// Rest. On a flat surface a ball's bounces under load end at a time known in closed form: after an impact that leaves
// it with the speed u, at 2u / (p (1 - e)) from then, where p is the acceleration that presses it on (a geometric
// series of flights). When that is less than the clock can resolve, or the impact is slower than rest_speed, the ball
// is put to rest: from then on it moves in the surface, with the reaction taken from its acceleration, and its path is
// a parabola again.
//
// Contact of any other kind, a body carried by a body, an edge or a corner, has no such path: such bodies join the crowd
// (exact_crowd.cpp).
#include <algorithm>
#include <cmath>

#include "physics/compensated.h"
#include "physics/contact_cone.h"
#include "physics/contact_time.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr double immovable = never;            // kg
constexpr double velocity_rounding = 0x1p-48;  // of the speeds that a component is made of

/// Whether a speed (m/s) against a pressing acceleration (m/s^2) lifts a body by less than its position x (m) is
/// rounded to.
bool too_low(const Vec3& x, double speed, double press) {
  return speed * speed < press * 0x1p-48 * x.cwiseAbs().sum();
}

}  // namespace

/// The speed (m/s) under which impacts in lasting contact no longer count one by one: rest_speed, or by default a
/// hundredth of the speed gained over `length` (m) at the pressing acceleration (m/s^2).
double ExactSimulator::slow_speed(double press, double length) const {
  return options_.rest_speed > 0 ? options_.rest_speed : 0.03 * std::sqrt(press * length);
}

/// Counts a slow impact of body i. Many within the time of one hop at that speed: its bounces are about to end.
bool ExactSimulator::in_burst(Entity i, double slow) {
  constexpr int many = 16;
  Burst& burst = burst_[i];
  if (now_.hi - burst.start > 2 * slow / world_.gravity.norm()) burst = {now_.hi, 0};
  return ++burst.impacts > many;
}

/// Whether an impact is the end of bouncing: lasting contact takes it up, nothing is left of the approach (m/s).
/// `press` is the acceleration (m/s^2) that drives the two together.
bool ExactSimulator::taken_up(Entity a, Entity b, double e, double approach, double press, double length) {
  if (place_.empty() || e >= 1) return false;
  const double slow = slow_speed(world_.gravity.norm(), length);
  if (approach >= slow) return false;
  const bool a_in = crowded(a), b_in = crowded(b);
  if (a_in && (b_in || !world_.is_body(b))) return true;
  if (press > 0 && (a_in || b_in)) return true;
  const bool burst_a = in_burst(a, slow), burst_b = world_.is_body(b) && in_burst(b, slow);
  return burst_a || burst_b;
}

void ExactSimulator::collide_pair(Entity a, Entity b) {
  const Flight &p = flight_[a], &q = flight_[b];
  const double ta = now_ - p.start, tb = now_ - q.start;
  const Vec3 xa = p.position(ta), xb = q.position(tb);
  const Vec3 va = p.velocity(ta), vb = q.velocity(tb);
  const double ma = world_.mass[a], mb = world_.mass[b];
  const Vec3 d = xb - xa, w = vb - va;
  // By the actual distance, not the sum of the radii: then the normal is a unit vector and energy is kept to rounding.
  const double distance = d.norm();
  const Vec3 n = d / distance;
  const double approach = std::max(-w.dot(n), 0.0);
  const double e = pair_restitution(world_, a, b);
  const double press = -(w.squaredNorm() - approach * approach + d.dot(q.a - p.a)) / distance;
  const bool take_up = taken_up(a, b, e, approach, press, distance);
  const double separation = take_up ? 0 : e * approach;
  const double impulse = impact_impulse(ma, mb, approach, separation);
  const double lost = impact_loss(ma, mb, approach, separation);
  lose(lost);
  tally_.max_overlap = std::max(tally_.max_overlap, world_.radius[a] + world_.radius[b] - distance);
  tally_.max_speed = std::max({tally_.max_speed, va.norm(), vb.norm()});
  if (!take_up)
    record({now_.hi, CollisionKind::body_body, a, b, xa + world_.radius[a] * n, n, approach, separation, e, impulse,
            lost});
  for (Entity i : {a, b})
    if (take_up || (crowded(i) && place_[i] == Place::asleep)) join(i);
  for (Entity i : {a, b})
    if (crowded(i)) stir(i, approach);
  restart(a, xa, keep_contacts(a, va - (impulse / ma) * n), {b, no_feature});
  restart(b, xb, keep_contacts(b, vb + (impulse / mb) * n), {a, no_feature});
  predict(a);
  predict(b);
  if (take_up) {
    jostle(a);
    jostle(b);
  }
}

void ExactSimulator::collide_fixed(Entity i, Entity surface, std::uint8_t feature) {
  const Flight& f = flight_[i];
  const double t = now_ - f.start;
  const Vec3 x = f.position(t), v = f.velocity(t);
  const double mass = world_.mass[i], radius = world_.radius[i];
  const bool flat = is_flat(surface, feature);
  // n points from the body to the surface.
  Vec3 n;
  double gap;
  if (flat) {
    n = -contact_normal({surface, feature, false, {}, 0});
    const Vec3& point = world_.is_plane(surface) ? world_.plane(surface).point : world_.wall(surface).center;
    gap = plane_gap(x, point, -n, radius);
  } else {
    const Vec3 d = nearest_on_wall(world_.wall(surface), x) - x;
    n = d / d.norm();
    gap = d.norm() - radius;
  }
  const double approach = std::max(v.dot(n), 0.0);
  const double e = pair_restitution(world_, i, surface);
  double separation = e * approach;
  const Vec3 free_a = free_acceleration(i, surface);
  // On a rim the body turns about the point of contact, and its speed across the edge lightens it.
  double across = v.squaredNorm() - approach * approach;
  if (!flat && feature < wall_corners) {
    const Wall& wall = world_.wall(surface);
    const double along = v.dot(feature < wall_edges + 2 ? wall.up : wall.right);
    across -= along * along;
  }
  const double press = free_a.dot(n) - (flat ? 0 : across / radius);
  tally_.max_overlap = std::max(tally_.max_overlap, -gap);
  tally_.max_speed = std::max(tally_.max_speed, v.norm());

  Contact contact{surface, feature, false, now_, separation};
  bool rests = false;
  if (press > 0 && flat && !contacts_.empty() && !crowded(i) && contacts_[i].count < max_contacts &&
      (e < 1 || approach == 0)) {
    const double left = separation == 0 ? 0 : 2 * separation / (press * (1 - e));
    const bool carried = contacts_[i].count > 0 && origin_[i].partner != surface;
    rests = now_.hi + left == now_.hi || approach < options_.rest_speed || (carried && too_low(x, approach, press));
    contact.rest_time = now_ + left;
    contact.settling = rests;
  }
  const bool take_up = !rests && taken_up(i, surface, e, approach, press, radius);
  if (take_up) {
    separation = 0;
    join(i);
  } else if (crowded(i) && place_[i] == Place::asleep) {
    join(i);
  }
  if (crowded(i)) stir(i, approach);
  if (approach > 0 || separation > 0) {
    const double lost = impact_loss(mass, immovable, approach, separation);
    lose(lost);
    if (!take_up)
      record({now_.hi, CollisionKind::body_fixed, i, surface, x + radius * n, n, approach, separation, e,
              impact_impulse(mass, immovable, approach, separation), lost});
  }
  if (rests) {
    settle(i, contact);
    restart(i, x + gap * n, keep_contacts(i, v - approach * n), {surface, feature});
  } else {
    restart(i, x, keep_contacts(i, v - (approach + separation) * n), {surface, feature});
  }
  predict(i);
  if (take_up) jostle(i);
}

/// Adds a surface to those that carry body i.
void ExactSimulator::settle(Entity i, const Contact& contact) {
  lose(impact_loss(world_.mass[i], immovable, contact.residual_speed, 0));
  Contacts& contacts = contacts_[i];
  if (contacts.count == 0) ++tally_.resting;
  contacts.at[contacts.count++] = contact;
}

/// The bounces' end, as a line in the record: the body has been carried since the last impact.
void ExactSimulator::finish_rest(Entity i) {
  for (std::size_t k = 0; k < contacts_[i].count; ++k) {
    Contact& contact = contacts_[i].at[k];
    if (!contact.settling || now_ < contact.rest_time) continue;
    contact.settling = false;
    const Vec3 n = -contact_normal(contact);
    const Vec3 x = flight_[i].position(now_ - flight_[i].start);
    const double u = contact.residual_speed;
    record({now_.hi, CollisionKind::rest, i, contact.surface, x + world_.radius[i] * n, n, u, 0,
            pair_restitution(world_, i, contact.surface), impact_impulse(world_.mass[i], immovable, u, 0),
            impact_loss(world_.mass[i], immovable, u, 0)});
    break;
  }
  predict(i);
}

/// Body i slides over the rim of the wall's face that carried it; the rim's edge is what it has last touched.
void ExactSimulator::release(Entity i, Entity surface, std::uint8_t edge) {
  Contacts& contacts = contacts_[i];
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface == surface) {
      contacts.at[k] = contacts.at[--contacts.count];
      if (contacts.count == 0) --tally_.resting;
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
  if (contacts_.empty() || contacts_[i].count == 0) return v;
  Contacts& contacts = contacts_[i];
  const Vec3 x = flight_[i].position(now_ - flight_[i].start);
  const double noise = velocity_rounding * (v.norm() + flight_[i].v.norm());
  std::array<bool, max_contacts> keep;
  std::array<double, max_contacts> press;
  for (std::size_t k = 0; k < contacts.count; ++k) {
    const Contact& contact = contacts.at[k];
    const Vec3 n = -contact_normal(contact);
    const double u = n.dot(v);  // into the surface
    press[k] = n.dot(free_acceleration(i, contact.surface));
    keep[k] = std::abs(u) <= noise || (press[k] > 0 && too_low(x, u, press[k]));
    if (keep[k] || u < 0 || press[k] <= 0) continue;
    const double e = pair_restitution(world_, i, contact.surface);
    keep[k] = e < 1 && now_.hi + 2 * e * u / (press[k] * (1 - e)) == now_.hi;
    if (keep[k])
      record({now_.hi, CollisionKind::body_fixed, i, contact.surface, x + world_.radius[i] * n, n, u, 0, e,
              impact_impulse(world_.mass[i], immovable, u, 0), impact_loss(world_.mass[i], immovable, u, 0)});
  }
  std::array<Vec3, max_contacts> normals;
  const auto thin_out = [&] {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < contacts.count; ++k) {
      if (!keep[k]) continue;
      normals[kept] = contact_normal(contacts.at[k]);
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
  if (contacts.count == 0) --tally_.resting;
  lose(0.5 * world_.mass[i] * (v - allowed).dot(v + allowed));
  return allowed;
}

/// The acceleration that gravity and the contacts' reactions leave to body i. Contacts that do not press are given up.
Vec3 ExactSimulator::contact_acceleration(Entity i) {
  if (crowded(i)) return Vec3::Zero();  // the crowd's steps have the forces in them
  if (contacts_.empty() || contacts_[i].count == 0) return world_.gravity;
  Contacts& contacts = contacts_[i];
  std::array<Vec3, max_contacts> normals;
  for (std::size_t k = 0; k < contacts.count; ++k) normals[k] = contact_normal(contacts.at[k]);
  unsigned active;
  const Vec3 a = project_to_cone(world_.gravity, {normals.data(), contacts.count}, active);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (active >> k & 1u) contacts.at[kept++] = contacts.at[k];
  contacts.count = kept;
  if (kept == 0) --tally_.resting;
  return a;
}

/// The same without one surface, and changing nothing: what would press body i against that surface.
Vec3 ExactSimulator::free_acceleration(Entity i, Entity without) const {
  if (contacts_.empty() || contacts_[i].count == 0) return world_.gravity;
  const Contacts& contacts = contacts_[i];
  std::array<Vec3, max_contacts> normals;
  std::size_t n = 0;
  for (std::size_t k = 0; k < contacts.count; ++k)
    if (contacts.at[k].surface != without) normals[n++] = contact_normal(contacts.at[k]);
  unsigned active;
  return project_to_cone(world_.gravity, {normals.data(), n}, active);
}

/// At the start: a body that touches a flat surface (but for rounding of the scene's numbers), does not move along its
/// normal and is pressed on rests there from the first.
void ExactSimulator::touch_down(Entity i) {
  Flight& f = flight_[i];
  const double radius = world_.radius[i];
  for (Entity e : near_[i]) {
    if (world_.is_body(e) || contacts_[i].count == max_contacts) continue;
    const bool plane = world_.is_plane(e);
    const Vec3& point = plane ? world_.plane(e).point : world_.wall(e).center;
    std::uint8_t feature = no_feature;
    if (!plane) {
      if (!(nearest_on_wall(world_.wall(e), f.x) - f.x).cross(world_.wall(e).normal).isZero(1e-12 * radius)) continue;
      feature = world_.wall(e).normal.dot(f.x - point) > 0 ? wall_front : wall_back;
    }
    const Contact contact{e, feature, false, {}, 0};
    const Vec3 n = contact_normal(contact);
    const double gap = plane_gap(f.x, point, n, radius);
    const double rounding = 0x1p-50 * (f.x.cwiseAbs().sum() + point.cwiseAbs().sum() + radius);
    if (std::abs(gap) > rounding || std::abs(n.dot(f.v)) > velocity_rounding * f.v.norm() || n.dot(world_.gravity) >= 0)
      continue;
    settle(i, contact);
    f.x -= gap * n;
    origin_[i] = {e, feature};
  }
  f.a = contact_acceleration(i);
}

bool ExactSimulator::in_contact(Entity i, Entity surface) const {
  if (contacts_.empty()) return false;
  for (std::size_t k = 0; k < contacts_[i].count; ++k)
    if (contacts_[i].at[k].surface == surface) return true;
  return false;
}

/// Unit, from the surface to the body that it carries.
Vec3 ExactSimulator::contact_normal(const Contact& contact) const {
  if (world_.is_plane(contact.surface)) return world_.plane(contact.surface).normal;
  const Vec3& normal = world_.wall(contact.surface).normal;
  return contact.feature == wall_back ? Vec3(-normal) : normal;
}

}  // namespace carom
