#include "simulate/constrained_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/contact_problem.h"
#include "physics/cube_root.h"
#include "physics/disjoint_sets.h"
#include "simulate/tolerances.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// m, with what radius at least the Minkowski sum of two volumes is bent where it is round: a cylinder's rim is sharp,
/// a sphere makes it as round as itself.
double bend_radius(const World& world, Entity i, Entity e) {
  const auto round = [&](Shape shape) {
    double sum = 0;
    for (const Entity k : {i, e}) {
      if (world.is_plane(k) || world.is_wall(k)) continue;
      const Volume volume = world.volume_of(k);
      if (volume.shape == shape) sum += volume.half.x();
    }
    return sum;
  };
  if (const double r = round(Shape::sphere); r > 0) return r;
  if (const double r = round(Shape::cylinder); r > 0) return r;
  return world.radius[i];
}

/// A product with the speed `fastest` as a divisor must not be infinite.
double at_least_tiny(double fastest) {
  return std::max(fastest, 0x1p-900);
}

}  // namespace

ConstrainedMotion::ConstrainedMotion(ExactBodies& bodies, ExactGroup& group, FlatContacts& flat,
                                     CollapseDetector& collapses, FlightChanges& flights, EventPredictor& predictor)
    : bodies_(bodies),
      group_(group),
      flat_(flat),
      collapses_(collapses),
      flights_(flights),
      predictor_(predictor),
      arrival_time_(bodies.body.size()),
      arrival_v_(bodies.body.size(), Vec3::Zero()),
      arrival_version_(bodies.body.size()) {}

Vec3 ConstrainedMotion::at(const std::vector<Vec3>& x, Entity e) const {
  return bodies_.world.is_body(e) ? x[group_.index[e]] : bodies_.world.fixed_position(e);
}

Vec3 ConstrainedMotion::rate(const std::vector<Vec3>& v, Entity e) const {
  return bodies_.world.is_body(e) ? v[group_.index[e]] : Vec3(Vec3::Zero());
}

void ConstrainedMotion::forget_index(const std::vector<Entity>& members) const {
  for (const Entity i : members) group_.index.write(i) = ContactConstraint::fixed;
}

bool ConstrainedMotion::advance(Entity i) {
  std::vector<Entity>& members = bodies_.islands.of(i).members;
  if (members.size() > 2 * tol::most_pairs) return false;
  std::sort(members.begin(), members.end());
  Step step = begin_step(members);
  find_contacts(step);
  const std::vector<std::uint32_t> part = parts_of(step);
  std::vector<std::size_t> pairs(part.size(), 0);  // by part
  for (const ContactConstraint& p : step.pairs) ++pairs[part[p.a]];
  const bool fits = *std::max_element(pairs.begin(), pairs.end()) <= tol::most_pairs;
  forget_index(members);
  if (!fits) return false;
  for (const Entity first : bodies_.islands.split(i, part)) {
    Step of_part = begin_step(bodies_.islands.of(first).members);
    find_contacts(of_part);
    advance_whole(of_part);
  }
  return true;
}

/// By member: the first one of those that contacts connect with it.
std::vector<std::uint32_t> ConstrainedMotion::parts_of(const Step& step) const {
  const std::size_t n = step.members.size();
  DisjointSets sets(n);
  for (const ContactConstraint& p : step.pairs)
    if (p.b != ContactConstraint::fixed) sets.join(p.a, p.b);
  std::vector<std::uint32_t> part(n), first(n, ContactConstraint::fixed);
  for (std::uint32_t k = 0; k < n; ++k) {
    std::uint32_t& of_part = first[sets.root(k)];
    of_part = std::min(of_part, k);
    part[k] = of_part;
  }
  return part;
}

/// The next step of an island whose bodies contacts connect.
void ConstrainedMotion::advance_whole(Step& step) {
  close_overlaps(step);
  take_approaches(step);
  drop_parting(step);
  for (ContactConstraint& p : step.pairs) p.force = p.target = 0;
  step.a = accelerate(step, step.x, step.v);
  for (const ContactConstraint& p : step.pairs) step.force.push_back(p.force);
  stop_parting(step);
  find_resting(step);
  choose_length(step);
  integrate(step);
  note_contacts(step);
  forget_index(step.members);
  begin_flights(step);
}

/// Where members are and how fast: at the end of a step they have the integrated velocities, not the parabolas'.
ConstrainedMotion::Step ConstrainedMotion::begin_step(std::vector<Entity> members) const {
  const Islands& islands = bodies_.islands;
  Step step;
  step.members = std::move(members);
  for (const Entity i : step.members) {
    group_.index.write(i) = static_cast<std::uint32_t>(step.x.size());
    step.x.push_back(bodies_.position(i));
    const bool constrained = bodies_.is_constrained(i);
    const bool arrived =
        constrained && bodies_.body[i].version == arrival_version_[i] && bodies_.now == arrival_time_[i];
    Vec3 v = arrived ? arrival_v_[i] : bodies_.velocity(i);
    if (!constrained && bodies_.now < islands.kicked_until[i])
      v -= (islands.kicked_until[i] - bodies_.now) * islands.kick[i];
    step.v.push_back(v);
    step.inverse_mass.push_back(1 / bodies_.world.mass[i]);
    step.greatest = std::max(step.greatest, bodies_.load_on(i));
    step.smallest = std::min(step.smallest, bodies_.world.radius[i]);
  }
  return step;
}

/// The pairs in contact, but for those that are about to strike.
void ConstrainedMotion::find_contacts(Step& step) const {
  const World& world = bodies_.world;
  for (std::size_t k = 0; k < step.members.size(); ++k) {
    const Entity i = step.members[k];
    for (const Entity e : bodies_.known_to(i)) {
      const bool body = world.is_body(e);
      if (body && (e < i || group_.index[e] == ContactConstraint::fixed)) continue;
      // A thing that it has struck just now it touches there, and nowhere else.
      const bool struck = bodies_.flights[i].start == bodies_.now && bodies_.body[i].origin_partner == e;
      const Vec3 xe = at(step.x, e);
      const Touch there = touch(world, i, step.x[k], e, xe, struck ? bodies_.body[i].origin_feature : no_feature);
      const double rounding = tol::contact_rounding * (step.x[k].cwiseAbs().sum() + xe.cwiseAbs().sum());
      if (there.gap > std::max(tol::contact_gap * world.radius[i], rounding)) continue;
      const double approach = there.normal.dot(step.v[k] - rate(step.v, e));
      if (group_.strikes(i, e, approach, step.greatest)) continue;
      const std::uint32_t other = body ? group_.index[e] : ContactConstraint::fixed;
      step.pairs.push_back({static_cast<std::uint32_t>(k), other, there.normal, -there.gap, 0, 0});
      step.names.push_back({i, e, there.feature});
    }
  }
}

void ConstrainedMotion::close_overlaps(Step& step) const {
  bool overlap = false;
  for (std::size_t c = 0; c < step.pairs.size(); ++c)
    overlap = overlap || step.pairs[c].target > tol::least_overlap * bodies_.world.radius[step.names[c].a];
  if (!overlap) return;
  std::vector<Vec3> displacement(step.x.size(), Vec3::Zero());  // m
  bodies_.log.note(solve({step.inverse_mass, displacement, step.pairs}));
  for (std::size_t k = 0; k < step.x.size(); ++k) step.x[k] += displacement[k];
}

/// Contact takes what pairs approach each other by. A body that is struck and held up by those behind it: an impact in
/// turn with the strike, as by e = 0.
void ConstrainedMotion::take_approaches(Step& step) {
  for (const Vec3& v : step.v) step.fastest = std::max(step.fastest, v.norm());
  for (ContactConstraint& p : step.pairs) p.target = p.force = 0;
  bodies_.log.note(solve({step.inverse_mass, step.v, step.pairs}));
  for (std::size_t k = 0; k < step.v.size(); ++k) {
    const Entity i = step.members[k];
    const Vec3 before = bodies_.velocity(i);
    if (group_.needed[i] < bodies_.now || (step.v[k] - before).norm() <= tol::velocity_change * before.norm()) continue;
    collapses_.count_in_turn(i, 1);
  }
}

/// Pairs that part by more than path errors are no contacts: if they come back, they meet.
void ConstrainedMotion::drop_parting(Step& step) const {
  const double parting =
      std::sqrt(2 * step.greatest * tol::path_error * step.smallest) + tol::velocity_rounding * step.fastest;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const Vec3 w = rate(step.v, step.names[c].b) - step.v[step.pairs[c].a];
    if (step.pairs[c].normal.dot(w) > parting) continue;
    step.pairs[kept] = step.pairs[c];
    step.names[kept++] = step.names[c];
  }
  step.pairs.resize(kept);
  step.names.resize(kept);
}

/// m/s^2, by member at x (m) and v (m/s): those nearest to the applied ones that keep pairs from nearing each other,
/// n . (a_b - a_a) >= -bending. The forces are left in step.pairs.
std::vector<Vec3> ConstrainedMotion::accelerate(Step& step, const std::vector<Vec3>& x,
                                                const std::vector<Vec3>& v) const {
  const World& world = bodies_.world;
  std::vector<Vec3> a;
  for (const Entity i : step.members) a.push_back(bodies_.applied[i]);
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.names[c];
    ContactConstraint& pair = step.pairs[c];
    if (is_flat(world, i, e, feature)) continue;
    const Vec3 xe = at(x, e);
    const Touch there = touch(world, i, x[pair.a], e, xe);
    pair.normal = there.normal;
    pair.target = -bending(world, i, x[pair.a], e, xe, there, rate(v, e) - v[pair.a]);
  }
  bodies_.log.note(solve({step.inverse_mass, a, step.pairs}));
  return a;
}

/// What presses on does not part: the little speed that is left of parting goes too, and no pair comes to approach.
void ConstrainedMotion::stop_parting(Step& step) const {
  std::vector<ContactConstraint> kept;
  bool parts = false;
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const ContactConstraint& p = step.pairs[c];
    const double speed = p.normal.dot(rate(step.v, step.names[c].b) - step.v[p.a]);
    parts = parts || (p.force > 0 && speed > tol::velocity_rounding * step.fastest);
    kept.push_back({p.a, p.b, p.normal});
    kept.back().bilateral = p.force > 0;
  }
  if (parts) bodies_.log.note(solve({step.inverse_mass, step.v, kept}));
}

/// At rest are islands none of whose bodies moves or is accelerated.
void ConstrainedMotion::find_resting(Step& step) const {
  const std::size_t n = step.x.size();
  DisjointSets islands(n);
  for (const ContactConstraint& p : step.pairs)
    if (p.b != ContactConstraint::fixed) islands.join(p.a, p.b);
  std::vector<std::uint32_t> island(n);
  for (std::uint32_t k = 0; k < n; ++k) island[k] = islands.root(k);
  std::vector<std::uint8_t> moves(n, 1);  // by island
  for (const ContactConstraint& p : step.pairs) moves[island[p.a]] = 0;
  step.fastest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double speed = step.v[k].norm();
    step.fastest = std::max(step.fastest, speed);
    if (!(speed <= tol::standstill * std::sqrt(step.greatest * step.smallest) &&
          step.a[k].norm() <= tol::constrained_balance * step.greatest))
      moves[island[k]] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) step.rests.push_back(!moves[island[k]]);
}

/// The step lasts as long as the parabolas are good, and not beyond when a body may leave the group.
void ConstrainedMotion::choose_length(Step& step) const {
  const double moment =  // s, in which hardly anything can happen
      step.greatest > 0 ? tol::longest_constrained * std::sqrt(2 * step.smallest / step.greatest)
                        : tol::short_time * step.smallest / at_least_tiny(step.fastest);
  double h = 2 * (Instant{bodies_.options.duration, 0} - bodies_.now) + moment;  // beyond the end
  for (std::size_t c = 0; c < step.pairs.size(); ++c)
    if (!step.rests[step.pairs[c].a]) h = length_for(step, c, h, moment);
  step.grace = step.greatest > 0 ? 2 * bodies_.slow_speed(step.greatest, step.smallest) / step.greatest
                                 : tol::free_time * step.smallest / at_least_tiny(step.fastest);
  find_unbound(step);
  for (std::size_t k = 0; k < step.x.size(); ++k)
    if (leaves(step, k))
      h = std::min(h, std::max(step.grace - (bodies_.now - group_.needed[step.members[k]]), 0.25 * step.grace));
  step.length = h;
}

/// s: the step, at most `length`, that a pair's curvature and rim allow.
///
/// The gap's third derivative is about 3 w . a / bend, its fourth 3 a . a / bend. A parabola through both ends leaves
/// t^3 by 4/27 of h^3 at most and t^4 by 1/4 of h^4, so that h^3 might be 13.5 room / (w . a) and h^4 32 room / (a .
/// a); steps are as short as the Runge-Kutta method asks for.
double ConstrainedMotion::length_for(const Step& step, std::size_t pair, double length, double moment) const {
  const World& world = bodies_.world;
  const auto& [i, e, feature] = step.names[pair];
  const std::uint32_t k = step.pairs[pair].a;
  const Vec3 w = rate(step.v, e) - step.v[k], a = rate(step.a, e) - step.a[k];
  const double smaller = world.is_body(e) ? std::min(world.radius[i], world.radius[e]) : world.radius[i];
  const bool flat = is_flat(world, i, e, feature);
  // Along a rim, not over it, but for rounding.
  RelativeMotion m{at(step.x, e) - step.x[k], w, a, w.norm(), true};
  const double speeds = step.v[k].norm() + rate(step.v, e).norm();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(w[axis]) <= tol::velocity_rounding * speeds) m.w[axis] = 0;
    if (std::abs(a[axis]) <= tol::velocity_rounding * step.greatest) m.a[axis] = 0;
  }
  // Beyond the feature's rim the surface bends otherwise: a step goes no farther over it than makes no difference.
  const double bend = flat ? smaller : bend_radius(world, i, e), room = tol::path_error * smaller * bend;
  const double over = flat ? tol::rim_time * moment : std::sqrt(2 * room) / at_least_tiny(w.norm());
  double h = std::min(length, std::max(leave_feature(world, i, e, feature, m, length).time, over));
  if (flat) return h;
  const double bent = m.a.norm() + m.w.squaredNorm() / bend;
  if (bent == 0) return h;
  h = std::min(h, moment);
  h = std::min(h, std::sqrt(std::sqrt(8 * room) / bent));
  if (w.norm() > 0) h = std::min(h, cube_root(2 * room / (w.norm() * bent)));
  return h;
}

/// What each member is pressed on by: flat surfaces alone, which it can rest on without the group, or something else.
void ConstrainedMotion::find_unbound(Step& step) const {
  const World& world = bodies_.world;
  const std::size_t n = step.x.size();
  step.held.assign(n, 0);
  step.bound.assign(n, 0);
  step.flats.resize(n);
  step.down.assign(n, Vec3::Zero());
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const ContactConstraint& p = step.pairs[c];
    if (!(step.force[c] > 0)) continue;
    const auto& [i, e, feature] = step.names[c];
    step.held[p.a] = 1;
    FlatContactList& flats = step.flats[p.a];
    if (p.b != ContactConstraint::fixed) {
      step.held[p.b] = step.bound[p.a] = step.bound[p.b] = 1;
    } else if (is_flat(world, i, e, feature) && flats.count < FlatContactList::most) {
      const double gap = touch(world, i, step.x[p.a] + step.down[p.a], e, at(step.x, e)).gap;
      if (gap > tol::path_error * world.radius[i]) step.bound[p.a] = 1;
      step.down[p.a] += gap * p.normal;
      flats.at[flats.count++] = {e, feature, -p.normal, false, bodies_.now, 0};
    } else {
      step.bound[p.a] = 1;
    }
  }
}

/// Whether member k is to leave the group once it has had time to fall back: on which nothing presses any more, or flat
/// surfaces alone.
bool ConstrainedMotion::leaves(const Step& step, std::size_t k) const {
  return !step.bound[k] && !(step.held[k] && step.rests[k]);
}

/// x'' = accelerate(x, x') by the classical Runge-Kutta method: the mean acceleration that leads to the end positions,
/// and the end velocities.
void ConstrainedMotion::integrate(Step& step) const {
  const std::size_t n = step.x.size();
  const double h = step.length;
  const std::vector<Vec3>&x = step.x, &v = step.v, &a0 = step.a;
  step.path_a = a0;
  step.end_v = v;
  for (std::size_t k = 0; k < n; ++k) step.end_v[k] += h * a0[k];
  const bool all_rest = std::find(step.rests.begin(), step.rests.end(), 0) == step.rests.end();
  if (all_rest || step.pairs.empty()) return;
  std::vector<Vec3> where(n), speed(n);
  for (std::size_t k = 0; k < n; ++k) {
    where[k] = x[k] + 0.5 * h * v[k];
    speed[k] = v[k] + 0.5 * h * a0[k];
  }
  const std::vector<Vec3> a1 = accelerate(step, where, speed);
  for (std::size_t k = 0; k < n; ++k) {
    where[k] = x[k] + 0.5 * h * (v[k] + 0.5 * h * a0[k]);
    speed[k] = v[k] + 0.5 * h * a1[k];
  }
  const std::vector<Vec3> a2 = accelerate(step, where, speed);
  for (std::size_t k = 0; k < n; ++k) {
    where[k] = x[k] + h * (v[k] + 0.5 * h * a1[k]);
    speed[k] = v[k] + h * a2[k];
  }
  const std::vector<Vec3> a3 = accelerate(step, where, speed);
  for (std::size_t k = 0; k < n; ++k) {
    step.path_a[k] = (a0[k] + a1[k] + a2[k]) / 3;
    step.end_v[k] = v[k] + h / 6 * (a0[k] + 2 * a1[k] + 2 * a2[k] + a3[k]);
  }
}

void ConstrainedMotion::note_contacts(const Step& step) {
  for (const Entity i : step.members) {
    group_.partners.write(i).clear();
    group_.pressing.write(i).clear();
  }
  for (std::size_t c = 0; c < step.names.size(); ++c) {
    const auto& [i, e, feature] = step.names[c];
    group_.partners.write(i).push_back(e);
    if (bodies_.world.is_body(e)) group_.partners.write(e).push_back(i);
    if (step.force[c] > 0) group_.pressing.write(i).push_back({e, step.force[c]});
  }
}

/// The members' flights until the step's end.
void ConstrainedMotion::begin_flights(const Step& step) {
  Island& island = bodies_.islands.of(step.members.front());
  island.constrained = false;  // until all flights are new
  island.fresh = false;
  island.end = bodies_.now + step.length;
  std::vector<Entity> stay;
  for (std::size_t k = 0; k < step.members.size(); ++k)
    if (begin_flight(step, k, step.members[k])) stay.push_back(step.members[k]);
  island.constrained = true;
  bodies_.islands.retain(step.members.front(), std::move(stay));
  for (const Entity i : step.members) predictor_.predict(i);
}

/// Body i, the step's member k, leaves its island, falls asleep, or goes on. Gives whether it stays.
bool ConstrainedMotion::begin_flight(const Step& step, std::size_t k, Entity i) {
  const Vec3 &x = step.x[k], &v = step.v[k], before = bodies_.velocity(i);
  bodies_.log.lose(0.5 * bodies_.world.mass[i] * (before - v).dot(before + v));
  if (step.bound[k]) group_.needed.write(i) = bodies_.now;
  if (leaves(step, k) && bodies_.now - group_.needed[i] >= step.grace) {
    bodies_.body[i].state = ContactState::free;
    group_.set_carried(i, false);
    for (std::size_t c = 0; c < step.flats[k].count; ++c) flat_.add(i, step.flats[k].at[c]);
    flights_.begin(i, x + step.down[k], flat_.keep_at(i, v), {});
    return false;
  }
  if (step.rests[k]) {
    bodies_.body[i].state = ContactState::asleep;
    group_.set_carried(i, true);
    flights_.begin(i, x, Vec3::Zero(), {});
    return false;
  }
  group_.set_carried(i, step.held[k]);
  bodies_.islands.kicked_until.write(i) = bodies_.now;
  // What it has struck just now it has still just struck, if nothing has changed since.
  const Flight f = bodies_.flights[i];
  const bool same = f.start == bodies_.now && x == f.x && v == before;
  flights_.begin(i, x, v, same ? bodies_.body[i].origin() : FlightOrigin{});
  bodies_.flights.accelerate(i, step.path_a[k]);
  arrival_v_.write(i) = step.end_v[k];
  arrival_version_.write(i) = bodies_.body[i].version;
  arrival_time_.write(i) = bodies_.islands.of(i).end;
  return true;
}

void ConstrainedMotion::report(const Island& island, double time, std::vector<ContactForce>& forces) const {
  const World& world = bodies_.world;
  const Instant now{time, 0};
  std::vector<Vec3> x, v, a;
  std::vector<double> inverse_mass;
  for (const Entity i : island.members) {
    const double t = now - bodies_.flights[i].start;
    group_.index.write(i) = static_cast<std::uint32_t>(x.size());
    x.push_back(bodies_.flights[i].position(t));
    v.push_back(bodies_.flights[i].velocity(t));
    a.push_back(bodies_.applied[i]);
    inverse_mass.push_back(1 / world.mass[i]);
  }
  std::vector<ContactConstraint> pairs;
  std::vector<std::pair<Entity, Entity>> names;
  for (const Entity i : island.members) {
    for (const Entity e : group_.partners[i]) {
      const bool body = world.is_body(e);
      if (body && (e < i || group_.index[e] == ContactConstraint::fixed)) continue;
      const std::uint32_t k = group_.index[i], other = body ? group_.index[e] : ContactConstraint::fixed;
      const Vec3 xe = at(x, e);
      const Touch there = touch(world, i, x[k], e, xe);
      const double bend = bending(world, i, x[k], e, xe, there, rate(v, e) - v[k]);
      pairs.push_back({k, other, there.normal, -bend});
      names.emplace_back(i, e);
    }
  }
  solve({inverse_mass, a, pairs});
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (pairs[c].force > 0) forces.push_back({names[c].first, names[c].second, pairs[c].force});
  forget_index(island.members);
}

}  // namespace carom
