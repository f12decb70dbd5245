// The same scenes in long steps of time, by every method. A run ends, no position is undefined, no bodies overlap, and
// outputs change nothing. Energy does not grow, except by Euler's method, of order 1.

#include "physics/world_now.h"
#include "simulate/exact.h"
#include "std.h"
#include "stress/check.h"
#include "stress/digits.h"
#include "stress/gaps.h"

namespace carom::stress {

namespace {

constexpr double deepest = 1e-8;    // of the smaller radius, in crowds, and
constexpr double most_gain = 1e-6;  // of the energy; measured: below 1e-7 in 1,371 scenes

struct Sampled {
  vector<State> states;
  Tally tally;
};

Sampled run(const RandomScene& scene, const ExactOptions& options, int instants) {
  const auto simulator = make_exact_simulator(scene.world, scene.initial, options);
  Sampled seen;
  simulator->advance_to(0);
  seen.states.push_back(simulator->state());
  for (int k = 1; k <= instants; ++k) {
    const double t = k == instants ? options.duration : options.duration * k / instants;
    do simulator->advance_to(t);
    while (simulator->time() < t);
    seen.states.push_back(simulator->state());
  }
  seen.tally = simulator->tally();
  return seen;
}

/// The energy (J). `size`: the sum without signs, to which its rounding is proportional.
long double energy(const World& world, const State& s, long double& size) {
  long double sum = 0;
  size = 0;
  const auto add = [&](long double part) {
    sum += part;
    size += std::abs(part);
  };

  for (Entity i = 0; i < world.body_count(); ++i) {
    const long double m = world.mass[i];
    const Long3 x = s.position[i].cast<long double>();
    add(0.5L * m * s.velocity[i].cast<long double>().squaredNorm());
    for (int axis = 0; axis < 3; ++axis) add(-m * world.gravity[axis] * x[axis]);
    for (const Force& f : world.forces) {
      if (f.from > 0 || isfinite(f.until) || !(f.on.empty() || ranges::count(f.on, i))) continue;
      for (int axis = 0; axis < 3; ++axis) add(-(per_mass(f) ? m : 1) * value(f)[axis] * x[axis]);
    }
  }
  return sum;
}

}  // namespace

Verdict check_stepped(const RandomScene& scene) {
  Verdict verdict;
  World world = scene.world;

  ExactOptions options;
  options.integrator = static_cast<Integrator>(scene.seed / 13 % 3);
  options.duration = scene.options.duration;
  const int steps = array{50, 100, 300}[scene.seed / 39 % 3];
  options.step = options.duration / steps;
  options.max_collisions = scene.options.max_collisions;
  options.record_collisions = false;

  const string what =
      "in " + to_string(steps) + " steps by method " + to_string(static_cast<int>(options.integrator)) + ": ";
  const auto fail = [&](const string& why) {
    if (verdict.violations.size() < 12) verdict.violations.push_back(what + why);
  };

  Sampled once, often;
  try {
    once = run(scene, options, 1);
    often = run(scene, options, 23);
  } catch (const SimulationError& error) {
    verdict.stopped = true;
    const bool so_many = string(error.what()).find("max_collisions") != string::npos;
    if (!scene.may_stop && !so_many) fail(error.what());
    return verdict;
  }

  set_off(world, once.tally.changes.fired);
  verdict.collisions = once.tally.collisions();
  const State &start = once.states.front(), &end = once.states.back();
  if (end.position != often.states.back().position || end.velocity != often.states.back().velocity)
    fail("outputs change where it ends");

  // All bodies are somewhere, and none overlap.
  const bool lively = any_of(world.restitution, [](double e) { return e > 1; });
  for (const State& s : often.states)
    for (Entity a = 0; a < world.body_count(); ++a) {
      if (!s.position[a].allFinite() || !s.velocity[a].allFinite()) {
        fail("body " + to_string(a) + " is nowhere at t = " + text(s.time));
        return verdict;
      }

      for (Entity b = a + 1; b < world.body_count() + world.fixed_count(); ++b) {
        const bool body = world.is_body(b);
        const Vec3 xb = body ? s.position[b] : fixed_position(world, b, {s.time, 0});
        const double depth =
            -static_cast<double>(gap(world, a, s.position[a].cast<long double>(), b, xb.cast<long double>()));
        const double size = body ? std::min(world.radius[a], world.radius[b]) : world.radius[a];
        if (!lively && depth > deepest * size + 1e-12 * s.position[a].norm())
          fail(to_string(a) + " and " + to_string(b) + " overlap by " + text(depth / size) +
               " of a radius at t = " + text(s.time));
      }
    }

  // The energy, except by Euler's method, which keeps none.
  if (lively || options.integrator == Integrator::euler) return verdict;
  long double before, after;
  const long double first = energy(world, start, before), last = energy(world, end, after);

  const double size = static_cast<double>(before + after) + once.tally.energy_lost + std::abs(once.tally.work);
  if (static_cast<double>(last - first) > once.tally.work + most_gain * size)
    fail("gains " + text(static_cast<double>(last - first) - once.tally.work) + " J of " + text(size));
  return verdict;
}

}  // namespace carom::stress
