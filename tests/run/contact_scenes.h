#pragma once
// Random scenes of bodies in lasting contact, on strings and rods, and at far places, with their true motion: by an
// independent method (simulate/constrained_reference.h), or impact by impact in 64-bit mantissas.

#include "engine/engine.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "simulate/constrained_reference.h"
#include "simulate/random.h"
#include "std.h"

namespace carom {

struct SceneWithTruth {
  string what{};
  Scene scene{};
  vector<Vec3> end{};  // m, by body, at the end of scene.simulate.duration

  /// m: of a run with these steps, at the end.
  double error(const StepChoice& steps = {}) const {
    const auto simulator = make_simulator(scene, {}, steps);
    while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
    double most = 0;
    for (size_t k = 0; k < end.size(); ++k) most = std::max(most, (simulator->state().position[k] - end[k]).norm());
    return most;
  }
};

class ContactScenes {
 public:
  explicit ContactScenes(uint64_t seed) : random_(seed), kind_(static_cast<int>(seed % 8)) {}

  /// None: the reference ends at once.
  optional<SceneWithTruth> make() {
    at_ = random_(0, 1) < 0.5 ? Vec3(Vec3::Zero()) : far_place();
    reference_.origin = at_;
    reference_.has_floor = false;
    gravity_ = Vec3(0, -9.75, 0);

    switch (kind_) {
      // Hanging from a point.
      case 0:
        return pendulum(decades(-7, 0));
      case 1:
        return conical();
      case 2:
        return chain();

      // Off something round.
      case 3:
        return off_a_globe();
      case 4:
        return off_a_ball();
      case 5:
        return train();

      // Between flats, and from impact to impact.
      case 6:
        return ladder();
      default:
        return bouncing();
    }
  }

 private:
  using Real = ConstrainedReference::Real;
  using Vec = ConstrainedReference::Vec;

  double decades(double from, double to) { return pow(10.0, random_(from, to)); }
  Vec3 far_place() {
    Vec3 place = Vec3::Zero();
    for (double& x : place)
      if (random_(0, 1) < 0.7) x = (random_(0, 1) < 0.5 ? -1 : 1) * decades(0, 6);
    return place;
  }

  void ball(const Vec3& x, double radius, double mass, const Vec3& v = Vec3::Zero()) {
    reference_.start.push_back(at_ + x);
    reference_.velocity.push_back(v);
    reference_.radius.push_back(radius);
    reference_.mass.push_back(mass);
    reference_.force.push_back(gravity_);
  }

  Scene scene_of(double duration, double e) const {
    Scene scene;
    scene.world.gravity = gravity_;

    for (size_t k = 0; k < reference_.mass.size(); ++k) {
      scene.world.mass.push_back(reference_.mass[k]);
      scene.world.radius.push_back(reference_.radius[k]);
      scene.world.restitution.push_back(e);
    }

    scene.initial.position = reference_.start;
    scene.initial.velocity = reference_.velocity;
    for (const auto& [point, normal] : reference_.flats) scene.world.planes.push_back({point, normal, nullopt});
    for (const auto& [center, radius] : reference_.globes)
      scene.world.obstacles.push_back({center, Volume::sphere(radius), nullopt});

    for (const ConstrainedReference::Tie& tie : reference_.ties) {
      const bool anchored = tie.other == ConstrainedReference::none;
      const Vec3 end = anchored ? tie.anchor : reference_.start[static_cast<size_t>(tie.other)];
      scene.world.strings.push_back({static_cast<Entity>(tie.body),
                                     anchored ? no_entity : static_cast<Entity>(tie.other), tie.anchor,
                                     (reference_.start[tie.body] - end).norm(), 0, tie.rod});
    }

    scene.simulate.duration = duration;
    return scene;
  }

  optional<SceneWithTruth> follow(const string& what, double duration, double step, double e = 0) {
    ConstrainedReference::Motion motion = reference_.follow(duration, step);
    if (!(motion.time > 0.05 * duration)) return {};
    // Until halved steps make no difference, or that of rounding.
    for (double before = 1, off = 0.1; off > 1e-14 + 0x1p-51 * at_.norm() && off <= 0.1 * before;) {
      step *= 0.5;
      const ConstrainedReference::Motion finer = reference_.follow(motion.time, step);
      if (finer.time < motion.time) return {};
      before = exchange(off, 0);
      for (size_t k = 0; k < motion.x.size(); ++k) off = std::max(off, (finer.x[k] - motion.x[k]).norm());
      motion = finer;
    }
    return SceneWithTruth{what, scene_of(motion.time, e), motion.x};
  }

  optional<SceneWithTruth> pendulum(double angle) {
    const double length = decades(-1, 1), turn = random_(0, 6);
    const Vec3 out(std::cos(turn), 0, std::sin(turn)), down(0, -1, 0);
    ball(length * (std::sin(angle) * out + std::cos(angle) * down), length * decades(-3, -1), decades(-2, 2),
         random_(0, 0.5) * angle * sqrt(9.75 * length) * out.cross(down));
    reference_.ties.push_back({0, ConstrainedReference::none, at_});
    const double swing = 2 * M_PI * sqrt(length / 9.75);
    return follow("pendulum", decades(-0.5, 1.3) * swing, swing / 32);
  }

  optional<SceneWithTruth> conical() {
    const double length = decades(-1, 1), angle = random_(0.1, 1.2), turn = random_(0, 6);
    const Vec3 out(std::cos(turn), 0, std::sin(turn)), down(0, -1, 0);
    const double rate = sqrt(9.75 / (length * std::cos(angle)));
    ball(length * (std::sin(angle) * out + std::cos(angle) * down), length * decades(-3, -1), decades(-2, 2),
         rate * length * std::sin(angle) * out.cross(down));
    reference_.ties.push_back({0, ConstrainedReference::none, at_});
    return follow("conical pendulum", decades(1, 2.3) / rate, 0.2 / rate);
  }

  optional<SceneWithTruth> chain() {
    const bool rods = random_(0, 1) < 0.5;
    const int n = 2 + static_cast<int>(random_(0, 3));
    Vec3 x = Vec3::Zero();
    for (int k = 0; k < n; ++k) {
      const double angle = random_(-1, 1), turn = random_(-0.5, 0.5), length = random_(0.2, 1);
      x += length * Vec3(std::sin(angle) * std::cos(turn), -std::cos(angle), std::sin(angle) * std::sin(turn));
      ball(x, 0.01, decades(-1, 1));
      reference_.ties.push_back({static_cast<size_t>(k), k == 0 ? ConstrainedReference::none : k - 1, at_, rods});
    }
    return follow(rods ? "chain of rods" : "chain of strings", random_(0.2, 0.6), 1.0 / 256);
  }

  optional<SceneWithTruth> off_a_globe() {
    const double globe = decades(-1, 1), radius = globe * decades(-2, 0), sum = globe + radius;
    const double angle = decades(-9, -0.5);
    ball(sum * Vec3(std::sin(angle), std::cos(angle), 0), radius, decades(-2, 2));
    reference_.globes.push_back({at_, globe});
    const double time = sqrt(sum / 9.75);
    return follow("ball on a globe", (random_(0.2, 1) * log(4 / angle) + 0.3) * time, 0.05 * time);
  }

  optional<SceneWithTruth> off_a_ball() {
    const double lower = decades(-1, 0), upper = decades(-1, 0), sum = lower + upper, angle = decades(-8, -0.3);
    reference_.flats.push_back({at_, {0, 1, 0}});
    ball({0, lower, 0}, lower, decades(-1, 1));
    ball(Vec3(0, lower, 0) + sum * Vec3(std::sin(angle) * 0.6, std::cos(angle), std::sin(angle) * 0.8), upper,
         decades(-1, 1));
    const double time = sqrt(sum / 9.75);
    return follow("ball on a ball", random_(0.2, 1.2) * log(4 / angle) * time, 0.05 * time);
  }

  optional<SceneWithTruth> train() {
    const auto n = 2 + static_cast<size_t>(random_(0, 4));
    const double globe = 5, r = 0.25, out = globe + r, turn = 2 * std::asin(r / out), first = decades(-5, -0.5);
    reference_.globes.push_back({at_, globe});
    for (size_t k = 0; k < n; ++k) {
      const double angle = first + static_cast<double>(k) * turn;
      ball(out * Vec3(std::sin(angle), std::cos(angle), 0), r, random_(0.5, 2));
    }
    return follow("train on a globe", random_(0.5, 3), 1.0 / 64);
  }

  optional<SceneWithTruth> ladder() {
    const double length = decades(-1, 1), radius = length * decades(-3, -1), angle = decades(-7, -0.1);
    reference_.flats.push_back({at_, {0, 1, 0}});
    reference_.flats.push_back({at_, {1, 0, 0}});
    ball({radius, radius + length * std::cos(angle), 0}, radius, decades(-1, 1));
    ball({radius + length * std::sin(angle), radius, 0}, radius, decades(-1, 1));
    reference_.ties.push_back({0, 1, Vec3::Zero(), true});
    const double time = sqrt(length / 9.75);
    return follow("ladder", random_(0.2, 1.2) * log(4 / angle) * time, 0.05 * time);
  }

  /// A ball bounces on a fixed one without loss.
  optional<SceneWithTruth> bouncing() {
    const double globe = decades(-1, 0), radius = globe * decades(-1, 0), sum = globe + radius;
    const double offset = decades(-10, -1) * sum, drop = random_(0.5, 1) * sum;
    const double time = sqrt(2 * drop / 9.75);

    ball({offset, sum + drop, 0}, radius, 1);
    reference_.globes.push_back({at_, globe});
    SceneWithTruth of{"bouncing ball", scene_of(random_(1, 14) * time, 1), {}};

    // From contact to contact: a scan for the first sign of the gap, then bisection.
    const Vec far = at_.cast<Real>(), g = gravity_.cast<Real>();
    Vec x = reference_.start[0].cast<Real>() - far, v = Vec::Zero();
    const Real both = static_cast<Real>(globe) + radius, scan = 1e-3L * time;
    Real left = of.scene.simulate.duration;
    const auto gap = [&](Real t) { return (x + t * v + 0.5L * t * t * g).norm() - both; };

    for (;;) {
      Real t = scan;
      while (t < left && gap(t) > 0) t += scan;
      if (t >= left) break;

      Real from = t - scan;
      for (int pass = 0; pass < 70; ++pass) (gap(0.5L * (from + t)) > 0 ? from : t) = 0.5L * (from + t);
      x += t * v + 0.5L * t * t * g;
      v += t * g;

      const Vec n = x.normalized();
      v -= 2 * n.dot(v) * n;
      left -= t;
    }

    of.end = {(far + x + left * v + 0.5L * left * left * g).cast<double>()};
    return of;
  }

  Random random_;
  int kind_;
  Vec3 at_ = Vec3::Zero();       // m: where the scene is
  Vec3 gravity_ = Vec3::Zero();  // m/s^2
  ConstrainedReference reference_;
};

}  // namespace carom
