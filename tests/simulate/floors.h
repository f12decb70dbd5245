#pragma once
// Random level floors of many pieces, and a body, or a body with riders, that slides over them.

#include "simulate/build.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {

enum class Sliding { ball, box, cylinder };

struct Crossing {
  Problem problem;
  vector<Vec3> start;  // m, of the bodies
  Vec3 velocity;       // m/s, of all of them
};

/// A floor of tiles (boxes of random heights) and level walls side by side in two directions. On some floors a plane
/// lies too. Their edges adjoin except for rounding. A body slides on it, on `riders` boxes or cylinders with the same
/// velocity.
inline Crossing random_crossing(Sliding kind, uint64_t seed, int riders = 0) {
  Random random(seed);
  constexpr int side = 5;
  const double unit = random(0.3, 2), top = seed % 4 == 0 ? 0 : random(-2, 2), e = 0.5 * static_cast<double>(seed % 3);
  const int pieces = static_cast<int>(seed % 4);  // tiles, walls, both, both on a plane
  Crossing crossing;
  Problem& problem = crossing.problem;
  problem.world.gravity = Vec3(0, -9.80665, 0);

  const auto edges = [&] {
    vector<double> at{random(-3, 3)};
    for (int k = 0; k < side; ++k) at.push_back(at.back() + unit * random(0.5, 1.5));
    return at;
  };
  const vector<double> x = edges(), z = edges();

  // Of each cell of the grid a wall or a tile.
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const auto p = static_cast<size_t>(i), q = static_cast<size_t>(j);
      const double width = x[p + 1] - x[p], length = z[q + 1] - z[q], height = random(0.1, 1);
      const Vec3 center(x[p] + width / 2, top, z[q] + length / 2);
      if (pieces == 1 || (pieces > 1 && random(0, 1) < 0.5))
        problem.wall(center, {0, 1, 0}, width, length, {0, 0, 1});
      else
        problem.obstacle(center - Vec3(0, height / 2, 0), Volume::box({width, height, length}));
    }
  if (pieces == 3) problem.plane({0, top, 0}, {0, 1, 0});

  // From one point to another, both well on the floor.
  const auto within = [&](const vector<double>& of) { return random(of.front(), of.back()); };
  const Vec3 from(within(x), 0, within(z)), to(within(x), 0, within(z));
  const double speed = random(0.5, 3);
  problem.options.duration = std::max((to - from).norm(), 0.1) / speed;
  crossing.velocity = (to - from) / problem.options.duration;

  double y = top;
  for (int k = riders; k >= 0; --k) {
    const double r = random(0.05, 0.5), mass = std::exp2(floor(random(-3, 4)));
    const Sliding shape = k == 0 ? kind : random(0, 1) < 0.5 ? Sliding::box : Sliding::cylinder;

    crossing.start.emplace_back(from + Vec3(0, y + r, 0));
    y = crossing.start.back().y() + r;
    const Vec3& at = crossing.start.back();

    if (shape == Sliding::ball) problem.ball(at, crossing.velocity, mass, r, e);
    if (shape == Sliding::box) problem.body(Volume::box({2 * r, 2 * r, 2 * r}), at, crossing.velocity, mass, e);
    if (shape == Sliding::cylinder) problem.body(Volume::cylinder(r, 2 * r), at, crossing.velocity, mass, e);
  }
  return crossing;
}

/// The error of a crossing: "" if all go on straight without a collision.
inline string fault_of(const Crossing& crossing) {
  const Outcome run = run_exact(crossing.problem);
  double off = 0;
  for (size_t k = 0; k < crossing.start.size(); ++k)
    off = std::max(
        off, (run.end.position[k] - crossing.start[k] - crossing.problem.options.duration * crossing.velocity).norm());
  if (!run.collisions.empty()) return to_string(run.collisions.size()) + " collisions";
  if (!(off < 1e-12)) return "off by " + to_string(1e12 * off) + "e-12 m";  // measured: 1e-13
  if (run.tally.stepped_contact > 0) return "as a crowd";
  return run.tally.taken_up.impacts > 0 ? "impacts are taken up" : "";
}

}  // namespace carom
