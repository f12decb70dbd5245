// Between two instants the last collision counts. Its place follows from the path since then, which is a parabola
// unless forces bend it.
#include "render/motion_samples.h"

#include "physics/body_now.h"
#include "physics/coupled_forces.h"
#include "std.h"

namespace carom {
namespace {

/// With as many, no body of a film moves far between two of them.
constexpr int64_t most_instants = 1025;
constexpr int64_t fewest_instants = 9;
constexpr int64_t most_samples = int64_t{1} << 19;

/// The bodies that the scene's camera frames.
vector<Entity> framed_bodies(const Scene& scene) {
  vector<Entity> bodies;
  const Entity count = scene.world.body_count();
  if (scene.camera && !scene.camera->fit_on.empty()) {
    for (const Entity e : scene.camera->fit_on)
      if (e < count) bodies.push_back(e);
  } else {
    for (Entity body = 0; body < count; ++body) bodies.push_back(body);
  }
  return bodies;
}

}  // namespace

int64_t worthwhile_instants(Entity bodies) {
  return clamp(most_samples / max<int64_t>(bodies, 1), fewest_instants, most_instants);
}

MotionSamples::MotionSamples(const Scene& scene)
    : scene_(scene),
      known_(scene.world),
      world_(known_.at({})),
      flies_freely_(scene.world.forces.empty() && scene.world.strings.empty() && !has_couplings(scene.world)),
      bodies_(framed_bodies(scene)),
      struck_(scene.world.body_count(), -infinity) {}

void MotionSamples::strike(span<const Collision> collisions) {
  for (const Collision& collision : collisions) {
    if (collision.kind == CollisionKind::rest) continue;
    struck_[collision.a] = collision.time;
    const Entity second = scene_.world.second_body(collision.b);
    if (second != no_entity) struck_[second] = collision.time;
  }
}

/// Whether the body's path since `time` (s) is known well enough.
bool MotionSamples::may_go_back(const State& state, Entity body, double time) const {
  return flies_freely_ || (state.time - time) * state.velocity[body].norm() < radius_now(world_, state, body);
}

void MotionSamples::add(const State& state) {
  known_.at(state.fired);
  const double before = times_.empty() ? -infinity : times_.back();
  times_.push_back(state.time);

  if (velocities_.empty())
    for (const Entity body : bodies_) velocities_.push_back(state.velocity[body]);

  for (size_t i = 0; i < bodies_.size(); ++i) {
    const Entity body = bodies_[i];
    const Vec3 change = state.velocity[body] - exchange(velocities_[i], state.velocity[body]);
    if (is_gone(state, body)) {
      samples_.push_back({state.position[body], 0});
      impulses_.push_back(-1);
      continue;
    }

    Vec3 center = state.position[body];
    const double time = struck_[body], mass = mass_now(scene_.world, state, body);
    const bool strikes = time > before && time <= state.time;
    if (strikes && may_go_back(state, body, time)) {
      const double since = state.time - time;
      center -= since * state.velocity[body] - 0.5 * since * since * scene_.world.gravity;
    }
    samples_.push_back({center, radius_now(scene_.world, state, body) / scene_.world.radius[body]});
    const Vec3 fall = times_.size() > 1 ? Vec3((state.time - before) * scene_.world.gravity) : Vec3::Zero();
    impulses_.push_back(strikes ? float(mass * (change - fall).norm()) : -1);
  }
}

Volume MotionSamples::volume(size_t instant, size_t i) const {
  Volume volume = scene_.world.volume_of(bodies_[i]);
  volume.half *= of(instant, i).scale;
  return volume;
}

}  // namespace carom
