// What impacts do to velocities.
#include <algorithm>
#include <cmath>

#include "physics/impact.h"
#include "physics/restitution.h"
#include "simulate/exact_simulator.h"

namespace carom {

/// The speed (m/s) under which impacts in lasting contact no longer count one by one: rest_speed, or by default 3 % of
/// the speed gained over `length` (m) at the pressing acceleration (m/s^2).
double ExactSimulator::slow_speed(double press, double length) const {
  return options_.rest_speed > 0 ? options_.rest_speed : 0.03 * std::sqrt(press * length);
}

/// The acceleration (m/s^2) with which body i may press on others. In common free fall, nothing fixed and no other
/// forces, there is none: gravity moves all alike.
double ExactSimulator::load_on(Entity i) const {
  return world_.fixed_count() == 0 && world_.forces.empty() ? 0 : pull_[i].norm();
}

/// Counts an impact of body i: whether it is one of many within a window of time (s).
bool ExactSimulator::in_burst(Entity i, double window, int many) {
  Burst& burst = burst_.write(i);
  if (now_.hi - burst.start > window) burst = {now_.hi, 0, false};
  return ++burst.impacts > many;
}

/// Inelastic collapse (McNamara & Young, Phys. Fluids A 4 (1992) 496): a body between others that close in on it
/// strikes them in turn, ever sooner, and what is left of the gaps is gone in no time. Sums 1 - e of a body's impacts,
/// where e above 1 makes up for others, until it has come from the spot by a billionth of `length` (m), or by what
/// positions far off are rounded by; bouncing on one and the same thing counts once. Impacts in turn that come to an
/// end multiply the speeds by sqrt(e) each, as the determinant of what they do says, and at this sum have left exp(-8)
/// of them: those that go on are a collapse, or as good as over.
bool ExactSimulator::collapses(Entity i, Entity other, double e, double approach, double length) {
  constexpr int many = 64;
  constexpr double enough = 16;
  if (e >= 1 && collapse_.empty()) return false;  // none has lost anything yet
  Collapse& collapse = collapse_.write(i);
  const double spot = std::max(1e-9 * length, 0x1p-48 * flight_[i].x.cwiseAbs().sum());
  if (approach * (now_ - collapse.start) > spot) collapse = {now_, 0, 0};
  if (body_[i].origin != other) {
    if (e < 1) ++collapse.impacts;
    collapse.lost = std::max(collapse.lost + 1 - e, 0.0);
  }
  if (collapse.impacts <= many || collapse.lost <= enough) return false;
  collapse.taken_up = now_;
  return true;
}

/// Whether an impact is the end of bouncing: lasting contact takes it up, nothing is left of the approach (m/s).
/// `press` is the acceleration (m/s^2) that drives the two together. An inelastic collapse ends bouncing at any speed.
/// Under load it also ends when an impact is slow and one of very many within the time of a hop at that speed, or is
/// slow and meets bodies in lasting contact.
bool ExactSimulator::taken_up(Entity a, Entity b, double e, double approach, double press, double length, bool alone) {
  const bool collapse_a = collapses(a, b, e, approach, length);
  const bool collapse_b = world_.is_body(b) && collapses(b, a, e, approach, length);
  if (collapse_a || collapse_b) return true;
  if (e >= 1) return false;
  const bool a_in = crowded(a), b_in = crowded(b), both_in = a_in && (b_in || !world_.is_body(b));
  const double load = std::max(load_on(a), world_.is_body(b) ? load_on(b) : 0.0);
  if (load == 0) return both_in && collapse_[a].impacts > 8;
  const double slow = slow_speed(load, length);
  if (approach >= slow) return false;
  if (both_in) return true;
  if (press > 0 && (a_in || b_in)) return true;
  const double window = 2 * slow / load;
  // Alone on flat surfaces a body comes to rest on each in closed form; only between several can it go on for ever.
  if (alone) return body_[a].origin != b && in_burst(a, window, 256);
  const bool burst_a = in_burst(a, window, 16), burst_b = world_.is_body(b) && in_burst(b, window, 16);
  if (world_.is_body(b)) burst_.write(a).bodies = burst_.write(b).bodies = true;
  return burst_a || burst_b;
}

/// How two things touch that have just met at this feature.
Touch ExactSimulator::touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature) const {
  if (world_.is_body(b) && world_.volume.empty()) {
    // By the actual distance, not the sum of the radii: then the normal is a unit vector and energy is kept to
    // rounding.
    const Vec3 d = xb - xa;
    const double distance = d.norm();
    const Vec3 n = d / distance;
    return {distance - (world_.radius[a] + world_.radius[b]), n, xa + world_.radius[a] * n, 0};
  }
  return touch(world_, a, xa, b, xb, feature);
}

/// Whether a body that lies on flat surfaces strikes one at rest that forces hold on all sides at a speed (m/s) so low
/// that it would lift it by no more than a ten-thousandth of its size.
bool ExactSimulator::too_slow_to_wake(Entity striker, Entity struck, double speed) const {
  constexpr double lift = 1e-4;
  if (contacts_[striker].count == 0) return false;
  if (!(speed * speed < 2 * lift * pull_[struck].norm() * world_.radius[struck])) return false;
  // Three forces at least, not in a plane.
  std::vector<Vec3> normals;
  const Vec3 x = flight_[struck].x;
  const auto hold = [&](Entity e) {
    const bool body = world_.is_body(e);
    normals.push_back(touch(world_, struck, x, e, body ? flight_[e].x : world_.fixed_position(e)).normal);
  };
  for (const Pressed& p : pressed_[struck])
    if (p.force > 0) hold(p.partner);
  for (Entity e : known_to(struck))
    if (world_.is_body(e) && body_[e].place == Place::asleep)
      for (const Pressed& p : pressed_[e])
        if (p.partner == struck && p.force > 0) hold(e);
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (std::abs(normals[i].cross(normals[j]).dot(normals[k])) > 1e-3) return true;
  return false;
}

/// A strike too slow to wake by a body that nothing presses on the struck one: the striker comes to rest.
void ExactSimulator::stop_at(Entity striker, Entity struck, std::uint8_t feature, const Touch& there, double approach) {
  const Flight& f = flight_[striker];
  const double t = now_ - f.start, mass = world_.mass[striker];
  const Vec3 x = f.position(t), v = f.velocity(t);
  const double lost = 0.5 * mass * v.squaredNorm();
  Collision met =
      make_collision(world_, CollisionKind::body_body, now_.hi, std::min(striker, struck), std::max(striker, struck),
                     there.point, there.normal, approach, 0, pair_restitution(world_, striker, struck));
  met.impulse = impact_impulse(mass, immovable, approach, 0);  // the struck one is held
  met.energy_lost = lost;
  log_.record(met);
  log_.lose(lost);
  restart(striker, x, Vec3::Zero(), {struck, feature});
  predict(striker);
}

void ExactSimulator::collide_pair(Entity a, Entity b, std::uint8_t feature) {
  const Flight &p = flight_[a], &q = flight_[b];
  const double ta = now_ - p.start, tb = now_ - q.start;
  const Vec3 xa = p.position(ta), xb = q.position(tb);
  const Vec3 va = p.velocity(ta), vb = q.velocity(tb);
  const Touch there = touch_at(a, xa, b, xb, feature);
  log_.note_overlap(-there.gap);
  log_.note_speed(va.norm());
  log_.note_speed(vb.norm());
  if (options_.merge) return merge(a, b, there);
  const double ma = world_.mass[a], mb = world_.mass[b];
  const Vec3 w = vb - va;
  const Vec3& n = there.normal;
  const double approach = -w.dot(n) > negligible_speed() ? -w.dot(n) : 0;
  const double e = struck_ = pair_restitution(world_, a, b);
  const double met = approach_now(approach, n, a, b), length = world_.radius[a] + world_.radius[b];
  double press = 0;
  if (p.a != q.a) press = -(n.dot(q.a - p.a) + bending(world_, a, xa, b, xb, there, w));
  if (press <= 0)
    for (const auto& [striker, struck] : {std::pair(a, b), std::pair(b, a)})
      if (body_[struck].place == Place::asleep && too_slow_to_wake(striker, struck, w.norm()))
        return stop_at(striker, struck, feature, there, approach);
  // Where nothing presses, an approach that is but rounding is over with this impact.
  const bool told = approach > 0x1p-50 * (va.norm() + vb.norm()) || load_on(a) > 0 || load_on(b) > 0;
  const bool take_up = (approach > 0 && met == 0) || (told && taken_up(a, b, e, met, press, length, false)) ||
                       (press > 0 && (e * met == 0 || too_low(xa, e * met, press)));
  const double separation = take_up ? 0 : e * met;
  const double impulse = impact_impulse(ma, mb, take_up ? approach : met, separation);
  log_.lose(impact_loss(ma, mb, approach, take_up || met == approach ? separation : met + separation - approach));
  if (!take_up)
    log_.record(make_collision(world_, CollisionKind::body_body, now_.hi, a, b, there.point, n, met, separation, e));
  for (Entity i : {a, b}) {
    if (take_up || body_[i].place == Place::asleep) join(i);
    stir(i, approach);
  }
  restart(a, xa, keep_contacts(a, va - (impulse / ma) * n), {b, feature});
  restart(b, xb, keep_contacts(b, vb + (impulse / mb) * n), {a, feature});
  if (take_up)
    for (Entity i : {a, b}) flight_.accelerate(i, Vec3::Zero());
  predict(a);
  predict(b);
  if (take_up) {
    const double held = impact_impulse(ma, mb, approach - met, 0);
    hasten(a, -held / ma * n);
    hasten(b, held / mb * n);
    jostle(a);
    jostle(b);
  }
}

void ExactSimulator::collide_fixed(Entity i, Entity surface, std::uint8_t feature) {
  const Flight& f = flight_[i];
  const double t = now_ - f.start;
  const Vec3 x = f.position(t), v = f.velocity(t);
  const double mass = world_.mass[i], radius = world_.radius[i];
  const bool flat = is_flat(world_, i, surface, feature);
  const Touch there = touch_at(i, x, surface, world_.fixed_position(surface), feature);
  const Vec3& n = there.normal;
  const double approach = v.dot(n) > negligible_speed() ? v.dot(n) : 0;
  const double e = struck_ = pair_restitution(world_, i, surface);
  const double met = approach_now(approach, n, i, surface);
  double separation = e * met;
  const double bend = flat ? 0 : bending(world_, i, x, surface, world_.fixed_position(surface), there, -v);
  const double press = free_acceleration(i, surface).dot(n) - bend;
  log_.note_overlap(-there.gap);
  log_.note_speed(v.norm());

  Contact contact{surface, feature, -n, false, now_, separation};
  bool rests = false;
  const bool ends = e < 1 || approach == 0 || (e == 1 && too_low(x, approach, press));
  if (press > 0 && flat && !crowded(i) && contacts_[i].count < max_contacts && ends) {
    const double left = separation == 0 || e == 1 ? 0 : 2 * separation / (press * (1 - e));
    // Not by hops on this surface alone: thrown back at it by others in between, or by those that carry it, at once.
    const bool carried = contacts_[i].count > 0 && (body_[i].origin != surface || f.start == now_);
    rests = now_.hi + left == now_.hi || approach < options_.rest_speed || (carried && too_low(x, approach, press));
    contact.rest_time = now_ + left;
    contact.settling = rests;
  }
  const bool take_up =
      !rests && ((approach > 0 && met == 0) || taken_up(i, surface, e, met, press, radius, flat && !burst_[i].bodies) ||
                 (press > 0 && (!flat || crowded(i)) && (separation == 0 || too_low(x, separation, press))));
  if (take_up) separation = 0;
  if (take_up || body_[i].place == Place::asleep) join(i);
  stir(i, approach);
  if (approach > 0 || separation > 0) {
    log_.lose(
        impact_loss(mass, immovable, approach, take_up || met == approach ? separation : met + separation - approach));
    if (!take_up)
      log_.record(
          make_collision(world_, CollisionKind::body_fixed, now_.hi, i, surface, there.point, n, met, separation, e));
  }
  if (rests) {
    settle(i, contact);
    restart(i, x + there.gap * n, keep_contacts(i, v - approach * n), {surface, feature});
  } else {
    restart(i, x, keep_contacts(i, v - ((take_up ? approach : met) + separation) * n), {surface, feature});
  }
  if (take_up) flight_.accelerate(i, Vec3::Zero());
  predict(i);
  if (take_up) {
    hasten(i, (met - approach) * n);
    jostle(i);
  }
}

}  // namespace carom
