#pragma once
// Short ways to build a world and to run it whole.

#include "physics/energy.h"
#include "physics/world.h"
#include "simulate/book.h"
#include "simulate/exact.h"
#include "simulate/simulation_error.h"
#include "std.h"

namespace carom {

/// Standard gravity, m/s^2.
inline constexpr double g_n = 9.80665;

struct Problem {
  World world;
  State initial;
  ExactOptions options;

  Problem() {
    world.gravity = Vec3::Zero();
    options.duration = 10;
  }
  Entity ball(const Vec3& x, const Vec3& v, double mass = 1, double radius = 0.5, double e = 1) {
    world.mass.push_back(mass);
    world.radius.push_back(radius);
    world.restitution.push_back(e);
    initial.position.push_back(x);
    initial.velocity.push_back(v);
    if (!world.volume.empty()) world.volume.push_back(Volume::sphere(radius));
    return world.body_count() - 1;
  }
  Entity body(const Volume& volume, const Vec3& x, const Vec3& v, double mass = 1, double e = 1) {
    for (Entity i = static_cast<Entity>(world.volume.size()); i < world.body_count(); ++i)
      world.volume.push_back(Volume::sphere(world.radius[i]));
    world.volume.push_back(volume);
    world.mass.push_back(mass);
    world.radius.push_back(volume.reach());
    world.restitution.push_back(e);
    initial.position.push_back(x);
    initial.velocity.push_back(v);
    return world.body_count() - 1;
  }
  void obstacle(const Vec3& center, const Volume& volume) { world.obstacles.push_back({center, volume, nullopt}); }
  void plane(const Vec3& point, const Vec3& normal) { world.planes.push_back({point, normal.normalized(), nullopt}); }
  void wall(const Vec3& center, const Vec3& normal, double width, double height, const Vec3& up = Vec3(0, 1, 0)) {
    const Vec3 n = normal.normalized(), u = (up - n * n.dot(up)).normalized();
    world.walls.push_back({center, n, u.cross(n), u, width / 2, height / 2, nullopt});
  }
  /// Lets a fixed thing move. All of them must be there.
  void move(Entity fixed, const vector<MotionWindow>& windows) {
    world.motions.resize(world.fixed_count());
    world.motions[fixed - world.body_count()] = motion_in_windows(windows);
  }
  void move(Entity fixed, SurfaceMotion motion) {
    world.motions.resize(world.fixed_count());
    world.motions[fixed - world.body_count()] = std::move(motion);
  }
  void room(const Vec3& min, const Vec3& max) {
    for (int k = 0; k < 3; ++k) {
      plane(min, Vec3::Unit(k));
      plane(max, -Vec3::Unit(k));
    }
  }
};

struct Outcome {
  vector<Collision> all;         // every record
  vector<Collision> collisions;  // without `rest`
  State end;
  Tally tally;
};

/// J.
inline double energy(const Problem& problem, const State& state) {
  return kinetic_energy(problem.world, state) + potential_energy(problem.world, state);
}

/// J, not accounted for by the energy balance: rounding.
inline double unbooked(const Problem& problem, const Outcome& run) {
  return energy(problem, run.end) - energy(problem, problem.initial) - run.tally.work + run.tally.energy_lost +
         run.tally.method_error;
}

/// J, not accounted for by impacts and work: the method's error, and rounding.
inline double residual(const Problem& problem, const Outcome& run) {
  return energy(problem, run.end) - energy(problem, problem.initial) - run.tally.work + run.tally.energy_lost;
}

inline Outcome run_to_end(Simulator& simulator, double duration) {
  Outcome run;
  do {
    simulator.advance_to(duration);
    for (const Collision& c : simulator.collisions()) {
      run.all.push_back(c);
      if (c.kind != CollisionKind::rest) run.collisions.push_back(c);
    }
  } while (simulator.time() < duration);
  run.end = simulator.state();
  run.tally = simulator.tally();
  return run;
}

inline Outcome run_exact(const Problem& problem) {
  const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);
  return run_to_end(*simulator, problem.options.duration);
}

/// The message of a run that fails. Empty: it does not.
inline string error_of(const Problem& problem) {
  try {
    run_exact(problem);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

/// Advances to `time` (s), in as many calls as the buffer needs.
inline void go_to(Simulator& simulator, double time) {
  do simulator.advance_to(time);
  while (simulator.time() < time);
}

/// N, between two things now; 0: they do not press on each other.
inline double force_between(Simulator& simulator, Entity a, Entity b) {
  for (const ContactForce& c : simulator.contacts())
    if (c.a == a && c.b == b) return c.force;
  return 0;
}

}  // namespace carom
