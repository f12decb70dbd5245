#include "benchmark/peers/cases.h"

#include <cmath>
#include <memory>

#include "physics/world.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "simulate/exact.h"

namespace carom {
namespace {

/// In closed form: a ball that falls on the floor y = 0. Impact n ends a flight that began with the speed u e^(n-1).
Truth bouncing(const Scene& scene) {
  return [&scene, state = scene.initial](double time) mutable -> const State& {
    const Vec3 start = scene.initial.position[0];
    const double g = -scene.world.gravity.y(), e = scene.world.restitution[0], radius = scene.world.radius[0];
    const double across = scene.initial.velocity[0].x(), fall = std::sqrt(2 * (start.y() - radius) / g);

    double height = start.y(), speed = -g * time;  // until the first impact
    if (time > fall) {
      double began = fall, up = e * g * fall;
      while (up > 1e-9 && time - began > 2 * up / g) began += 2 * up / g, up *= e;
      const double t = time - began;
      height = up > 1e-9 ? radius + up * t - g * t * t / 2 : radius;
      speed = up > 1e-9 ? up - g * t : 0;
    } else {
      height -= g * time * time / 2;
    }

    state.position[0] = {start.x() + across * time, height, start.z()};
    state.velocity[0] = {across, speed, 0};
    return state;
  };
}

/// In closed form: a row along x whose first ball alone moves, at the speed v. Ball i goes from when it is struck until
/// it strikes the next.
Truth handing_on(const Scene& scene) {
  return [&scene, state = scene.initial](double time) mutable -> const State& {
    const Vec3 v = scene.initial.velocity[0];
    double struck = 0;
    for (std::size_t i = 0; i < scene.initial.position.size(); ++i) {
      const Vec3& x = scene.initial.position[i];
      const bool last = i + 1 == scene.initial.position.size();
      const double gap = last ? HUGE_VAL : scene.initial.position[i + 1].x() - x.x() - 2 * scene.world.radius[i];

      const double strikes = struck + gap / v.x();
      const bool moves = time >= struck && time < strikes;
      state.velocity[i] = moves ? v : Vec3(0, 0, 0);
      state.position[i] = x + v * (time < struck ? 0 : moves ? time - struck : strikes - struck);

      struck = strikes;
    }
    return state;
  };
}

/// By the exact simulator, which is right to rounding as long as positions are compared.
Truth computed(const Scene& scene) {
  ExactOptions options;
  options.duration = 1e6;
  options.record_collisions = false;
  std::shared_ptr<Simulator> simulator = make_exact_simulator(scene.world, scene.initial, options);
  return [simulator](double time) -> const State& {
    while (simulator->time() < time) simulator->advance_to(time);
    return simulator->state();
  };
}

Scene scene_of(const std::string& file, const std::vector<std::string>& set = {}) {
  LoadOptions options;
  options.set = set;
  return load_scene(SOURCE_DIR "/" + file, options);
}

}  // namespace

std::vector<Case> cases_named(const std::string& name) {
  const std::string here = "tests/benchmark/peers/";
  const auto wanted = [&](const std::string& other) { return other.starts_with(name); };
  const double frame = 1.0 / 60;
  std::vector<Case> cases;

  if (wanted("bounce")) cases.push_back({"bounce", scene_of("scenes/bouncing_ball.yaml"), 3, frame, 3, 10, bouncing});
  if (wanted("bounce_elastic"))
    cases.push_back({"bounce_elastic", scene_of("scenes/bouncing_ball.yaml", {"balls.ball.restitution=1"}), 10, frame,
                     10, 10, bouncing});
  if (wanted("cradle")) cases.push_back({"cradle", scene_of(here + "cradle.yaml"), 1, frame, 1, 10, handing_on});

  if (wanted("cradle_gap")) {
    const std::vector<std::string> apart = {"balls.b.position.x=0.015625", "balls.c.position.x=0.15625",
                                            "balls.d.position.x=0.296875", "balls.e.position.x=0.4375"};
    cases.push_back({"cradle_gap", scene_of(here + "cradle.yaml", apart), 1, frame, 1, 10, handing_on});
  }

  const std::string gas = "scenes/benchmark/gas_1000.yaml";
  if (wanted("gas_1000")) cases.push_back({"gas_1000", scene_of(gas), 0.5, 1.0 / 960, frame, 10, computed});
  if (wanted("gas_10000")) {
    const std::string room = "min=[-1.3573,-1.3573,-1.3573]", top = "max=[1.3573,1.3573,1.3573]";
    const std::vector<std::string> large = {"groups.gas.count=10000", "room." + room, "room." + top,
                                            "groups.gas.in." + room, "groups.gas.in." + top};
    cases.push_back({"gas_10000", scene_of(gas, large), 0.1, 1.0 / 960, frame, 10, computed});
  }

  if (wanted("settling")) cases.push_back({"settling", scene_of(here + "settling.yaml"), 10, frame, 0, 25});
  return cases;
}

}  // namespace carom
