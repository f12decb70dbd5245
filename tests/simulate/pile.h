#pragma once
// Balls of 1 m and 1 kg, thrown a little out of a wide lattice above the floor of a box, e = 0.5: a pile.
#include <gtest/gtest.h>

#include "simulate/build.h"
#include "std.h"

namespace carom {

/// `side` x `side` balls a layer, in a box of 1.15 m by ball and side.
inline Problem loose_pile(int side, int layers, double duration) {
  Problem problem;
  problem.world.gravity = Vec3(0, -9.80665, 0);
  const double pitch = 1.15, width = side * pitch;

  uint64_t state = 12345;
  const auto off = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return 0.1 * (static_cast<double>(state >> 11) * 0x1p-53 - 0.5);
  };

  for (int k = 0; k < layers; ++k)
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const double x = off(), y = off(), z = off();
        problem.ball({(i + 0.5) * pitch + x, 0.6 + 1.2 * k + y, (j + 0.5) * pitch + z}, Vec3::Zero(), 1, 0.5, 0.5);
      }

  problem.plane({0, 0, 0}, {0, 1, 0});
  problem.plane({0, 0, 0}, {1, 0, 0});
  problem.plane({width, 0, 0}, {-1, 0, 0});
  problem.plane({0, 0, 0}, {0, 0, 1});
  problem.plane({0, 0, width}, {0, 0, -1});

  problem.options.duration = duration;
  problem.options.record_collisions = false;
  return problem;
}

/// By body: whether it slides on a level surface without other contacts. Without friction this never ends.
inline vector<uint8_t> gliding(const World& world, Simulator& simulator) {
  const State& state = simulator.state();
  vector<uint8_t> glides(world.body_count());
  for (Entity a = 0; a < world.body_count(); ++a)
    glides[a] = state.velocity[a].squaredNorm() > 0 && state.velocity[a].y() == 0;
  for (const ContactForce& c : simulator.contacts())
    if (world.is_body(c.b)) glides[c.a] = glides[c.b] = 0;
  return glides;
}

/// J, of all other bodies.
inline double energy_of_pile(const World& world, Simulator& simulator) {
  const vector<uint8_t> glides = gliding(world, simulator);
  double energy = 0;
  for (Entity a = 0; a < world.body_count(); ++a)
    if (!glides[a]) energy += 0.5 * world.mass[a] * simulator.state().velocity[a].squaredNorm();
  return energy;
}

/// At these times only sliding bodies move, to the last bit, and nothing overlaps. Before, no overlap exceeds
/// `deepest_ever` (m). The contact forces on each ball balance its weight, except for the share `unbalanced`.
/// So many balls may glide, and one of a hundred: between balls at rest they bounce ever more slowly, without end.
inline void expect_pile_at_rest(const Problem& problem, Simulator& simulator, const vector<double>& times,
                                double deepest_ever = 1e-9, double unbalanced = 1e-9, double still = 0,
                                int gliders = 0) {
  const World& world = problem.world;
  const Entity n = world.body_count(), floor = n;

  vector<Vec3> first;
  // Nothing moves any more.
  for (double t : times) {
    go_to(simulator, t);
    const State& state = simulator.state();
    const vector<uint8_t> glides = gliding(world, simulator);
    EXPECT_LE(energy_of_pile(world, simulator), still) << t;
    EXPECT_LE(ranges::count(glides, 1), gliders + static_cast<int>(n) / 100) << t;
    if (first.empty()) first = state.position;
    // A body stopped by linear drag is at the end of its path, to rounding.
    for (Entity a = 0; a < n; ++a) {
      if (!glides[a]) {
        EXPECT_LE((state.position[a] - first[a]).norm(), still == 0 ? 0 : 2e-15) << t;
      }
    }
  }

  const State& state = simulator.state();
  double deepest = 0;
  for (Entity a = 0; a < n; ++a) {
    for (Entity b = 0; b < a; ++b) deepest = std::max(deepest, 1 - (state.position[a] - state.position[b]).norm());
    for (const Plane& p : world.planes) deepest = std::max(deepest, 0.5 - (state.position[a] - p.point).dot(p.normal));
  }

  EXPECT_LT(deepest, 1e-9);
  EXPECT_LT(simulator.tally().max_overlap, deepest_ever);

  // The forces balance the weights.
  vector<Vec3> held(n, world.gravity);
  double on_floor = 0;
  for (const ContactForce& c : simulator.contacts()) {
    EXPECT_GT(c.force, 0);
    if (!world.is_body(c.b)) {
      held[c.a] += c.force * world.plane(c.b).normal;
      if (c.b == floor) on_floor += c.force;
      continue;
    }
    const Vec3 normal = (state.position[c.b] - state.position[c.a]).normalized();
    held[c.a] -= c.force * normal;
    held[c.b] += c.force * normal;
  }

  double worst = 0;
  for (const Vec3& a : held) worst = std::max(worst, a.norm());
  EXPECT_LT(worst, unbalanced * 9.80665);
  EXPECT_NEAR(on_floor / (n * 9.80665), 1, unbalanced);

  EXPECT_EQ(simulator.tally().resting, n);
  std::printf("deepest overlap %.2g m, forces off by %.2g g, floor force by %.2g of the weight\n", deepest,
              worst / 9.80665, on_floor / (n * 9.80665) - 1);
}

}  // namespace carom
