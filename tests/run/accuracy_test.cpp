// A tolerance gives steps that meet it, or a warning that it is not met.
#include "engine/accuracy.h"

#include <gtest/gtest.h>

#include <tuple>

#include "physics/world.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/long_kepler.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

constexpr auto no_stop_check = [] {};

Scene scene_of(Simulate simulate) {
  Scene scene;
  scene.simulate = simulate;
  scene.world.gravity = Vec3::Zero();
  return scene;
}

void add_ball(Scene& scene, const Vec3& x, const Vec3& v, double radius) {
  scene.world.mass.push_back(1);
  scene.world.radius.push_back(radius);
  scene.world.restitution.push_back(1);
  scene.initial.position.push_back(x);
  scene.initial.velocity.push_back(v);
}

Simulate stepped(double duration, double tolerance, Integrator integrator = Integrator::dop853) {
  Simulate simulate;
  simulate.duration = duration;
  simulate.engine = Engine::stepped;
  simulate.integrator = integrator;
  simulate.tolerance = tolerance;
  return simulate;
}

Vec3 end_of(const Scene& scene, const EngineChoice& engine) {
  const auto simulator = make_simulator(scene, {}, engine.steps);
  while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
  return simulator->state().position[0];
}

/// Softened so little that the motion is Kepler's to the last digit, but without a closed form for the engine.
void attract(Scene& scene, double mu, double softening) {
  scene.world.forces.push_back({Attractor{Vec3::Zero(), mu, softening}});
}

TEST(Accuracy, OfOrbitsIsTheRequestedTolerance) {
  SLOW_WITH_SANITIZERS();
  for (const double e : {0.0, 0.5, 0.9, 0.99, 0.999})
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
      Scene scene = scene_of(stepped(20 * M_PI + 1, tolerance));
      add_ball(scene, {1 + e, 0, 0}, {0, sqrt((1 - e) / (1 + e)), 0}, 1e-3);
      attract(scene, 1, 1e-12 * (1 - e));
      EngineChoice engine = choose_engine(scene);
      settle_steps(scene, engine, no_stop_check);
      const LongKepler kepler(1, scene.initial.position[0], scene.initial.velocity[0]);
      const double off = (end_of(scene, engine) - kepler.at(scene.simulate.duration)).norm();
      EXPECT_TRUE(off < tolerance || !engine.shortfall.empty()) << e << ": " << off << ", " << engine.why;
      // Ten passages at 45 m/s: rounding alone exceeds 1e-9 m.
      EXPECT_TRUE(engine.shortfall.empty() || (e > 0.99 && tolerance < 1e-8)) << e << ": " << engine.shortfall;
    }
}

TEST(Accuracy, OfFlybysIsTheRequestedToleranceByAnyIntegrator) {
  for (const double b : {1e-1, 1e-3, 1e-5})
    for (const Integrator integrator : {Integrator::dop853, Integrator::rk4}) {
      Scene scene = scene_of(stepped(0.2, 1e-3, integrator));
      add_ball(scene, {-1, b, 0}, {10, 0, 0}, 0.01);
      attract(scene, 1e-4, 0);
      EngineChoice engine = choose_engine(scene);
      settle_steps(scene, engine, no_stop_check);
      const LongKepler kepler(1e-4, scene.initial.position[0], scene.initial.velocity[0]);
      const double off = (end_of(scene, engine) - kepler.at(0.2)).norm();
      EXPECT_TRUE(off < 1e-3 || !engine.shortfall.empty()) << b << ": " << off << ", " << engine.why;
      EXPECT_TRUE(engine.shortfall.empty() || (integrator == Integrator::rk4 && b < 1e-4)) << b;
    }
}

TEST(Accuracy, OfAMethodsStepsIsTheToleranceToo) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    Scene scene = scene_of(stepped(10, tolerance, Integrator::rk4));
    add_ball(scene, {1, 0, 0}, {0, 0, 0}, 0.1);
    scene.world.forces = {{Spring{Vec3::Zero(), 4, 0, 0}}};
    EngineChoice engine = choose_engine(scene);
    settle_steps(scene, engine, no_stop_check);
    EXPECT_EQ(engine.shortfall, "");
    EXPECT_NEAR(end_of(scene, engine).x(), std::cos(20), tolerance);
  }
}

// Both of two runs cross the window in one step, which neither may treat as exact.
TEST(Accuracy, OfAMomentOfStrongDragIsTheToleranceToo) {
  for (const auto& [speed, quadratic, duration] : {std::tuple(5.0, 2e8, 1.0), std::tuple(1000.0, 1e6, 1000.0)})
    for (const double tolerance : {1e-3, 1e-6}) {
      Scene scene = scene_of(stepped(duration, tolerance));
      add_ball(scene, {0, 0, 0}, {speed, 0, 0}, 0.1);
      Force drag{Drag{0, quadratic, Vec3::Zero()}};
      drag.from = 0.25;
      drag.until = 0.25 + 1e-9;
      scene.world.forces = {drag};

      EngineChoice engine = choose_engine(scene);
      settle_steps(scene, engine, no_stop_check);

      // Braked for the moment, then as fast as before its end.
      const double w = drag.until - drag.from, f = quadratic * speed * w;
      const double end = speed * 0.25 + std::log1p(f) / quadratic + speed / (1 + f) * (duration - drag.until);
      EXPECT_TRUE(engine.shortfall.empty()) << engine.shortfall;
      EXPECT_NEAR(end_of(scene, engine).x(), end, tolerance) << speed;
    }
}

Scene crowd(double duration, double tolerance) {
  Scene scene = scene_of(stepped(duration, tolerance));
  for (int k = 0; k < 12; ++k)  // balls among balls: errors grow tenfold at each collision
    add_ball(scene, {-0.75 + 0.5 * (k % 4), -0.5 + 0.5 * (k / 4), 0.01 * k}, {std::cos(k), std::sin(3 * k), 0.3}, 0.15);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 normal = -side * Vec3::Unit(axis);
      scene.world.planes.push_back({side * Vec3::Unit(axis), normal, 1.0});
    }
  scene.world.forces = {{Spring{Vec3::Zero(), 1, 0, 0}}};
  return scene;
}

TEST(Accuracy, OfChaosEndsAndIsReported) {
  SLOW_WITH_SANITIZERS();
  const Scene scene = crowd(60, 1e-6);
  EngineChoice engine = choose_engine(scene);
  settle_steps(scene, engine, no_stop_check);
  EXPECT_TRUE(engine.growth.chaotic);
  EXPECT_GT(engine.growth.lyapunov_time, 0.1);
  EXPECT_LT(engine.growth.lyapunov_time, 5);
  EXPECT_GT(engine.right_until, 2);
  EXPECT_LT(engine.right_until, 40);
  EXPECT_NE(engine.shortfall.find("chaotic"), string::npos) << engine.shortfall;
}

// Its disturbance is large long before the first eighth of the run is over.
TEST(Accuracy, FindsChaosThatIsOverEarlyInARun) {
  SLOW_WITH_SANITIZERS();
  const double lyapunov_time = growth_of(crowd(60, 1e-6), crowd(60, 1e-6).simulate, {}, no_stop_check).lyapunov_time;
  const Scene scene = crowd(1000, 1e-6);
  const Growth growth = growth_of(scene, scene.simulate, {}, no_stop_check);
  EXPECT_TRUE(growth.chaotic);
  EXPECT_LT(growth.large_at, 60);
  EXPECT_NEAR(growth.lyapunov_time / lyapunov_time, 1, 0.5);
}

TEST(Accuracy, DoesNotCallOrbitsChaotic) {
  SLOW_WITH_SANITIZERS();
  for (const double e : {0.0, 0.9, 0.999}) {
    Scene scene = scene_of(stepped(200 * M_PI, 1e-6));
    add_ball(scene, {1 + e, 0, 0}, {0, sqrt((1 - e) / (1 + e)), 0}, 1e-3);
    attract(scene, 1, 1e-9 * (1 - e));
    EXPECT_FALSE(growth_of(scene, scene.simulate, {}, no_stop_check).chaotic) << e;
  }
}

TEST(Accuracy, OfStiffForcesIsFoundToo) {
  SLOW_WITH_SANITIZERS();
  Scene scene = scene_of(stepped(1, 1e-6, Integrator::rk4));
  add_ball(scene, {1, 0, 0}, {0, 0, 0}, 0.1);
  scene.world.forces = {{Drag{0, 1e4, {0, 3, 0}}}};  // longer steps throw the ball to infinity
  EngineChoice engine = choose_engine(scene);
  settle_steps(scene, engine, no_stop_check);
  EXPECT_EQ(engine.shortfall, "");
}

}  // namespace
}  // namespace carom
