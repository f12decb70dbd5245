#include "simulate/stepped_group_contacts.h"

#include <algorithm>
#include <cmath>

namespace carom {

GroupContacts::GroupContacts(const StepShared& shared, const StepImpactPredictor& predictor, bool others_fixed)
    : shared_(shared), predictor_(predictor), others_fixed_(others_fixed), place_(shared.world.body_count()) {}

void GroupContacts::start(const GroupBodies& bodies, double more) {
  start_all(bodies, 0);
  for (std::size_t k = 0; k < bodies.size(); ++k) bound_[k] = bodies.v[k].norm() + more;
}

void GroupContacts::start_all(const GroupBodies& bodies, double speed) {
  place_.number(bodies.entity);
  bound_.assign(bodies.size(), speed);
  searched_.assign(bodies.size(), -never);
  list_.clear();
}

void GroupContacts::find(const GroupBodies& bodies) {
  const double drop = bodies.greatest_acceleration * shared_.clock.length() * shared_.clock.length();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (searched(k)) continue;
    const std::size_t first = list_.size();
    find_near(bodies, k, drop);
    // Lists of neighbours are in no order that results may depend on.
    std::sort(list_.begin() + static_cast<std::ptrdiff_t>(first), list_.end(),
              [](const GroupContact& p, const GroupContact& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  }
  searched_ = bound_;
}

/// Adds the contacts of body k that are within its bound, and were not within the last one. Pairs that the other body
/// finds are left out. drop: m, how far bodies fall in a step.
void GroupContacts::find_near(const GroupBodies& bodies, std::size_t k, double drop) {
  const double h = shared_.clock.length();
  const Entity i = bodies.entity[k];
  for (const Entity e : predictor_.neighbours().near(i)) {
    const bool body = shared_.world.is_body(e);
    if (body && !others_fixed_) {  // most are not in reach
      const double reach = predictor_.ball(i).radius + predictor_.ball(e).radius;
      if ((predictor_.ball(e).x - bodies.x[k]).squaredNorm() > reach * reach) continue;
    }
    const bool member = body && place_.in(bodies.entity, e);
    if (body && !member && !others_fixed_) continue;
    const std::uint32_t other = member ? place_[e] : ContactConstraint::fixed;
    if (member && e < i && !searched(other)) continue;  // e has found i
    const Vec3 xe = member ? bodies.x[other] : body ? shared_.paths.end_x[e] : shared_.world.fixed_position(e);
    const double reach = h * (bound_[k] + (member ? bound_[other] : 0)) + drop;
    const double known = h * (searched_[k] + (member ? searched_[other] : 0)) + drop;
    const Touch there = touch_of(bodies, k, e, xe, reach);
    if (!(there.gap <= reach) || there.gap <= known) continue;
    const double approach = there.normal.dot(bodies.v[k] - (member ? bodies.v[other] : Vec3(Vec3::Zero())));
    if (member && e < i)
      list_.push_back({e, i, other, static_cast<std::uint32_t>(k), Vec3(-there.normal), there.gap, approach});
    else
      list_.push_back({i, e, static_cast<std::uint32_t>(k), other, there.normal, there.gap, approach});
  }
}

/// How body k and e, which is at xe (m), lie to each other; never: balls farther apart than `reach` (m).
Touch GroupContacts::touch_of(const GroupBodies& bodies, std::size_t k, Entity e, const Vec3& xe, double reach) const {
  const World& world = shared_.world;
  const Entity i = bodies.entity[k];
  if (!world.is_body(e) || !world.volume.empty()) return touch(world, i, bodies.x[k], e, xe);
  const Vec3 d = xe - bodies.x[k];
  const double s = world.radius[i] + world.radius[e], square = d.squaredNorm();
  if (square > (s + reach) * (s + reach)) return {never, Vec3::Zero(), xe, 0};
  const double distance = std::sqrt(square);
  return {distance - s, distance > 0 ? Vec3(d / distance) : Vec3(Vec3::UnitY()), xe, 0};
}

}  // namespace carom
