#include "simulate/step_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "physics/force.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

namespace {

using Track = std::vector<std::vector<Vec3>>;  // m, by instant, by body

Track run(const World& world, const State& initial, const ExactOptions& options, const std::function<void()>& look) {
  const auto simulator = make_exact_simulator(world, initial, options);
  Track track;
  for (int k = 1; k <= instants; ++k) {
    const double time = k == instants ? options.duration : options.duration * k / instants;
    while (simulator->time() < time) {
      look();
      simulator->advance_to(time);
    }
    track.push_back(simulator->state().position);
  }
  return track;
}

double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

}  // namespace

StepChoice choose_step(const World& world, const State& initial, ExactOptions options, double tolerance,
                       const std::function<void()>& look) {
  options.record_collisions = false;
  const double fine = default_step(world, initial);
  StepChoice best{fine, std::numeric_limits<double>::infinity(), 0};
  if (options.duration == 0) return {fine, 0};
  Track last;
  std::string trouble;
  double step = std::min(options.duration, longest_choice * fine);
  for (int halving = 0, vain = 0; halving < most_halvings && vain < most_vain_halvings; ++halving, step *= 0.5) {
    if (options.duration / step * static_cast<double>(world.body_count()) > most_steps) break;
    options.step = step;
    Track track;
    try {
      track = run(world, initial, options, look);
    } catch (const SimulationError& error) {  // too long a step for these forces, perhaps
      trouble = error.what();
      last.clear();
      continue;
    }
    if (last.empty()) {
      last = std::move(track);
      continue;
    }
    StepChoice choice{step, 0};
    for (int k = 0; k < instants; ++k) {
      const double apart = difference(track[k], last[k]);
      choice.difference = std::max(choice.difference, apart);
      if (!(apart <= tolerance))
        choice.chaotic_from = std::min(choice.chaotic_from, options.duration * (k + 1) / instants);
    }
    if (choice.difference <= tolerance) return choice;
    const double longer = choice.chaotic_from - best.chaotic_from;
    // It gains if differences fall, or if at this rate they will be gone in a few halvings.
    const bool gains = choice.difference < 0.5 * best.difference ||
                       (longer > 0 && options.duration - choice.chaotic_from <= few_halvings * longer);
    vain = gains ? 0 : vain + 1;
    if (longer > 0 || (longer == 0 && choice.difference < best.difference)) best = choice;
    last = std::move(track);
  }
  if (best.difference == std::numeric_limits<double>::infinity() && !trouble.empty()) throw SimulationError(trouble);
  if (last.empty())
    throw SimulationError(fmt::format(
        "the forces change so fast that even steps of {:.4g} s take more than {:g} steps of bodies: shorten "
        "simulate.duration, or name a simulate.step in place of the tolerance",
        std::min(options.duration, longest_choice * fine), most_steps));
  return best;
}

}  // namespace carom
