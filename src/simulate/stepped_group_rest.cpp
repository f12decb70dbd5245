#include "simulate/stepped_group_rest.h"

#include <algorithm>
#include <limits>

#include "physics/contact_problem.h"
#include "physics/disjoint_sets.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

GroupRest::GroupRest(StepShared& shared, const StepImpactPredictor& predictor)
    : shared_(shared),
      contacts_(shared, predictor, true),
      slow_steps_(shared.world.body_count()),
      failures_(shared.world.body_count()) {}

void GroupRest::note(Entity i, bool pressed, double speed, double acceleration) {
  const bool slow = speed * speed < slow_body * slow_body * acceleration * shared_.world.radius[i];
  slow_steps_[i] = pressed && slow ? slow_steps_[i] + 1 : 0;
}

void GroupRest::put_to_rest(const GroupBodies& group, const std::vector<GroupContact>& contacts) {
  const auto slow = [&](Entity i) { return slow_steps_[i] >= slow_steps; };
  if (std::none_of(group.entity.begin(), group.entity.end(), slow)) return;
  for (const Places& part : parts_of(group, contacts))
    if (due(group, part)) try_part(group, part);
}

/// The group's bodies by what hangs together, by root; some are empty.
std::vector<GroupRest::Places> GroupRest::parts_of(const GroupBodies& group,
                                                   const std::vector<GroupContact>& contacts) const {
  DisjointSets sets(group.size());
  for (const GroupContact& c : contacts) {
    const bool touches = c.impulse > 0 || c.gap < 2 * first_sink * group.smallest_radius;
    if (touches && c.of_b != ContactConstraint::fixed) sets.join(c.of_a, c.of_b);
  }
  std::vector<Places> parts(group.size());
  for (std::uint32_t k = 0; k < group.size(); ++k) parts[sets.root(k)].push_back(k);
  return parts;
}

/// Whether a part is to be looked at now. Found in no balance, it is left alone for a while, longer each time.
bool GroupRest::due(const GroupBodies& group, const Places& part) const {
  std::uint32_t since = std::numeric_limits<std::uint32_t>::max();
  for (const std::uint32_t k : part) since = std::min(since, slow_steps_[group.entity[k]]);
  if (part.empty() || since < slow_steps) return false;
  return since % (slow_steps << failures_[group.entity[part.front()]]) == 0;
}

void GroupRest::try_part(const GroupBodies& group, const Places& places) {
  GroupBodies part;
  for (const std::uint32_t k : places) {
    const Entity i = group.entity[k];
    part.add(shared_.world, i, shared_.paths.end_x[i], Vec3::Zero(), group.free_acceleration[k]);
  }
  part.greatest_acceleration = group.greatest_acceleration;
  std::uint32_t& failures = failures_[part.entity.front()];
  if (!find_balance(part)) {
    failures = std::min(failures + 1, longest_wait);
    return;
  }
  failures = 0;
  stand(part);
  fall_asleep(part);
}

/// Whether and where forces hold a part of the group in balance, close to where it is. It sinks by a little at a time,
/// as far as its contacts let it, until it sinks no more. part.x is where it begins; then where it stands. The impulses
/// of its contacts become forces (N).
bool GroupRest::find_balance(GroupBodies& part) {
  const std::vector<Vec3> from = part.x;
  std::vector<ContactConstraint> pairs;
  double drive = first_sink;
  for (int pass = 0; pass < balance_passes; ++pass) {
    const double farthest = sink(part, drive, pairs);
    if (farthest == never) return false;
    for (std::size_t k = 0; k < part.size(); ++k)
      if ((part.x[k] - from[k]).norm() > farthest_sink * part.smallest_radius) return false;
    if (farthest <= group_balance * drive * part.smallest_radius) {
      const double per_displacement = part.greatest_acceleration / (drive * part.smallest_radius);  // 1/s^2
      for (std::size_t p = 0; p < pairs.size(); ++p) contacts_.list()[p].impulse = per_displacement * pairs[p].force;
      return true;
    }
    if (farthest < small_sink * first_sink * part.smallest_radius) drive = std::min(sink_grows * drive, last_sink);
  }
  return false;  // it slides
}

/// Lets a part sink to where its contacts let it; without them it would by `drive` (of a radius). pairs becomes its
/// contacts with their forces (kg m). m: how far the farthest body sinks. never: no displacement keeps all contacts.
double GroupRest::sink(GroupBodies& part, double drive, std::vector<ContactConstraint>& pairs) {
  contacts_.start_all(part, 4 * farthest_sink * part.smallest_radius / shared_.clock.length());
  contacts_.find(part);
  pairs.clear();
  for (const GroupContact& c : contacts_.list())
    pairs.push_back({c.of_a, c.of_b, c.normal, -c.gap, balance_slack * part.smallest_radius, 0});
  std::vector<Vec3> displacement(part.size());
  for (std::size_t k = 0; k < part.size(); ++k)
    displacement[k] = drive * part.smallest_radius / part.greatest_acceleration * part.free_acceleration[k];
  const Certificate certificate = solve({part.inverse_mass, displacement, pairs, ContactAccuracy::contacts});
  shared_.log.note(certificate);
  if (!certificate.solved()) return never;
  double farthest = 0;
  for (std::size_t k = 0; k < part.size(); ++k) {
    part.x[k] += displacement[k];
    farthest = std::max(farthest, displacement[k].norm());
  }
  return farthest;
}

/// A part stops where it has sunk to.
void GroupRest::stand(const GroupBodies& part) {
  StepPaths& paths = shared_.paths;
  for (std::size_t k = 0; k < part.size(); ++k) {
    const Entity i = part.entity[k];
    paths.end_x[i] = part.x[k];
    paths.end_v[i].setZero();
    paths.path[i] = {paths.x[i], (part.x[k] - paths.x[i]) / shared_.clock.length(), Vec3::Zero(), Vec3::Zero()};
  }
}

void GroupRest::fall_asleep(const GroupBodies& part) {
  const std::uint32_t c = shared_.clusters.create();
  Cluster& cluster = shared_.clusters[c];
  cluster.asleep = true;
  for (const Entity i : part.entity) {
    shared_.clusters.add(c, i);
    shared_.group.leave(i);
    slow_steps_[i] = 0;
  }
  shared_.log.add_resting(part.size());
  for (const GroupContact& contact : contacts_.list())
    if (contact.impulse > 0) cluster.contacts.push_back({contact.a, contact.b, no_feature, true, contact.impulse});
}

}  // namespace carom
