// Event-driven integration (Acary & Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008, ch. 8). A step
// closes overlaps, takes away approaches, computes forces and picks a motion: parabolas where they are exact, otherwise
// a method of order 8, whose dense output is the bodies' flight. It ends at the first change of contact.
#include "simulate/island/constrained_steps.h"

#include <fmt/format.h>

#include "geometry/path_time_of_impact.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Keeps a speed above zero, so that products divided by it stay finite.
double at_least_tiny(double fastest) {
  return max(fastest, 0x1p-900);
}

/// The speed of approach (m/s). A rod may push, which is a pull along the other direction.
double speed_of(const vector<Vec3>& v, const ContactConstraint& p) {
  return p.bilateral ? std::abs(approach(v, p)) : approach(v, p);
}

}  // namespace

void ConstrainedSteps::complete(IslandStep& step, double next_length) const {
  close_overlaps(step);
  take_approaches(step);
  drop_parting(step);
  ConstrainedSystem system = find_forces(step);
  find_resting(step);
  find_pressed(step);
  choose_motion(step, system, next_length);
}

/// Of the usual error of a step, the share that is asked for. What else counts as rounding is as much smaller, or a run
/// with smaller errors would not show what it does. Contacts allow for no greater errors.
double ConstrainedSteps::share_of_errors() const {
  return min(1.0, bodies_.options.step_error / tol::step_error);
}

/// What pressed on a thing that swings keeps to its path, which has no error: gaps are closed there, too.
void ConstrainedSteps::close_overlaps(IslandStep& step) const {
  bool overlap = false;
  vector<ContactConstraint> rows = step.contacts.pairs;
  for (size_t c = 0; c < rows.size(); ++c) {
    ContactConstraint& p = rows[c];
    const auto& [i, e, feature] = step.contacts.names[c];
    const double least = tol::least_overlap * bodies_.world.radius[i];
    if (bodies_.world.swing(e) != nullptr && group_.pressing_force(i, e) > 0) {
      p.bilateral = true;
      p.slack = least;
    }

    const double closes = p.bilateral ? std::abs(p.target) : p.target;
    overlap = overlap || closes > least;
  }
  if (!overlap) return;

  vector<Vec3> displacement(step.x.size(), Vec3::Zero());  // m
  step.bookings.solutions.push_back(solve({step.inverse_mass, displacement, rows}));
  for (size_t k = 0; k < step.x.size(); ++k) step.x[k] += displacement[k];
}

/// Contact takes away the approach of pairs. A struck body that others behind it hold up has an impact in turn with the
/// strike, as with e = 0.
void ConstrainedSteps::take_approaches(IslandStep& step) const {
  for (const Vec3& v : step.v) step.fastest = max(step.fastest, v.norm());
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    ContactConstraint& p = step.contacts.pairs[c];
    const Entity e = step.contacts.names[c].e;
    p.target = 0;
    p.force = 0;
    p.slack = p.bilateral ? tol::step_error * step.fastest : 0;
    p.surface = bodies_.world.moves(e) ? p.normal.dot(bodies_.fixed_velocity(e)) : 0;
  }

  // The contact solver ends the approaches.
  const vector<Vec3> met = step.v;
  const Certificate certificate = solve({step.inverse_mass, step.v, step.contacts.pairs});
  if (certificate.verdict == Certificate::Verdict::infeasible) step.contacts.check_room(bodies_, step.v);
  step.bookings.solutions.push_back(certificate);

  // What that absorbs is booked with the step.
  vector<AbsorbedImpact> impacts = absorbed_impacts(step, met);
  record_fast(step, impacts);
  step.bookings.absorbed = {met, step.v, step.contacts.pairs, std::move(impacts), {}};
  if (bodies_.contact_work.impulses.any()) step.bookings.absorbed.names = step.contacts.names;

  for (size_t k = 0; k < step.v.size(); ++k) {
    const Entity i = step.members[k];
    const Vec3 before = bodies_.velocity(i);
    const bool changed = (step.v[k] - before).norm() > tol::velocity_change * before.norm();
    if (changed && !(group_.member[i].needed < bodies_.now)) step.bookings.struck.push_back(i);
  }
}

/// By pair: the impacts at velocities `met` (m/s) that contact has just absorbed. A pair that a struck body closes has
/// its impact after that body's, and each takes energy from the velocities that it meets.
vector<AbsorbedImpact> ConstrainedSteps::absorbed_impacts(const IslandStep& step, const vector<Vec3>& met) const {
  const vector<ContactConstraint>& pairs = step.contacts.pairs;
  const double errors = tol::drift * step.fastest;  // m/s
  vector<AbsorbedImpact> impacts(pairs.size());
  double all = 0;  // J, lost by all of them
  bool closed_later = false;

  for (size_t c = 0; c < pairs.size(); ++c) {
    impacts[c].approach = speed_of(met, pairs[c]);
    impacts[c].lost = 0.5 * pairs[c].force * approach(met, pairs[c]);
    all += impacts[c].lost;
    // A rod that others move back before it takes its impact gives them energy.
    const bool gives = pairs[c].bilateral && impacts[c].lost < 0 && impacts[c].approach > errors;
    closed_later = closed_later || gives || (pairs[c].force > 0 && impacts[c].approach < -errors);
  }
  if (!closed_later) return impacts;

  // One round after the other, of the pairs that approach by then and of those before.
  for (AbsorbedImpact& impact : impacts) impact = {};
  double in_rounds = 0;  // J
  vector<Vec3> v = met;
  vector<size_t> which;
  vector<uint8_t> taken(pairs.size(), 0);
  for (;;) {
    const size_t before = which.size();
    for (size_t c = 0; c < pairs.size(); ++c) {
      if (taken[c] || !(speed_of(v, pairs[c]) > errors)) continue;
      taken[c] = 1;
      which.push_back(c);
      impacts[c].approach = speed_of(v, pairs[c]);
    }
    if (which.size() == before) break;

    vector<ContactConstraint> rows;
    for (const size_t c : which) rows.push_back(pairs[c]);
    const vector<Vec3> first = v;
    solve({step.inverse_mass, v, rows});
    for (size_t k = 0; k < which.size(); ++k) {
      const double lost = max(0.5 * rows[k].force * (approach(first, rows[k]) + approach(v, rows[k])), 0.0);
      impacts[which[k]].lost += lost;
      in_rounds += lost;
    }
  }

  // Impulses of one round may end in a later one. Energy is that of all together.
  for (AbsorbedImpact& impact : impacts) impact.lost *= in_rounds > 0 ? max(all, 0.0) / in_rounds : 0;
  return impacts;
}

/// Records the absorbed impacts that were not slow: those that struck bodies passed on at once.
void ConstrainedSteps::record_fast(IslandStep& step, vector<AbsorbedImpact>& impacts) const {
  const World& world = bodies_.world;
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const auto& [i, e, feature] = step.contacts.names[c];
    const bool presses = p.force > 0 || (p.bilateral && p.force < 0);
    const double slow = step.load > 0 ? bodies_.slow_speed(step.load, bodies_.smaller_length(i, e)) : 0;
    if (!(presses && impacts[c].approach > max(slow, step.contacts.slow[c]))) continue;

    const double sign = p.force < 0 ? -1 : 1;
    const Touch there = touch(world, i, step.x[p.a], e, step.position_of(bodies_, e), feature);
    // The energy is shared among all struck bodies.
    step.bookings.collisions.push_back({bodies_.now.hi, impact_kind(world, e), i, e, there.point, sign * p.normal,
                                        impacts[c].approach, 0, pair_restitution(world, i, e), sign * p.force,
                                        impacts[c].lost});
    impacts[c].recorded = true;
  }
}

/// The speed (m/s) at which path errors let pairs separate. Strings hold by their curvature where nothing else pulls.
double ConstrainedSteps::parting_speed(const IslandStep& step) const {
  const bool tied = any_of(step.contacts.names, [&](const auto& name) { return bodies_.world.is_string(name.e); });
  return sqrt(2 * step.load * tol::step_error * step.smallest) +
         (tied ? tol::drift : tol::velocity_rounding) * step.fastest;
}

/// Pairs that separate by more than path errors are not contacts. If they return, they meet.
void ConstrainedSteps::drop_parting(IslandStep& step) const {
  const double parting = parting_speed(step);
  const double rounding = tol::velocity_rounding * step.fastest;
  step.contacts.drop_if(0, [&](size_t c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    const double least = group_.has_parted(i, e) ? rounding : parting;
    return !step.contacts.pairs[c].bilateral && step.parting_speed(bodies_, c) > least;
  });
}

/// The equations of motion of a step's members and contacts.
ConstrainedSystem ConstrainedSteps::make_system(const IslandStep& step) const {
  vector<ConstrainedSystem::Applied> applied;
  for (const Entity i : step.members) {
    applied.push_back({bodies_.applied[i], bodies_.fade[i], bodies_.bent[i] != 0});
    if (bodies_.bent[i]) applied.back().parts = bodies_.merged.shares_of(i);
  }
  ConstrainedSystem system(bodies_.world, bodies_.now.hi, step.members.bodies(), std::move(applied),
                           share_of_errors() * tol::step_error);

  system.couple(step.couplings);

  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    if (bodies_.world.moves(e)) system.add_moving(e, bodies_.fixed_position(e), bodies_.fixed_velocity(e));
    system.add(step.contacts.names[c], step.contacts.pairs[c], group_.pressing_force(i, e));
  }
  return system;
}

/// Computes accelerations and forces.
void ConstrainedSteps::accelerate(IslandStep& step, ConstrainedSystem& system) {
  step.a = system.accelerate(step.x, step.v, true);
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) step.contacts.pairs[c].force = system.rows()[c].force;
}

/// Computes the accelerations and forces at the step's start. Contacts that separate and carry no force open.
/// They are watched until they are wide enough to meet again.
ConstrainedSystem ConstrainedSteps::find_forces(IslandStep& step) const {
  ConstrainedSystem system = make_system(step);
  accelerate(step, system);
  if (stop_parting(step)) accelerate(step, system);

  const ConstrainedSystem::Scales scales = system.scales(step.x, step.v);
  check_digits(step, scales.acceleration);
  vector<uint8_t> opens(step.contacts.pairs.size(), 0);
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (p.force > 0 || p.bilateral) continue;
    opens[c] = step.parting_speed(bodies_, c) > tol::drift * scales.speed ||
               system.gap_acceleration(c, step.a) > scales.opening;
  }

  system.open_contacts(opens);
  step.bookings.solutions.push_back(system.certificate());
  return system;
}

/// Removes the small remaining speed of separation of pairs that press, without making any pair approach. This takes no
/// more energy than path errors may have made. Where contacts almost lock a motion, it would stop it: the separation
/// then remains. Returns whether any was removed.
bool ConstrainedSteps::stop_parting(IslandStep& step) const {
  vector<ContactConstraint> kept;
  bool parts = false;
  const double rounding = share_of_errors() * tol::velocity_rounding * step.fastest;  // m/s

  // What presses is to stay closed.
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    parts = parts || (p.force > 0 && step.parting_speed(bodies_, c) > rounding);
    kept.push_back({p.a, p.b, p.normal});
    kept.back().bilateral = p.force > 0 || p.bilateral;
    kept.back().slack = p.slack;
    kept.back().surface = p.surface;
  }
  if (!parts) return false;

  // More energy than errors may have made is no error.
  vector<Vec3> stopped = step.v;  // m/s
  const Certificate certificate = solve({step.inverse_mass, stopped, kept});
  const double errors = parting_speed(step) * (step.fastest + sqrt(step.load * step.smallest));  // m^2/s^2
  double taken = 0;                                                                              // J, twice
  double made = 0;
  for (size_t k = 0; k < step.v.size(); ++k) {
    taken += (stopped[k] - step.v[k]).squaredNorm() / step.inverse_mass[k];
    made += errors / step.inverse_mass[k];
  }
  if (!(taken <= made)) return false;

  step.v = std::move(stopped);
  step.bookings.solutions.push_back(certificate);
  for (const ContactConstraint& p : kept) step.bookings.work += p.work();
  for (size_t c = 0; bodies_.contact_work.impulses.any() && c < kept.size(); ++c)
    if (const Contact& name = step.contacts.names[c]; !step.contacts.pairs[c].bilateral)
      step.bookings.stopped.push_back({name.i, name.e, kept[c].force});
  return true;
}

/// Throws SimulationError where strings and contacts work against one another with forces so great that rounding makes
/// a noticeable part of the accelerations (m/s^2). Those would then be arbitrary: the bodies are jammed. Rounding is
/// that of the force, and that of positions, which turns the string's direction.
void ConstrainedSteps::check_digits(const IslandStep& step, double acceleration) const {
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    if (!bodies_.world.is_string(e)) continue;
    const ContactConstraint& p = step.contacts.pairs[c];
    const double of_e = inverse_mass_of_b(step.inverse_mass, p);
    const double by_force = std::abs(p.force) * max(step.inverse_mass[p.a], of_e);  // m/s^2
    const double noticeable = tol::arbitrary * acceleration;                        // m/s^2
    const double turn = turn_by_rounding(step, c);

    // Forces are great where a motion is across almost all pairs that bear. An error along them is then one across them
    // that is greater by as much as the force is than what acts: such an estimate is cheap.
    const bool doubtful = by_force * turn * by_force > noticeable * acceleration;
    // Great forces on light bodies are no contradiction. A frame with more rods than it needs has no such motion.
    const double magnified = doubtful ? leverage(step, c) : 0;
    if (0x1p-53 * by_force > noticeable || (magnified < never && by_force * turn * magnified > noticeable))
      fail_jammed(i, std::abs(p.force));
  }
}

/// The angle (radians) by which the rounding of positions turns the pair's string.
double ConstrainedSteps::turn_by_rounding(const IslandStep& step, size_t pair) const {
  const Entity e = step.contacts.names[pair].e;
  const double places =
      step.x[step.contacts.pairs[pair].a].cwiseAbs().sum() + step.position_of(bodies_, e).cwiseAbs().sum();
  return 0x1p-53 * places / bodies_.world.string(e).length;
}

/// Throws SimulationError where a string's direction decides whether bodies can move, and rounding decides on that.
void ConstrainedSteps::check_directions(const IslandStep& step) const {
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const auto& [i, e, feature] = step.contacts.names[c];
    if (bodies_.world.is_string(e) && turn_by_rounding(step, c) * leverage(step, c) > tol::arbitrary)
      fail_jammed(i, std::abs(step.contacts.pairs[c].force));
  }
}

/// How far the pair's closing by a unit moves bodies while all others that bear stay closed. Infinity: they keep it
/// from closing.
double ConstrainedSteps::leverage(const IslandStep& step, size_t pair) const {
  vector<ContactConstraint> bearing;
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    ContactConstraint p = step.contacts.pairs[c];
    if (p.force == 0 && c != pair) continue;
    p.bilateral = true;
    p.target = c == pair ? 1 : 0;
    p.force = p.slack = p.surface = 0;
    bearing.push_back(p);
  }

  vector<Vec3> moved(step.x.size(), Vec3::Zero());
  solve({step.inverse_mass, moved, bearing});
  for (const ContactConstraint& p : bearing)
    if (std::abs(approach(moved, p) + p.target) > 0.25) return never;

  double farthest = 0;
  for (const Vec3& u : moved) farthest = max(farthest, u.norm());
  return farthest;
}

/// `force`: of a string of body i, in N.
void ConstrainedSteps::fail_jammed(Entity i, double force) const {
  const char* motion = bodies_.moving.any() ? "end or slow `motion` before, or " : "";
  throw SimulationError(fmt::format("at t = {} s the strings and contacts of ", bodies_.now.hi), i,
                        fmt::format(" work against one another, with a force of {:.3g} N that rounding makes arbitrary "
                                    "(jammed): {}let lengths of strings differ from those that just fit",
                                    force, motion));
}

/// Parts in which no body moves or accelerates are at rest.
void ConstrainedSteps::find_resting(IslandStep& step) const {
  const size_t n = step.x.size();
  const vector<ContactConstraint>& pairs = step.contacts.pairs;
  const vector<uint32_t> part = step.parts();
  vector<uint8_t> moves(n, 1);  // by part
  for (const ContactConstraint& p : pairs) moves[part[p.a]] = 0;

  // The rim of a thing that moves may come along.
  for (size_t c = 0; c < pairs.size(); ++c)
    if (bodies_.moving.moves(step.contacts.names[c].e, bodies_.now)) moves[part[pairs[c].a]] = 1;

  // What drag alone balances goes on.
  const vector<Vec3> moving = step.applied_at(bodies_, step.v);
  const vector<Vec3> at_rest = step.applied_at(bodies_, vector<Vec3>(n, Vec3::Zero()));
  step.fastest = 0;
  for (size_t k = 0; k < n; ++k) {
    const double speed = step.v[k].norm();
    step.fastest = max(step.fastest, speed);
    const Vec3 drag = moving[k] - at_rest[k];
    if (!(speed <= tol::drift * sqrt(step.load * step.smallest) &&
          (step.a[k] - drag).norm() <= tol::constrained_balance * step.load))
      moves[part[k]] = 1;
  }

  step.fates.resize(n);
  for (size_t k = 0; k < n; ++k) step.fates[k].rests = !moves[part[k]];
  note_unbalanced(step);
}

/// Notes accelerations of members at rest that are more than the rounding of forces and of their directions.
void ConstrainedSteps::note_unbalanced(IslandStep& step) const {
  vector<double> rounding(step.x.size(), tol::velocity_rounding * step.load);  // m/s^2
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    const Vec3 xe = step.position_of(bodies_, step.contacts.names[c].e);
    const double places = step.x[p.a].cwiseAbs().sum() + xe.cwiseAbs().sum();
    const double of_force =
        std::abs(p.force) * (tol::velocity_rounding + tol::contact_rounding * places / step.smallest);

    // A rod's force has an allowed error.
    const double of_rod = p.bilateral ? tol::step_error * step.load : 0;
    for (const uint32_t k : {p.a, p.b})
      if (k != ContactConstraint::fixed) rounding[k] += of_force * step.inverse_mass[k] + of_rod;
  }

  const double left = Instant{bodies_.options.duration, 0} - bodies_.now;
  for (size_t k = 0; k < step.x.size(); ++k) {
    const double a = step.a[k].norm();
    if (step.fates[k].rests && a > rounding[k])
      step.bookings.unbalanced.push_back({a, 0.5 * a * left * left, step.members[k]});
  }
}

/// Finds what presses on each member, and what binds it: flat surfaces alone, on which it can rest by itself, or other
/// things.
void ConstrainedSteps::find_pressed(IslandStep& step) const {
  const World& world = bodies_.world;
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c) {
    const ContactConstraint& p = step.contacts.pairs[c];
    if (!(p.force > 0 || p.bilateral)) continue;

    const auto& [i, e, feature] = step.contacts.names[c];
    MemberFate& fate = step.fates[p.a];
    fate.pressed = true;
    if (p.b != ContactConstraint::fixed) {
      MemberFate& other = step.fates[p.b];
      other.pressed = fate.bound = other.bound = true;
      continue;
    }

    if (!is_flat(world, i, e, feature) || bodies_.bent[i] || world.swing(e) != nullptr ||
        fate.flats.count == FlatContactList::most) {
      fate.bound = true;
      continue;
    }

    const double gap = touch(world, i, step.x[p.a] + fate.down, e, step.position_of(bodies_, e)).gap;
    if (gap > tol::drift * world.radius[i]) fate.bound = true;
    fate.down += gap * p.normal;
    fate.flats.at[fate.flats.count++] = {e, feature, -p.normal, false, bodies_.now, 0};
  }

  // Forces between members hold them together.
  step.couplings.for_each_link([&](uint32_t a, uint32_t b) { step.fates[a].bound = step.fates[b].bound = true; });
}

/// The longest step (s). It ends when a body may leave the island, otherwise beyond the run's end.
double ConstrainedSteps::longest(IslandStep& step) const {
  const bool loaded = step.load > 0;
  double h = 2 * (Instant{bodies_.options.duration, 0} - bodies_.now) +
             (loaded ? tol::first_step * sqrt(step.smallest / step.load)
                     : tol::first_step * step.smallest / at_least_tiny(step.fastest));
  step.grace = loaded ? 2 * bodies_.slow_speed(step.load, step.smallest) / step.load
                      : tol::free_time * step.smallest / at_least_tiny(step.fastest);

  for (size_t k = 0; k < step.x.size(); ++k)
    if (step.fates[k].leaves()) {
      const double since = bodies_.now - group_.member[step.members[k]].needed;
      h = min(h, max(step.grace - since, 0.25 * step.grace));
    }
  return step.couplings.any() ? min(h, bodies_.options.step) : h;
}

/// Takes parabolas, for as long as they are the paths, or a step of the method.
void ConstrainedSteps::choose_motion(IslandStep& step, ConstrainedSystem& system, double next_length) const {
  const double time = system.scales(step.x, step.v).time();  // s
  step.length = longest(step);
  const bool all_rest = all_of(step.fates, [](const MemberFate& fate) { return fate.rests; });
  const double straight = all_rest ? step.length : system.straight_time(step.x, step.v, step.a);

  if (!(straight >= min(step.length, time))) {
    // Forces between members change within a moment, too, and do work.
    if (step.undisturbed || step.couplings.any())
      follow(step, system, next_length);
    else
      step.length = min(step.length, tol::moment * time);
    return;
  }

  step.motion.inexact = straight < never && !all_rest;
  step.length = min(step.length, straight);
  step.fade = all_rest ? 0 : max(system.common_fade(), 0.0);
  for (size_t c = 0; c < step.contacts.pairs.size(); ++c)
    if (!step.fates[step.contacts.pairs[c].a].rests)
      step.length = min({step.length, rim_time(step, c, step.length), away_time(step, c)});
}

/// Takes a step of the method.
void ConstrainedSteps::follow(IslandStep& step, ConstrainedSystem& system, double next_length) const {
  ConstrainedSystem::Followed followed = system.follow(step.x, step.v, step.a, next_length, step.length);
  step.length = followed.motion->length();
  if (followed.stuck) check_directions(step);

  step.motion.inexact = true;
  step.motion.next_length = followed.next;
  step.motion.changes = followed.changes;
  step.path = make_shared<IslandPath>(IslandPath{bodies_.now, std::move(followed.motion)});
  if (system.works() || bodies_.contact_work.impulses.any())
    step.motion.forces = make_shared<ConstrainedSystem>(std::move(system));
}

/// The time (s) at which the pair crosses its feature's rim, on parabolas. Motion along a rim, up to rounding, does not
/// cross it.
double ConstrainedSteps::rim_time(const IslandStep& step, size_t pair, double length) const {
  const World& world = bodies_.world;
  const auto& [i, e, feature] = step.contacts.names[pair];
  const uint32_t k = step.contacts.pairs[pair].a;
  const Vec3 ve = step.velocity_of(bodies_, e);
  const Vec3 w = ve - step.v[k];
  const Vec3 a = step.pull_of(bodies_, e) - step.a[k];

  // Motion and acceleration that are mere rounding do not count.
  RelativeMotion m{step.position_of(bodies_, e) - step.x[k], w, a, w.norm(), true};
  const double speeds = step.v[k].norm() + ve.norm();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(w[axis]) <= tol::velocity_rounding * speeds) m.w[axis] = 0;
    if (std::abs(a[axis]) <= tol::velocity_rounding * step.load) m.a[axis] = 0;
  }

  const double over = tol::step_error * step.smallest / at_least_tiny(w.norm());
  const FadingPath of_i{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0};
  const FadingPath of_e{m.d, m.w, m.a, step.fade};
  const double leaves = step.fade == 0 ? leave_feature(world, i, e, feature, m, length).time
                                       : leave_feature(world, i, of_i, e, of_e, feature, length).time;
  return max(leaves, over);
}

/// The time (s) at which a separating pair, or one about to separate, is so far apart that it may meet again.
double ConstrainedSteps::away_time(const IslandStep& step, size_t pair) const {
  const ContactConstraint& p = step.contacts.pairs[pair];
  if (p.force > 0 || p.bilateral) return never;
  const auto& [i, e, feature] = step.contacts.names[pair];
  const double u = step.parting_speed(bodies_, pair);
  const double w = p.normal.dot(step.pull_of(bodies_, e) - step.a[p.a]);
  const double far = 4 * tol::contact_gap * max(bodies_.world.radius[i], step.smallest);  // m

  double t = never;
  if (u > 0) t = min(t, far / u);
  if (w > 0) t = min(t, sqrt(2 * far / w));
  return t;
}

}  // namespace carom
