#include "benchmark/peers/measure.h"

#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <numeric>

#include "bench/state_hash.h"
#include "physics/energy.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// By a radius: the deepest overlap of two balls, found among those near along x, or of a ball and a plane.
double deepest_overlap(const World& world, const State& state) {
  const auto& x = state.position;
  const double widest = 2 * *std::max_element(world.radius.begin(), world.radius.end());
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x[i].x() < x[j].x(); });

  double deepest = 0;
  for (std::size_t m = 0; m < order.size(); ++m) {
    const std::size_t i = order[m];
    for (const Plane& plane : world.planes)
      deepest = std::max(deepest, 1 - (x[i] - plane.point).dot(plane.normal) / world.radius[i]);

    for (std::size_t n = m + 1; n < order.size() && x[order[n]].x() - x[i].x() < widest; ++n) {
      const std::size_t j = order[n];
      const double sum = world.radius[i] + world.radius[j];
      if ((x[i] - x[j]).squaredNorm() < sum * sum)
        deepest = std::max(deepest, (sum - (x[i] - x[j]).norm()) / world.radius[i]);
    }
  }
  return deepest;
}

double energy(const World& world, const State& state) {
  return kinetic_energy(world, state) + potential_energy(world, state);
}

/// kg m/s: the sum of the changes of all balls' momenta.
double exchanged(const World& world, const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) sum += world.mass[i] * (after[i] - before[i]).norm();
  return sum;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = (a[i] - b[i]).norm();
    largest = difference <= largest ? largest : difference;  // not a number counts as the largest
  }
  return largest;
}

/// s of CPU time of a run without checks, repeated until it can be measured.
double cpu_of_short_run(const Peer& peer, const Case& what, double step) {
  double sum = 0;
  int runs = 0;
  for (; runs < 3 || (sum < 0.02 && runs < 1000); ++runs) {
    const auto motion = peer.make(what.scene, step);
    const double from = cpu_seconds();
    motion->advance(static_cast<int>(std::lround(what.end / step)));
    sum += cpu_seconds() - from;
  }
  return sum / runs;
}

/// The run whose checks fill `result`; true at the end of the case.
bool run_sampled(PeerWorld& motion, const Case& what, double step, const Truth& truth, Result& result, State& state) {
  const World& world = what.scene.world;
  const double sample_interval = std::max(step, what.sample_interval);
  const int samples = static_cast<int>(std::lround(what.end / sample_interval));
  std::vector<Vec3> before = state.velocity, true_before = before;
  double given = 0, true_given = 0;

  for (int k = 1; k <= samples; ++k) {
    const double from = cpu_seconds();
    motion.advance(static_cast<int>(std::lround(sample_interval / step)));
    motion.read(state);
    result.cpu += cpu_seconds() - from;
    result.reached = state.time = k * sample_interval;

    result.end_overlap = deepest_overlap(world, state);
    result.overlap = std::max(result.overlap, result.end_overlap);
    for (std::size_t m = 0; m < settling_times.size(); ++m)
      if (std::abs(state.time - settling_times[m]) < sample_interval / 2) result.until[m] = result.cpu;

    if (truth) {
      const State& right = truth(state.time);
      if (state.time < what.horizon + sample_interval / 2)
        result.position_error = std::max(result.position_error, largest_difference(state.position, right.position));
      given += exchanged(world, before, state.velocity);
      true_given += exchanged(world, true_before, right.velocity);
      before = state.velocity;
      true_before = right.velocity;
      result.exchange = given / true_given;
    }

    if (result.cpu > what.budget) return k == samples;
  }
  return true;
}

Result run(const Peer& peer, const Case& what, double step) {
  Result result;
  const auto motion = peer.make(what.scene, step);
  if (!motion) {
    result.outcome = Outcome::beyond;
    return result;
  }

  result.until.fill(none);
  const World& world = what.scene.world;
  const Truth truth = what.truth ? what.truth(what.scene) : Truth{};
  State state = what.scene.initial;

  result.outcome = run_sampled(*motion, what, step, truth, result, state) ? Outcome::done : Outcome::stopped;
  result.kinetic = kinetic_energy(world, state);
  result.collisions = motion->collisions();
  result.hash = hash_of(state);

  if (world.gravity.norm() > 0) result.exchange = none;  // changes momentum too
  if (!truth) result.position_error = none;
  result.velocity_error = result.energy_error = none;

  if (truth) {
    const State& right = truth(result.reached);
    result.energy_error = std::abs(energy(world, state) - energy(world, right)) / energy(world, what.scene.initial);
    if (what.horizon >= what.end) result.velocity_error = largest_difference(state.velocity, right.velocity);
  }

  if (result.cpu < 0.05) result.cpu = cpu_of_short_run(peer, what, step);
  return result;
}

}  // namespace

Result measure(const Peer& peer, const Case& what, double step) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    Result result;
    try {
      result = run(peer, what, step);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", peer.name.c_str(), error.what());
    }
    _exit(write(ends[1], &result, sizeof(result)) == sizeof(result) ? 0 : 1);
  }

  close(ends[1]);
  Result result;
  if (read(ends[0], &result, sizeof(result)) != sizeof(result)) result = {};  // the peer ended the process
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return result;
}

}  // namespace carom
