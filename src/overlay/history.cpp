// The end of a body's bounces is a record without an impact. It counts for paths and for nothing else.
#include "overlay/history.h"

#include "physics/world.h"
#include "scene/caption.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

OverlayNeeds overlay_needs(const Scene& scene) {
  return scene.output.pictures() ? picture_needs(scene) : OverlayNeeds{};
}

OverlayNeeds picture_needs(const Scene& scene) {
  const Overlay& overlay = scene.overlay;
  const bool trails = overlay.trails.has_value();
  const bool parabolas = trails && goes_along_parabolas(scene.world, scene.simulate);
  OverlayNeeds needs;
  needs.paths = parabolas;
  needs.states = trails && !parabolas;
  needs.collisions = overlay.flash || needs.states || colors_by_collisions(scene);
  needs.collision_counts = has_name(overlay.caption, "collisions");
  return needs;
}

History::History(const Scene& scene, const OverlayNeeds& needs) : scene_(scene), needs_(needs) {
  const Entity bodies = scene.world.body_count();
  const bool by_collisions = needs_.collisions && colors_by_collisions(scene);
  if (by_collisions) counts_.assign(bodies, 0);
  if (scene.overlay.flash && needs_.collisions) last_.assign(bodies, no_collision);
  if (!needs_.paths && !needs_.states) return;
  const Trails& trails = *scene.overlay.trails;
  tracks_.emplace(bodies, trails.on, trails.seconds);
  if (by_collisions) recent_.resize(bodies);
  if (needs_.states) sampler_.emplace(scene.world, *tracks_, trails.seconds);
}

void History::count(Entity body, double time) {
  if (!scene_.world.is_body(body)) return;
  if (!counts_.empty()) ++counts_[body];
  if (!last_.empty()) last_[body] = time;
  if (recent_.empty()) return;
  vector<double>& times = recent_[body];
  const auto kept = std::lower_bound(times.begin(), times.end(), time - scene_.overlay.trails->seconds);
  if (2 * (kept - times.begin()) > times.end() - times.begin()) times.erase(times.begin(), kept);
  times.push_back(time);
}

void History::record(span<const Collision> collisions) {
  if (!needs_.collisions) return;
  for (const Collision& collision : collisions) {
    if (collision.kind == CollisionKind::rest) continue;
    count(collision.a, collision.time);
    count(scene_.world.second_body(collision.b), collision.time);
  }
  if (sampler_) sampler_->record(collisions);
}

void History::record_paths(span<const PathPiece> pieces) {
  if (needs_.paths) tracks_->add(pieces);
}

double History::next_sample() const {
  return sampler_ ? sampler_->next() : infinity;
}

void History::sample(const State& state) {
  if (sampler_) sampler_->sample(state);
}

uint64_t History::collisions_of(Entity body, double time) const {
  if (counts_.empty()) return 0;
  if (recent_.empty()) return counts_[body];
  const vector<double>& times = recent_[body];
  return counts_[body] - uint64_t(times.end() - std::upper_bound(times.begin(), times.end(), time));
}

}  // namespace carom
