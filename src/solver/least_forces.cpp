// Least forces: the nearest motion to that of the contact forces alone, for bodies of unit mass and rows that are
// closed. The forces that end such a motion have the sums on each body that the solution has. A proximal Newton method
// (contact_interior_point.h) finds them from zero, so that they contain nothing that cancels among themselves.
#include "solver/least_forces.h"

#include "solver/contact_interior_point.h"
#include "std.h"

namespace carom {

namespace {

/// Whether a row is closed, up to rounding.
bool is_closed(const ContactIsland& island, const ContactSolution& solution, size_t c) {
  const ContactIsland::Row& r = island.rows[c];
  return r.bilateral || solution.force[c].hi > 0 ||
         r.scale * excess(r, solution.motion) <= accepted_change * island.noise_scale(r);
}

/// Sets forces to zero that are only rounding, beside the greatest force on either body.
void clear_rounding(const ContactIsland& island, const vector<size_t>& which, vector<DoubleDouble>& force) {
  vector<double> greatest(island.free.size(), 0.0);  // by body
  for (const size_t c : which) {
    const ContactIsland::Row& r = island.rows[c];
    greatest[r.a] = max(greatest[r.a], std::abs(force[c].hi));
    if (r.moves_b()) greatest[r.b] = max(greatest[r.b], std::abs(force[c].hi));
  }

  for (const size_t c : which) {
    const ContactIsland::Row& r = island.rows[c];
    const double beside = r.moves_b() ? min(greatest[r.a], greatest[r.b]) : greatest[r.a];
    if (std::abs(force[c].hi) <= accepted_change * beside) force[c] = {0, 0};
  }
}

/// Gives all bodies unit mass and all rows one scale, so that their z are forces. False: there is no force on a body.
bool scale_alike(ContactIsland& bodies) {
  bodies.inverse_mass.assign(bodies.free.size(), 1);
  bodies.scale();
  for (ContactIsland::Row& r : bodies.rows) {
    r.scale = 1;
    r.left = bodies.root[r.a] * r.normal;
    if (r.moves_b()) r.right = bodies.root[r.b] * r.normal;
  }
  return bodies.speed != 0;
}

}  // namespace

bool take_least_forces(const ContactIsland& island, ContactSolution& solution, bool independent) {
  vector<size_t> closed;
  bool open = !independent;  // the forces are
  for (size_t c = 0; c < island.rows.size(); ++c) {
    if (!is_closed(island, solution, c)) continue;
    closed.push_back(c);
    open = open || solution.force[c].hi == 0;
  }
  if (!open || closed.size() < 2) return false;

  // Bodies of unit mass, which would move by the sums of these forces.
  find_imbalance(island, solution);
  ContactIsland bodies;
  bodies.free.resize(island.free.size());
  for (size_t i = 0; i < solution.push.size(); ++i) bodies.free[i / 3][int(i % 3)] = -solution.push[i].value();
  for (const size_t c : closed) {
    ContactIsland::Row r = island.rows[c];
    r.target = 0;
    r.force = 0;
    bodies.rows.push_back(r);
  }
  if (!scale_alike(bodies)) return false;

  ContactSolution least;
  if (!ContactInteriorPoint(bodies).solve_least(least).within_slack) return false;

  vector<DoubleDouble> found(island.rows.size(), DoubleDouble{0, 0});
  const PowerOfTwo unit(bodies.motion_exponent - bodies.mass_exponent);
  for (size_t k = 0; k < closed.size(); ++k) found[closed[k]] = {unit * least.force[k].hi, unit * least.force[k].lo};
  clear_rounding(island, closed, found);

  // They must be as exact as the others.
  std::swap(found, solution.force);
  if (judge(island, solution).within_slack) return true;
  std::swap(found, solution.force);
  return false;
}

void correct_hold(const ContactProblem& problem) {
  // The forces on the bodies, and the contacts that bear them.
  ContactIsland bodies;
  for (size_t i = 0; i < problem.motion.size(); ++i) bodies.free.push_back(problem.motion[i] / problem.inverse_mass[i]);
  for (const ContactConstraint& c : problem.contacts) {
    ContactIsland::Row& r = bodies.rows.emplace_back();
    r.a = c.a;
    r.b = c.b;
    r.normal = c.normal;
    r.force = c.force;
  }
  if (!scale_alike(bodies)) return;

  const vector<double> found = ContactInteriorPoint(bodies).correct_hold();
  const PowerOfTwo unit(bodies.motion_exponent - bodies.mass_exponent);
  for (size_t c = 0; c < found.size(); ++c) {
    ContactConstraint& contact = problem.contacts[c];
    contact.force = contact.independent = unit * found[c];
    const Vec3 force = contact.force * contact.normal;
    problem.motion[contact.a] -= problem.inverse_mass[contact.a] * force;
    if (contact.b != ContactConstraint::fixed) problem.motion[contact.b] += problem.inverse_mass[contact.b] * force;
  }
}

}  // namespace carom
