// One other run of the same kind does not reveal a run's error, because both may step over the same encounter.
// A run with fixed steps is therefore compared with a method of another order that chooses its own steps (dop853).
// That method is compared with itself at a smaller error of each step.
// A perturbation by rounding in the finer run shows the error that no steps can remove.
// Comparing two runs by halved steps was rejected, because their agreement does not show what both have missed.
#include "engine/accuracy.h"

#include <fmt/format.h>

#include <bit>

#include "physics/force.h"
#include "physics/places.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "simulate/tolerances.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

namespace {

using namespace accuracy_tolerance;

/// The positions of all bodies: by instant, by body (m).
using Track = vector<vector<Vec3>>;

/// In s, of a run until `end`, and `end` itself.
vector<double> instants_of(const Scene& scene, double end) {
  vector<double> instants = uneven_instants(0, end, scene.world.body_count());
  instants.back() = end;
  return instants;
}

struct TrackedRun {
  Track track;
  Tally tally;
  /// Whether the error of its steps in islands is more than rounding.
  bool inexact_islands = false;
};

/// Runs of one scene, sampled at the same instants.
class Runs {
 public:
  Runs(const Scene& scene, const function<void()>& stop_check) : Runs(scene, stop_check, scene.simulate.duration) {}
  /// Runs until `end` (s).
  Runs(const Scene& scene, const function<void()>& stop_check, double end)
      : scene_(scene), stop_check_(stop_check), instants_(instants_of(scene, end)) {}

  TrackedRun track(const Simulate& way, const StepChoice& steps, double disturbance = 0) const {
    if (disturbance == 0) return tracked_run(scene_.world, scene_.initial, way, steps);
    const Perturbed other = perturbed(scene_.world, scene_.initial, disturbance);
    return tracked_run(other.world, other.initial, way, steps);
  }
  const vector<double>& instants() const { return instants_; }

  /// In m, by instant: the greatest distance so far between a body's positions in the two runs.
  static vector<double> differences(const TrackedRun& one, const TrackedRun& other) {
    const Track &a = one.track, &b = other.track;
    vector<double> most;
    double greatest = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      for (size_t i = 0; i < a[k].size(); ++i) greatest = max(greatest, (a[k][i] - b[k][i]).norm());
      most.push_back(greatest);
    }
    return most;
  }

 private:
  TrackedRun tracked_run(const World& world, const State& initial, const Simulate& way, const StepChoice& steps) const {
    const auto simulator = make_simulator(world, initial, way, {}, steps);
    TrackedRun run;
    for (const double time : instants_) {
      while (simulator->time() < time) {
        stop_check_();
        simulator->advance_to(time);
      }
      run.track.push_back(simulator->state().position);
    }
    run.tally = simulator->tally();
    run.inexact_islands = simulator->effort().inexact_steps > 0;
    return run;
  }

  const Scene& scene_;
  const function<void()>& stop_check_;
  vector<double> instants_;  // s
};

/// The number of instants before differences exceed a tolerance (m).
size_t within(const vector<double>& differences, double tolerance) {
  const auto beyond = ranges::find_if(differences, [&](double d) { return !(d <= tolerance); });
  return size_t(beyond - differences.begin());
}

/// Steps with clearly smaller errors. Where doubles have no smaller ones, clearly greater errors.
StepChoice finer_steps(const Scene& scene, const Simulate& way, StepChoice steps) {
  if (way.engine != Engine::book) {
    const double error = steps.error > 0 ? steps.error : exact_tolerance::step_error;
    steps.error = error / finer >= finest_error ? error / finer : error * finer;
  }
  if (way.engine == Engine::book || (way.engine == Engine::stepped && way.integrator != Integrator::dop853)) {
    const double usual = way.engine == Engine::book ? 1.0 / 60 : default_step(scene.world, scene.initial);
    steps.length = 0.5 * steps.length.value_or(way.step.value_or(usual));
  }
  return steps;
}

/// The steps with which positions are within a tolerance, and how far that holds.
struct Accuracy {
  StepChoice steps;  // of the stepped engine
  /// In m: the greatest difference of its positions from those of a finer run, within the time that both are reliable.
  double difference = 0;
  // In s: the time after which no steps give positions within the tolerance. Infinity: never.
  double right_until = infinity;
  /// In m: the difference of the finest runs after that.
  double beyond = 0;
  /// Whether the tolerance is met until then.
  bool reached = true;
};

class Settling {
 public:
  Settling(const Scene& scene, const Simulate& way, double tolerance, const function<void()>& stop_check)
      : scene_(scene), way_(way), tolerance_(tolerance), runs_(scene, stop_check) {}

  Accuracy go() {
    if (way_.duration == 0) return accuracy_;
    if (way_.engine == Engine::exact)
      settle_exact();
    else if (way_.integrator == Integrator::dop853)
      settle_adaptive(tolerance_, coarsest_error);
    else
      settle_fixed();
    return accuracy_;
  }

 private:
  /// Records until when the tolerance is met, from the differences of two runs of a kind.
  void note(const vector<double>& differences) {
    const size_t good = within(differences, tolerance_);
    accuracy_.right_until = infinity;
    accuracy_.difference = good > 0 ? differences[good - 1] : 0;
    accuracy_.beyond = differences.back();
    if (good < differences.size()) accuracy_.right_until = good > 0 ? runs_.instants()[good - 1] : 0;
  }

  void settle_exact() {
    const TrackedRun run = runs_.track(way_, {});
    if (run.inexact_islands)
      settle_adaptive(tolerance_, exact_tolerance::step_error);
    else
      note(Runs::differences(run, runs_.track(way_, {}, disturbance)));
  }

  /// Begins with step errors of `coarsest` at most. Returns the finer of the last two runs.
  TrackedRun settle_adaptive(double tolerance, double coarsest) {
    double least = infinity;  // m
    for (const double radius : scene_.world.radius) least = min(least, radius);
    StepChoice steps{way_.step, clamp(first_share * tolerance / least, finest_error, coarsest)};
    for (;;) {
      const TrackedRun coarse = runs_.track(way_, steps);
      // In islands greater errors are none, so that a finer run would not show what they are.
      if (coarse.inexact_islands && steps.error > exact_tolerance::step_error) {
        steps.error = exact_tolerance::step_error;
        continue;
      }

      const bool finest = steps.error <= finest_error * finer;
      steps.error = max(steps.error / finer, finest_error);
      TrackedRun fine = runs_.track(way_, steps, disturbance);
      const vector<double> differences = Runs::differences(coarse, fine);
      accuracy_.steps = steps;
      note(differences);

      if (differences.back() <= tolerance || finest) return fine;
      // Scale by what is still missing.
      steps.error *= min(1.0, tolerance / differences.back());
      steps.error = max(steps.error, finest_error * finer);
    }
  }

  /// Halves the step until a run agrees with that of dop853, within the time that the latter is reliable.
  void settle_fixed() {
    Simulate finer_way = way_;
    finer_way.integrator = Integrator::dop853;
    finer_way.step.reset();
    const Simulate own = exchange(way_, finer_way);
    const TrackedRun reference = settle_adaptive(reference_share * tolerance_, coarsest_error);
    way_ = own;

    const size_t known = accuracy_.right_until < scene_.simulate.duration
                             ? within(runs_.instants(), accuracy_.right_until)
                             : runs_.instants().size();
    accuracy_.reached = false;
    accuracy_.difference = infinity;
    accuracy_.steps = {};

    string trouble;
    // In m: with twice the step, and with four times the step.
    double before = 0, coarse = 0;
    double step = min(way_.duration, longest_choice * default_step(scene_.world, scene_.initial));
    const double bodies = double(scene_.world.body_count());

    for (int vain = 0; vain < most_vain_halvings && way_.duration / step * bodies <= most_steps; step *= 0.5) {
      vector<double> off;
      try {
        off = Runs::differences(runs_.track(way_, {step, 0}), reference);
        // The step may be too long for these forces.
      } catch (const SimulationError& error) {
        trouble = error.what();
        continue;
      }

      const double difference = known > 0 ? off[known - 1] : 0;
      const double steps = way_.duration / step * bodies;
      const bool out_of_reach = steps > few_steps && steps_to_go(coarse, difference) * steps > most_steps;
      coarse = exchange(before, difference);
      vain = difference <= gain * accuracy_.difference ? 0 : vain + 1;
      if (!(difference < accuracy_.difference)) continue;
      accuracy_.difference = difference;
      accuracy_.steps = {step, 0};
      if ((accuracy_.reached = difference <= tolerance_)) return;
      if (out_of_reach) break;
    }

    if (accuracy_.steps.length) return;
    if (!trouble.empty()) throw SimulationError(trouble);
    throw SimulationError(fmt::format(
        "the forces change so fast that even steps of {:.4g} s take more than {:g} steps of bodies: shorten "
        "simulate.duration, or set simulate.step instead of the tolerance",
        step, most_steps));
  }

  /// The factor by which steps must be more numerous to meet the tolerance.
  /// `difference` (m) is that of the present steps, `coarse` (m) that of a quarter of them.
  double steps_to_go(double coarse, double difference) const {
    if (!(difference > tolerance_) || !(coarse > difference)) return 1;
    return std::exp2(2 * log(difference / tolerance_) / log(coarse / difference));
  }

  const Scene& scene_;
  Simulate way_;
  double tolerance_;  // m
  Runs runs_;
  Accuracy accuracy_;
};

/// The number of instants with a small perturbation that suffices to measure its growth.
size_t enough(const vector<double>& apart) {
  return min(least_small, apart.size() / 2);
}

/// Measures growth from the distances of two runs (m) at instants (s). The first `small` of them are small.
void measure_growth(const vector<double>& instants, const vector<double>& apart, size_t small, Growth& growth) {
  const auto first = ranges::find_if(apart, [](double d) { return d > 0; });
  if (first == apart.end()) return;
  growth.factor = apart.back() / *first;
  if (small < enough(apart)) return;
  const size_t half = small / 2 - 1, between = (half + small - 1) / 2, end = small - 1;

  // The logarithm of the growth beyond the third power of time, from one instant to another.
  const auto excess = [&](size_t from, size_t to) {
    if (!(apart[from] > 0)) return 0.0;
    return log(apart[to] / apart[from]) - 3 * log(instants[to] / instants[from]);
  };
  growth.chaotic = excess(half, between) > 0 && excess(between, end) > 0;
  if (growth.chaotic) growth.lyapunov_time = (instants[end] - instants[half]) / log(apart[end] / apart[half]);
}

/// A number in [-1, -1/2] or [1/2, 1], from a fraction in [0, 1].
double away_from_zero(double fraction) {
  return fraction < 0.5 ? fraction - 1 : fraction;
}

/// The k-th such number, from irrational steps around a circle.
double irregular(double k) {
  const double x = k * golden;
  return away_from_zero(x - floor(x));
}

/// A place (m) with other last digits. Equal coordinates stay equal, and mirrored ones mirrored.
Vec3 rounded_otherwise(Vec3 place) {
  for (double& x : place) {
    // Steps of the golden section around a circle, as many as the coordinate's bits say (Knuth, The Art of Computer
    // Programming 3, 6.4).
    const uint64_t turned = std::bit_cast<uint64_t>(std::abs(x)) * 0x9e3779b97f4a7c15;
    x *= 1 + place_disturbance * away_from_zero(std::ldexp(double(turned), -64));
  }
  return place;
}

/// Describes how a run misses its tolerance; empty: it does not.
string shortfall_of(const Scene& scene, const Accuracy& accuracy, const Growth& growth) {
  const double tolerance = *scene.simulate.tolerance;
  vector<string> texts;
  if (!accuracy.reached)
    texts.push_back(fmt::format(
        "not converged: the shortest steps tried, {:.3g} s, leave an error of {:.2g} m in positions, not {} m",
        *accuracy.steps.length, accuracy.difference, tolerance));

  if (accuracy.right_until < scene.simulate.duration)
    texts.push_back(fmt::format(
        "positions are right to {} m until {:.4g} s, and differ by up to {:.2g} m later: {}", tolerance,
        accuracy.right_until, accuracy.beyond,
        growth.chaotic ? fmt::format("chaotic, a disturbance grows e-fold in {:.3g} s", growth.lyapunov_time)
                       : "not converged, though not chaotic: the motion amplifies rounding, or forces change too fast "
                         "for doubles"));
  return joined(texts, "; ");
}

}  // namespace

vector<double> uneven_instants(double from, double to, size_t bodies) {
  const int count = int(clamp(places_kept / max(double(bodies), 1.0), 8.0, double{most_instants}));
  vector<double> instants;
  for (int k = 0; k < count; ++k) instants.push_back(from + (to - from) * (k + golden) / count);
  return instants;
}

void settle_steps(const Scene& scene, EngineChoice& engine, const function<void()>& stop_check) {
  if (!scene.simulate.tolerance || engine.engine == Engine::book) return;
  Simulate way = scene.simulate;
  way.engine = engine.engine;
  const Accuracy accuracy = Settling(scene, way, *way.tolerance, stop_check).go();
  engine.steps = accuracy.steps;

  // What the steps are, and what they reach.
  vector<string> why;
  if (!engine.why.empty()) why.push_back(engine.why);
  const bool stepped = engine.engine == Engine::stepped;
  if (stepped && way.integrator != Integrator::dop853)
    why.push_back(fmt::format("{}, steps of {:.4g} s", name_of(way.integrator), *engine.steps.length));
  else if (stepped || engine.steps.error > 0)
    why.push_back(fmt::format("{} {:.1g} of a radius", stepped ? "dop853, step error" : "step error in islands",
                              engine.steps.error));
  const bool known = accuracy.right_until >= way.duration;
  if (accuracy.reached && known)
    why.push_back(fmt::format("positions agree within {:.2g} m with a finer run", accuracy.difference));
  engine.why = joined(why, "; ");

  if (!known) engine.growth = growth_of(scene, way, engine.steps, stop_check);
  engine.right_until = accuracy.right_until;
  engine.shortfall = shortfall_of(scene, accuracy, engine.growth);
}

Perturbed perturbed(const World& world, const State& initial, double share) {
  Perturbed other{world, initial};
  for (Vec3& place : other.initial.position) place = rounded_otherwise(place);
  for_each_place(other.world, [](Vec3& place) { place = rounded_otherwise(place); });
  double k = 0;
  for (Vec3& v : other.initial.velocity)
    for (double& component : v) component *= 1 + share * irregular(++k);
  for (double& mass : other.world.mass) mass *= 1 + share * irregular(++k);
  for (double& component : other.world.gravity) component *= 1 + share * irregular(++k);
  return other;
}

Assessment assess(const Scene& scene, const EngineChoice& engine, const function<void()>& stop_check) {
  Assessment assessment;
  Simulate way = scene.simulate;
  way.engine = engine.engine;
  const double least = *ranges::min_element(scene.world.radius);
  assessment.tolerance = way.tolerance.value_or(default_tolerance * least);

  const Runs runs(scene, stop_check);
  const TrackedRun run = runs.track(way, engine.steps);
  assessment.stepped_contact = run.tally.stepped_contact;
  assessment.method_error = run.tally.method_error;
  vector<double> off = Runs::differences(run, runs.track(way, engine.steps, disturbance));
  assessment.rounding = off.back();

  // The error of steps, where there are any.
  const bool inexact_flights = way.engine != Engine::exact && force_without_closed_form(scene.world) != nullptr;
  if (inexact_flights || run.inexact_islands) {
    const vector<double> finer_off = Runs::differences(run, runs.track(way, finer_steps(scene, way, engine.steps)));
    // Two runs that are the same to the last bit show no error.
    const bool unknown = !inexact_flights && finer_off.back() == 0;
    assessment.integrator = unknown ? numeric_limits<double>::quiet_NaN() : finer_off.back();
    for (size_t k = 0; k < off.size(); ++k) off[k] = max(off[k], finer_off[k]);
  }
  // Impacts at one instant: what the choice of their law changes. It is no error of the run.
  if (run.tally.shared.instants + run.tally.shared.without_room > 0) {
    StepChoice steps = engine.steps;
    steps.one_by_one = true;
    assessment.order = Runs::differences(run, runs.track(way, steps)).back();
  }

  if (const size_t good = within(off, assessment.tolerance); good < off.size())
    assessment.right_until = good > 0 ? runs.instants()[good - 1] : 0;
  assessment.growth = growth_of(scene, way, engine.steps, stop_check);
  return assessment;
}

Growth growth_of(const Scene& scene, const Simulate& way, const StepChoice& steps, const function<void()>& stop_check) {
  Growth growth;
  if (way.duration == 0 || scene.world.body_count() == 0) return growth;
  const double large = saturated * *ranges::max_element(scene.world.radius);
  // Measure only while the perturbation is small, because it cannot grow beyond the size of bodies.
  // That phase may end long before the run does. The runs are then repeated up to the end of that phase.
  for (double end = way.duration;;) {
    const Runs runs(scene, stop_check, end);
    const vector<double> apart = Runs::differences(runs.track(way, steps), runs.track(way, steps, carried_disturbance));
    const size_t small = within(apart, large);

    if (small < apart.size()) {
      growth.large_at = runs.instants()[small];
      if (small < enough(apart) && growth.large_at > clock_share * way.duration) {
        end = growth.large_at;
        continue;
      }
    }

    measure_growth(runs.instants(), apart, small, growth);
    return growth;
  }
}

}  // namespace carom
