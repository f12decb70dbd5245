// Of every scene, with its camera and without: all that collides is in the picture as it does, large enough, and not
// hidden.
#include <gtest/gtest.h>

#include "engine/engine.h"
#include "export/picture_streams.h"
#include "physics/world.h"
#include "physics/world_now.h"
#include "render/eye.h"
#include "render/moving_camera.h"
#include "render/sight.h"
#include "run/motion_sink.h"
#include "run/survey.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::testing {
namespace {

/// Of the pictures that the scene asks for.
Size size_of(const Scene& scene) {
  const Output& output = scene.requested;
  return output.video ? output.video->size : output.frames ? output.frames->size : Size{1280, 720};
}

/// The bodies of collisions, as the camera sees them.
struct Seen {
  size_t all = 0, outside = 0, hidden = 0;
  double least = 1;  // of the heights of bodies, in that of the picture
};

class Watching {
 public:
  Watching(const Scene& scene, const MovingCamera& camera)
      : scene_(scene), camera_(camera), size_(size_of(scene)), sight_(scene) {}

  void see(const State& state, const Collision& collision) {
    add(state, collision, collision.a, -1);
    const Entity second = scene_.world.second_body(collision.b);
    if (second != no_entity) add(state, collision, second, collision.kind == CollisionKind::taut ? 0 : 1);
  }
  const Seen& seen() const { return seen_; }

 private:
  void add(const State& at, const Collision& collision, Entity body, double side) {
    State state = at;
    state.time = collision.time;
    const Camera camera = camera_.at(state);
    const Eye eye(camera, size_);
    const Volume volume = scene_.world.volume_of(body);
    if (collision.kind == CollisionKind::taut) return;  // its place is not that of the body
    const Vec3 center = collision.position + side * volume.support(collision.normal) * collision.normal;
    const Vec3 place = eye.point(center);

    ++seen_.all;
    const bool inside = std::abs(place.x()) <= eye.tan_x * place.z() && std::abs(place.y()) <= eye.tan_y * place.z();
    seen_.outside += !inside;
    seen_.least = min(seen_.least, volume.half.maxCoeff() / (eye.tan_y * place.z()));
    vector<Entity> hiders =
        sight_.hiders(scene_.world, collision.time, camera.eye, eye.view, center, volume.half.maxCoeff());
    std::erase_if(hiders, [&](Entity e) {
      return ranges::binary_search(camera_.faded(), uint32_t(e - scene_.world.body_count()));
    });
    seen_.hidden += !hiders.empty();
  }

  const Scene& scene_;
  const MovingCamera& camera_;
  const Size size_;
  const Sight sight_;
  Seen seen_;
};

/// Keeps the collisions of the time that pictures show.
class Keeping final : public MotionSink {
 public:
  explicit Keeping(const Scene& scene) {
    for (const Ticks& ticks : shown_instants(scene)) {
      from_ = min(from_, ticks.at(ticks.first()));
      until_ = max(until_, ticks.at(ticks.last()));
    }
  }
  bool more() const override { return more_; }
  double time() override { return until_; }
  void record(const Simulator& simulator) override {
    for (const Collision& c : simulator.collisions())
      if (c.kind != CollisionKind::rest && c.time >= from_ && c.time <= until_) kept.push_back(c);
  }
  void sample(const Sample&) override { more_ = false; }
  void end_at(double time) override { until_ = time; }

  vector<Collision> kept;

 private:
  double from_ = infinity, until_ = 0;
  bool more_ = true;
};

/// By its camera, and by the one that frames the motion.
array<Seen, 2> seen_of(const Scene& scene) {
  Scene without = scene;
  without.camera.reset();
  MovingCamera own(scene, size_of(scene)), framing_camera(without, size_of(scene));
  MovingCamera* const cameras[] = {&own, &framing_camera};
  Framing framing(cameras);
  Keeping keeping(scene);
  MotionSink* const sinks[] = {&framing, &keeping};
  const auto simulator = make_simulator(scene, {.collisions = true});
  carry_through(*simulator, sinks, scene.simulate.duration, unguarded, {.stop_check = [] {}});
  framing.finish();

  Watching by_own(scene, own), by_framing(without, framing_camera);
  for (size_t i = 0; i < keeping.kept.size(); i += 1 + keeping.kept.size() / 20000)
    for (Watching* watching : {&by_own, &by_framing}) watching->see(simulator->state(), keeping.kept[i]);
  return {by_own.seen(), by_framing.seen()};
}

class EverySceneInView : public ::testing::TestWithParam<string> {};

/// Scenes of bodies that are tiny beside the space in which they collide, all the time and everywhere.
const array<string, 3> tiny = {"binary_stars", "effusion", "funnel"};

TEST_P(EverySceneInView, ShowsWhatCollides) {
  SLOW_WITH_SANITIZERS("balls_in_a_box", "gas_1000", "brick_wall", "pile_at_rest", "binary_stars", "hourglass",
                       "lattice", "pour_into_bowl", "pi_to_six_digits", "piston", "opening_gate", "shaken_tray",
                       "funnel");
  const Scene scene = load(GetParam());
  // In the frames of the engine book bodies overlap before they collide.
  if (scene.simulate.engine == Engine::book) return;

  const array<Seen, 2> cameras = seen_of(scene);
  for (const Seen& seen : cameras) {
    SCOPED_TRACE(&seen == &cameras.front() ? "its camera" : "without camera");
    EXPECT_EQ(seen.outside, 0u);
    EXPECT_EQ(seen.hidden, 0u);
    const double least = seen.all == 0 ? 0 : ranges::find(tiny, GetParam()) != tiny.end() ? 0.005 : 0.02;
    EXPECT_GE(seen.least, least);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneInView, ::testing::ValuesIn(scene_names()), [](const auto& parameter) {
  string name = parameter.param;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace carom::testing
