// Cost of a collision in the exact simulator. Balls on a face-centred cubic lattice are set free in a room, with e = 1.
// Their number (one to a million), their density and other content of the scene vary. Each line is measured in a
// process of its own, which is warmed up first. The CPU time is the median of three such processes. A hash of the final
// state follows the time: equal hashes are equal results, bit for bit.
//
//    carom_gas                 the table, as CSV
//    carom_gas K COLLISIONS    4 K^3 balls at density 0.5, so many collisions a ball after the warm-up, in this process
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <random>

#include "bench/state_hash.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "std.h"

namespace carom {
namespace {

struct Gas {
  string name;
  int cells;                 // 4 cells^3 balls, unless
  size_t most = ~size_t{0};  // of them are fewer
  size_t still = 0;          // and so many stand still, far from the room
  double density = 0.5;      // balls per cubed diameter
  double gravity = 0;        // m/s^2; balls weigh 1 kg, are 1 m wide and about 1 m/s fast along each axis
  bool shuffled = false;     // numbered in no order of places
  bool large = false;        // one of radius 15 m among them
  double collisions = 10;    // a ball
};

struct Result {
  uint64_t collisions, all, hash;  // those measured, and with those before
  double seconds;                  // of CPU
  double bytes;                    // a ball, with the scene
};

size_t moving(const Gas& gas) {
  const auto cells = static_cast<size_t>(gas.cells);
  return std::min(gas.most, 4 * cells * cells * cells);
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss);
}

void fill(const Gas& gas, World& world, State& start) {
  std::mt19937_64 bits(7);
  const auto unit = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  const auto normal = [&] {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += unit();
    return sum;
  };

  const double pitch = std::cbrt(4 / gas.density), side = pitch * gas.cells;
  const Vec3 middle = Vec3::Constant(side / 2);
  constexpr double large = 15;

  const auto put = [&](const Vec3& x, const Vec3& v, double radius) {
    world.mass.push_back(8 * radius * radius * radius);
    world.radius.push_back(radius);
    world.restitution.push_back(1);
    start.position.push_back(x);
    start.velocity.push_back(v);
  };

  const size_t balls = moving(gas);
  for (auto* values : {&world.mass, &world.radius, &world.restitution}) values->reserve(balls + 1);
  for (auto* values : {&start.position, &start.velocity}) values->reserve(balls + 1);

  // A close packing of spheres, with a hole for the large one.
  if (gas.large) put(middle, Vec3::Zero(), large);
  for (int z = 0; z < gas.cells; ++z)
    for (int y = 0; y < gas.cells; ++y)
      for (int x = 0; x < gas.cells; ++x)
        for (const Vec3& in_cell : {Vec3(1, 1, 1), Vec3(1, 3, 3), Vec3(3, 1, 3), Vec3(3, 3, 1)}) {
          const Vec3 at = pitch * (Vec3(x, y, z) + 0.25 * in_cell);
          const double vx = normal(), vy = normal(), vz = normal();
          if (start.position.size() == gas.most || (gas.large && (at - middle).norm() < large + 0.5)) continue;
          put(at, Vec3(vx, vy, vz), 0.5);
        }

  if (gas.shuffled)
    for (size_t i = start.position.size() - 1; i > 0; --i)
      std::swap(start.position[i], start.position[bits() % (i + 1)]);
  for (size_t i = 0; i < gas.still; ++i) put(Vec3(-1000 - 2 * static_cast<double>(i), 0, 0), Vec3::Zero(), 0.5);

  world.gravity = Vec3(0, -gas.gravity, 0);
  for (int k = 0; k < 3; ++k) {
    world.planes.push_back({Vec3::Zero(), Vec3::Unit(k), 1.0});
    world.planes.push_back({Vec3::Constant(side), -Vec3::Unit(k), 1.0});
  }
}

Result run(const Gas& gas) {
  const double before = peak_bytes();
  const size_t balls = moving(gas);
  World world;
  State start;
  fill(gas, world, start);

  ExactOptions options;
  options.duration = 1e9;
  options.record_collisions = false;
  const auto simulator = make_exact_simulator(world, start, options);

  const auto go_on = [&](double a_ball) {
    const uint64_t until =
        simulator->tally().collisions() + static_cast<uint64_t>(a_ball * 0.5 * static_cast<double>(balls));

    // By Enskog's rate of collisions, until there are enough of them.
    const double packed = gas.density * 3.14159265358979 / 6;
    const double rate = 0.5 * gas.density * 3.14159265358979 * 1.6 * 1.414 * (1 - packed / 2) / pow(1 - packed, 3);
    while (simulator->tally().collisions() < until) {
      const double to = simulator->time() + std::max(0.02 * a_ball, 100 / static_cast<double>(balls)) / rate;
      while (simulator->time() < to) simulator->advance_to(to);
    }
  };

  go_on(std::min(4.0, gas.collisions));
  const uint64_t first = simulator->tally().collisions();
  const double from = cpu_seconds();
  go_on(gas.collisions);

  Result result{};
  result.seconds = cpu_seconds() - from;
  result.all = simulator->tally().collisions();
  result.collisions = result.all - first;
  result.bytes = (peak_bytes() - before) / static_cast<double>(world.body_count());
  result.hash = hash_of(simulator->state());
  return result;
}

/// The same in its own process, so that memory is in the state of a new program.
Result run_apart(const Gas& gas) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    const Result result = run(gas);
    _exit(write(ends[1], &result, sizeof(result)) == sizeof(result) ? 0 : 1);
  }

  close(ends[1]);
  Result result{};
  if (read(ends[0], &result, sizeof(result)) != sizeof(result)) std::abort();
  close(ends[0]);

  waitpid(child, nullptr, 0);
  return result;
}

void measure(const Gas& gas) {
  vector<Result> results;
  for (int k = 0; k < 3; ++k) results.push_back(run_apart(gas));
  ranges::sort(results, [](const Result& p, const Result& q) { return p.seconds < q.seconds; });
  const Result& median = results[1];
  fmt::print("{},{},{},{},{:.3f},{:.0f},{:016x}\n", gas.name, moving(gas) + gas.still, gas.density, median.collisions,
             1e6 * median.seconds / static_cast<double>(median.collisions), median.bytes, median.hash);
  std::fflush(stdout);
}

int table() {
  fmt::print("gas,balls,density,collisions,cpu_us_per_collision,bytes_per_ball,hash\n");

  measure({.name = "plain", .cells = 1, .most = 1, .collisions = 100'000});
  for (const int cells : {1, 2, 4, 7, 14, 30, 63})
    measure({.name = "plain",
             .cells = cells,
             .collisions = cells < 4    ? 10'000.0
                           : cells < 14 ? 200.0
                           : cells < 30 ? 40.0
                           : cells < 63 ? 8.0
                                        : 3.0});

  for (const double density : {0.01, 0.03, 0.1, 0.3, 0.8, 1.0})
    measure({.name = "plain", .cells = 14, .density = density});

  measure({.name = "ten", .cells = 2, .most = 10, .collisions = 20'000});
  measure({.name = "ten of 10000", .cells = 2, .most = 10, .still = 9990, .collisions = 20'000});
  measure({.name = "gravity", .cells = 14, .gravity = 0.04, .collisions = 40});
  measure({.name = "base", .cells = 30});
  measure({.name = "radii 1:30", .cells = 30, .large = true});
  measure({.name = "shuffled", .cells = 30, .shuffled = true});
  return 0;
}

}  // namespace
}  // namespace carom

int main(int count, char** arguments) {
  if (count < 3) return carom::table();
  const carom::Result result =
      carom::run({.name = "plain", .cells = std::atoi(arguments[1]), .collisions = std::atof(arguments[2])});
  fmt::print("{} collisions after a warm-up, {:.3f} us of CPU each; {} in all, hash {:016x}\n", result.collisions,
             1e6 * result.seconds / static_cast<double>(result.collisions), result.all, result.hash);
}
