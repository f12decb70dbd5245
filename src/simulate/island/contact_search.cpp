// A pair is in contact where its gap is within rounding. One that approaches faster than the force that pressed it last
// could explain has an impact of its own, and is left out.
#include "simulate/island/contact_search.h"

#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

void ContactSearch::find(IslandStep& step) const {
  find_touching(step);
  step.load = load_of(step);
  find_slow_speeds(step);
  drop_striking(step);
}

/// The pairs that touch.
void ContactSearch::find_touching(IslandStep& step) const {
  const World& world = bodies_.world;
  for (uint32_t k = 0; k < step.members.size(); ++k) {
    const Entity i = step.members[k];
    const size_t first = step.contacts.pairs.size();
    for (const Entity e : bodies_.neighbours_of(i)) {
      const bool body = world.is_body(e);
      if (body && (e < i || step.members.number(e) == Numbering::none)) continue;
      // Bodies that merge where they meet have no contact.
      if (body && bodies_.options.merge) continue;

      // A thing that it has just struck touches it at that feature, and at no other.
      const bool struck = bodies_.flights[i].start == bodies_.now && bodies_.body[i].origin_partner == e;
      const Vec3 xe = step.position_of(bodies_, e);
      const Touch there = touch(world, i, step.x[k], e, xe, struck ? bodies_.body[i].origin_feature : no_feature);
      if (there.gap > bodies_.contact_gap(i, step.x[k], xe)) continue;

      const uint32_t other = step.members.number(world.second_body(e));
      step.contacts.add({k, other, there.normal, -there.gap, 0, 0}, {i, e, there.feature}, there.gap);
    }
    step.contacts.drop_hidden(bodies_, step.x[k], first);
    find_strings(step, k);
  }
}

/// The same for the strings of member k. Each belongs to one of its two bodies. A rod is always in contact.
void ContactSearch::find_strings(IslandStep& step, uint32_t k) const {
  const Entity i = step.members[k];
  for (const Entity e : bodies_.ties.of(i)) {
    const String& s = bodies_.world.string(e);
    const uint32_t other = step.members.number(s.other);
    if (s.body != i || (s.other != no_entity && other == Numbering::none)) continue;

    const Vec3 xe = step.position_of(bodies_, e);
    const Touch there = touch(bodies_.world, i, step.x[k], e, xe);
    if (!s.rod && there.gap > bodies_.contact_gap(i, step.x[k], xe)) continue;

    ContactConstraint pair{k, other, there.normal, -there.gap};
    pair.bilateral = s.rod;
    pair.slack = s.rod ? tol::step_error * bodies_.world.radius[i] : 0;
    step.contacts.add(pair, {i, e, there.feature}, there.gap);
  }
}

/// The greatest acceleration by forces with which members may press on anything (m/s^2). Without a fixed thing in
/// contact it is that relative to one another, because what falls freely presses on nothing.
double ContactSearch::load_of(const IslandStep& step) const {
  const bool held =
      any_of(step.contacts.pairs, [](const ContactConstraint& p) { return p.b == ContactConstraint::fixed; });
  const Vec3 common = held ? Vec3(Vec3::Zero()) : step.applied[0];
  double greatest = 0;
  for (const Vec3& pull : step.applied) greatest = max(greatest, (pull - common).norm());
  if (!bodies_.moving.any()) return greatest;

  // What swings presses by its own acceleration, too.
  double swings = 0;
  for (const Contact& name : step.contacts.names)
    if (const Swing* swing = bodies_.world.swing(name.e)) swings = max(swings, greatest_acceleration(*swing));
  return greatest + swings;
}

/// The speeds below which approaches are no impacts of their own, by the forces that pressed pairs together last.
void ContactSearch::find_slow_speeds(IslandStep& step) const {
  ContactList& contacts = step.contacts;
  for (size_t c = 0; c < contacts.pairs.size(); ++c) {
    const ContactConstraint& p = contacts.pairs[c];
    const auto& [i, e, feature] = contacts.names[c];
    const double press =
        group_.pressing_force(i, e) * (step.inverse_mass[p.a] + inverse_mass_of_b(step.inverse_mass, p));  // m/s^2

    // A pair that nothing has pressed together decides by its impact. An error of paths is none.
    const bool pressed = press > tol::curve_rounding * step.load;
    const double slow = pressed ? bodies_.slow_speed(press, bodies_.smaller_length(i, e)) : 0;
    const double errors = bodies_.drift_of(i, step.v[p.a], step.velocity_of(bodies_, e));
    contacts.slow[c] = max({slow, errors, numeric_limits<double>::min()});
  }
}

/// Drops the pairs that are about to strike: they approach faster than that.
void ContactSearch::drop_striking(IslandStep& step) const {
  ContactList& contacts = step.contacts;
  contacts.drop_if(0, [&](size_t c) {
    const ContactConstraint& p = contacts.pairs[c];
    const auto& [i, e, feature] = contacts.names[c];
    const double approach = p.normal.dot(step.v[p.a] - step.velocity_of(bodies_, e));
    const double places = step.x[p.a].cwiseAbs().sum() + step.position_of(bodies_, e).cwiseAbs().sum();
    const bool apart = contacts.gaps[c] > tol::contact_rounding * places;
    return !p.bilateral && group_.strikes(i, e, approach, contacts.slow[c], apart);
  });
}

}  // namespace carom
