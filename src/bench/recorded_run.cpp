// Advances a simulator from instant to instant and keeps states and collisions, or only the final hash.
// Recording costs time, so timed runs use bare_run().
#include "bench/recorded_run.h"

#include <tuple>

#include "bench/state_hash.h"
#include "bench/timing.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

RecordedRun record_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                       const vector<double>& instants, const function<void()>& stop_check) {
  const double start = cpu_time();
  RecordedRun run;

  run.duration = simulate.duration;
  const auto simulator = make_simulator(world, initial, simulate, {.collisions = true}, steps);
  const auto go_to = [&](double time) {
    while (simulator->time() < time) {
      stop_check();
      simulator->advance_to(time);
      for (const Collision& c : simulator->collisions()) {
        if (c.kind == CollisionKind::rest) continue;
        run.impacts.push_back({c.time, c.approach_speed, c.a, c.b, c.impulse});
      }
    }
  };

  // Sample the run, and go on to its end.
  for (const double instant : instants) {
    go_to(instant);
    run.states.push_back(simulator->state());
  }
  go_to(simulate.duration);

  run.tally = simulator->tally();
  run.inexact_islands = simulator->effort().inexact_steps > 0 || run.tally.stepped_contact > 0;
  run.hash = hash_of(simulator->state(), run.tally);

  ranges::stable_sort(run.impacts,
                      [](const Impact& p, const Impact& q) { return tie(p.a, p.b, p.time) < tie(q.a, q.b, q.time); });
  run.cpu_s = cpu_time() - start;
  return run;
}

uint64_t bare_run(const World& world, const State& initial, const Simulate& simulate, const StepChoice& steps,
                  const function<void()>& stop_check) {
  const auto simulator = make_simulator(world, initial, simulate, {}, steps);
  while (simulator->time() < simulate.duration) {
    stop_check();
    simulator->advance_to(simulate.duration);
  }
  return hash_of(simulator->state(), simulator->tally());
}

}  // namespace carom
