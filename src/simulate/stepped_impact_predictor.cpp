#include "simulate/stepped_impact_predictor.h"

#include <algorithm>

#include "physics/path_time_of_impact.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

namespace {

/// How far a path may be from where it begins after `length` (s), along each axis (m).
Vec3 reach_of(const Path& p, double length) {
  return length * (p.v.cwiseAbs() + 0.5 * length * (p.a.cwiseAbs() + length / 3 * p.j.cwiseAbs()));
}

}  // namespace

StepImpactPredictor::StepImpactPredictor(const StepShared& shared, StepEvents& events)
    : shared_(shared), events_(events), neighbours_(shared.world), clear_until_(shared.world.body_count()) {
  for (Entity i = 0; i < shared.world.body_count(); ++i) balls_.push_back({shared.paths.x[i], shared.world.radius[i]});
  neighbours_.start(shared.paths.x);
}

void StepImpactPredictor::begin_step() {
  travelled_ += step_travel_;
  step_travel_ = 0;
}

void StepImpactPredictor::cover_path(Entity i) {
  const Path& path = shared_.paths.path[i];
  const double step = shared_.clock.length(), length = step - shared_.paths.start[i];
  const double far = reach_of(path, length).norm();
  const double rounding = path_rounding * (path.x.cwiseAbs().maxCoeff() + shared_.world.radius[i]);
  balls_[i] = {path.x, shared_.world.radius[i] + far + rounding};
  if (length > 0) step_travel_ = std::max(step_travel_, far * (step / length));
  if ((path.x - neighbours_.center(i)).norm() + far <= neighbours_.room(i)) return;
  neighbours_.cover(i, path.x, far, region_steps * step * shared_.paths.v[i]);
}

void StepImpactPredictor::predict_step() {
  for (const Entity i : shared_.awake.list()) cover_path(i);
  some_asleep_ = shared_.clusters.any_asleep();
  for (const Entity i : shared_.awake.list()) predict(i, false);
}

/// Schedules the first impact of body i with each of its neighbours. all: else only with those that do not find it
/// themselves. The contact group's bodies are kept apart by its step. Others find them, but those asleep do not.
void StepImpactPredictor::predict(Entity i, bool all) {
  const GroupMembers& group = shared_.group;
  const Clusters& clusters = shared_.clusters;
  const bool sleepers_only = !all && group.from_start(i);
  if (sleepers_only && !some_asleep_) return;
  if (!all && !neighbours_.has_news(i) && travelled_ + step_travel_ < clear_until_[i]) return;
  const Entity bodies = shared_.world.body_count();
  const PathBall* const balls = balls_.data();
  const PathBall here = balls[i];
  double nearest = never;
  for (const Entity e : neighbours_.near(i)) {
    if (e >= bodies) {
      nearest = std::min(nearest, predict_fixed(i, e, sleepers_only));
      continue;
    }
    const PathBall& there = balls[e];
    const double clear = (there.x - here.x).norm() - (here.radius + there.radius);
    nearest = std::min(nearest, clear);
    if (clear > 0) continue;  // most: what branches foresee comes first
    if (sleepers_only && !clusters.asleep(e)) continue;
    if (!all && e < i && !clusters.asleep(e) && !group.from_start(e)) continue;
    predict_pair(std::min(i, e), std::max(i, e));
  }
  clear_until_[i] = all ? 0 : travelled_ + 0.5 * nearest;
}

/// Schedules the first impact of body i with a fixed thing, unless sleepers only are looked at. m: from body i's ball
/// to it.
double StepImpactPredictor::predict_fixed(Entity i, Entity e, bool sleepers_only) {
  const World& world = shared_.world;
  const PathBall& here = balls_[i];
  const double clear = touch(world, i, here.x, e, world.fixed_position(e)).gap + world.radius[i] - here.radius;
  if (clear <= 0 && !sleepers_only) predict_pair(i, e);
  return clear;
}

/// Whether the contact group's step has kept a body and another thing apart. One that came later it has not.
bool StepImpactPredictor::kept_apart(Entity a, Entity b) const {
  const GroupMembers& group = shared_.group;
  const bool body = shared_.world.is_body(b);
  if (!group.in_step(a) || (body && !group.in_step(b))) return false;
  const auto came_later = [&](Entity i, Entity other) {
    return group.carrier(i) != no_entity && group.carrier(i) != other;
  };
  return !came_later(a, b) && !(body && came_later(b, a));
}

void StepImpactPredictor::predict_pair(Entity a, Entity b) {
  if (kept_apart(a, b) || shared_.clusters.in_contact(a, b)) return;
  const StepPaths& paths = shared_.paths;
  const bool body = shared_.world.is_body(b);
  const double base = body ? std::max(paths.start[a], paths.start[b]) : paths.start[a];
  const double length = shared_.clock.length() - base;
  const Path pa = paths.from(a, base), pb = paths.from(b, base);
  const bool left =
      paths.origin[a].partner == b && (!body || (paths.origin[b].partner == a && paths.start[a] == paths.start[b]));
  const FeatureTime first =
      time_of_impact(shared_.world, a, pa, b, pb, left ? paths.origin[a].feature : no_feature, length);
  if (!(first.time <= length)) return;
  events_.push(base + first.time, StepEventKind::impact, a, b, first.feature);
}

}  // namespace carom
