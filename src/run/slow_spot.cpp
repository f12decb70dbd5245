// A record has no speeds of a collision. The state just before it has, so that the motion is followed twice up to
// there.
#include "run/slow_spot.h"

#include "physics/body_now.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

struct Met {
  double time;  // s
  Entity a, b;  // bodies; b may be no_entity
};

class Search {
 public:
  Search(const Scene& scene, const VideoOutput& video) : scene_(scene), video_(video) {}

  optional<Met> first(Simulator& simulator, const function<void()>& stop_check) const {
    const double until = min(video_.until.value_or(scene_.simulate.duration), end_of(scene_));
    const double slice = scene_.simulate.duration / 1000;
    for (;;) {
      for (const Collision& collision : simulator.collisions())
        if (const optional<Met> met = met_in(collision, until)) return met;
      if (!(simulator.time() < until) || simulator.tally().end) return nullopt;

      stop_check();
      const double next = min(until, simulator.time() + slice);
      simulator.advance_to(next > simulator.time() ? next : until);
    }
  }

  /// `state`: just before it.
  Slowdown around(const Met& met, const State& state) const {
    double radius = radius_now(scene_.world, state, met.a);
    Vec3 relative = state.velocity[met.a];
    if (met.b != no_entity) {
      radius = min(radius, radius_now(scene_.world, state, met.b));
      relative -= state.velocity[met.b];
    }
    return {met.time, halvings_for(relative.norm(), radius, video_.speed)};
  }

 private:
  optional<Met> met_in(const Collision& collision, double until) const {
    if (collision.kind == CollisionKind::rest) return nullopt;
    if (!(collision.time >= video_.from && collision.time <= until)) return nullopt;
    const Entity other = scene_.world.second_body(collision.b);
    const Met met{collision.time, collision.a, scene_.world.is_body(other) ? other : no_entity};
    return is_sought(met.a) || is_sought(met.b) ? optional(met) : nullopt;
  }

  bool is_sought(Entity body) const {
    const SlowSettings& slow = *video_.slow;
    return body != no_entity && (slow.count == 0 || (body >= slow.first && body - slow.first < slow.count));
  }

  const Scene& scene_;
  const VideoOutput& video_;
};

}  // namespace

optional<Slowdown> find_slowdown(const Scene& scene, const function<unique_ptr<Simulator>()>& motion,
                                 const function<void()>& stop_check) {
  const bool own = scene.output.video && scene.output.video->slow;
  const Search search(scene, own ? *scene.output.video : *scene.requested.video);
  const optional<Met> met = search.first(*motion(), stop_check);
  if (!met) return nullopt;

  const unique_ptr<Simulator> before = motion();
  before->advance_to(std::nextafter(met->time, 0));
  while (before->time() < std::nextafter(met->time, 0)) before->advance_to(std::nextafter(met->time, 0));
  return search.around(*met, before->state());
}

}  // namespace carom
