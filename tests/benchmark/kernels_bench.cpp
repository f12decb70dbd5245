// Cost of single laws of motion and impact. Each kernel runs over the same thousand random inputs.
#include <benchmark/benchmark.h>

#include <random>

#include "geometry/contact_time.h"
#include "physics/impact.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr size_t inputs = 1024;
constexpr double horizon = 100;  // s

/// Numbers in [low, high), the same on every machine.
class Random {
 public:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  Vec3 vector(double size) {
    const double x = in(-size, size), y = in(-size, size), z = in(-size, size);
    return {x, y, z};
  }

 private:
  std::mt19937_64 bits_{8};
};

/// Calls kernel(i) for every input, over and over, and counts inputs.
template <typename Kernel>
void over_inputs(benchmark::State& state, Kernel kernel) {
  for (auto _ : state) {
    for (size_t i = 0; i < inputs; ++i) {
      benchmark::DoNotOptimize(kernel(i));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(inputs));
}

/// Pairs of unit diameter, 2 to 4 diameters apart, that approach head on within `offset` diameters (1: grazing).
vector<RelativeMotion> approaching_pairs(double offset, const Vec3& acceleration) {
  Random random;
  vector<RelativeMotion> pairs(inputs);
  for (RelativeMotion& pair : pairs) {
    pair.w = random.vector(1);
    const Vec3 along = pair.w.normalized(), aside = random.vector(1).cross(along).normalized();
    pair.d = -random.in(2, 4) * along + random.in(0, offset) * aside;
    pair.a = acceleration;
    pair.speeds = 2;
    pair.just_separated = false;
  }
  return pairs;
}

void sphere_sphere(benchmark::State& state, double offset, const Vec3& acceleration) {
  const auto pairs = approaching_pairs(offset, acceleration);
  over_inputs(state, [&](size_t i) { return sphere_contact_time(pairs[i], 1, horizon); });
}
BENCHMARK_CAPTURE(sphere_sphere, hits, 0.99, Vec3(0, 0, 0));
BENCHMARK_CAPTURE(sphere_sphere, hits_and_misses, 2, Vec3(0, 0, 0));
BENCHMARK_CAPTURE(sphere_sphere, quartic, 2, Vec3(0, -9.80665, 0));

void sphere_plane(benchmark::State& state) {
  Random random;
  vector<Vec3> gap_speed(inputs);
  for (Vec3& input : gap_speed) {
    input = {random.in(0, 2), random.in(-3, 3), -9.80665};
  }
  over_inputs(state, [&](size_t i) {
    return plane_contact_time(gap_speed[i].x(), gap_speed[i].y(), gap_speed[i].z(), 1e-15, false, horizon);
  });
}
BENCHMARK(sphere_plane);

void sphere_wall(benchmark::State& state) {
  Random random;
  vector<Vec3> x(inputs), v(inputs);
  for (size_t i = 0; i < inputs; ++i) {
    x[i] = random.vector(1) + Vec3(0, 0, 2);
    v[i] = random.vector(1) - Vec3(0, 0, 2);
  }
  const Wall wall{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1, {}};
  over_inputs(state, [&](size_t i) {
    return wall_contact_time(wall, x[i], v[i], Vec3(0, -9.80665, 0), 0.1, no_feature, horizon).time;
  });
}
BENCHMARK(sphere_wall);

void impact(benchmark::State& state) {
  Random random;
  vector<Vec3> masses_speed(inputs);
  for (Vec3& input : masses_speed) {
    input = {random.in(1, 2), random.in(1, 2), random.in(0, 1)};
  }
  over_inputs(state, [&](size_t i) {
    return impact_impulse(masses_speed[i].x(), masses_speed[i].y(), masses_speed[i].z(), 0.5 * masses_speed[i].z());
  });
}
BENCHMARK(impact);

}  // namespace
}  // namespace carom
