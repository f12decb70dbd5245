// The constrained equations of motion of an island, with the accelerations from the complementarity conditions of its
// closed contacts. While the set of contacts is the same the motion is smooth, and DOP853 follows it. Stiff drag goes
// to collocation at Radau's points. Openings are found from the accelerations of gaps, because forces need not be
// unique. Rims are found at samples of the dense output.
#include "simulate/island/constrained_system.h"

#include <fmt/format.h>

#include "geometry/shell.h"
#include "numerics/cube_root.h"
#include "numerics/disjoint_sets.h"
#include "numerics/dormand_prince.h"
#include "numerics/elementary.h"
#include "numerics/gauss.h"
#include "numerics/radau_collocation.h"
#include "physics/closed_motion.h"
#include "physics/force.h"
#include "physics/world.h"
#include "simulate/path/instant.h"
#include "simulate/simulation_error.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

// Samples of a step at which rims and opened contacts are examined.
constexpr int samples = 6;

/// The least radius of curvature of the Minkowski sum of two volumes where it is round (m).
/// A cylinder's rim is sharp. A sphere makes it as round as the sphere.
double bend_radius(const World& world, const Contact& contact) {
  const auto& [i, e, feature] = contact;
  if (world.is_string(e)) return world.string(e).length;
  if (world.is_shell(e)) return Shell(world.obstacle(e)).bend_radius(world.radius[i], feature);

  // The sum of the sizes of those that are of this shape.
  const auto round = [&](Shape shape) {
    double sum = 0;
    for (const Entity k : {contact.i, contact.e}) {
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

double smaller_radius(const World& world, const Contact& c) {
  const Entity second = world.second_body(c.e);
  return second != no_entity ? min(world.radius[c.i], world.radius[second]) : world.radius[c.i];
}

bool is_rod(const World& world, Entity e) {
  return world.is_string(e) && world.string(e).rod;
}

Vec3 relative(const vector<Vec3>& v, const ContactConstraint& p) {
  return (p.b == ContactConstraint::fixed ? Vec3(Vec3::Zero()) : v[p.b]) - v[p.a];
}

/// The first time (s) in a step at which `happens` is true of all positions (m). It is false at `from` and true at
/// `to`.
template <typename Happens>
double first_time(const DenseMotion& motion, double from, double to, Happens happens) {
  vector<Vec3> x, v;
  while (to - from > tol::time_precision * motion.length()) {
    const double t = 0.5 * (from + to);
    motion.at(t, x, v);
    (happens(x) ? to : from) = t;
  }
  return to;
}

/// The acceleration (m/s^2) of a body, or of one that parts with these shares of its mass make up.
Vec3 bent_acceleration(const World& world, Entity i, const vector<pair<Entity, double>>& parts, double time,
                       const Vec3& x, const Vec3& v) {
  if (parts.empty()) return free_acceleration(world, i, time, x, v);
  Vec3 sum = Vec3::Zero();
  for (const auto& [part, share] : parts)
    sum += share * free_acceleration(world, part, time, {x, v, share * world.mass[i]});
  return sum;
}

double greatest_norm(const vector<Vec3>& v) {
  double greatest = 0;
  for (const Vec3& of : v) greatest = max(greatest, of.norm());
  return greatest;
}

}  // namespace

ConstrainedSystem::ConstrainedSystem(const World& world, double time, vector<Entity> members, vector<Applied> applied,
                                     double step_error)
    : world_(world),
      time_(time),
      step_error_(step_error),
      rounding_(0x1p-53 * (step_error / tol::step_error)),
      members_(std::move(members)),
      applied_(std::move(applied)),
      left_(members_.size(), 0) {
  for (const Entity i : members_) inverse_mass_.push_back(1 / world.mass[i]);
}

void ConstrainedSystem::add_moving(Entity e, const Vec3& x, const Vec3& v) {
  if (carrier_of(e) != nullptr) return;
  carriers_.push_back({e, x, v});
  const Swing* const swing = world_.swing(e);
  if (swing == nullptr) return;
  Carrier& carrier = carriers_.back();
  carrier.rate = turning_rate(*swing);
  carrier.greatest = greatest_acceleration(*swing);
  carrier.middle = world_.fixed_position(e) + swing->middle;
}

/// The greatest acceleration of a thing that swings (m/s^2).
double ConstrainedSystem::greatest_swing() const {
  double greatest = 0;
  for (const Carrier& carrier : carriers_) greatest = max(greatest, carrier.greatest);
  return greatest;
}

/// The time (s) until the acceleration of a thing that swings is the greatest or least along the normal of a contact. A
/// contact that it opens for a moment is open then, so that a step which ends there shows it.
double ConstrainedSystem::to_extreme() const {
  double first = never;
  const auto take = [&](const vector<Contact>& contacts, const vector<ContactConstraint>& rows) {
    for (size_t c = 0; c < contacts.size(); ++c) {
      const Carrier* const carrier = carrier_of(rows[c], contacts[c].e);
      if (carrier == nullptr || carrier->rate == 0) continue;
      // out cos(rate t) + speed sin(rate t) is the greatest at this angle, and the least half a turn later.
      const double out = carrier->rate * rows[c].normal.dot(carrier->x - carrier->middle);
      const double speed = rows[c].normal.dot(carrier->v);
      double angle = arc_tangent(speed, out);
      while (angle < tol::extreme) angle += 3.14159265358979323846;
      first = min(first, angle / carrier->rate);
    }
  };
  take(closed_, rows_);
  take(opened_, opened_rows_);
  return first;
}

const ConstrainedSystem::Carrier* ConstrainedSystem::carrier_of(Entity e) const {
  for (const Carrier& carrier : carriers_)
    if (carrier.thing == e) return &carrier;
  return nullptr;
}

/// Positions or velocities of the members, and of the moving things after them.
vector<Vec3> ConstrainedSystem::with_carriers(vector<Vec3> of_members, Vec3 Carrier::*of_carrier) const {
  for (const Carrier& carrier : carriers_) of_members.push_back(carrier.*of_carrier);
  return of_members;
}

void ConstrainedSystem::add(const Contact& contact, const ContactConstraint& pair, double guess) {
  closed_.push_back(contact);
  rows_.push_back({pair.a, pair.b, pair.normal});
  rows_.back().bilateral = pair.bilateral;
  rows_.back().force = guess;
}

void ConstrainedSystem::open_contacts(const vector<uint8_t>& which) {
  size_t kept = 0;
  for (size_t c = 0; c < closed_.size(); ++c) {
    if (which[c]) {
      opened_.push_back(closed_[c]);
      opened_rows_.push_back(rows_[c]);
    } else {
      closed_[kept] = closed_[c];
      rows_[kept++] = rows_[c];
    }
  }
  closed_.resize(kept);
  rows_.resize(kept);
}

/// The accelerations by forces without contact (m/s^2), by member.
vector<Vec3> ConstrainedSystem::forces_at(const vector<Vec3>& x, const vector<Vec3>& v) const {
  vector<Vec3> a;
  a.reserve(v.size());

  for (size_t k = 0; k < v.size(); ++k) {
    if (k >= applied_.size()) {
      a.push_back(carriers_[k - applied_.size()].acceleration(x[k]));
      continue;
    }

    const auto& [at_rest, fade, bent, parts] = applied_[k];
    if (bent)
      a.push_back(bent_acceleration(world_, members_[k], parts, time_, x[k], v[k]));
    else
      a.push_back(fade == 0 ? at_rest : Vec3(at_rest - fade * v[k]));
  }

  if (couplings_.any()) couplings_.accelerate(inverse_mass_, x, v, a);
  return a;
}

bool ConstrainedSystem::any_bent() const {
  return couplings_.any() || any_of(applied_, [](const Applied& of) { return of.bent; });
}

double ConstrainedSystem::common_fade() const {
  const double fade = applied_.front().fade;
  const bool same = all_of(applied_, [&](const Applied& of) { return of.fade == fade; });
  return same ? fade : -1;
}

/// The position of a contact's second thing (m). x: of the members at the start, or of all points later.
Vec3 ConstrainedSystem::place_of(const vector<Vec3>& x, uint32_t b, Entity e) const {
  if (b != ContactConstraint::fixed) return x[b];
  const Carrier* const carrier = carrier_of(e);
  if (carrier == nullptr) return world_.fixed_position(e);
  return x.size() > members_.size() ? x[place_of_carrier(*carrier)] : carrier->x;
}

Vec3 ConstrainedSystem::relative_velocity(const vector<Vec3>& v, const ContactConstraint& row, Entity e) const {
  const Carrier* const carrier = carrier_of(row, e);
  if (carrier == nullptr) return relative(v, row);
  return (v.size() > members_.size() ? v[place_of_carrier(*carrier)] : carrier->v) - v[row.a];
}

/// The displacement of a contact's second thing relative to the first since the start (m).
Vec3 ConstrainedSystem::moved(const DenseMotion& motion, const vector<Vec3>& x, const ContactConstraint& row,
                              Entity e) const {
  const Vec3 of_a = x[row.a] - motion.start(row.a);
  if (row.b != ContactConstraint::fixed) return (x[row.b] - motion.start(row.b)) - of_a;
  const Carrier* const carrier = carrier_of(e);
  return (carrier == nullptr ? Vec3(Vec3::Zero()) : Vec3(x[place_of_carrier(*carrier)] - carrier->x)) - of_a;
}

/// Allows rods path errors of the accelerations, where other rods hold their ends already.
void ConstrainedSystem::allow_contradictions(const vector<Vec3>& a, vector<ContactConstraint>& rows) const {
  double greatest = greatest_norm(a);
  for (const ContactConstraint& row : rows) greatest = max(greatest, std::abs(row.target));
  for (size_t c = 0; c < rows.size(); ++c)
    if (is_rod(world_, closed_[c].e)) rows[c].slack = tol::step_error * greatest;
}

vector<Vec3> ConstrainedSystem::solve_rows(const vector<Vec3>& x, const vector<Vec3>& v,
                                           vector<ContactConstraint>& rows, Certificate& certificate,
                                           bool least) const {
  vector<Vec3> a = forces_at(x, v);
  bool rods = false;
  for (size_t c = 0; c < rows.size(); ++c) {
    const auto& [i, e, feature] = closed_[c];
    ContactConstraint& row = rows[c];
    const Carrier* const carrier = carrier_of(row, e);
    const bool swings = carrier != nullptr && carrier->rate > 0;
    const bool flat = is_flat(world_, i, e, feature);
    if (flat && !swings) continue;

    const Vec3 xe = place_of(x, row.b, e);
    const Vec3 lead = swings ? carrier->acceleration(xe) : Vec3(Vec3::Zero());
    if (flat) {
      row.target = -row.normal.dot(lead);
      continue;
    }

    // Also beyond its rim.
    const Touch there = touch(world_, i, x[row.a], e, xe, feature);
    row.normal = there.normal;
    if (is_rod(world_, e)) rods = true;
    row.target = -bending(world_, i, x[row.a], e, xe, there, relative_velocity(v, row, e)) - row.normal.dot(lead);
  }

  if (rods) allow_contradictions(a, rows);
  certificate.merge(solve({inverse_mass_, a, rows, least}));
  return a;
}

vector<Vec3> ConstrainedSystem::accelerate(const vector<Vec3>& x, const vector<Vec3>& v, bool least) {
  return solve_rows(x, v, rows_, certificate_, least);
}

double ConstrainedSystem::gap_acceleration(size_t c, const vector<Vec3>& a) const {
  return rows_[c].normal.dot(relative(a, rows_[c])) - rows_[c].target;
}

/// The greatest speed of members relative to what they touch, and where forces vary in space (m/s). What moves all of
/// them alike does not count.
double ConstrainedSystem::relative_speed(const vector<Vec3>& v) const {
  double fastest = 0;
  const auto take = [&](const vector<Contact>& contacts, const vector<ContactConstraint>& rows) {
    for (size_t c = 0; c < contacts.size(); ++c)
      fastest = max(fastest, relative_velocity(v, rows[c], contacts[c].e).norm());
  };
  take(closed_, rows_);
  take(opened_, opened_rows_);
  for (size_t k = 0; k < members_.size(); ++k)
    if (applied_[k].bent || applied_[k].fade > 0) fastest = max(fastest, v[k].norm());

  if (couplings_.any()) {
    const Vec3 common = common_velocity(v);
    for (size_t k = 0; k < members_.size(); ++k) fastest = max(fastest, (v[k] - common).norm());
  }
  return fastest;
}

/// The velocity of the members' centre of mass (m/s).
Vec3 ConstrainedSystem::common_velocity(const vector<Vec3>& v) const {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (size_t k = 0; k < members_.size(); ++k) {
    sum += v[k] / inverse_mass_[k];
    mass += 1 / inverse_mass_[k];
  }
  return sum / mass;
}

/// By member: the greatest speed (m/s) among those that springs and contacts connect with it, relative to the centre of
/// mass. What attracts it from afar has a speed of its own.
vector<double> ConstrainedSystem::own_speeds(const vector<Vec3>& v) const {
  DisjointSets sets(members_.size());
  couplings_.for_each_spring([&](uint32_t a, uint32_t b) { sets.join(a, b); });
  for (const auto* rows : {&rows_, &opened_rows_})
    for (const ContactConstraint& row : *rows)
      if (row.b != ContactConstraint::fixed) sets.join(row.a, row.b);

  const Vec3 common = common_velocity(v);
  vector<double> of_set(members_.size(), 0);
  for (uint32_t k = 0; k < members_.size(); ++k) {
    double& fastest = of_set[sets.root(k)];
    fastest = max(fastest, (v[k] - common).norm());
  }
  vector<double> speeds;
  for (uint32_t k = 0; k < members_.size(); ++k) speeds.push_back(of_set[sets.root(k)]);
  return speeds;
}

ConstrainedSystem::Scales ConstrainedSystem::scales(const vector<Vec3>& x, const vector<Vec3>& v) const {
  Scales s;
  double farthest = 0;
  for (const Entity i : members_) s.length = min(s.length, world_.radius[i]);
  for (const Vec3& at : x) farthest = max(farthest, at.cwiseAbs().maxCoeff());

  s.acceleration = max(greatest_norm(forces_at(x, v)), greatest_swing());
  for (const ContactConstraint& row : rows_) s.acceleration = max(s.acceleration, std::abs(row.target));
  s.speed = max(relative_speed(v), sqrt(s.acceleration * s.length));

  // The greatest term of the forces' sum.
  double strongest = s.acceleration;
  for (size_t k = 0; k < v.size(); ++k)
    if (applied_[k].fade > 0) strongest = max({strongest, applied_[k].at_rest.norm(), applied_[k].fade * v[k].norm()});
  if (couplings_.any() && !rows_.empty()) {
    const vector<double> none(members_.size(), 0);
    for (const CoupledForces::Scale& of : couplings_.scales(inverse_mass_, x, v, none))
      strongest = max(strongest, of.strongest);
  }
  s.opening = strongest * max(tol::opening, tol::contact_rounding * farthest / s.length);
  return s;
}

/// By member: the rounding of its position (m). A coordinate that does not change is not rounded.
vector<double> ConstrainedSystem::place_roundings(const vector<Vec3>& x, const vector<Vec3>& v,
                                                  const vector<Vec3>& a) const {
  vector<double> roundings;
  for (size_t k = 0; k < members_.size(); ++k) {
    double sum = 0;  // m
    for (int axis = 0; axis < 3; ++axis)
      if (v[k][axis] != 0 || a[k][axis] != 0) sum += std::abs(x[k][axis]);
    roundings.push_back(rounding_ * sum);
  }
  return roundings;
}

/// The same for the distance of a contact's two things.
double ConstrainedSystem::distance_rounding(const vector<double>& of_places, const ContactConstraint& row,
                                            Entity e) const {
  if (row.b != ContactConstraint::fixed) return of_places[row.a] + of_places[row.b];
  const Carrier* const carrier = carrier_of(e);
  return of_places[row.a] + (carrier == nullptr ? 0 : rounding_ * carrier->x.cwiseAbs().sum());
}

/// The acceleration by a contact's force of its two members relative to one another (m/s^2).
double ConstrainedSystem::reaction(const ContactConstraint& row) const {
  const double inverse_mass = inverse_mass_[row.a] + inverse_mass_of_b(inverse_mass_, row);
  return std::abs(row.force) * inverse_mass;
}

/// The time (s) for which a contact's force keeps its direction, where its members slide at w (m/s) and with the
/// acceleration a (m/s^2) over a surface of radius `bend` (m).
///
/// The force turns by the way over the radius. Parabolas then miss load (w t^3 / 6 + a t^4 / 24) / bend, with the
/// acceleration `load` (m/s^2) by the force, however small w and a are. That must be a small share of the way itself,
/// because the motion away from an equilibrium grows in proportion to it, or half the rounding of positions (m).
double ConstrainedSystem::turning_time(double load, double bend, double w, double a, double rounding) const {
  if (!(load * (w + a) > 0)) return never;
  const double share = sqrt(6 * step_error_ * bend / load);
  double rounded = never;
  if (w > 0) rounded = cube_root(3 * rounding * bend / (load * w));
  if (a > 0) rounded = min(rounded, sqrt(sqrt(12 * rounding * bend / (load * a))));
  return max(share, rounded);
}

/// The time for which parabolas stay on closed contacts, and for which open contacts cannot return unseen.
///
/// The gap's third derivative is about 3 w . a / bend, its fourth 3 a . a / bend. For this time they move the body off
/// the parabola by less than the method's error. The forces keep their direction meanwhile.
double ConstrainedSystem::straight_time(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const {
  if (any_swings()) return 0;
  double h = never;
  const double fade = max(common_fade(), 0.0);
  const vector<double> roundings = place_roundings(x, v, a);

  const auto keep = [&](const vector<Contact>& contacts, const vector<ContactConstraint>& rows) {
    for (size_t c = 0; c < contacts.size(); ++c) {
      const auto& [i, e, feature] = contacts[c];
      if (is_flat(world_, i, e, feature)) continue;

      const double bend = bend_radius(world_, contacts[c]);
      const double room = step_error_ * smaller_radius(world_, contacts[c]) * bend;
      const double w = relative_velocity(v, rows[c], e).norm();
      const double pull = relative(a, rows[c]).norm();

      const double bent = pull + w * w / bend;
      if (bent > 0) h = min(h, sqrt(sqrt(8 * room) / bent));
      if (w * bent > 0) h = min(h, cube_root(2 * room / (w * bent)));
      h = min(h, turning_time(reaction(rows[c]), bend, w, pull, distance_rounding(roundings, rows[c], e)));
      // On a path that drag bends the acceleration decays, and that across the surface does not.
      if (fade * w > 0) h = min(h, max(cube_root(6 * room / (fade * w * w)), sqrt(2 * room) / w));
    }
  };

  keep(closed_, rows_);
  keep(opened_, opened_rows_);
  if (any_bent()) return 0;
  if (common_fade() >= 0) return h;

  double length = never;
  for (const Entity i : members_) length = min(length, world_.radius[i]);
  // m/s^3, an upper bound: the effect of drag on forces in flat contacts.
  const double jerk = greatest_fade() * greatest_norm(a);
  return jerk > 0 ? min(h, cube_root(6 * step_error_ * length / jerk)) : h;
}

/// The errors that a step may have: shares of the motion itself, as far as rounding allows. Near an equilibrium speeds
/// and accelerations are small, and errors grow with the motion.
ConstrainedSystem::Allowed ConstrainedSystem::allowed_errors(const vector<Vec3>& x, const vector<Vec3>& v,
                                                             const vector<Vec3>& a) const {
  const vector<double> roundings = place_roundings(x, v, a);
  double rate = 0;     // 1/s, at which accelerations change
  double fastest = 0;  // m/s, along what bends paths
  double rounded = 0;  // m/s, by the rounding of what turns forces

  const auto take = [&](double of_rate, double speed, double rounding) {
    rate = max(rate, of_rate);
    fastest = max(fastest, speed);
    rounded = max(rounded, of_rate * rounding);
  };

  for (size_t c = 0; c < closed_.size(); ++c) {
    const auto& [i, e, feature] = closed_[c];
    if (is_flat(world_, i, e, feature)) continue;
    const double bend = bend_radius(world_, closed_[c]);
    const double w = relative_velocity(v, rows_[c], e).norm();
    take(max(sqrt(reaction(rows_[c]) / bend), w / bend), w, distance_rounding(roundings, rows_[c], e));
  }

  // Forces that vary refer to places and velocities in space.
  double width = scales_.length;  // m, in which forces change
  double left = 1;                // of speeds
  for (size_t k = 0; k < members_.size(); ++k) {
    const Entity i = members_[k];
    if (applied_[k].bent || applied_[k].fade > 0) take(0, v[k].norm(), 0);
    if (!applied_[k].bent) continue;

    const double swings = sqrt(force_jacobian(world_, i, time_, x[k], v[k]).by_position.norm());
    take(min(swings, force_rate(world_, i, x[k], v[k])), 0, roundings[k]);
    width = min(width, force_reach(world_, i, x[k]));
    left = min(left, left_of_speed(world_, i, time_, x[k], v[k]));
  }

  for (const Carrier& carrier : carriers_) take(carrier.rate, 0, 0);

  // The speed that the motion reaches, from rest, before accelerations change.
  const double pull = max(greatest_norm(a), greatest_swing());
  double gained = sqrt(pull * width);
  if (rate > 0) gained = min(gained, pull / rate);
  if (const double fade = greatest_fade(); fade > 0) gained = min(gained, pull / fade);

  const double place = *ranges::max_element(roundings);
  const double speed = step_error_ * left * max(fastest, gained);
  Allowed allowed{max(step_error_ * left * width, place),
                  max({speed, rounded, rounding_ * greatest_norm(v), 0x1p-900})};
  if (couplings_.any()) allow_each(x, v, a, allowed);
  return allowed;
}

/// The errors that forces between members allow each of them: shares of its own motion, as far as rounding allows.
void ConstrainedSystem::allow_each(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a,
                                   Allowed& allowed) const {
  const vector<double> roundings = place_roundings(x, v, a);
  const vector<CoupledForces::Scale> scales = couplings_.scales(inverse_mass_, x, v, roundings);
  const vector<double> speeds = own_speeds(v);
  for (size_t k = 0; k < members_.size(); ++k) {
    const Entity i = members_[k];
    double width = min(world_.radius[i], scales[k].reach);  // m, in which forces change
    double left = scales[k].left;
    if (applied_[k].bent) {
      width = min(width, force_reach(world_, i, x[k]));
      left = min(left, left_of_speed(world_, i, time_, x[k], v[k]));
    }

    // The speed that it reaches, from rest, before its acceleration changes.
    const double pull = a[k].norm();
    double gained = sqrt(pull * width);
    if (scales[k].rate > 0) gained = min(gained, pull / scales[k].rate);

    // Sums of a step have the rounding of a few terms.
    const double rounded = max(scales[k].rounded, 4 * rounding_ * v[k].norm());
    allowed.places.push_back(max(step_error_ * left * width, roundings[k]));
    allowed.speeds.push_back(max({step_error_ * left * max(speeds[k], gained), rounded, 0x1p-900}));
  }

  // Things that carry members have no error.
  allowed.places.resize(members_.size() + carriers_.size(), allowed.place);
  allowed.speeds.resize(members_.size() + carriers_.size(), allowed.speed);
}

/// The longest step (s) in which no member comes to more than half of its way to an attractor.
double ConstrainedSystem::within_reach(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const {
  double longest = never;
  for (size_t k = 0; k < members_.size(); ++k) {
    if (!applied_[k].bent) continue;
    const double time = step_within(force_reach(world_, members_[k], x[k]), v[k].norm(), a[k].norm());
    if (time > 0) longest = min(longest, time);
  }
  return couplings_.any() ? min(longest, couplings_.longest_step(x, v, a)) : longest;
}

ConstrainedSystem::Followed ConstrainedSystem::follow(const vector<Vec3>& x, const vector<Vec3>& v,
                                                      const vector<Vec3>& a, double first, double longest) {
  scales_ = scales(x, v);
  // Contacts that press are held as equalities, and would pull rather than open. The motion is then smooth beyond an
  // opening too.
  held_ = rows_;
  for (ContactConstraint& row : held_) row.bilateral = row.bilateral || row.independent > 0;
  allowed_ = allowed_errors(x, v, a);
  const double h =
      min({first > 0 ? first : tol::first_step * scales_.time(), longest, within_reach(x, v, a), to_extreme()});
  // Where drag decays within the step that its stability allows, an implicit method takes longer steps.
  if (greatest_fade() * h > 1 && !any_bent() && !any_swings())
    if (Followed followed = follow_stiff(x, v, h); followed.motion) return followed;
  return follow_smooth(x, v, a, h);
}

/// Whether a step moves any body by more than its position's rounding.
bool ConstrainedSystem::moves(const DenseMotion& motion) {
  for (size_t k = 0; k < motion.size(); ++k)
    if (motion.displacement(k, motion.length()).norm() > 0x1p-53 * motion.start(k).norm()) return true;
  return false;
}

/// Follows the motion by the method of order 8, with a first step of h (s).
ConstrainedSystem::Followed ConstrainedSystem::follow_smooth(const vector<Vec3>& x, const vector<Vec3>& v,
                                                             const vector<Vec3>& a, double h) {
  vector<ContactConstraint> rows = held_;
  const auto smooth = [&](const vector<Vec3>& at, const vector<Vec3>& speed) {
    Certificate of_stage;
    return solve_rows(at, speed, rows, of_stage);
  };

  Followed followed;
  vector<Vec3> start = a;
  for (const Carrier& carrier : carriers_) start.push_back(carrier.acceleration(carrier.x));
  auto motion =
      make_unique<DormandPrince>(with_carriers(x, &Carrier::x), with_carriers(v, &Carrier::v), std::move(start));

  const double rounded = rounding_ * greatest_norm(v);  // m/s
  const auto step = [&](double length) {
    if (allowed_.places.empty())
      return motion->step(length, smooth, max(allowed_.place, length * rounded), allowed_.speed);
    vector<double> places = allowed_.places;
    for (size_t k = 0; k < v.size(); ++k) places[k] = max(places[k], length * rounding_ * v[k].norm());
    return motion->step(length, smooth, places, allowed_.speeds);
  };

  // Shorter steps follow until the error is allowed.
  bool rejected = false;
  for (;;) {
    check_clock(h);
    const double error = step(h);
    followed.next = DormandPrince::next_length(h, error);
    if (error <= 1) {
      motion->interpolate(smooth);
      if (!couplings_.any()) break;
      // The path between is as right as its end.
      const double between = error_between(*motion, smooth);
      followed.next = min(followed.next, DormandPrince::next_length(h, between));
      if (between <= 1) break;
    }
    rejected = true;
    h = followed.next;
  }

  followed.stuck = rejected && greatest_norm(v) > 0 && !moves(*motion);
  // The step ends at the first change in it.
  const double change = first_change(*motion);
  followed.changes = change < never;
  if (change < h) {
    step(change);
    motion->interpolate(smooth);
  }

  followed.motion = std::move(motion);
  return followed;
}

/// The error of velocities within a step, as a share of the allowed one: from the defect, the path's acceleration less
/// that by the forces there. Both vanish at a step's ends. An error like s^2 (1 - s)^2 is 1/3 of its slope at a
/// quarter.
double ConstrainedSystem::error_between(const DenseMotion& motion, const DormandPrince::Acceleration& forces) const {
  const double h = motion.length();
  double greatest = 0;
  vector<Vec3> x;
  vector<Vec3> v;

  for (const double s : {0.25, 0.75}) {
    motion.at(s * h, x, v);
    const vector<Vec3> a = forces(x, v);
    for (size_t k = 0; k < members_.size(); ++k) {
      const double defect = (motion.path(k).acceleration(s * h) - a[k]).cwiseAbs().maxCoeff();
      greatest = max(greatest, defect * h / 3 / allowed_.speeds[k]);
    }
  }
  return greatest;
}

/// Throws SimulationError if forces between members ask for a step (s) that does not move the clock.
void ConstrainedSystem::check_clock(double length) const {
  if (!couplings_.any() || Instant{time_, 0} < Instant{time_, 0} + length) return;
  throw SimulationError(fmt::format("at t = {} s the forces between bodies on ", time_), members_.front(),
                        " or others change faster than the clock resolves: soften `gravitation`, or weaken a stiff "
                        "`spring`");
}

/// Follows the motion by collocation. No motion: drag does not decay within its steps.
ConstrainedSystem::Followed ConstrainedSystem::follow_stiff(const vector<Vec3>& x, const vector<Vec3>& v, double h) {
  vector<RadauCollocation::Forces> forces;
  for (const Applied& of : applied_) forces.push_back({of.at_rest, of.fade});
  forces.resize(forces.size() + carriers_.size(), {Vec3::Zero(), 0});

  // Each stage stays on the surfaces.
  vector<ContactConstraint> rows = held_;
  vector<double> inverse_mass(members_.size());
  const auto hold = [&](const vector<Vec3>& at, double s, vector<Vec3>& u) {
    for (size_t k = 0; k < members_.size(); ++k) inverse_mass[k] = inverse_mass_[k] / (1 + s * applied_[k].fade);
    for (size_t c = 0; c < rows.size(); ++c) {
      const auto& [i, e, feature] = closed_[c];
      rows[c].target = 0;
      if (!is_flat(world_, i, e, feature))
        rows[c].normal = touch(world_, i, at[rows[c].a], e, place_of(at, rows[c].b, e), feature).normal;
      if (const Carrier* carrier = carrier_of(e)) rows[c].surface = rows[c].normal.dot(carrier->v);
    }
    solve({inverse_mass, u, rows});
  };

  Followed followed;
  auto motion = make_unique<RadauCollocation>(with_carriers(x, &Carrier::x), with_carriers(v, &Carrier::v));
  const auto step = [&](double length) { return motion->step(length, forces, hold, allowed_.place, allowed_.speed); };

  // Shorter steps follow until the error is allowed.
  for (;;) {
    const double error = step(h);
    followed.next = DormandPrince::next_length(h, error);
    if (error <= 1) break;
    h = followed.next;
    if (greatest_fade() * h < 1) return {};
  }

  const double change = first_change(*motion);
  followed.changes = change < never;
  if (change < h) step(change);
  followed.motion = std::move(motion);
  return followed;
}

/// The integral of force times velocity by Gauss's rule, with the forces that hold the motion on the surfaces.
double ConstrainedSystem::work(const DenseMotion& motion, double length) const {
  vector<ContactConstraint> rows = held_;
  double work = 0;
  vector<Vec3> x;
  vector<Vec3> v;
  for (const GaussPoint& point : gauss_6) {
    motion.at(point.at * length, x, v);
    Certificate certificate;
    solve_rows(x, v, rows, certificate);

    // The power of moving things on members that are not left out.
    double power = 0;
    for (size_t c = 0; c < rows.size(); ++c)
      if (const Carrier* carrier = carrier_of(closed_[c].e); carrier != nullptr && !left_[rows[c].a])
        power -= rows[c].force * rows[c].normal.dot(v[place_of_carrier(*carrier)]);
    work += point.weight * length * power;
  }

  return work;
}

/// Adds the integrals of forces between two times (s), by closed contact, by Gauss's rule. False, and nothing is added:
/// the force of a rod changes its sign between the rule's points.
bool ConstrainedSystem::add_integrals(const DenseMotion& motion, double from, double to, vector<double>& sums) const {
  vector<ContactConstraint> rows = held_;
  vector<double> found(rows.size(), 0);  // N s
  vector<double> magnitude(rows.size(), 0);
  vector<Vec3> x;
  vector<Vec3> v;
  for (const GaussPoint& point : gauss_6) {
    motion.at(from + point.at * (to - from), x, v);
    Certificate certificate;
    solve_rows(x, v, rows, certificate);

    for (size_t c = 0; c < rows.size(); ++c) {
      const bool rod = is_rod(world_, closed_[c].e);
      found[c] += point.weight * (to - from) * (rod ? rows[c].force : max(rows[c].force, 0.0));
      magnitude[c] += point.weight * (to - from) * std::abs(rows[c].force);
    }
  }

  for (size_t c = 0; c < rows.size(); ++c)
    if (is_rod(world_, closed_[c].e) && std::abs(found[c]) != magnitude[c]) return false;
  for (size_t c = 0; c < rows.size(); ++c) sums[c] += std::abs(found[c]);
  return true;
}

void ConstrainedSystem::add_impulses(const DenseMotion& motion, double from, double to,
                                     const WorkingPath::Take& take) const {
  // Where the sign of a rod's force changes, halves of the time follow. What such a change is in at last is too short
  // to matter.
  vector<double> sums(closed_.size(), 0);  // N s
  const double shortest = 0x1p-26 * motion.length();
  vector<pair<double, double>> todo{{from, to}};
  while (!todo.empty()) {
    const auto [begin, end] = todo.back();
    todo.pop_back();
    if (add_integrals(motion, begin, end, sums) || end - begin < shortest) continue;
    const double middle = 0.5 * (begin + end);
    todo.emplace_back(middle, end);
    todo.emplace_back(begin, middle);
  }

  for (size_t c = 0; c < closed_.size(); ++c)
    if (!left_[held_[c].a]) take({closed_[c].i, closed_[c].e, sums[c]});
}

ConstrainedSystem::Exchanged ConstrainedSystem::exchanged(const DenseMotion& motion, double length) const {
  Exchanged all;
  vector<Vec3> x;
  vector<Vec3> v;
  motion.at(0, x, v);
  all.released = couplings_.potential(x).sum();
  motion.at(length, x, v);
  all.released -= couplings_.potential(x).sum();

  if (!couplings_.works()) return all;
  for (const GaussPoint& point : gauss_10) {
    motion.at(point.at * length, x, v);
    const CoupledForces::Shares power = couplings_.power(x, v);
    all.work.springs += point.weight * length * power.springs;
    all.work.gravitation += point.weight * length * power.gravitation;
  }
  return all;
}

double ConstrainedSystem::greatest_fade() const {
  double fade = 0;
  for (const Applied& of : applied_) fade = max(fade, of.fade);
  return fade;
}

/// The first change in a step (s), or never.
double ConstrainedSystem::first_change(const DenseMotion& motion) {
  const double h = motion.length();
  double first = never;

  // Openings are searched in the first half, and then in the second.
  const double middle = opens(motion, 0.5 * h);
  if (middle > tol::opened) {
    first = find_opening(motion, 0, 0.5 * h, middle);
  } else if (const double end = opens(motion, h); end > tol::opened) {
    first = find_opening(motion, 0.5 * h, h, end);
  }

  // Rims and opened contacts are examined at samples.
  const auto rim = [&](const vector<Vec3>& at) { return over_rim(motion, at); };
  const auto back = [&](const vector<Vec3>& at) { return classify_opened(motion, at) == Opened::back; };
  vector<Vec3> x;
  vector<Vec3> v;
  for (int k = 1; k <= samples; ++k) {
    const double from = h * (k - 1) / samples;
    const double to = k == samples ? h : h * k / samples;
    if (from >= first) break;

    motion.at(to, x, v);
    if (rim(x)) first = min(first, first_time(motion, from, to, rim));
    const Opened opened = classify_opened(motion, x);
    if (opened == Opened::away) first = min(first, to);
    if (opened == Opened::back) first = min(first, first_time(motion, from, to, back));
  }
  return first;
}

/// The greatest acceleration of a gap at t (s), as a multiple of its rounding.
double ConstrainedSystem::opens(const DenseMotion& motion, double t) {
  if (scales_.opening == 0) return 0;
  vector<Vec3> x, v;
  motion.at(t, x, v);
  const vector<Vec3> a = accelerate(x, v);
  double greatest = 0;
  for (size_t c = 0; c < rows_.size(); ++c)
    if (!rows_[c].bilateral) greatest = max(greatest, gap_acceleration(c, a));
  return greatest / scales_.opening;
}

/// The time (s) at which gaps accelerate clearly, but only just. They do at `to` (by at_end), and not at `from`.
double ConstrainedSystem::find_opening(const DenseMotion& motion, double from, double to, double at_end) {
  const double aim = sqrt(tol::opened * tol::wide_open);
  // A second point at which contacts are open.
  double beyond = to;
  double at_beyond = at_end;

  for (int pass = 0; pass < 100 && to - from > tol::time_precision * motion.length(); ++pass) {
    if (at_end <= tol::wide_open) break;
    // The middle, or the secant's point where that lies between `from` and `to`.
    double t = 0.5 * (from + to);
    if (beyond > to && at_beyond > at_end) {
      const double secant = to - (at_end - aim) * (beyond - to) / (at_beyond - at_end);
      if (secant > from && secant < to) t = secant;
    }

    const double at_t = opens(motion, t);
    if (at_t > tol::opened) {
      beyond = exchange(to, t);
      at_beyond = exchange(at_end, at_t);
    } else {
      from = t;
    }
  }
  return to;
}

/// Whether a closed contact has crossed its feature's rim by more than rounding.
bool ConstrainedSystem::over_rim(const DenseMotion& motion, const vector<Vec3>& x) const {
  for (size_t c = 0; c < closed_.size(); ++c) {
    const auto& [i, e, feature] = closed_[c];
    const ContactConstraint& row = rows_[c];
    const Vec3 xe = place_of(x, row.b, e);
    if (touch(world_, i, x[row.a], e, xe).feature == feature) continue;
    const double over = max(tol::step_error * smaller_radius(world_, closed_[c]),
                            tol::contact_rounding * (x[row.a].cwiseAbs().sum() + xe.cwiseAbs().sum()));  // m
    if (moved(motion, x, row, e).norm() > over) return true;
  }
  return false;
}

/// The state of the opened contacts: the first that returns counts, then those far enough away to meet again.
ConstrainedSystem::Opened ConstrainedSystem::classify_opened(const DenseMotion& motion, const vector<Vec3>& x) const {
  Opened all = Opened::near;
  for (size_t c = 0; c < opened_.size(); ++c) {
    const auto& [i, e, feature] = opened_[c];
    const ContactConstraint& row = opened_rows_[c];
    const double least = smaller_radius(world_, opened_[c]);
    const Vec3 xe = place_of(x, row.b, e);
    const double gap = touch(world_, i, x[row.a], e, xe).gap;

    // The place of the second thing at the start.
    const Carrier* const carrier = row.b == ContactConstraint::fixed ? carrier_of(e) : nullptr;
    const Vec3 xe_first = row.b != ContactConstraint::fixed ? motion.start(row.b)
                          : carrier != nullptr              ? carrier->x
                                                            : xe;

    const double rounding = tol::contact_rounding * (x[row.a].cwiseAbs().sum() + xe.cwiseAbs().sum());
    if (gap < -max(tol::step_error * least, rounding) &&
        gap < touch(world_, i, motion.start(row.a), e, xe_first).gap - tol::step_error * least)
      return Opened::back;
    if (gap > max(tol::contact_gap * least, rounding)) all = Opened::away;
  }
  return all;
}

}  // namespace carom
