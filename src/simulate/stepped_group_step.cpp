#include "simulate/stepped_group_step.h"

#include <algorithm>
#include <cmath>

#include "physics/restitution.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

double GroupForces::between(Entity a, Entity b) const {
  for (const PartnerForce& f : of_[a])
    if (f.partner == b) return f.force;
  return 0;
}

void GroupForces::remember(const GroupBodies& bodies, const std::vector<GroupContact>& contacts, double h) {
  for (const Entity i : bodies.entity) of_[i].clear();
  for (const GroupContact& c : contacts)
    if (c.impulse > 0) of_[c.a].push_back({c.b, c.impulse / h});
}

void GroupStep::find_velocities(const GroupBodies& bodies, std::vector<GroupContact>& contacts) {
  choose_pairs(bodies, contacts);
  end_v_ = bodies.v;
  for (std::size_t k = 0; k < bodies.size(); ++k) end_v_[k] += shared_.clock.length() * bodies.free_acceleration[k];
  const std::vector<Vec3> free = end_v_;
  const Certificate certificate = solve_velocities(bodies, false);
  // A body that is struck from two sides at once cannot always separate from both: then no contact bounces in this
  // step.
  const bool energy_may_grow = std::any_of(contacts.begin(), contacts.end(),
                                           [](const GroupContact& c) { return c.impact && c.restitution > 1; });
  if (!certificate.solved() || (!energy_may_grow && gains_energy(bodies, free))) {
    end_v_ = free;
    shared_.log.note(solve_velocities(bodies, true));
  } else {
    shared_.log.note(certificate);
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) contacts[contact_of_[p]].impulse = pairs_[p].force;
}

/// The contacts that may act in the step, with the velocities at which they are to separate.
void GroupStep::choose_pairs(const GroupBodies& bodies, std::vector<GroupContact>& contacts) {
  const double h = shared_.clock.length(), overlap = 2 * allowed_overlap(bodies);
  const double strongest = bodies.greatest_acceleration;
  const double slack = std::clamp(velocity_accuracy * froude_, least_accuracy, most_accuracy) * strongest * h;
  pairs_.clear();
  contact_of_.clear();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    GroupContact& c = contacts[k];
    c.restitution = pair_restitution(shared_.world, c.a, c.b);
    shared_.log.note_overlap(-c.gap);
    const bool fast = 2 * c.restitution * c.approach > strongest * h && c.approach > shared_.options.rest_speed;
    // Farther apart than they fall in a step: a body that is pushed across that collides in a later one.
    if (!fast && c.gap > overlap + strongest * h * h) continue;
    double target = -std::max(c.gap - overlap, 0.0) / h;
    if (fast) {
      if (c.gap > impact_gap * bodies.smallest_radius) continue;  // it has not come yet
      c.impact = true;
      target = c.restitution * c.approach;
    }
    pairs_.push_back({c.of_a, c.of_b, c.normal, target, slack + slack_of_approach * std::max(c.approach, 0.0),
                      forces_.between(c.a, c.b) * h});
    contact_of_.push_back(k);
  }
}

/// Moves end_v_, free velocities, to where contacts allow.
Certificate GroupStep::solve_velocities(const GroupBodies& bodies, bool without_impacts) {
  if (without_impacts)
    for (ContactConstraint& pair : pairs_) {
      pair.target = std::min(pair.target, 0.0);
      pair.force = 0;
    }
  return solve({bodies.inverse_mass, end_v_, pairs_, ContactAccuracy::energy});
}

/// Whether the bodies have more kinetic energy at end_v_ than at these velocities (m/s), beyond what the solver leaves.
bool GroupStep::gains_energy(const GroupBodies& bodies, const std::vector<Vec3>& free) const {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < free.size(); ++k) {
    before += free[k].squaredNorm() / bodies.inverse_mass[k];
    after += end_v_[k].squaredNorm() / bodies.inverse_mass[k];
  }
  return !(after <= (1 + most_gain) * before);
}

void GroupStep::find_displacements(const GroupBodies& bodies, const std::vector<GroupContact>& contacts) {
  const double h = shared_.clock.length(), slack = allowed_overlap(bodies) / h;
  drift_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) drift_[k] = 0.5 * (bodies.v[k] + end_v_[k]);
  pairs_.clear();
  for (const GroupContact& c : contacts) pairs_.push_back({c.of_a, c.of_b, c.normal, -c.gap / h, slack, 0});
  const Certificate certificate = solve({bodies.inverse_mass, drift_, pairs_, ContactAccuracy::contacts});
  shared_.log.note(certificate);
  converged_ = certificate.solved();
}

void GroupStep::find_pressed(const GroupBodies& bodies, const std::vector<GroupContact>& contacts) {
  pressed_.assign(bodies.size(), 0);
  for (const GroupContact& c : contacts) {
    if (!(c.impulse > 0)) continue;
    pressed_[c.of_a] = 1;
    if (c.of_b != ContactConstraint::fixed) pressed_[c.of_b] = 1;
  }
}

void GroupStep::limit_free_bodies(const GroupBodies& bodies) {
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (pressed(k)) continue;
    const double fell = 2 * shared_.clock.length() * bodies.free_acceleration[k].dot(drift_[k]);
    const double after = std::max(bodies.v[k].squaredNorm() + fell, 0.0), now = end_v_[k].squaredNorm();
    if (now > 0) end_v_[k] *= std::sqrt(after / now);
  }
}

void GroupStep::remember(const GroupBodies& bodies, const std::vector<GroupContact>& contacts) {
  const std::size_t n = bodies.size();
  const double h = shared_.clock.length(), strongest = bodies.greatest_acceleration;
  forces_.remember(bodies, contacts, h);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double speed = std::max(drift_[k].norm(), end_v_[k].norm());
    sum += speed / std::sqrt(strongest * shared_.world.radius[bodies.entity[k]]);
  }
  froude_ = strongest > 0 ? sum / static_cast<double>(n) : 1;
  const double far = overlap_of_drift * froude_ * h * std::sqrt(strongest / bodies.smallest_radius);
  overlap_ = std::clamp((converged_ ? overlap_falls : overlap_grows) * overlap_,
                        std::clamp(far, least_overlap, most_overlap), most_overlap);
}

}  // namespace carom
