// Matches the collisions of two runs pair by pair in order of time, within the time of passing through each other.
// A fixed tolerance of time would not suit both slow and fast collisions.
#include "bench/differences.h"

#include "numerics/compensated.h"
#include "physics/body_now.h"
#include "physics/coupled_forces.h"
#include "physics/force.h"
#include "std.h"

namespace carom {

namespace {

struct Interval {
  double from, to;  // s
};

/// Matches two runs' collisions, and determines for each body when the runs are on different sides of one.
class Matching {
 public:
  Matching(const World& world, const RecordedRun& reference, const RecordedRun& run, double until)
      : world_(world),
        until_(until),
        end_(reference.duration),
        least_speed_(reference.least_speed()),
        between_(world.body_count()) {
    auto r = reference.impacts.begin();
    auto s = run.impacts.begin();
    while (r != reference.impacts.end() || s != run.impacts.end()) {
      // The next pair that collides in either run, and all its collisions in both.

      const bool from_reference = s == run.impacts.end() || (r != reference.impacts.end() && key(*r) <= key(*s));
      const auto pair = key(from_reference ? *r : *s);
      const auto r_end = std::find_if(r, reference.impacts.end(), [&](const Impact& i) { return key(i) != pair; });
      const auto s_end = std::find_if(s, run.impacts.end(), [&](const Impact& i) { return key(i) != pair; });
      match({r, r_end}, {s, s_end});
      r = r_end;
      s = s_end;
    }
  }

  uint64_t missed() const { return missed_; }
  uint64_t invented() const { return invented_; }

  bool same_side(Entity body, double time) const {
    const auto& between = between_[body];
    return none_of(between, [&](const Interval& i) { return i.from <= time && time <= i.to; });
  }

 private:
  static pair<Entity, Entity> key(const Impact& i) { return {i.a, i.b}; }

  /// In s: the time in which a and b pass through each other at this collision's speed; of a string, that in which its
  /// body moves by its radius.
  double passage(const Impact& i) const {
    const double size = world_.radius[i.a] + (world_.is_body(i.b)       ? world_.radius[i.b]
                                              : world_.is_obstacle(i.b) ? world_.obstacle(i.b).volume.reach()
                                                                        : 0);
    // A speed of 0 gives infinity.
    return size / i.approach_speed;
  }

  /// Matches one pair's collisions in order of time. Of two that are too far apart the earlier one has no counterpart.
  void match(span<const Impact> reference, span<const Impact> run) {
    size_t i = 0, j = 0;
    while (i < reference.size() && j < run.size()) {
      const auto [from, to] = std::minmax(reference[i].time, run[j].time);
      if (to - from <= passage(reference[i])) {
        between_[reference[i].a].push_back({from, to});
        const Entity second = world_.second_body(reference[i].b);
        if (second != no_entity) between_[second].push_back({from, to});
        ++i, ++j;

      } else if (reference[i].time < run[j].time) {
        count(reference[i++], missed_);
      } else {
        count(run[j++], invented_);
      }
    }

    for (; i < reference.size(); ++i) count(reference[i], missed_);
    for (; j < run.size(); ++j) count(run[j], invented_);
  }

  /// A collision near the end may have its counterpart after it and does not count.
  void count(const Impact& impact, uint64_t& sum) const {
    if (impact.time <= until_ && impact.time + passage(impact) <= end_ && impact.approach_speed >= least_speed_) ++sum;
  }

  const World& world_;
  double until_, end_, least_speed_;
  vector<vector<Interval>> between_;  // by body
  uint64_t missed_ = 0, invented_ = 0;
};

}  // namespace

namespace {

/// In J: kinetic energy, and potential energy in the World.
double body_energy(const World& world, const State& state, Entity body) {
  const double mass = mass_now(world, state, body);
  return 0.5 * mass * state.velocity[body].squaredNorm() + potential(world, body, state.position[body]);
}

}  // namespace

Differences larger(const Differences& a, const Differences& b) {
  return {max(a.position, b.position), max(a.velocity, b.velocity), max(a.energy, b.energy), max(a.missed, b.missed),
          max(a.invented, b.invented)};
}

Differences differences(const World& world, const RecordedRun& reference, const RecordedRun& run,
                        const vector<double>& instants, double until) {
  const Matching matching(world, reference, run, until);
  Differences most;
  most.missed = matching.missed();
  most.invented = matching.invented();

  for (size_t k = 0; k < instants.size() && instants[k] <= until; ++k) {
    const State &there = reference.states[k], &here = run.states[k];
    Sum energy;
    bool all_count = true;
    for (Entity body = 0; body < world.body_count(); ++body) {
      most.position = max(most.position, (here.position[body] - there.position[body]).norm());
      if (!matching.same_side(body, instants[k])) {
        all_count = false;
        continue;
      }
      most.velocity = max(most.velocity, (here.velocity[body] - there.velocity[body]).norm());
      energy.add(body_energy(world, here, body));
      energy.add(-body_energy(world, there, body));
    }
    // Forces between bodies have an energy of them all.
    if (all_count && has_couplings(world)) {
      energy.add(coupled_forces(world, here).potential(here.position).sum());
      energy.add(-coupled_forces(world, there).potential(there.position).sum());
    }
    most.energy = max(most.energy, std::abs(energy.value()));
  }
  return most;
}

}  // namespace carom
