// Balances the energy of a run: end - start - work + lost + removed - appeared = residual.
// The residual has a column of its own and is not counted as a loss. The error of the method thus stays visible.
#include "run/account.h"

#include <fmt/format.h>

#include <numeric>

#include "numerics/compensated.h"
#include "physics/coupled_forces.h"
#include "physics/energy.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

// Momentum just after the impulses given at time 0.
Vec3 starting_momentum(const Scene& scene) {
  Vec3 sum = momentum(scene.world, scene.initial);
  for (const Vec3& impulse : scene.world.impulse) sum += impulse;
  return sum;
}

/// The work of each force.
/// A force that acts at all times does the work that its potential loses. The tally has the rest.
/// Empty for a run replayed from its record, which does not hold that work.
vector<ForceWork> work_of_forces(const Scene& scene, const State& end, const Tally& tally) {
  const World& world = scene.world;
  vector<ForceWork> all;
  const bool coupled = has_couplings(world);
  if ((world.forces.empty() && !coupled) || tally.force_work.empty()) return all;

  Sum fallen;
  for (Entity i = 0; i < world.body_count(); ++i)
    fallen.add(world.mass[i] * world.gravity.dot(end.position[i] - scene.initial.position[i]));
  if (!world.gravity.isZero(0)) all.push_back({"gravity", fallen.value()});

  for (size_t k = 0; k < world.forces.size(); ++k) {
    Sum work;
    work.add(tally.force_work[k]);
    for (Entity i = 0; i < world.body_count(); ++i) {
      work.add(potential(world, world.forces[k], i, scene.initial.position[i]));
      work.add(-potential(world, world.forces[k], i, end.position[i]));
    }
    all.push_back({fmt::format("forces.{}.{}", k, name_of(world.forces[k].law)), work.value()});
  }

  // Forces between bodies.
  if (coupled) {
    const auto before = coupled_forces(world, scene.initial).potential(scene.initial.position);
    const auto after = coupled_forces(world, end).potential(end.position);
    const double* const work = &tally.force_work[world.forces.size()];
    if (!world.springs.empty()) all.push_back({"forces.spring", work[0] + before.springs - after.springs});
    if (!world.gravitations.empty())
      all.push_back({"forces.gravitation", work[1] + before.gravitation - after.gravitation});
  }

  // Merged bodies are moved out of what they overlap. No force does this work.
  if (tally.merges > 0)
    all.push_back(
        {"merging", std::accumulate(tally.force_work.begin(), tally.force_work.end(), tally.work, std::minus())});
  return all;
}

/// The first instant with several impacts on a body, in words; empty: there was none.
string first_shared(const Scene& scene, const SharedImpacts& shared) {
  if (shared.instants == 0) return {};
  const auto name = [&](Entity e) { return scene.roster.name(e); };
  return fmt::format("`{}` with `{}` and `{}` at {:.4g} s", name(shared.body), name(shared.one), name(shared.other),
                     shared.first);
}

string ended_by(const Scene& scene, const Tally& tally) {
  if (!tally.end) return "duration";
  switch (tally.end->reason) {
    case EndReason::rest:
      return "rest";
    case EndReason::collisions:
      return "collisions";
    case EndReason::region:
      return "region " + scene.roster.regions.at(tally.end->region);
  }
  return "";
}

/// A lower bound of the greatest kinetic energy of a run (J), so that one whose motion ends as it began has turned over
/// energy too: that of the fastest body at its greatest speed.
double greatest_kinetic(const World& world, const StoredEnergy& start, const StoredEnergy& end, const Tally& tally) {
  const double at_ends = start.kinetic + end.kinetic;
  const auto [speed, body] = tally.fastest;
  return body == no_entity ? at_ends : max(at_ends, 0.5 * world.mass[body] * speed * speed);
}

}  // namespace

StoredEnergy stored_energy(const Scene& scene, const State& state) {
  return {kinetic_energy(scene.world, state), potential_energy(scene.world, state)};
}

vector<SceneEvent> events_of(const Scene& scene, span<const double> fired) {
  vector<SceneEvent> events;
  for (size_t k = 0; k < fired.size(); ++k)
    events.push_back({scene.roster.events[k], fired[k] < not_yet ? fired[k] : numeric_limits<double>::quiet_NaN()});
  return events;
}

// The energy at the start is that of the first row of energy.csv.
// By then bodies of the exact engine have their impulses.
// Bodies of the book engine receive theirs as a force in the first frame, which counts as work.
// The residual is what impacts, work and motion do not account for: the error of the method, and rounding.
Summary account_of(const Scene& scene, const EngineChoice& engine, const StoredEnergy& start, const State& end,
                   const Tally& tally) {
  Summary summary;
  summary.title = scene.title;
  summary.engine = name_of(engine.engine);
  summary.duration = tally.end ? tally.end->time : scene.simulate.duration;
  summary.ended_by = ended_by(scene, tally);

  // Counts.
  summary.bodies = scene.world.body_count();
  summary.collisions = tally.collisions();
  summary.body_body = tally.body_body;
  summary.body_fixed = tally.body_fixed;
  summary.first_collision = tally.first_collision;
  summary.last_collision = tally.last_collision;

  // The balance of energy.
  const StoredEnergy last = stored_energy(scene, end);
  summary.energy.start = start.total();
  summary.energy.end = last.total();
  summary.energy.lost = tally.energy_lost;
  summary.energy.work = tally.work;
  summary.energy.removed = tally.changes.removed.energy;
  summary.energy.appeared = tally.changes.appeared.energy;
  summary.energy.residual = summary.energy.end - summary.energy.start - summary.energy.work + summary.energy.lost +
                            summary.energy.removed - summary.energy.appeared;
  summary.energy.turnover = greatest_kinetic(scene.world, start, last, tally) +
                            std::abs(last.potential - start.potential) + std::abs(tally.energy_lost) +
                            std::abs(tally.work) + std::abs(tally.changes.removed.energy) +
                            std::abs(tally.changes.appeared.energy);

  const Vec3 passed = tally.changes.removed.momentum - tally.changes.appeared.momentum;
  summary.momentum_drift = (momentum(scene.world, end) + passed - starting_momentum(scene)).norm();
  summary.max_overlap = tally.max_overlap;
  summary.max_speed = tally.fastest.speed;
  summary.resting = tally.resting;
  summary.stepped_contact = tally.stepped_contact;

  // What only the report has.
  summary.contact = {tally.merges,
                     tally.tautened,
                     tally.changes.removed.bodies,
                     tally.changes.appeared.bodies,
                     tally.collapses,
                     tally.taken_up,
                     tally.doubts.contact_made,
                     tally.doubts.crowd_steps,
                     tally.doubts.unsolved_steps,
                     tally.shared,
                     first_shared(scene, tally.shared)};

  summary.contact.events = events_of(scene, tally.changes.fired);
  summary.energy.of_forces = work_of_forces(scene, end, tally);
  return summary;
}

}  // namespace carom
